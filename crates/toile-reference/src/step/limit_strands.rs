//! The predictive rule along strands, from limits over many steps to those over one.

use crate::Particles;
use glam::Vec3;
use toile_model::{Strand, path_chord};

/// Removes from the velocities what would make a limit along some strands over-long after a move of `dt` [s], by inverse mass: level
/// by level, the longest first, and in each level by turns of limits that share no particle. What is held is the length of a limit's
/// path ([`path_chord`]): around a body that of the cloth on it, where a single chord is shorter and would let it stretch. The strands
/// are those of one colour: no two share a particle. `strand_particles` and `strand_lengths` [m] are those of the model.
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
            let chord = path_chord(reach);
            let turns = reach / chord + 1;
            for turn in 0..turns {
                for first in (0..line.len().saturating_sub(reach)).filter(|k| (k / chord) % turns == turn) {
                    let knots = |k: usize| first + k * chord;
                    if chord == reach {
                        hold_chord(&mut points, [0, 1].map(knots), lengths[first]);
                    } else {
                        hold_path(&mut points, [0, 1, 2, 3, 4].map(knots), lengths[first]);
                    }
                }
            }
        }
        for (i, point) in line.iter().zip(points) {
            particles.velocities[*i as usize] += point.shift / dt;
        }
    }
}

/// A particle of a strand.
struct Point {
    /// Where it would be after the coming move [m].
    place: Vec3,
    inverse_mass: f32,
    /// How far the limits have moved that place [m].
    shift: Vec3,
}

impl Point {
    fn after_move(particles: &Particles, i: usize, dt: f32) -> Self {
        let place = particles.positions[i] + particles.velocities[i] * dt;
        Self { place, inverse_mass: particles.inverse_masses[i], shift: Vec3::ZERO }
    }

    fn now(&self) -> Vec3 {
        self.place + self.shift
    }
}

fn hold_chord(points: &mut [Point], [a, b]: [usize; 2], max_length: f32) {
    let weight = points[a].inverse_mass + points[b].inverse_mass;
    let chord = points[b].now() - points[a].now();
    let length = chord.length();
    if length > max_length && weight > 0.0 {
        let pull = chord * ((length - max_length) / (length * weight));
        points[a].shift += pull * points[a].inverse_mass;
        points[b].shift -= pull * points[b].inverse_mass;
    }
}

/// The excess of the path goes to each particle along the gradient of its length, by inverse mass.
fn hold_path(points: &mut [Point], knots: [usize; 5], max_length: f32) {
    let chords = [0, 1, 2, 3].map(|k| points[knots[k + 1]].now() - points[knots[k]].now());
    let lengths = chords.map(Vec3::length);
    let excess = lengths[0] + lengths[1] + lengths[2] + lengths[3] - max_length;
    let direction = |k: usize| if lengths[k] > 0.0 { chords[k] / lengths[k] } else { Vec3::ZERO };
    let [first, second, third, fourth] = [0, 1, 2, 3].map(direction);
    let gradients = [first, second - first, third - second, fourth - third, -fourth];
    let yields = knots.iter().zip(&gradients).map(|(knot, g)| points[*knot].inverse_mass * g.length_squared());
    let yielding = yields.reduce(|sum, part| sum + part).expect("a path has knots");
    if excess > 0.0 && yielding > 0.0 {
        let pull = excess / yielding;
        for (knot, gradient) in knots.into_iter().zip(gradients) {
            let point = &mut points[knot];
            point.shift += gradient * (pull * point.inverse_mass);
        }
    }
}
