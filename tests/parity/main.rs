//! Parity: the device gives the answers of the reference.

mod branches;
mod garments;
mod kernels;
mod large;
mod life;
mod rounding;
mod saboteur;
mod sheets;
