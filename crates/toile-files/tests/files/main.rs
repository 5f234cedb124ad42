//! Reads and writes of every kind of file, good and bad.

mod bodies;
mod broken;
mod garbage;
mod garments;
mod gltf_bodies;
mod motions;
mod real;
mod scenes;
mod support;
mod writers;
