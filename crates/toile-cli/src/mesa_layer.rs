//! Keeps Mesa's device selection layer from writing to the terminal.
//!
//! The layer asks a Wayland server which GPU is the default. On a machine without a session, as servers and containers are,
//! the Wayland library prints an error each time, which looks as if the program had failed. The layer only sorts the
//! adapters, and the program sorts them itself. It can be switched off by the environment alone, before the process starts.

/// Starts the program anew without the layer where there is no session to ask.
#[cfg(target_os = "linux")]
pub fn silence() {
    use std::env;
    use std::os::unix::process::CommandExt;
    use std::path::Path;
    use std::process::Command;

    const SWITCH: &str = "NODEVICE_SELECT";
    let session = env::var_os("XDG_RUNTIME_DIR").is_some_and(|folder| Path::new(&folder).is_absolute());
    if session || env::var_os(SWITCH).is_some() {
        return;
    }
    if let Ok(program) = env::current_exe() {
        // It returns only when it fails, and then the noise is all there is to suffer.
        let _ = Command::new(program).args(env::args_os().skip(1)).env(SWITCH, "1").exec();
    }
}

/// There is no such layer here.
#[cfg(not(target_os = "linux"))]
pub fn silence() {}
