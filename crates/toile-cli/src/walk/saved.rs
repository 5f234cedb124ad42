//! What is kept of every frame while a walk is under way, so that it can go on after an interruption, bit for bit.

use super::rows::FrameRow;
use crate::adapter::Gpu;
use anyhow::{Context, Result, bail};
use glam::{Vec3, Vec4};
use std::fs;
use std::path::{Path, PathBuf};
use toile::Cloth;
use toile::files::write_atomically;
use toile::gpu::readback;
use toile::model::Model;

/// Folder of a walk that is not finished, within that of its results.
const FOLDER: &str = ".unfinished-walk";
/// File that says which walk it is.
const IDENTITY: &str = "identity.txt";

/// The state of a garment as the device holds it: arrays of vec4.
#[derive(Clone, Debug, PartialEq)]
pub struct GarmentState {
    /// Positions and inverse masses, velocities and masses, each of shape [particle_count]; contacts, two per particle; what the limits
    /// pulled with, four in each, or none where they have not pulled yet.
    arrays: [Vec<Vec4>; 4],
}

impl GarmentState {
    /// A garment that stands still and touches nothing yet.
    pub fn at_rest(positions: &[Vec3]) -> Self {
        let zeros = vec![Vec4::ZERO; positions.len()];
        let positions = positions.iter().map(|p| p.extend(0.0)).collect();
        Self { arrays: [positions, zeros.clone(), [zeros.clone(), zeros].concat(), Vec::new()] }
    }

    /// Reads the state of a garment.
    pub fn download(gpu: &Gpu, cloth: &Cloth) -> Result<Self> {
        let contacts = cloth.contacts().context("a garment on a body has contacts")?;
        let read = |buffer| readback::read_vec4s(&gpu.device, &gpu.queue, buffer);
        let impulses = cloth.limit_impulses().map_or(Ok(Vec::new()), read)?;
        Ok(Self { arrays: [read(&cloth.frame().positions)?, read(cloth.velocities())?, read(contacts)?, impulses] })
    }

    /// Writes it to the device; the masses are those of the model.
    pub fn upload(&self, gpu: &Gpu, cloth: &Cloth, model: &Model) -> Result<()> {
        let [positions, velocities, contacts, impulses] = &self.arrays;
        let count = model.positions.len();
        if [positions.len(), velocities.len(), contacts.len()] != [count, count, 2 * count] {
            bail!("the saved walk has {} particles where the garment has {count}: start anew", positions.len());
        }
        let places = cloth.limit_impulses().filter(|_| !impulses.is_empty());
        if places.is_some_and(|places| places.size() != 16 * impulses.len() as u64) {
            bail!("the saved walk has other limits than the garment: start anew");
        }
        let with = |values: &[Vec4], w: &[f32]| -> Vec<Vec4> {
            values.iter().zip(w).map(|(value, w)| value.truncate().extend(*w)).collect()
        };
        let write = |buffer: &wgpu::Buffer, values: &[Vec4]| {
            gpu.queue.write_buffer(buffer, 0, bytemuck::cast_slice(values));
        };
        write(&cloth.frame().positions, &with(positions, &model.inverse_masses));
        write(cloth.velocities(), &with(velocities, &model.masses));
        write(cloth.contacts().context("a garment on a body has contacts")?, contacts);
        if let Some(places) = places {
            write(places, impulses);
        }
        Ok(())
    }

    /// Positions [m], shape [particle_count].
    pub fn positions(&self) -> Vec<Vec3> {
        self.arrays[0].iter().map(|position| position.truncate()).collect()
    }

