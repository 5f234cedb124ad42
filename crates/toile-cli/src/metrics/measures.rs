//! The numbers of one cloth, and how those of several become one.

use super::contact::Surfaces;
use crate::worn::Worn;
use serde::Serialize;
use toile_lab::max_and_p99;

/// The numbers of one cloth, or of several together.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Measures {
    /// Number of particles of the sewn cloth.
    pub particle_count: u32,
    /// Number of springs.
    pub spring_count: u32,
    /// Number of colours of the limits.
    pub colour_count: u32,
    /// Number of quads and triangles.
    pub quad_count: u32,
    /// Steps until the seams were closed.
    pub steps_sewing: u64,
    /// Steps from then until rest, or steps of the run.
    pub steps_draping: u64,
    /// Widest seam gap at the end of sewing [mm].
    pub seam_gap_max_mm: f64,
    /// Largest elongation of a structural or shear spring at the end [1].
    pub elongation_max: f64,
    /// 99th percentile of it [1].
    pub elongation_p99: f64,
    /// Largest elongation at the end of any frame of the run, or of draping [1].
    pub elongation_max_over_run: f64,
    /// Further sweeps of the polish while draping, or in the run.
    pub further_sweeps: u32,
    /// Steps then that ended above its target.
    pub missed_steps: u32,
    /// Steps of a frame.
    pub steps_per_frame: u32,
    /// Deepest particle below the surface of the body [mm], negative when all are outside; null without a body.
    pub penetration_max_mm: Option<f64>,
    /// 99th percentile of it [mm].
    pub penetration_p99_mm: Option<f64>,
    /// Deepest middle of an edge of a face below the surface of the body [mm]: cloth bends over a body between its particles.
    pub edge_penetration_max_mm: Option<f64>,
    /// Deepest middle of a face [mm].
    pub face_penetration_max_mm: Option<f64>,
    /// Particles on the wrong side of the body: more than 1 cm inside, or on a spring whose middle is; null without a body.
    pub crossed_count: Option<u32>,
    /// Part of the particles that count as touching although they are farther from every surface than thickness + 2 texels.
    pub false_contact_fraction: Option<f64>,
    /// Mean kinetic energy of a particle at the end [J].
    pub kinetic_energy_per_particle_j: f64,
    /// Particles that are not finite.
    pub non_finite_count: u32,
    /// Median wall time of a step [ms].
    pub step_ms_median: f64,
    /// Time of a copy of all positions and velocities [ms]; null by the reference.
    pub state_copy_ms: Option<f64>,
    /// Sum of the passes of a step in state copies; null by the reference.
    pub step_state_copies: Option<f64>,
    /// Bytes on the device.
    pub gpu_bytes: u64,
    /// Cost of one step by pass.
    pub passes: Vec<PassMeasures>,
}

/// Cost of one kernel in a step.
#[derive(Clone, Debug, Serialize)]
pub struct PassMeasures {
    /// Name of the kernel.
    pub name: String,
    /// Dispatches per step.
    pub dispatches: u32,
    /// Time per step [ms].
    pub ms: f64,
}

impl Measures {
    /// Measures a cloth against the surfaces that it lies over; `texel` is that of their maps [m].
    pub fn new(worn: &Worn, surfaces: &Surfaces, texel: f32) -> Self {
        let [elongation_max, elongation_p99] = max_and_p99(elongations(worn)).unwrap_or_default();
        let contact = surfaces.measure(worn, texel);
        let (copies, passes): (Vec<_>, Vec<_>) = worn
            .pass_times
            .iter()
            .map(|(name, time)| PassMeasures { name: name.clone(), dispatches: time.dispatches, ms: time.milliseconds })
            .partition(|pass| pass.name == "state_copy");
        let state_copy_ms = copies.first().map(|copy| copy.ms).filter(|ms| *ms > 0.0);
        let step_ms: f64 = passes.iter().map(|pass| pass.ms).sum();
        let particles = f64::from(worn.model.particle_count().max(1));
        Self {
            particle_count: worn.model.particle_count(),
            spring_count: worn.model.spring_count(),
            colour_count: worn.model.colour_count(),
            quad_count: worn.model.quad_count(),
            steps_sewing: worn.sewing_steps,
            steps_draping: worn.draping_steps,
            seam_gap_max_mm: 1e3 * f64::from(worn.seam_gap),
            elongation_max,
            elongation_p99,
            elongation_max_over_run: f64::from(worn.log.elongation_max()),
            further_sweeps: worn.status.further_sweeps,
            missed_steps: worn.status.missed_steps,
            steps_per_frame: worn.settings.steps_per_frame,
            penetration_max_mm: contact.map(|contact| 1e3 * contact.penetration_max),
            penetration_p99_mm: contact.map(|contact| 1e3 * contact.penetration_p99),
            edge_penetration_max_mm: contact.map(|contact| 1e3 * contact.edge_penetration_max),
            face_penetration_max_mm: contact.map(|contact| 1e3 * contact.face_penetration_max),
            crossed_count: contact.map(|contact| contact.crossed_count),
            false_contact_fraction: contact.map(|contact| contact.false_fraction),
            kinetic_energy_per_particle_j: f64::from(worn.status.kinetic_energy) / particles,
            non_finite_count: worn.status.non_finite_count,
            step_ms_median: worn.log.step_ms_median(),
            state_copy_ms,
            step_state_copies: state_copy_ms.map(|copy| step_ms / copy),
            gpu_bytes: worn.gpu_bytes,
            passes,
        }
    }

