//! Garment, body and scene files in, dressed meshes out, errors with path and place.

mod body;
mod error;
mod foreign;
mod format;
mod garment;
mod out;
mod plausible;
mod scene;
mod source;
mod unread;

pub use body::mesh_sequence::read_mesh_sequence;
pub use body::moving_body::{MovingBodyFile, parse_moving_body, read_moving_body};
pub use body::{BodyFile, BodyOptions, parse_body, read_body};
pub use error::{Fault, FileError, Place};
pub use garment::{GarmentFile, parse_garment, read_garment};
pub use out::motion::{MovingFaces, write_pc2, write_usda};
pub use out::write::{write_atomically, write_obj};
pub use out::write_glb::{NamedMesh, write_glb};
pub use scene::fabric::read_fabric;
pub use scene::{SceneFile, read_scene};
