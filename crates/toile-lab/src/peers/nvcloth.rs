//! NvCloth's scheme, written anew from what its documentation and headers say: position-based dynamics, on one thread.
//!
//! An iteration moves particles by their last move and gravity, pulls them back to their anchors by one-sided tethers, goes once over the
//! constraints, phase by phase and in each phase set by set, and then sets what is inside of a shape on its surface. Constraints of
//! a set share no particle. A frame has as many iterations as the solver's frequency gives.
//! Stiffness and damping are shares per period of the stiffness frequency, so that an iteration of dt takes 1 − (1 − share)^(frequency·dt).

use super::{Sphere, Trial};
use glam::{Vec3, Vec4, Vec4Swizzles};

/// Its default stiffness frequency [1/s].
const STIFFNESS_FREQUENCY: f64 = 10.0;
/// Constraints that are held at once: their roots and quotients go through a processor side by side.
const LANES: usize = 8;

/// A constraint that keeps two particles at a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// Particles.
    pub ends: [u32; 2],
    /// Their distance [m], positive.
    pub rest_length: f32,
}

/// Constraints of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Phase {
    /// Share of an error that a period of the stiffness frequency takes, 0 to 1.
    pub stiffness: f64,
    /// Constraints; those of a set share no particle.
    pub sets: Vec<Vec<Constraint>>,
}

/// What a particle may not be farther from than a length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tether {
    /// The other particle.
    pub anchor: u32,
    /// Largest distance [m].
    pub length: f32,
}

/// What a user sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NvClothSettings {
    /// Whether tethers lead to the held particles.
    pub tethers: bool,
    /// Stiffness of the sides of cells, of their diagonals, and of what spans two cells, 0 to 1.
    pub stiffness: [f64; 3],
}

/// A cloth under NvCloth's scheme.
#[derive(Clone, Debug)]
pub struct NvClothScheme {
    /// Acceleration that acts on all particles [m/s²].
    pub gravity: Vec3,
    /// What stands in the way.
    pub sphere: Option<Sphere>,
    /// Share of the velocity that a period of the stiffness frequency takes, 0 to 1.
    pub damping: f64,
    /// Constraints, in the order in which they are held.
    pub phases: Vec<Phase>,
    /// Tethers of each particle, as many for each.
    pub tethers: Vec<Vec<Tether>>,
    /// Positions [m] with inverse masses [1/kg]; 0 does not move.
    current: Vec<Vec4>,
    previous: Vec<Vec4>,
}

impl NvClothScheme {
    /// Particles at rest that nothing joins.
    ///
    /// # Panics
    /// When there are not as many inverse masses as positions.
    pub fn of_particles(positions: &[Vec3], inverse_masses: &[f32]) -> Self {
        assert_eq!(positions.len(), inverse_masses.len(), "each particle has a mass");
        let current: Vec<Vec4> = positions.iter().zip(inverse_masses).map(|(p, w)| p.extend(*w)).collect();
        Self {
            gravity: Vec3::ZERO,
            sphere: None,
            damping: 0.0,
            phases: Vec::new(),
            tethers: Vec::new(),
            previous: current.clone(),
            current,
        }
    }

    /// The sheet of a trial.
    pub fn new(trial: &Trial, settings: NvClothSettings) -> Self {
        let (positions, inverse_masses) = (trial.positions(), &trial.model.inverse_masses);
        let mut scheme = Self::of_particles(positions, inverse_masses);
        let scene = &trial.scene.settings;
        scheme.gravity = scene.gravity.as_vec3();
        scheme.sphere = trial.sphere;
        scheme.damping = 1.0 - (-scene.fabric.damping / STIFFNESS_FREQUENCY).exp();
        let kinds: [&[[i32; 2]]; 3] = [&[[1, 0], [0, 1]], &[[1, 1], [-1, 1]], &[[2, 0], [0, 2]]];
        scheme.phases = kinds
            .iter()
            .zip(settings.stiffness)
            .filter(|(_, stiffness)| *stiffness > 0.0)
            .map(|(offsets, stiffness)| Phase {
                stiffness,
                sets: offsets.iter().flat_map(|offset| sets(trial.n as i32, *offset, trial.spacing())).collect(),
            })
            .collect();
        if settings.tethers {
            let held = || (0..positions.len()).filter(|at| inverse_masses[*at] == 0.0);
            let to = |from: Vec3| {
                held().map(move |at| Tether { anchor: at as u32, length: from.distance(positions[at]) }).collect()
            };
            scheme.tethers = positions.iter().map(|position| to(*position)).collect();
        }
        scheme
    }

