//! How garments are worn, asked of the device and waited for.

use crate::Error;
use crate::dressed::Done;
use crate::simulation::{Phase, Simulation};
use glam::Vec3;
use toile_gpu::readback;
use toile_model::{Judged, Piece, Solid, Verdict};
use toile_scene::Mesh;

impl Simulation {
    /// How the garments are worn that are dressed, from the inside out, on the bodies as they are dressed; empty once all go together. A host asks
    /// at [`Stage::Dressed`](crate::Stage::Dressed). Waits for the device; what was recorded must have been submitted.
    ///
    /// # Errors
    /// [`Error::Gpu`] when the device is lost.
    pub fn verdicts(&self, queue: &wgpu::Queue) -> Result<Vec<Verdict>, Error> {
        let Phase::Dressing(dressed) = &self.phase else { return Ok(Vec::new()) };
        let shapes: Vec<Mesh> = self.bodies.shapes.iter().map(|shape| shape.mesh(0.0)).collect();
        let body = Solid::of(self.dressing_meshes().into_iter().chain(&shapes));
        let read = |buffer: &wgpu::Buffer| -> Result<Vec<Vec3>, Error> {
            let values = readback::read_vec4s(&self.device, queue, buffer)?;
            Ok(values.into_iter().map(|value| value.truncate()).collect())
        };
        let garments = self.pieces.iter().filter(|piece| piece.open.is_some());
        let verdict = |(piece, Done { cloth, dressing, velocities, .. }): (&Piece, &Done)| -> Result<Verdict, Error> {
            let positions = read(&cloth.frame().positions)?;
            let velocities = match velocities.as_slice() {
                [] => &read(cloth.velocities())?,
                seen => seen,
            };
            let (model, is_at_rest) = (&piece.model, dressing.is_at_rest());
            Ok(Verdict::of(&Judged::new(model, &positions, velocities, is_at_rest), &body))
        };
        garments.zip(&dressed.done).map(verdict).collect()
    }
}