    /// Which particles are in contact, shape [particle_count].
    pub fn touching(&self) -> impl Iterator<Item = bool> {
        self.arrays[2].chunks_exact(2).map(|contact| contact[0].w > 0.0)
    }
}

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

    /// Makes the folder of a walk that begins, without what one that lost its first frame may have left there.
    fn begin(&self) -> Result<()> {
        if self.folder.exists() {
            self.remove()?;
        }
        fs::create_dir_all(&self.folder).with_context(|| format!("cannot create {}", self.folder.display()))?;
        Ok(write_atomically(&self.folder.join(IDENTITY), self.identity.as_bytes())?)
    }

    /// How many frames there are, without a gap from the first.
    pub fn frame_count(&self) -> u32 {
        (0..).take_while(|frame| self.state_path(*frame).exists()).count() as u32
    }

    /// Keeps a frame; frame 0 begins the walk.
    pub fn write(&self, frame: u32, states: &[GarmentState], row: Option<&FrameRow>) -> Result<()> {
        if frame == 0 {
            self.begin()?;
        }
        if let Some(row) = row {
            write_atomically(&self.row_path(frame), &serde_json::to_vec(row)?)?;
        }
        let mut bytes = Vec::new();
        for array in states.iter().flat_map(|state| &state.arrays) {
            bytes.extend((array.len() as u64).to_le_bytes());
            bytes.extend_from_slice(bytemuck::cast_slice(array));
        }
        // The state last: a frame counts once it is there.
        Ok(write_atomically(&self.state_path(frame), &bytes)?)
    }

    /// The garments of a frame.
    pub fn read(&self, frame: u32) -> Result<Vec<GarmentState>> {
        let path = self.state_path(frame);
        let bytes = fs::read(&path).with_context(|| format!("{}: it cannot be read", path.display()))?;
        let damaged = || self.damaged(frame);
        let mut arrays = Vec::new();
        let mut rest = bytes.as_slice();
        while !rest.is_empty() {
            let (length, more) = rest.split_at_checked(8).with_context(damaged)?;
            let count = u64::from_le_bytes(length.try_into().with_context(damaged)?);
            let size = usize::try_from(count).ok().and_then(|count| count.checked_mul(16)).with_context(damaged)?;
            let (values, more) = more.split_at_checked(size).with_context(damaged)?;
            arrays.push(bytemuck::pod_collect_to_vec(values));
            rest = more;
        }
        let mut states = Vec::new();
        let mut arrays = arrays.into_iter();
        while let Some(positions) = arrays.next() {
            let mut next = || arrays.next().with_context(damaged);
            states.push(GarmentState { arrays: [positions, next()?, next()?, next()?] });
        }
        Ok(states)
    }

    fn damaged(&self, frame: u32) -> String {
        let path = self.state_path(frame);
        format!("{}: it is damaged: delete it, and --resume goes on from the frame before", path.display())
    }

    /// Positions of a garment in a frame [m].
    pub fn positions(&self, frame: u32, garment: usize) -> Result<Vec<Vec3>> {
        let states = self.read(frame)?;
        let state = states.get(garment).with_context(|| self.damaged(frame))?;
        Ok(state.positions())
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
        let state = GarmentState::at_rest(&[Vec3::X, Vec3::Y]);
        saved.write(0, &[state.clone(), state.clone()], None).expect("written");
        assert!(told(false, "a").is_err_and(|e| e.contains("--resume")), "nothing is overwritten");
        assert!(told(true, "b").is_err_and(|e| e.contains("another one")));
        assert_eq!(told(true, "a"), Ok(()));

        saved.write(2, std::slice::from_ref(&state), None).expect("written");
        assert_eq!(saved.frame_count(), 1, "frame 1 is missing");
        assert_eq!(saved.read(0).expect("read"), [state.clone(), state]);
        assert_eq!(saved.positions(0, 1).expect("read"), [Vec3::X, Vec3::Y]);

        let path = saved.state_path(0);
        let bytes = fs::read(&path).expect("there");
        fs::write(&path, &bytes[..bytes.len() - 3]).expect("cut short");
        assert!(saved.read(0).is_err_and(|e| e.to_string().contains("damaged")));
        assert!(saved.positions(0, 0).is_err_and(|e| e.to_string().contains("delete it")));

        fs::remove_file(&path).expect("deleted");
        let anew = open(false, "b").expect("without its first frame it begins anew");
        anew.write(0, std::slice::from_ref(&GarmentState::at_rest(&[Vec3::Z])), None).expect("written");
        assert!(!anew.state_path(2).exists(), "what the other one left is gone");
        assert_eq!(told(true, "b"), Ok(()));
        saved.remove().expect("removed");
        assert!(told(true, "a").is_err());
    }
}
