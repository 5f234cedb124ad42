//! Ctrl-c: asks the run to end at the next frame, so that nothing is left half-written.

use anyhow::{Context, Result};
use std::sync::atomic::{AtomicBool, Ordering};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// The user pressed ctrl-c.
#[derive(Debug, thiserror::Error)]
#[error("interrupted: nothing was written")]
pub struct Interrupted;

/// Listens for ctrl-c from now on.
pub fn listen() -> Result<()> {
    ctrlc::set_handler(|| REQUESTED.store(true, Ordering::Relaxed)).context("ctrl-c cannot be listened for")
}

/// An error once the user pressed ctrl-c.
pub fn check() -> Result<(), Interrupted> {
    if REQUESTED.load(Ordering::Relaxed) { Err(Interrupted) } else { Ok(()) }
}

/// Forgets that the user pressed ctrl-c: the run has ended, and what it did is about to be written.
pub fn forget() {
    REQUESTED.store(false, Ordering::Relaxed);
}
