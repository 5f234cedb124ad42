//! Parity: the device gives the answers of the reference.

mod branches;
mod garments;
mod input;
mod kernels;
mod large;
mod life;
mod saboteur;
mod seeded;
mod sheets;
