//! Parity: the device gives the answers of the reference.

mod branches;
mod drivers;
mod garments;
mod kernels;
mod large;
mod life;
mod mutants;
mod rounding;
mod saboteur;
mod sheets;
