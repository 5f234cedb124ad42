//! Writes the WGSL of every kernel, imports resolved, into a folder: what other compilers of WGSL are given to read.

use std::path::Path;
use std::{env, fs, io};
use toile_kernels::{TABLE, render_sides_source};

fn main() -> io::Result<()> {
    let folder = env::args().nth(1).ok_or_else(|| io::Error::other("usage: resolved FOLDER"))?;
    let folder = Path::new(&folder);
    if folder.is_dir() {
        // A kernel that is gone must not be read any more.
        fs::remove_dir_all(folder)?;
    }
    fs::create_dir_all(folder)?;
    for row in TABLE {
        fs::write(folder.join(format!("{}.wgsl", row.kernel.name())), row.kernel.source())?;
    }
    fs::write(folder.join("render_sides.wgsl"), render_sides_source())
}
