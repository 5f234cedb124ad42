//! What every experiment is given: a device, a scale, a seed, and a way to say how far it is.

use crate::Gpu;
use serde::{Deserialize, Serialize};
use std::fmt;
use thiserror::Error;

/// How much is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// All experiments in five minutes on two cores.
    Quick,
    /// All experiments in about a quarter of an hour.
    Full,
}

impl Scale {
    /// Its name.
    pub fn word(self) -> &'static str {
        match self {
            Scale::Quick => "quick",
            Scale::Full => "full",
        }
    }
}

/// Told what is going on; says whether to go on. The first number is the share of the experiment that is done, 0 to 1.
pub type Progress = Box<dyn FnMut(f64, &str) -> bool>;

/// What every experiment is given.
pub struct Lab {
    /// Where it runs.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Name of its adapter.
    pub adapter: String,
    /// How much is measured.
    pub scale: Scale,
    /// Seed of everything that is random.
    pub seed: u64,
    /// Who is told how far it is.
    pub progress: Progress,
}

/// Why an experiment has no answer. A run that diverges is an answer.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum LabError {
    /// The device refuses or is lost.
    #[error(transparent)]
    Toile(#[from] toile::Error),
    /// A file of the experiments cannot be read.
    #[error(transparent)]
    File(#[from] toile::files::FileError),
    /// Whoever listens to the progress asked to stop.
    #[error("the experiment was interrupted")]
    Interrupted,
}

impl Lab {
    /// A lab whose progress nobody listens to.
    pub fn new(device: wgpu::Device, queue: wgpu::Queue, adapter: String, scale: Scale, seed: u64) -> Self {
        Self { device, queue, adapter, scale, seed, progress: Box::new(|_, _| true) }
    }

    /// Says what is going on, and which share of the experiment is done, 0 to 1.
    ///
    /// # Errors
    /// [`LabError::Interrupted`] when whoever listens asks to stop.
    pub fn say(&mut self, share: f64, message: &str) -> Result<(), LabError> {
        if (self.progress)(share, message) { Ok(()) } else { Err(LabError::Interrupted) }
    }

    /// One of two values, by scale.
    pub fn pick<T>(&self, quick: T, full: T) -> T {
        match self.scale {
            Scale::Quick => quick,
            Scale::Full => full,
        }
    }

    /// The device with its queue.
    pub fn gpu(&self) -> Gpu {
        Gpu { device: self.device.clone(), queue: self.queue.clone(), adapter: self.adapter.clone() }
    }

    /// The end of every caption: adapter and seed.
    pub fn place(&self) -> String {
        format!("Adapter: {}; seed {}.", self.adapter, self.seed)
    }
}

impl From<toile::gpu::GpuError> for LabError {
    fn from(error: toile::gpu::GpuError) -> Self {
        Self::Toile(error.into())
    }
}

impl From<toile::model::ModelError> for LabError {
    fn from(error: toile::model::ModelError) -> Self {
        Self::Toile(error.into())
    }
}

impl fmt::Debug for Lab {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Lab")
            .field("adapter", &self.adapter)
            .field("scale", &self.scale)
            .field("seed", &self.seed)
            .finish_non_exhaustive()
    }
}
