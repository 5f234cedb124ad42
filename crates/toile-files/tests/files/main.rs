//! Reads and writes of every kind of file, good and bad.

mod bodies;
mod broken;
mod compressed;
mod floors;
mod fuzz;
mod garbage;
mod garments;
mod gltf_bodies;
mod moving;
mod real;
mod scenes;
mod support;
mod writers;