    /// Positions [m], shape [particle_count].
    pub fn positions(&self) -> Vec<Vec3> {
        self.current.iter().map(|particle| particle.xyz()).collect()
    }

    /// Does some iterations, which take some seconds in all.
    pub fn advance(&mut self, seconds: f64, iterations: u32) {
        let dt = seconds / f64::from(iterations);
        for _ in 0..iterations {
            self.iterate(dt);
        }
    }

    fn iterate(&mut self, dt: f64) {
        self.integrate(dt);
        self.hold_tethers();
        for phase in &self.phases {
            let share = share(phase.stiffness, dt) as f32;
            for set in &phase.sets {
                let (whole, rest) = set.as_chunks::<LANES>();
                whole.iter().for_each(|constraints| hold(&mut self.current, constraints, share));
                rest.iter().for_each(|constraint| hold(&mut self.current, &[*constraint], share));
            }
        }
        if let Some(sphere) = self.sphere {
            self.keep_out(sphere);
        }
    }

    fn integrate(&mut self, dt: f64) {
        let kept = 1.0 - share(self.damping, dt) as f32;
        let fall = (self.gravity * (dt * dt) as f32).extend(0.0);
        for (current, previous) in self.current.iter_mut().zip(&mut self.previous) {
            let last = std::mem::replace(previous, *current);
            if current.w > 0.0 {
                *current += (*current - last) * kept + fall;
            }
        }
    }

    fn hold_tethers(&mut self) {
        for (at, tethers) in self.tethers.iter().enumerate() {
            let particle = self.current[at];
            if particle.w > 0.0 && !tethers.is_empty() {
                let pull = |tether: &Tether| {
                    let span = self.current[tether.anchor as usize].xyz() - particle.xyz();
                    span * (1.0 - tether.length / span.length().max(f32::MIN_POSITIVE)).max(0.0)
                };
                let pulls: Vec3 = tethers.iter().map(pull).sum();
                self.current[at] += (pulls / tethers.len() as f32).extend(0.0);
            }
        }
    }

    /// What is inside of the sphere is set on it, and slides by what friction leaves: Coulomb's law on the moves of an iteration.
    fn keep_out(&mut self, sphere: Sphere) {
        let (radius, friction) = (sphere.radius as f32, sphere.friction as f32);
        for (current, previous) in self.current.iter_mut().zip(&self.previous) {
            let position = current.xyz();
            let depth = radius - position.length();
            if depth > 0.0 && current.w > 0.0 {
                let normal = position.normalize_or(Vec3::Y);
                let outside = position + normal * depth;
                let moved = outside - previous.xyz();
                let sliding = moved - normal * moved.dot(normal);
                let stopped = (friction * depth / sliding.length().max(f32::MIN_POSITIVE)).min(1.0);
                *current = (outside - sliding * stopped).extend(current.w);
            }
        }
    }
}

/// What an iteration takes of what a period of the stiffness frequency takes a share of.
fn share(of_a_period: f64, dt: f64) -> f64 {
    1.0 - (1.0 - of_a_period).powf(STIFFNESS_FREQUENCY * dt)
}

