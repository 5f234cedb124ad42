//! The library's door: a scene becomes a running simulation, is dressed, goes on one clock, is saved and goes on.

mod clock;
mod control;
mod dressing;
mod headings;
mod jumps;
mod layers;
mod put_on;
mod saved;
mod sewing;
mod support;
