//! What is measured of a walk, frame by frame.

use super::regions::Regions;
use super::walker::Walker;
use crate::fit;
use crate::look::State;
use crate::metrics::{Told, depth, elongation, is_far, reach};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toile::Teleport;
use toile::model::{Fit, Model, Solid, Status, Verdict, crossed_particles};
use toile::scene::Mesh;
use toile_lab::{max_and_p99, middles};
use toile_reference::ExactDistance;

/// What is measured of a walk. The names are stable.
#[derive(Debug, Serialize)]
pub struct WalkMetrics {
    adapter: String,
    garments: Vec<String>,
    /// How each of them is worn before the walk.
    verdicts: Vec<Told>,
    /// What was found before sewing, and what was mended.
    fit: Vec<String>,
    particle_count: u32,
    steps_per_frame: u32,
    frame_rate: f64,
    /// Elongation that the fabric allows along warp, weft and bias [1].
    threshold: [f64; 3],
    frame_count: usize,
    elongation_max: f64,
    elongation_p99_worst: f64,
    further_sweeps: u32,
    missed_steps: u32,
    penetration_max_mm: f64,
    penetration_p99_worst_mm: f64,
    edge_penetration_max_mm: f64,
    face_penetration_max_mm: f64,
    /// The most in a frame.
    crossed_count: u32,
    false_contact_fraction_mean: f64,
    false_contacts_by_region: BTreeMap<String, u32>,
    /// Where the body jumped and took its garments along.
    teleports: Vec<Teleport>,
    non_finite_count: u32,
    maps_ms_median: f64,
    simulation_ms_median: f64,
    /// The part of `simulation_ms` that goes to the bodies: reaction, quad midpoints, sampling of the maps, response and what the guard keeps out; from a
    /// step after the walk, timed pass by pass.
    collision_ms_median: f64,
    output_ms_median: f64,
    picture_ms_median: f64,
    frames: Vec<FrameRow>,
}

/// What is measured of one frame, over all garments.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct FrameRow {
    /// Number of the frame; 0 is the dressed start.
    pub frame: u32,
    /// Time in the walk [s].
    pub time_s: f64,
    /// Largest elongation of a structural or shear spring [1].
    pub elongation_max: f64,
    /// The two particles of the spring that has it.
    pub longest_spring: Option<[u32; 2]>,
    /// The region of the body that is nearest to it.
    pub longest_region: Option<String>,
    /// Number of springs whose elongation is above the threshold along them.
    pub over_long_count: u32,
    /// Further sweeps of the polish in the steps of the frame.
    pub further_sweeps: u32,
    /// Steps of the frame, of all garments, that ended above its target.
    pub missed_steps: u32,
    /// 99th percentile of the elongation, of the garment where it is largest [1].
    pub elongation_p99: f64,
    /// Deepest particle below the exact surface of the body [mm], negative when all are outside.
    pub penetration_max_mm: f64,
    /// 99th percentile of that depth, of the garment where it is largest [mm].
    pub penetration_p99_mm: f64,
    /// Deepest middle of an edge of a face [mm].
    pub edge_penetration_max_mm: f64,
    /// Deepest middle of a face [mm].
    pub face_penetration_max_mm: f64,
    /// Particles on the wrong side of the body.
    pub crossed_count: u32,
    /// Particles in contact by the maps that are farther from body and inner garments than thickness + 2 texels, as part of all.
    pub false_contact_fraction: f64,
    /// Those particles by the region of the body that is nearest to them.
    pub false_contacts_by_region: BTreeMap<String, u32>,
    /// Jumps of the body in which it took its garments along.
    pub teleports: Vec<Teleport>,
    /// Number of particles.
    pub particle_count: u32,
    /// Largest speed [m/s].
    pub speed_max: f32,
    /// Kinetic energy [J].
    pub kinetic_energy: f32,
    /// Particles that are not finite.
    pub non_finite_count: u32,
    /// Wall time of the poses and maps of the frame [ms].
    pub maps_ms: f64,
    /// Wall time of its steps [ms].
    pub simulation_ms: f64,
    /// Wall time of reading back, measuring, drawing and saving [ms].
    pub output_ms: f64,
    /// The part of it that goes to the pictures of the frame, drawn and saved [ms].
    pub picture_ms: f64,
}