    /// Two cloths as one: sums of counts and steps, the worse of the maxima and percentiles, means weighted by particles, and
    /// the cost of the one whose step takes longer, because they are simulated one after the other.
    pub fn with(self, other: Self) -> Self {
        let worse = |a: Option<f64>, b: Option<f64>| a.into_iter().chain(b).reduce(f64::max);
        let weights = [&self, &other].map(|m| f64::from(m.particle_count));
        let mean = |a: f64, b: f64| (a * weights[0] + b * weights[1]) / (weights[0] + weights[1]).max(1.0);
        let cost = if self.step_ms_median >= other.step_ms_median { &self } else { &other };
        Self {
            particle_count: self.particle_count + other.particle_count,
            spring_count: self.spring_count + other.spring_count,
            colour_count: self.colour_count.max(other.colour_count),
            quad_count: self.quad_count + other.quad_count,
            steps_sewing: self.steps_sewing + other.steps_sewing,
            steps_draping: self.steps_draping + other.steps_draping,
            seam_gap_max_mm: self.seam_gap_max_mm.max(other.seam_gap_max_mm),
            elongation_max: self.elongation_max.max(other.elongation_max),
            elongation_p99: self.elongation_p99.max(other.elongation_p99),
            elongation_max_over_run: self.elongation_max_over_run.max(other.elongation_max_over_run),
            further_sweeps: self.further_sweeps + other.further_sweeps,
            missed_steps: self.missed_steps + other.missed_steps,
            steps_per_frame: self.steps_per_frame.max(other.steps_per_frame),
            penetration_max_mm: worse(self.penetration_max_mm, other.penetration_max_mm),
            penetration_p99_mm: worse(self.penetration_p99_mm, other.penetration_p99_mm),
            edge_penetration_max_mm: worse(self.edge_penetration_max_mm, other.edge_penetration_max_mm),
            face_penetration_max_mm: worse(self.face_penetration_max_mm, other.face_penetration_max_mm),
            crossed_count: self.crossed_count.into_iter().chain(other.crossed_count).reduce(|a, b| a + b),
            // A sheet that hangs free has no contacts, so it has no false ones.
            false_contact_fraction: worse(self.false_contact_fraction, other.false_contact_fraction)
                .map(|_| mean(self.false_contact_fraction.unwrap_or(0.0), other.false_contact_fraction.unwrap_or(0.0))),
            kinetic_energy_per_particle_j: mean(
                self.kinetic_energy_per_particle_j,
                other.kinetic_energy_per_particle_j,
            ),
            non_finite_count: self.non_finite_count + other.non_finite_count,
            step_ms_median: cost.step_ms_median,
            state_copy_ms: cost.state_copy_ms,
            step_state_copies: cost.step_state_copies,
            gpu_bytes: self.gpu_bytes.max(other.gpu_bytes),
            passes: cost.passes.clone(),
        }
    }
}

/// Elongation of every structural and shear spring at the end [1].
fn elongations(worn: &Worn) -> Vec<f64> {
    let positions = &worn.mesh.positions;
    worn.model
        .limits
        .iter()
        .map(|limit| {
            let [a, b] = limit.ends.map(|i| positions[i as usize].as_dvec3());
            a.distance(b) / f64::from(limit.rest_length) - 1.0
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_cloths_add_up_and_show_the_worse() {
        let one = Measures {
            particle_count: 300,
            elongation_max: 0.1,
            false_contact_fraction: Some(0.4),
            step_ms_median: 1.0,
            steps_draping: 5,
            ..Measures::default()
        };
        let other = Measures {
            particle_count: 100,
            elongation_max: 0.2,
            penetration_max_mm: Some(-3.0),
            step_ms_median: 2.0,
            state_copy_ms: Some(0.1),
            steps_draping: 7,
            ..Measures::default()
        };
        let whole = one.with(other);
        assert_eq!((whole.particle_count, whole.steps_draping, whole.elongation_max), (400, 12, 0.2));
        assert_eq!((whole.penetration_max_mm, whole.penetration_p99_mm), (Some(-3.0), None));
        assert!(whole.false_contact_fraction.is_some_and(|fraction| (fraction - 0.3).abs() < 1e-12));
        assert_eq!((whole.step_ms_median, whole.state_copy_ms), (2.0, Some(0.1)));
    }
}
