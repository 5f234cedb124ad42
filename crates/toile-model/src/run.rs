//! What a run needs beside its model: the numbers of a step, status, criteria of dressing, how a garment is worn, the place of the maps.

pub(crate) mod dressing;
pub(crate) mod letting_out;
pub(crate) mod map_box;
pub(crate) mod motion;
pub(crate) mod piece;
pub(crate) mod pin_target;
pub(crate) mod shape_step;
pub(crate) mod side_box;
pub(crate) mod status;
pub(crate) mod step;
mod step_check;
pub(crate) mod verdict;