impl FrameRow {
    /// A frame of which only the times are known.
    pub fn new(frame: u32, time_s: f64, maps_ms: f64, simulation_ms: f64) -> Self {
        let none = f64::NEG_INFINITY;
        Self {
            frame,
            time_s,
            maps_ms,
            simulation_ms,
            penetration_max_mm: none,
            penetration_p99_mm: none,
            edge_penetration_max_mm: none,
            face_penetration_max_mm: none,
            ..Self::default()
        }
    }

    /// Adds a garment that lies over the `inner` ones.
    #[expect(clippy::too_many_arguments, reason = "a row is where garment, body and settings meet")]
    pub fn add(
        &mut self,
        model: &Model,
        state: &State,
        status: &Status,
        (exact, solid): &(ExactDistance, Solid),
        inner: &[ExactDistance],
        body: &Mesh,
        regions: &Regions,
        thickness: f64,
        texel: f32,
    ) {
        let positions = &state.positions;
        let elongation = |limit: &toile::model::Limit| {
            let [a, b] = limit.ends.map(|end| positions[end as usize].as_dvec3());
            a.distance(b) / f64::from(limit.rest_length) - 1.0
        };
        let [max, p99] = max_and_p99(model.limits.iter().map(elongation).collect()).unwrap_or_default();
        self.over_long_count += status.over_long_count;
        if max > self.elongation_max {
            self.elongation_max = max;
            self.longest_spring = status.longest_limit.map(|longest| model.limits[longest as usize].ends);
            let place = self.longest_spring.map(|[end, _]| positions[end as usize].as_dvec3());
            self.longest_region = place.map(|place| regions.nearest(body, place).to_owned());
        }
        self.elongation_p99 = self.elongation_p99.max(p99);
        let depths: Vec<f64> = positions.iter().map(|p| exact.penetration(p.as_dvec3())).collect();
        let reach = reach(thickness, texel);
        let mut false_count = 0;
        for ((position, depth), touching) in positions.iter().zip(&depths).zip(&state.touching) {
            if *touching && is_far(position.as_dvec3(), *depth, inner, reach) {
                false_count += 1;
                let region = regions.nearest(body, position.as_dvec3());
                *self.false_contacts_by_region.entry(region.to_owned()).or_default() += 1;
            }
        }
        let before = f64::from(self.particle_count) * self.false_contact_fraction;
        self.particle_count += positions.len() as u32;
        self.false_contact_fraction = (before + f64::from(false_count)) / f64::from(self.particle_count.max(1));
        let [max, p99] = max_and_p99(depths).unwrap_or([f64::NEG_INFINITY; 2]);
        self.penetration_max_mm = self.penetration_max_mm.max(1e3 * max);
        self.penetration_p99_mm = self.penetration_p99_mm.max(1e3 * p99);
        let [edge, face] = middles(model, positions)
            .map(|points| points.into_iter().map(|point| exact.penetration(point)).fold(f64::NEG_INFINITY, f64::max));
        self.edge_penetration_max_mm = self.edge_penetration_max_mm.max(1e3 * edge);
        self.face_penetration_max_mm = self.face_penetration_max_mm.max(1e3 * face);
        self.crossed_count += crossed_particles(model, positions, solid).0.len() as u32;
        self.speed_max = self.speed_max.max(status.speed_max);
        self.kinetic_energy += status.kinetic_energy;
        self.non_finite_count += status.non_finite_count;
    }
}

impl FrameRow {
    /// Adds what the polish of a garment did from one status to the next.
    pub fn add_polish(&mut self, before: &Status, after: &Status) {
        self.further_sweeps += after.further_sweeps - before.further_sweeps;
        self.missed_steps += after.missed_steps - before.missed_steps;
    }
}

