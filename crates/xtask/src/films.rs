//! The films of the documentation: motions that are made for the built-in body, in garments of the fixtures.

use crate::{command, ensure_adapter, run, say, target};
use std::fs;
use std::path::Path;

/// One film.
struct Film {
    /// Name of its file.
    name: &'static str,
    /// Option `--motion` of `toile walk`.
    motion: &'static str,
    /// File in `fixtures/garments`.
    garment: &'static str,
}

const FILMS: [Film; 5] = [
    Film { name: "corner_dress", motion: "corner", garment: "dress" },
    Film { name: "corner_trousers", motion: "corner", garment: "trousers" },
    Film { name: "arms_folded", motion: "arms-folded", garment: "shirt_sleeves" },
    Film { name: "sitting", motion: "sitting", garment: "skirt" },
    Film { name: "pirouette", motion: "pirouette", garment: "circle_skirt" },
];

/// Options of every film: few enough pictures, and small ones, so that a page with all films loads.
const OPTIONS: &[&str] = &["--spacing", "2.5cm", "--fps", "15", "--height", "260", "--view", "three-quarter"];

/// Larger films than this make a page slow [bytes].
const LARGEST: u64 = 1_500_000;

/// Makes the films of these names, or all of them: `docs/films` gets the pictures, `target/films` keeps frames and metrics.
pub fn make(toile: &Path, names: &[String]) -> Result<(), String> {
    if let Some(unknown) = names.iter().find(|name| FILMS.iter().all(|film| film.name != name.as_str())) {
        let known = FILMS.map(|film| film.name).join(", ");
        return Err(format!("there is no film {unknown}; there is: {known}"));
    }
    ensure_adapter(toile, "")?;
    for film in FILMS.iter().filter(|film| names.is_empty() || names.iter().any(|name| name == film.name)) {
        let folder = target()?.join("films").join(film.name);
        if folder.exists() {
            fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        }
        let garment = format!("fixtures/garments/{}.json", film.garment);
        let mut walk = command(&toile.display().to_string(), &["walk", "--motion", film.motion, "--garment", &garment]);
        walk.args(OPTIONS).arg("--out").arg(&folder);
        run(walk)?;
        let (from, to) = (folder.join("walk.gif"), format!("docs/films/{}.gif", film.name));
        let size = fs::copy(from, &to).map_err(|error| format!("{to}: {error}"))?;
        if size > LARGEST {
            return Err(format!("{to} has {size} bytes, more than {LARGEST}"));
        }
        say(&format!("wrote {to}, {} kB", size / 1000));
    }
    Ok(())
}
