//! What is kept of every frame while a walk is under way, so that it can go on after an interruption, bit for bit.

use super::rows::FrameRow;
use anyhow::{Context, Result, bail};
use glam::Vec3;
use std::fs;
use std::path::{Path, PathBuf};
use toile::files::write_atomically;
use toile::model::Verdict;

/// Folder of a walk that is not finished, within that of its results.
const FOLDER: &str = ".unfinished-walk";
/// File that says how the garments are worn.
const VERDICTS: &str = "verdicts.json";
/// File that says which walk it is.
const IDENTITY: &str = "identity.txt";

/// The frames of a walk on disk.
pub struct Saved {
    folder: PathBuf,
    identity: String,
}

impl Saved {
    /// Opens the frames of a walk; a new one leaves nothing on disk before its first frame.
    ///
    /// An unfinished walk is never overwritten: it is an error unless `resume` says to go on, and then it must have the same identity.
    pub fn open(out: &Path, identity: String, resume: bool) -> Result<Self> {
        let saved = Self { folder: out.join(FOLDER), identity };
        match (saved.frame_count(), resume) {
            (0, false) => Ok(saved),
            (0, true) => bail!("there is no unfinished walk in {}: leave --resume out", out.display()),
            (_, false) => bail!(
                "{} holds an unfinished walk: go on with --resume, name another folder, or delete {}",
                out.display(),
                saved.folder.display()
            ),
            (_, true) => {
                let known = saved.folder.join(IDENTITY);
                let text =
                    fs::read_to_string(&known).with_context(|| format!("{}: it cannot be read", known.display()))?;
                if text != saved.identity {
                    bail!(
                        "the unfinished walk in {} is another one: give the same options and files, or name another folder",
                        out.display()
                    );
                }
                Ok(saved)
            }
        }
    }

    /// Makes the folder of a walk that begins, without what one that lost its first frame may have left there, and keeps how the garments
    /// are worn.
    pub fn begin(&self, verdicts: &[Verdict]) -> Result<()> {
        if self.folder.exists() {
            self.remove()?;
        }
        fs::create_dir_all(&self.folder).with_context(|| format!("cannot create {}", self.folder.display()))?;
        write_atomically(&self.folder.join(VERDICTS), &serde_json::to_vec(verdicts)?)?;
        Ok(write_atomically(&self.folder.join(IDENTITY), self.identity.as_bytes())?)
    }

    /// How the garments are worn.
    pub fn verdicts(&self) -> Result<Vec<Verdict>> {
        let path = self.folder.join(VERDICTS);
        let text = fs::read(&path).with_context(|| format!("{}: it cannot be read", path.display()))?;
        serde_json::from_slice(&text).with_context(|| format!("{}: it is damaged", path.display()))
    }

    /// How many frames there are, without a gap from the first.
    pub fn frame_count(&self) -> u32 {
        (0..).take_while(|frame| self.state_path(*frame).exists()).count() as u32
    }

    /// Keeps a frame, its state and the positions of all garments [m], of a walk that has begun.
    pub fn write(&self, frame: u32, state: &[u8], positions: &[Vec<Vec3>], row: Option<&FrameRow>) -> Result<()> {
        if let Some(row) = row {
            write_atomically(&self.row_path(frame), &serde_json::to_vec(row)?)?;
        }
        for (garment, points) in positions.iter().enumerate() {
            write_atomically(&self.points_path(frame, garment), bytemuck::cast_slice(points))?;
        }
        // The state last: a frame counts once it is there.
        Ok(write_atomically(&self.state_path(frame), state)?)
    }

    /// The state of a frame.
    pub fn state(&self, frame: u32) -> Result<Vec<u8>> {
        let path = self.state_path(frame);
        fs::read(&path).with_context(|| format!("{}: it cannot be read", path.display()))
    }

    /// The error of a state that is none: what the user can do.
    pub fn damaged(&self, frame: u32) -> String {
        let path = self.state_path(frame);
        format!("{}: delete it, and --resume goes on from the frame before", path.display())
    }

    /// Positions of a garment in a frame [m].
    pub fn positions(&self, frame: u32, garment: usize) -> Result<Vec<Vec3>> {
        let path = self.points_path(frame, garment);
        let bytes = fs::read(&path).with_context(|| format!("{}: it cannot be read", path.display()))?;
        if bytes.len() % size_of::<Vec3>() != 0 {
            bail!("{}: it is damaged", path.display());
        }
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }

    /// The rows of the frames from 1 to `last`.
    pub fn rows(&self, last: u32) -> Result<Vec<FrameRow>> {
        let row = |frame| {
            let path = self.row_path(frame);
            let text = fs::read(&path).with_context(|| format!("{}: it cannot be read", path.display()))?;
            serde_json::from_slice(&text).with_context(|| format!("{}: it is damaged", path.display()))
        };
        (1..=last).map(row).collect()
    }

    /// Deletes what was kept: the walk is finished.
    pub fn remove(&self) -> Result<()> {
        fs::remove_dir_all(&self.folder).with_context(|| format!("{}: it cannot be deleted", self.folder.display()))
    }

    fn state_path(&self, frame: u32) -> PathBuf {
        self.folder.join(format!("{frame:06}.state"))
    }

    fn points_path(&self, frame: u32, garment: usize) -> PathBuf {
        self.folder.join(format!("{frame:06}_{garment}.points"))
    }

    fn row_path(&self, frame: u32) -> PathBuf {
        self.folder.join(format!("{frame:06}.json"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_walk_goes_on_only_where_and_as_it_was() {
        let out = tempfile::tempdir().expect("a folder");
        let open = |resume, identity: &str| Saved::open(out.path(), identity.to_owned(), resume);
        let told = |resume, identity| open(resume, identity).map(|_| ()).map_err(|e| e.to_string());
        assert!(told(true, "a").is_err_and(|e| e.contains("no unfinished walk")));
        let saved = open(false, "a").expect("a new walk");
        assert_eq!(fs::read_dir(out.path()).expect("a folder").count(), 0, "nothing is written before its first frame");
        let points = vec![vec![Vec3::X], vec![Vec3::Y, Vec3::Z]];
        saved.begin(&[Verdict::default()]).expect("begun");
        saved.write(0, b"state", &points, None).expect("written");
        assert!(told(false, "a").is_err_and(|e| e.contains("--resume")), "nothing is overwritten");
        assert!(told(true, "b").is_err_and(|e| e.contains("another one")));
        assert_eq!(told(true, "a"), Ok(()));

        saved.write(2, b"later", &points, None).expect("written");
        assert_eq!(saved.frame_count(), 1, "frame 1 is missing");
        assert_eq!(saved.state(0).expect("read"), b"state");
        assert_eq!(saved.positions(0, 1).expect("read"), points[1]);
        assert_eq!(saved.verdicts().expect("read"), [Verdict::default()]);

        let path = saved.points_path(0, 1);
        let bytes = fs::read(&path).expect("there");
        fs::write(&path, &bytes[..bytes.len() - 3]).expect("cut short");
        assert!(saved.positions(0, 1).is_err_and(|e| e.to_string().contains("damaged")));

        let path = saved.state_path(0);
        fs::remove_file(&path).expect("deleted");
        let anew = open(false, "b").expect("without its first frame it begins anew");
        anew.begin(&[]).expect("begun");
        anew.write(0, b"anew", &points, None).expect("written");
        assert!(!anew.state_path(2).exists(), "what the other one left is gone");
        assert_eq!(told(true, "b"), Ok(()));
        saved.remove().expect("removed");
        assert!(told(true, "a").is_err());
    }
}
