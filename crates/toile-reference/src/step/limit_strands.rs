//! The predictive rule along strands, from limits over many edges to single ones.

use crate::Particles;
use glam::Vec3;
use toile_model::{Strand, path_chord};

/// Removes from the velocities what would make a limit along some strands over-long after a move of `dt` [s], by inverse mass: level
/// by level, the longest first, and in each level first limits that share no particle and then those between. What is held is the length of a limit's
/// path ([`path_chord`]): around a body that of the cloth on it, where a single chord is shorter and would let it stretch. The strands are those of one
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
            let chord = path_chord(level);
            // Limits that begin in the same turn share no particle.
            let turns = reach / chord + 1;
            for turn in 0..turns {
                for first in (0..line.len().saturating_sub(reach)).filter(|k| (k / chord) % turns == turn) {
                    if chord == reach {
                        hold_chord(&mut points, [first, first + reach], lengths[first], dt);
                    } else {
                        hold_path(&mut points, [0, 1, 2, 3, 4].map(|k| first + k * chord), lengths[first], dt);
                    }
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

    fn shift(&mut self, way: Vec3, dt: f32) {
        self.place += way * self.inverse_mass;
        self.change += way * (self.inverse_mass / dt);
    }
}

fn hold_chord(points: &mut [Point], [a, b]: [usize; 2], max_length: f32, dt: f32) {
    let weight = points[a].inverse_mass + points[b].inverse_mass;
    let chord = points[b].place - points[a].place;
    let squared = chord.length_squared();
    if squared > max_length * max_length && weight > 0.0 {
        let length = squared.sqrt();
        let way = chord * ((length - max_length) / (length * weight));
        points[a].shift(way, dt);
        points[b].shift(-way, dt);
    }
}

/// The excess of the path goes to each particle along the gradient of its length, by inverse mass.
fn hold_path(points: &mut [Point], knots: [usize; 5], max_length: f32, dt: f32) {
    let chords = [0, 1, 2, 3].map(|k| points[knots[k + 1]].place - points[knots[k]].place);
    let squared = chords.map(Vec3::length_squared);
    if !(4.0 * ((squared[0] + squared[1]) + (squared[2] + squared[3])) > max_length * max_length) {
        return;
    }
    let lengths = squared.map(f32::sqrt);
    let excess = ((lengths[0] + lengths[1]) + (lengths[2] + lengths[3])) - max_length;
    if !(excess > 0.0) {
        return;
    }
    let direction = |k: usize| if lengths[k] > 0.0 { chords[k] / lengths[k] } else { Vec3::ZERO };
    let [first, second, third, fourth] = [0, 1, 2, 3].map(direction);
    let ways = [first, second - first, third - second, fourth - third, fourth];
    let yields = |k: usize| points[knots[k]].inverse_mass * ways[k].length_squared();
    let yielding = yields(0) + yields(1) + yields(2) + yields(3) + yields(4);
    if yielding > 0.0 {
        let pull = excess / yielding;
        for (knot, way) in knots.into_iter().zip(ways).take(4) {
            points[knot].shift(way * pull, dt);
        }
        points[knots[4]].shift(fourth * -pull, dt);
    }
}
