//! Files out: meshes and their motion, each whole or not at all.

pub(crate) mod motion;
pub(crate) mod write;
pub(crate) mod write_glb;
