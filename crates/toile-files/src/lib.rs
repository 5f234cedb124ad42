//! Garment, body and scene files in, dressed meshes and their motion out, errors with path and place.

mod body;
mod crossing;
mod error;
mod fabric;
mod garment;
mod garment_json;
mod gltf_body;
mod gltf_file;
mod gltf_pose;
mod obj;
mod ply;
mod ply_header;
mod scene;
mod scene_toml;
mod soup;
mod source;
mod toml_text;
mod write;
mod write_glb;
mod write_pc2;
mod write_usda;

pub use body::{BodyFile, BodyOptions, parse_body, read_body};
pub use error::{Fault, FileError, Place};
pub use fabric::read_fabric;
pub use garment::{parse_garment, read_garment};
pub use scene::{SceneFile, read_scene};
pub use write::{write_atomically, write_obj};
pub use write_glb::{NamedMesh, write_glb};
pub use write_pc2::write_pc2;
pub use write_usda::{NamedMotion, write_usda};
