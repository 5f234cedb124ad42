//! What can go wrong on a device that the caller cannot foresee.

use thiserror::Error;

/// What can go wrong on a device that the caller cannot foresee.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GpuError {
    /// A buffer is larger than the device binds.
    #[error(
        "the buffer {name} needs {needed} bytes but this device binds at most {available}; make cloth or body coarser, or ask the \
         adapter for its own limits when the device is created"
    )]
    BufferTooLarge {
        /// Name of the buffer in the kernels.
        name: String,
        /// Bytes needed.
        needed: u64,
        /// Bytes that the device binds.
        available: u64,
    },
    /// The device was created with a limit below that of WebGPU.
    #[error(
        "the device has {name} {available} but the kernels are made for {needed}, the default of WebGPU; create it with at least that"
    )]
    LimitTooLow {
        /// Name of the limit in WebGPU.
        name: &'static str,
        /// WebGPU's default.
        needed: u32,
        /// What the device has.
        available: u32,
    },
    /// The device refuses a pipeline.
    #[error("the device refuses the pipeline of {kernel}: {message}")]
    Pipeline {
        /// Name of the kernel.
        kernel: String,
        /// What it says.
        message: String,
    },
    /// The maps are larger than the device's textures.
    #[error(
        "the maps need {columns} × {rows} texels but this device has textures of at most {available} on a side; use a larger texel"
    )]
    MapTooLarge {
        /// Texels along x.
        columns: u32,
        /// Texels along y.
        rows: u32,
        /// Texels that the device allows on a side.
        available: u32,
    },
    /// The device did not give back what it was asked for.
    #[error("the device did not finish: {0}")]
    Device(String),
}
