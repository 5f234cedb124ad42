//! The predictive rule along strands, from limits over many edges to single ones.

use crate::Particles;
use glam::Vec3;
use toile_model::Strand;

/// Removes from the velocities what would make a limit along some strands over-long after a move of `dt` [s], by inverse mass: level
/// by level, the longest first, and in each level every other limit and then those between. The strands are those of one
/// colour: no two share a particle. `strand_particles` and `strand_lengths` [m] are those of the model.
///
/// Along a strand the velocities change by the sum of all that its limits ask for, added up from zero: added one by one to the
/// velocities of fast cloth, small changes would lose their last bits, and with them momentum.
pub fn limit_strands(
    particles: &mut Particles,
    strands: &[Strand],
    strand_particles: &[u32],
    strand_lengths: &[f32],
    dt: f32,
) {
    for strand in strands {
        let line = &strand_particles[strand.particles.start as usize..strand.particles.end as usize];
        let mut points: Vec<Point> = line.iter().map(|i| Point::after_move(particles, *i as usize, dt)).collect();
        for level in (0..strand.level_count).rev() {
            let reach = 1_usize << level;
            let lengths = &strand_lengths[strand.lengths_from(level) as usize..];
            for parity in [0, 1] {
                for first in (0..line.len().saturating_sub(reach)).filter(|k| (k / reach) % 2 == parity) {
                    hold(&mut points, [first, first + reach], lengths[first], dt);
                }
            }
        }
        for (i, point) in line.iter().zip(points) {
            particles.velocities[*i as usize] += point.change;
        }
    }
}

/// A particle of a strand.
struct Point {
    /// Where it will be after the coming move [m].
    place: Vec3,
    inverse_mass: f32,
    /// By how much its velocity has changed [m/s].
    change: Vec3,
}

impl Point {
    fn after_move(particles: &Particles, i: usize, dt: f32) -> Self {
        let place = particles.positions[i] + particles.velocities[i] * dt;
        Self { place, inverse_mass: particles.inverse_masses[i], change: Vec3::ZERO }
    }

    fn add(&mut self, change: Vec3, dt: f32) {
        self.place += change * dt;
        self.change += change;
    }
}

fn hold(points: &mut [Point], [a, b]: [usize; 2], max_length: f32, dt: f32) {
    let [weight_a, weight_b] = [points[a].inverse_mass, points[b].inverse_mass];
    let weight = weight_a + weight_b;
    let span = points[b].place - points[a].place;
    let squared = span.length_squared();
    if squared > max_length * max_length && weight > 0.0 {
        let length = squared.sqrt();
        let impulse = span * ((length - max_length) / ((length * dt) * weight));
        points[a].add(impulse * weight_a, dt);
        points[b].add(-(impulse * weight_b), dt);
    }
}
