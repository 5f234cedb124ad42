//! Taichi's cloth example as a process of its own.

use crate::Ended;
use crate::settings::TaichiSettings;
use std::fs;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};
use toile_lab::peers::{Course, Trial};

/// A run of `taichi_cloth.py`. Its import and compilation count against the limit, and not among the frames.
///
/// # Errors
/// What it said, in a line, when it failed or its answer cannot be read.
pub fn course(
    python: &Path,
    trial: &Trial,
    settings: TaichiSettings,
    frames: u32,
    limit: Duration,
) -> Result<Ended, String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("peers-{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(|error| format!("{} cannot be made: {error}", folder.display()))?;
    let ended = run(python, trial, settings, frames, limit, &folder);
    // It holds nothing that anyone misses.
    let _ = fs::remove_dir_all(&folder);
    ended
}

fn run(
    python: &Path,
    trial: &Trial,
    settings: TaichiSettings,
    frames: u32,
    limit: Duration,
    folder: &Path,
) -> Result<Ended, String> {
    let [start, output, said, faults] =
        ["start.f32", "frames.f32", "said.txt", "faults.txt"].map(|name| folder.join(name));
    let bytes: Vec<u8> = trial.positions().iter().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes).collect();
    fs::write(&start, bytes).map_err(|error| format!("{} cannot be written: {error}", start.display()))?;
    let scene = &trial.scene.settings;
    let mut command = Command::new(python);
    command.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/peers/taichi_cloth.py"));
    command.arg("--start").arg(&start).arg("--output").arg(&output);
    let numbers = [
        ("--n", f64::from(trial.n)),
        ("--frames", f64::from(frames)),
        ("--substeps", f64::from(settings.substeps)),
        ("--frame-seconds", trial.frame_seconds()),
        ("--stiffness", settings.stiffness),
        ("--gravity", -scene.gravity.y),
        ("--damping", scene.fabric.damping),
        ("--radius", trial.sphere.map_or(0.0, |sphere| sphere.radius)),
        ("--friction", trial.sphere.map_or(0.0, |sphere| sphere.friction)),
    ];
    for (option, number) in numbers {
        command.args([option, &number.to_string()]);
    }
    if trial.is_held() {
        command.arg("--held");
    }
    let file = |path: &PathBuf| {
        File::create(path).map_err(|error| format!("{} cannot be written: {error}", path.display())).map(Stdio::from)
    };
    // Into files: a pipe that nobody reads would stop it.
    command.stdin(Stdio::null()).stdout(file(&said)?).stderr(file(&faults)?);
    let mut child = command.spawn().map_err(|error| {
        format!("{} cannot run ({error}): `-- --make-environments` makes its environment anew", python.display())
    })?;
    let Some(status) = wait(&mut child, limit)? else { return Ok(Ended::Late) };
    let read = |path: &PathBuf| fs::read(path).unwrap_or_default();
    if !status.success() {
        let words = String::from_utf8_lossy(&read(&faults)).into_owned();
        let last = words.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it says nothing");
        return Err(format!(
            "Taichi ended with {status} ({last}): `-- --make-environments` makes its environment anew"
        ));
    }
    let said = String::from_utf8_lossy(&read(&said)).into_owned();
    let told = Course::told(&said, &read(&output), trial.n as usize, frames as usize);
    let (_, course) = told.map_err(|error| format!("Taichi's answer is not readable: {error}"))?;
    Ok(Ended::Whole(course))
}

/// Waits until it ends; stops it at the limit.
fn wait(child: &mut Child, limit: Duration) -> Result<Option<ExitStatus>, String> {
    let start = Instant::now();
    loop {
        match child.try_wait().map_err(|error| format!("Taichi cannot be waited for: {error}"))? {
            Some(status) => return Ok(Some(status)),
            None if start.elapsed() > limit => {
                // It may have ended by itself just now.
                let _ = child.kill();
                let _ = child.wait();
                return Ok(None);
            }
            None => std::thread::sleep(Duration::from_millis(50)),
        }
    }
}
