//! The springs of a model in f64, with a step that goes to zero: what a simulation at the same mesh converges to.

use glam::DVec3;
use toile::model::{Model, StepSettings};

/// The springs of a model in f64: D eq. 2 with gravity and viscous damping, in a classic Runge-Kutta step of fourth order. Limits,
/// where they are wanted, are springs that resist lengthening alone.
#[derive(Clone, Debug)]
pub struct Network {
    /// Positions [m], shape [particle_count].
    pub positions: Vec<DVec3>,
    /// Velocities [m/s], shape [particle_count].
    pub velocities: Vec<DVec3>,
    inverse_masses: Vec<f64>,
    springs: Vec<Spring>,
    gravity: DVec3,
    damping: f64,
}

#[derive(Clone, Copy, Debug)]
struct Spring {
    ends: [usize; 2],
    rest_length: f64,
    stiffness: f64,
    resists_shortening: bool,
}

impl Network {
    /// The springs of a model at its start, at rest. The links are taken, which a model may have softened to what its step carries.
    pub fn new(model: &Model, step: &StepSettings) -> Self {
        let springs = (0..model.positions.len()).flat_map(|i| {
            model.links.row(i).iter().filter(move |link| link.other as usize > i).map(move |link| Spring {
                ends: [i, link.other as usize],
                rest_length: f64::from(link.rest_length),
                stiffness: f64::from(link.stiffness),
                resists_shortening: true,
            })
        });
        Self {
            positions: model.positions.iter().map(|position| position.as_dvec3()).collect(),
            velocities: vec![DVec3::ZERO; model.positions.len()],
            inverse_masses: model.inverse_masses.iter().map(|inverse_mass| f64::from(*inverse_mass)).collect(),
            springs: springs.collect(),
            gravity: step.gravity.as_dvec3(),
            damping: f64::from(step.damping),
        }
    }

    /// Adds the limits of the model's springs: beyond its maximum length each pulls with a stiffness [N/m].
    #[must_use]
    pub fn with_limits(mut self, model: &Model, stiffness: f64) -> Self {
        self.springs.extend(model.limits.iter().map(|limit| Spring {
            ends: limit.ends.map(|end| end as usize),
            rest_length: f64::from(limit.max_length),
            stiffness,
            resists_shortening: false,
        }));
        self
    }

    /// Goes on by some seconds in steps of at most `step` [s].
    pub fn advance(&mut self, seconds: f64, step: f64) {
        let count = (seconds / step).ceil().max(1.0);
        let dt = seconds / count;
        for _ in 0..count as u64 {
            self.step(dt);
        }
    }

    /// Largest step [s] that is surely stable: 2.78 over Gershgorin's bound of the fastest rate, where Runge-Kutta of fourth order ends.
    pub fn stable_step(&self) -> f64 {
        let mut sums = vec![0.0; self.positions.len()];
        for spring in &self.springs {
            spring.ends.iter().for_each(|end| sums[*end] += spring.stiffness);
        }
        let squared = sums.iter().zip(&self.inverse_masses).map(|(sum, w)| 2.0 * sum * w).fold(0.0, f64::max);
        2.78 / squared.sqrt()
    }

    fn step(&mut self, dt: f64) {
        let start = [self.positions.clone(), self.velocities.clone()];
        let mut mean = [vec![DVec3::ZERO; start[0].len()], vec![DVec3::ZERO; start[0].len()]];
        let mut rates = [self.velocities.clone(), self.accelerations()];
        for (weight, next) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
            for (sum, rate) in mean.iter_mut().zip(&rates) {
                sum.iter_mut().zip(rate).for_each(|(sum, rate)| *sum += *rate * (weight / 6.0));
            }
            if next > 0.0 {
                self.set(&start, &rates, next * dt);
                rates = [self.velocities.clone(), self.accelerations()];
            }
        }
        self.set(&start, &mean, dt);
    }

    fn set(&mut self, start: &[Vec<DVec3>; 2], rates: &[Vec<DVec3>; 2], dt: f64) {
        for (state, (start, rate)) in
            [&mut self.positions, &mut self.velocities].into_iter().zip(start.iter().zip(rates))
        {
            state
                .iter_mut()
                .zip(start.iter().zip(rate))
                .for_each(|(state, (start, rate))| *state = *start + *rate * dt);
        }
    }

    /// Accelerations [m/s²]; zero for pinned particles.
    fn accelerations(&self) -> Vec<DVec3> {
        let mut forces = vec![DVec3::ZERO; self.positions.len()];
        for &Spring { ends: [a, b], rest_length, stiffness, resists_shortening } in &self.springs {
            let span = self.positions[b] - self.positions[a];
            let length = span.length();
            if length > 0.0 && (resists_shortening || length > rest_length) {
                let pull = span * (stiffness * (length - rest_length) / length);
                forces[a] += pull;
                forces[b] -= pull;
            }
        }
        let free = |(i, force): (usize, DVec3)| {
            let w = self.inverse_masses[i];
            if w > 0.0 { force * w + self.gravity - self.velocities[i] * self.damping } else { DVec3::ZERO }
        };
        forces.into_iter().enumerate().map(free).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Network;
    use crate::scenes::hanging_sheet;
    use toile::model::{Model, StepSettings};
    use toile::scene::{Rule, VelocityModification};

    fn swing(step: f64) -> Network {
        let (sheet, mut settings) = hanging_sheet(4);
        settings.velocity_modification = VelocityModification::new(Rule::None);
        let model = Model::from_sheet(&sheet, &settings);
        let mut network = Network::new(&model, &StepSettings::new(&settings, &model));
        network.advance(0.25, step);
        network
    }

    /// Halving the step of a method of order four leaves a sixteenth of the error.
    #[test]
    fn it_converges_with_order_four() {
        let exact = swing(1e-4);
        let error = |step| {
            let rough = swing(step);
            rough.positions.iter().zip(&exact.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
        };
        let ratio = error(4e-3) / error(2e-3);
        assert!((12.0..20.0).contains(&ratio), "{ratio}");
    }
}
