//! The same cloth on the device and in the reference, compared after every step.

use crate::drivers::{FLUSHES, first_beyond};
use toile_gpu::Solver;
use toile_lab::DrawnMaps;
use toile_lab::kernels::vec3_words;
use toile_model::{Merge, Model, Status, StepSettings};
use toile_reference::Reference;
use toile_scene::Shape;
use toile_workspace::{arrived, gpu};

/// A status without what may differ where the smallest numbers are nothing: the last bits, and which of two equally long springs
/// is the longest.
fn comparable(status: Status) -> Status {
    if !*FLUSHES {
        return status;
    }
    let rounded = |value: f32| (f64::from(value) * 1e5).round() as f32 * 1e-5;
    Status {
        speed_max: rounded(status.speed_max),
        kinetic_energy: rounded(status.kinetic_energy),
        elongation_max: rounded(status.elongation_max),
        longest_limit: None,
        seam_gap_max: rounded(status.seam_gap_max),
        ..status
    }
}

/// The same cloth on the device and in the reference.
pub struct Life {
    pub solver: Solver,
    pub reference: Reference,
    /// Most particles that were in contact after any step.
    pub contacts_max: usize,
}

impl Life {
    pub fn new(model: &Model, settings: &StepSettings, layers: Option<&DrawnMaps>, shapes: Vec<Shape>) -> Self {
        let maps = layers.map(|layers| layers.maps.clone());
        let solver =
            Solver::new(&gpu().device, model, settings, maps, shapes.clone()).expect("the model fits the device");
        let maps = layers.map(|layers| layers.read.clone());
        let reference = Reference::new(model, settings, toile_reference::Colliders::new(maps, shapes));
        Self { solver, reference, contacts_max: 0 }
    }

    /// Steps both, up to `frames` frames, and demands the same bits after every step of the first frame, and the same state and outputs after
    /// every frame: bits that differ do not come together again. Ends early once the state is no longer finite on both sides; gives the status
    /// at the end.
    pub fn agree(&mut self, name: &str, frames: u32) -> Status {
        let mut last = Status::default();
        for frame in 0..frames {
            let steps = self.solver.settings().steps_per_frame;
            let at_once = if frame == 0 { 1 } else { steps };
            for _ in 0..steps / at_once {
                gpu().run(|encoder| {
                    (0..at_once).for_each(|_| self.solver.record_steps(&gpu().device, encoder, 0..1, 1));
                });
                for _ in 0..at_once {
                    self.reference.step();
                    let contacts = self.reference.contacts().iter().filter(|contact| contact.touching).count();
                    self.contacts_max = self.contacts_max.max(contacts);
                }
                if let Some(fault) = self.difference() {
                    panic!("{name}: one of the {at_once} steps up to {} differs: {fault}", self.solver.step());
                }
            }
            gpu().run(|encoder| self.solver.record_outputs(encoder));
            last = self.status();
            assert_eq!(comparable(last), comparable(self.reference.status()), "{name}: status");
            let normals = vec3_words(&gpu().vec3s(self.solver.normals()));
            if let Some(fault) = first_beyond(&normals, &vec3_words(&self.reference.normals())) {
                panic!("{name}: normals after step {}: {fault}", self.solver.step());
            }
            if last.non_finite_count > 0 {
                break;
            }
        }
        last
    }

    /// The status of the frame that is done.
    fn status(&mut self) -> Status {
        let step = self.solver.step();
        arrived("the status of a frame", || self.solver.status().filter(|status| status.step == step))
    }

    /// Where positions, velocities, what limits gave or contacts differ.
    pub fn difference(&self) -> Option<String> {
        let device = [self.solver.positions(), self.solver.velocities()].map(|buffer| vec3_words(&gpu().vec3s(buffer)));
        let reference = [self.reference.positions(), self.reference.velocities()].map(vec3_words);
        for (name, (device, reference)) in ["positions", "velocities"].into_iter().zip(device.iter().zip(&reference)) {
            if let Some(difference) = first_beyond(device, reference) {
                return Some(format!("{name}: {difference}"));
            }
        }
        if let Some(buffer) = self.solver.pulls() {
            let device = vec3_words(&gpu().vec3s(buffer));
            if let Some(difference) = first_beyond(&device, &vec3_words(self.reference.pulls())) {
                return Some(format!("what limits gave: {difference}"));
            }
        }
        // The directional rule asks for contacts even where there is nothing to touch.
        let buffer = self.solver.contacts().filter(|_| !self.reference.contacts().is_empty())?;
        let contacts: Vec<_> = self.reference.contacts().iter().flat_map(|c| [c.normal, c.velocity]).collect();
        first_beyond(&vec3_words(&gpu().vec3s(buffer)), &vec3_words(&contacts))
            .map(|fault| format!("contacts: {fault}"))
    }

    /// The handover to the sewn model on both sides.
    pub fn sewn(self, model: &Model, merge: &Merge, settings: &StepSettings, layers: Option<&DrawnMaps>) -> Self {
        let maps = layers.map(|layers| layers.maps.clone());
        let mut solver =
            Solver::new(&gpu().device, model, settings, maps, Vec::new()).expect("the model fits the device");
        gpu().run(|encoder| solver.record_merge(&gpu().device, encoder, &self.solver, merge));
        Self { solver, reference: self.reference.sewn(model, settings, merge), contacts_max: 0 }
    }
}
