//! Simulations driven to the end of a frame, as a program that waits drives them.

use crate::gpu;
use std::time::{Duration, Instant};
use toile::model::Status;

/// Longest wait for something that the device has under way.
const PATIENCE: Duration = Duration::from_secs(30);

/// Polls the device until something has arrived. Nothing may arrive for a moment although the device is done, when the thread
/// of another test has it in its hands.
///
/// # Panics
/// When it does not arrive.
pub fn arrived<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let start = Instant::now();
    loop {
        gpu().device.poll(wgpu::PollType::Poll).expect("the device answers");
        if let Some(found) = look() {
            return found;
        }
        assert!(start.elapsed() < PATIENCE, "{what} does not arrive");
        std::thread::yield_now();
    }
}

/// Does one frame and waits for its status.
///
/// # Errors
/// What [`toile::Cloth::status`] reports.
pub fn advance(cloth: &mut toile::Cloth) -> Result<Status, toile::Error> {
    gpu().run(|encoder| cloth.record(&gpu().device, encoder));
    finish_frame(cloth)
}

/// Waits for the status of the frame that was submitted last.
///
/// # Errors
/// What [`toile::Cloth::status`] reports.
pub fn finish_frame(cloth: &mut toile::Cloth) -> Result<Status, toile::Error> {
    arrived("the status of a frame", || match cloth.status() {
        Ok(Some(status)) if status.step == cloth.step() => Some(Ok(status)),
        Ok(_) => None,
        Err(error) => Some(Err(error)),
    })
}