/// Holds constraints that share no particle: each end takes its part of the correction by inverse mass.
fn hold<const COUNT: usize>(particles: &mut [Vec4], constraints: &[Constraint; COUNT], share: f32) {
    let ends = constraints.map(|constraint| constraint.ends.map(|end| end as usize));
    let spans = ends.map(|[a, b]| particles[b] - particles[a]);
    let weights = ends.map(|[a, b]| particles[a].w + particles[b].w);
    let mut shares = [0.0; COUNT];
    for lane in 0..COUNT {
        let [x, y, z, _] = spans[lane].to_array();
        let length = (x * x + y * y + z * z).sqrt().max(f32::MIN_POSITIVE);
        shares[lane] = share * (1.0 - constraints[lane].rest_length / length) / weights[lane].max(f32::MIN_POSITIVE);
    }
    for lane in 0..COUNT {
        let [a, b] = ends[lane];
        let correction = spans[lane].with_w(0.0) * shares[lane];
        let [wa, wb] = [particles[a].w, particles[b].w];
        particles[a] += correction * wa;
        particles[b] -= correction * wb;
    }
}

/// All constraints of a grid between particles an offset apart, as two sets: along the offset they take turns.
fn sets(n: i32, [right, down]: [i32; 2], spacing: f64) -> [Vec<Constraint>; 2] {
    let rest_length = (spacing * f64::from(right * right + down * down).sqrt()) as f32;
    let mut sets = [Vec::new(), Vec::new()];
    for row in 0..n - down {
        for column in (-right).max(0)..n - right.max(0) {
            let turn = if down > 0 { row / down } else { column / right };
            let at = row * n + column;
            let ends = [at, at + down * n + right].map(|end| end as u32);
            sets[turn as usize % 2].push(Constraint { ends, rest_length });
        }
    }
    sets
}

#[cfg(test)]
mod tests {
    use super::{Constraint, NvClothScheme, NvClothSettings, Phase, Tether};
    use crate::Random;
    use crate::peers::{Sphere, Trial};
    use glam::{DVec3, Vec3};

    const SETTINGS: NvClothSettings = NvClothSettings { tethers: true, stiffness: [1.0, 0.8, 0.5] };

    /// Mean position by mass [m].
    fn centre(scheme: &NvClothScheme, masses: &[f32]) -> DVec3 {
        let weighed = scheme.positions().into_iter().zip(masses).map(|(p, m)| p.as_dvec3() * f64::from(*m));
        weighed.sum::<DVec3>() / masses.iter().map(|m| f64::from(*m)).sum::<f64>()
    }

    /// A chain of particles of 1 kg that hangs from its first, in cells of 0.1 m; it starts level.
    fn chain(count: u32) -> NvClothScheme {
        let positions: Vec<Vec3> = (0..count).map(|at| Vec3::X * 0.1 * at as f32).collect();
        let inverse_masses: Vec<f32> = (0..count).map(|at| if at == 0 { 0.0 } else { 1.0 }).collect();
        let mut chain = NvClothScheme::of_particles(&positions, &inverse_masses);
        let set = |turn: u32| (turn..count - 1).step_by(2).map(|a| Constraint { ends: [a, a + 1], rest_length: 0.1 });
        chain.phases = vec![Phase { stiffness: 1.0, sets: vec![set(0).collect(), set(1).collect()] }];
        chain.gravity = Vec3::NEG_Y * 9.81;
        chain
    }

    #[test]
    fn constraints_of_a_set_share_no_particle_and_all_are_there() {
        let trial = Trial::new("hang", 9);
        let scheme = NvClothScheme::new(&trial, SETTINGS);
        let counts = scheme.phases.iter().map(|phase| phase.sets.iter().map(Vec::len).sum::<usize>());
        assert_eq!(counts.collect::<Vec<_>>(), [2 * 8 * 9, 2 * 8 * 8, 2 * 7 * 9]);
        for set in scheme.phases.iter().flat_map(|phase| &phase.sets) {
            let mut ends: Vec<u32> = set.iter().flat_map(|constraint| constraint.ends).collect();
            ends.sort_unstable();
            let count = ends.len();
            ends.dedup();
            assert_eq!(ends.len(), count, "a set that meets itself");
            for Constraint { ends: [a, b], rest_length } in set {
                let apart = trial.positions()[*a as usize].distance(trial.positions()[*b as usize]);
                assert!((apart - rest_length).abs() < 1e-6, "a flat sheet is at rest: {apart} {rest_length}");
            }
        }
    }