impl WalkMetrics {
    /// The metrics of a walk from its rows, and the part of a step that goes to the bodies [1].
    pub fn new(
        adapter: &str,
        fit: &Fit,
        walkers: &[Walker],
        verdicts: &[Verdict],
        collision_part: f64,
        frames: Vec<FrameRow>,
    ) -> Self {
        let most = |value: fn(&FrameRow) -> f64| frames.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
        let median = |value: fn(&FrameRow) -> f64| {
            let mut values: Vec<f64> = frames.iter().map(value).collect();
            values.sort_by(f64::total_cmp);
            values.get(values.len() / 2).copied().unwrap_or(0.0)
        };
        let mut regions: BTreeMap<String, u32> = BTreeMap::new();
        for (region, count) in frames.iter().flat_map(|row| &row.false_contacts_by_region) {
            *regions.entry(region.clone()).or_default() += count;
        }
        let settings = &fit.scene.settings;
        let thresholds = fit.scene.fabrics().map(|fabric| fabric.threshold);
        let threshold = thresholds
            .fold([0.0_f64; 3], |most, of| [most[0].max(of.warp), most[1].max(of.weft), most[2].max(of.shear)]);
        let fractions: f64 = frames.iter().map(|row| row.false_contact_fraction).sum();
        Self {
            adapter: adapter.to_owned(),
            garments: walkers.iter().map(|walker| walker.name.clone()).collect(),
            verdicts: walkers.iter().zip(verdicts).map(|(walker, verdict)| Told::new(&walker.name, verdict)).collect(),
            fit: fit::sentences(fit),
            particle_count: walkers.iter().map(|walker| walker.particle_count).sum(),
            steps_per_frame: walkers.first().map_or(0, |walker| walker.steps_per_frame),
            frame_rate: settings.frame_rate,
            threshold,
            frame_count: frames.len(),
            elongation_max: most(|row| row.elongation_max),
            elongation_p99_worst: most(|row| row.elongation_p99),
            further_sweeps: frames.iter().map(|row| row.further_sweeps).sum(),
            missed_steps: frames.iter().map(|row| row.missed_steps).sum(),
            penetration_max_mm: most(|row| row.penetration_max_mm),
            penetration_p99_worst_mm: most(|row| row.penetration_p99_mm),
            edge_penetration_max_mm: most(|row| row.edge_penetration_max_mm),
            face_penetration_max_mm: most(|row| row.face_penetration_max_mm),
            crossed_count: frames.iter().map(|row| row.crossed_count).max().unwrap_or(0),
            false_contact_fraction_mean: fractions / frames.len().max(1) as f64,
            false_contacts_by_region: regions,
            teleports: frames.iter().flat_map(|row| row.teleports.iter().copied()).collect(),
            non_finite_count: frames.iter().map(|row| row.non_finite_count).sum(),
            maps_ms_median: median(|row| row.maps_ms),
            simulation_ms_median: median(|row| row.simulation_ms),
            collision_ms_median: collision_part * median(|row| row.simulation_ms),
            output_ms_median: median(|row| row.output_ms),
            picture_ms_median: median(|row| row.picture_ms),
            frames,
        }
    }

    /// One line for each jump of the body, for the terminal.
    pub fn jumps(&self) -> impl Iterator<Item = String> {
        self.teleports.iter().map(|jump| {
            let degrees = jump.angle.to_degrees();
            format!(
                "the body jumps at {:.2} s, by {:.2} m and {degrees:.0}°: its garments are carried along",
                jump.time, jump.distance
            )
        })
    }

    /// The walk on one line, for the terminal.
    pub fn line(&self) -> String {
        format!(
            "{}: {} particles · {} frames of {} steps · {} · {} (99 of 100: {}, edges {}, faces {}) · crossed {} · false contacts {:.2} % · maps {:.0} ms, simulation {:.0} ms (bodies {:.0} ms), output {:.0} ms (pictures {:.0} ms) per frame",
            self.garments.join(", "),
            self.particle_count,
            self.frame_count,
            self.steps_per_frame,
            elongation(self.elongation_max, self.elongation_p99_worst, self.threshold),
            depth(self.penetration_max_mm),
            depth(self.penetration_p99_worst_mm),
            depth(self.edge_penetration_max_mm),
            depth(self.face_penetration_max_mm),
            self.crossed_count,
            1e2 * self.false_contact_fraction_mean,
            self.maps_ms_median,
            self.simulation_ms_median,
            self.collision_ms_median,
            self.output_ms_median,
            self.picture_ms_median,
        )
    }
}
