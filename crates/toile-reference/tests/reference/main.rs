//! Physics and measurements of the reference.

mod contact;
mod distance;
mod free_fall;
mod keep_out;
mod levels;
mod life;
mod limit_guard;
mod limits;
mod maps;
mod normals;
mod sewing;
mod shortening;
mod statics;
mod status;
mod support;
mod time_step;
mod warm_start;
mod wind;
