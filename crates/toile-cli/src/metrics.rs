//! What is measured of a run: `metrics.json`.

use crate::engine::Layer;
use crate::worn::Worn;
use glam::DVec3;
use serde::Serialize;
use toile_reference::ExactDistance;

/// What is measured of a run. The names are stable.
#[derive(Debug, Serialize)]
pub struct Metrics {
    /// Scene or outfit.
    pub scene: String,
    /// Name of the adapter, or "reference".
    pub adapter: String,
    /// All cloths together: sums of counts and steps, largest of the maxima.
    #[serde(flatten)]
    pub whole: ClothMetrics,
    /// Each cloth.
    pub cloths: Vec<ClothMetrics>,
}

/// What is measured of one cloth.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ClothMetrics {
    /// Name of the garment or sheet.
    pub name: String,
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
    /// Widest seam gap when the pairs were merged [mm].
    pub seam_gap_max_mm: f64,
    /// Largest elongation of a structural or shear spring at the end [1].
    pub elongation_max: f64,
    /// 99th percentile of it [1].
    pub elongation_p99: f64,
    /// Largest elongation at the end of any frame [1].
    pub elongation_max_over_run: f64,
    /// Steps of a frame.
    pub steps_per_frame: u32,
    /// Deepest particle below the surface of the body [mm], negative when all are outside; null without a body.
    pub penetration_max_mm: Option<f64>,
    /// 99th percentile of it [mm].
    pub penetration_p99_mm: Option<f64>,
    /// Part of the particles that the maps take for touching although they are farther from every surface than thickness + 2 texels.
    pub false_contact_fraction: Option<f64>,
    /// Mean kinetic energy of a particle at the end [J].
    pub kinetic_energy_per_particle_j: f64,
    /// Particles that are not finite.
    pub non_finite_count: u32,
    /// Median wall time of a step [ms].
    pub step_ms_median: f64,
    /// Time of a copy of all positions and velocities [ms]; null without timestamps.
    pub state_copy_ms: Option<f64>,
    /// Sum of the passes of a step in state copies; null without timestamps.
    pub step_state_copies: Option<f64>,
    /// Bytes on the device.
    pub gpu_bytes: u64,
    /// Cost of one step by pass.
    pub passes: Vec<PassMetrics>,
}

/// Cost of one kernel in a step.
#[derive(Clone, Debug, Serialize)]
pub struct PassMetrics {
    /// Name of the kernel.
    pub name: String,
    /// Dispatches per step.
    pub dispatches: u32,
    /// Time per step [ms].
    pub ms: f64,
}

impl Metrics {
    /// Measures each cloth; the first layer is the body, the i-th cloth lies over all layers before `layers[first + i]`.
    pub fn new(scene: &str, adapter: &str, cloths: Vec<ClothMetrics>) -> Self {
        let mut whole = ClothMetrics { name: scene.to_owned(), ..Default::default() };
        for cloth in &cloths {
            whole.add(cloth);
        }
        Self { scene: scene.to_owned(), adapter: adapter.to_owned(), whole, cloths }
    }
}

impl ClothMetrics {
    /// Measures a cloth against the surfaces that it lies over; `texel` is that of their maps [m].
    pub fn new(worn: &Worn, layers: &[Layer], texel: f32) -> Self {
        let mut elongations = elongations(worn);
        elongations.sort_by(f64::total_cmp);
        let p99 = |sorted: &[f64]| sorted.get((sorted.len() * 99).div_ceil(100).saturating_sub(1)).copied();
        let contact = ContactMetrics::new(worn, layers, texel);
        let milliseconds = |name: &str| worn.pass_times.get(name).map(|time| time.milliseconds);
        let state_copy_ms = milliseconds("state_copy").filter(|ms| *ms > 0.0);
        let passes: Vec<_> = worn
            .pass_times
            .iter()
            .filter(|(name, _)| *name != "state_copy")
            .map(|(name, time)| PassMetrics {
                name: name.clone(),
                dispatches: time.dispatches,
                ms: time.milliseconds,
            })
            .collect();
        let step_ms: f64 = passes.iter().map(|pass| pass.ms).sum();
        Self {
            name: worn.name.clone(),
            particle_count: worn.model.particle_count(),
            spring_count: worn.model.spring_count(),
            colour_count: worn.model.colour_count(),
            quad_count: worn.model.quad_count(),
            steps_sewing: worn.sewing_steps,
            steps_draping: worn.draping_steps,
            seam_gap_max_mm: 1e3 * f64::from(worn.seam_gap),
            elongation_max: elongations.last().copied().unwrap_or(0.0),
            elongation_p99: p99(&elongations).unwrap_or(0.0),
            elongation_max_over_run: f64::from(worn.log.elongation_max),
            steps_per_frame: worn.settings.steps_per_frame,
            penetration_max_mm: contact.as_ref().map(|c| c.penetration_max_mm),
            penetration_p99_mm: contact.as_ref().map(|c| c.penetration_p99_mm),
            false_contact_fraction: contact.as_ref().map(|c| c.false_contact_fraction),
            kinetic_energy_per_particle_j: f64::from(worn.status.kinetic_energy)
                / f64::from(worn.model.particle_count().max(1)),
            non_finite_count: worn.status.non_finite_count,
            step_ms_median: worn.log.step_ms_median(),
            state_copy_ms,
            step_state_copies: state_copy_ms.map(|copy| step_ms / copy),
            gpu_bytes: worn.gpu_bytes,
            passes,
        }
    }