    /// Constraints act between their ends alone, so that a crumpled sheet falls as one mass does.
    #[test]
    fn a_crumpled_sheet_in_free_fall_keeps_its_momentum() {
        let trial = Trial::new("ball", 12);
        let masses = &trial.model.masses;
        let sheet = NvClothScheme::new(&trial, SETTINGS);
        let mut random = Random::new(1);
        let crumpled: Vec<Vec3> = sheet.positions().into_iter().map(|p| p + random.vector(0.02)).collect();
        let mut free = NvClothScheme::of_particles(&crumpled, &trial.model.inverse_masses);
        free.phases = sheet.phases;
        free.gravity = sheet.gravity;
        let start = centre(&free, masses);
        let (dt, count) = (1.0 / 600.0, 60);
        free.advance(dt * f64::from(count), count);
        // Symplectic Euler goes g·dt² further a step.
        let fallen = 0.5 * dt * dt * f64::from(count * (count + 1));
        let expected = start + trial.scene.settings.gravity * fallen;
        // Each step rounds positions of about 0.5 m to 3e-8 m, and keeps what it rounded as velocity.
        assert!(centre(&free, masses).distance(expected) < 1e-4, "{} {expected}", centre(&free, masses));
        let moved = free.positions()[5].distance(crumpled[5] + expected.as_vec3() - start.as_vec3());
        assert!(moved > 1e-3, "the constraints did something: {moved}");
    }

    #[test]
    fn a_chain_comes_to_hang_straight_at_its_length() {
        let mut chain = chain(8);
        chain.damping = 0.9;
        chain.advance(20.0, 24_000);
        for (at, position) in chain.positions().into_iter().enumerate() {
            let straight = Vec3::NEG_Y * 0.1 * at as f32;
            // Gravity draws every link out by what one sweep leaves of g·dt².
            assert!(position.distance(straight) < 1e-3, "{at}: {position} {straight}");
        }
    }

    #[test]
    fn few_iterations_stretch_and_a_tether_holds() {
        let reach = |tether: bool| {
            let mut chain = chain(40);
            chain.damping = 0.9;
            if tether {
                chain.tethers = (0..40).map(|at| vec![Tether { anchor: 0, length: 0.1 * at as f32 }]).collect();
            }
            chain.advance(5.0, 300);
            let positions = chain.positions();
            positions.iter().map(|position| position.length()).fold(0.0, f32::max) / 3.9 - 1.0
        };
        let [loose, held] = [reach(false), reach(true)];
        assert!(loose > 0.05 && held < 0.01, "{loose} {held}");
    }

    /// A share per period of a tenth of a second, however many iterations it has.
    #[test]
    fn stiffness_hangs_on_time_and_not_on_iterations() {
        let left = |iterations: u32| {
            let mut pair = NvClothScheme::of_particles(&[Vec3::ZERO, Vec3::X * 2.0], &[1.0, 0.0]);
            let set = vec![Constraint { ends: [0, 1], rest_length: 1.0 }];
            pair.phases = vec![Phase { stiffness: 0.75, sets: vec![set] }];
            // All velocity goes, so that the constraint alone moves it.
            pair.damping = 1.0;
            pair.advance(0.1, iterations);
            2.0 - pair.positions()[0].x - 1.0
        };
        for iterations in [1, 4, 50] {
            assert!((left(iterations) - 0.25).abs() < 1e-4, "{iterations}: {}", left(iterations));
        }
    }

    /// On a slope below the angle of friction a particle stays, above it slides.
    #[test]
    fn what_lies_on_a_sphere_sticks_by_coulombs_law() {
        let slid = |friction: f64| {
            let start = Vec3::new(0.2, 1.0, 0.0).normalize();
            let mut lying = NvClothScheme::of_particles(&[start], &[1.0]);
            lying.gravity = Vec3::NEG_Y * 9.81;
            lying.sphere = Some(Sphere { radius: 1.0, friction });
            lying.advance(0.1, 60);
            assert!(lying.positions()[0].length() > 0.999, "it is kept out");
            lying.positions()[0].distance(start)
        };
        assert!(slid(0.3) < 1e-4 && slid(0.1) > 1e-3, "{} {}", slid(0.3), slid(0.1));
    }
}
