//! The WGSL as text, the kernel table, the buffer table, imports, reflection, shared structs. Nothing here knows wgpu.
//!
//! A new pass is one WGSL file and one row in [`TABLE`]; its bindings, workgroup size, reads and writes come from the WGSL
//! itself, by global name ([`Interface`]).

mod buffers;
mod import;
mod reflect;
pub mod structs;
mod table;

pub use buffers::{BUFFERS, BufferRow, Per, Role, buffer_row};
pub use reflect::{Binding, Interface, Resource, StructField, StructLayout};
pub use table::{Domain, Kernel, Need, Row, Stage, TABLE, render_sides_source};

/// Invocations of one workgroup of every compute kernel.
pub const WORKGROUP_SIZE: u32 = 64;