    fn add(&mut self, other: &Self) {
        let most = |a: Option<f64>, b: Option<f64>| a.into_iter().chain(b).reduce(f64::max);
        let before = f64::from(self.particle_count);
        let now = f64::from(self.particle_count + other.particle_count).max(1.0);
        let mean = |a: f64, b: f64| (a * before + b * f64::from(other.particle_count)) / now;
        self.kinetic_energy_per_particle_j =
            mean(self.kinetic_energy_per_particle_j, other.kinetic_energy_per_particle_j);
        self.false_contact_fraction = other
            .false_contact_fraction
            .map(|b| mean(self.false_contact_fraction.unwrap_or(0.0), b))
            .or(self.false_contact_fraction);
        self.particle_count += other.particle_count;
        self.spring_count += other.spring_count;
        self.colour_count = self.colour_count.max(other.colour_count);
        self.quad_count += other.quad_count;
        self.steps_sewing += other.steps_sewing;
        self.steps_draping += other.steps_draping;
        self.seam_gap_max_mm = self.seam_gap_max_mm.max(other.seam_gap_max_mm);
        self.elongation_max = self.elongation_max.max(other.elongation_max);
        self.elongation_p99 = self.elongation_p99.max(other.elongation_p99);
        self.elongation_max_over_run = self.elongation_max_over_run.max(other.elongation_max_over_run);
        self.steps_per_frame = self.steps_per_frame.max(other.steps_per_frame);
        self.penetration_max_mm = most(self.penetration_max_mm, other.penetration_max_mm);
        self.penetration_p99_mm = most(self.penetration_p99_mm, other.penetration_p99_mm);
        self.non_finite_count += other.non_finite_count;
        self.step_ms_median = self.step_ms_median.max(other.step_ms_median);
        self.state_copy_ms = most(self.state_copy_ms, other.state_copy_ms);
        self.step_state_copies = most(self.step_state_copies, other.step_state_copies);
        self.gpu_bytes = self.gpu_bytes.max(other.gpu_bytes);
        if self.passes.is_empty() {
            self.passes.clone_from(&other.passes);
        }
    }
}

struct ContactMetrics {
    penetration_max_mm: f64,
    penetration_p99_mm: f64,
    false_contact_fraction: f64,
}

impl ContactMetrics {
    fn new(worn: &Worn, layers: &[Layer], texel: f32) -> Option<Self> {
        let [body, inner @ ..] = layers else { return None };
        let points: Vec<DVec3> = worn.mesh.positions.iter().map(|p| p.as_dvec3()).collect();
        let body_distance = ExactDistance::new(&body.mesh);
        let inner: Vec<_> = inner.iter().map(|l| (ExactDistance::new(&l.mesh), l.thickness)).collect();
        let depths: Vec<f64> = points.iter().map(|p| body_distance.penetration(*p)).collect();
        let slack = 2.0 * f64::from(texel);
        let far = |index: usize| {
            depths[index] < -(f64::from(body.thickness) + slack)
                && inner
                    .iter()
                    .all(|(mesh, thickness)| mesh.penetration(points[index]) < -(f64::from(*thickness) + slack))
        };
        let touching: Vec<usize> = (0..worn.touching.len()).filter(|i| worn.touching[*i]).collect();
        let false_contacts = touching.iter().filter(|i| far(**i)).count();
        let mut sorted = depths;
        sorted.sort_by(f64::total_cmp);
        let rank = (sorted.len() * 99).div_ceil(100).max(1) - 1;
        Some(Self {
            penetration_max_mm: 1e3 * sorted.last()?,
            penetration_p99_mm: 1e3 * sorted[rank],
            false_contact_fraction: false_contacts as f64 / points.len() as f64,
        })
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
