//! Cloth, bodies and numbers that the tests share.

use glam::{DVec3, Vec2, Vec3};
use std::collections::HashSet;
use std::ops::Range;
use toile_model::{Arrays, Cluster, Csr, Level, Limit, Link, Model, NO_CORNER, Spring, SpringKind, StepSettings};
use toile_reference::Particles;
use toile_scene::{Fabric, Friction, Rule, Settings};

/// Elongation that the limits of the test cloth allow.
pub const THRESHOLD: f32 = 0.05;

pub const GRAVITY: f32 = 9.81;

pub fn settings() -> StepSettings {
    let particle = Model::new(Arrays::of_particles(vec![Vec3::ZERO], vec![1.0])).expect("a particle is a model");
    let mut step = StepSettings::new(&Settings::new(Fabric::preset("cotton").expect("a preset")), &particle);
    step.dt = 1.0 / 600.0;
    step.steps_per_frame = 10;
    step.gravity = Vec3::new(0.0, -GRAVITY, 0.0);
    step.wind = None;
    step.damping = 0.0;
    step.thickness = 1e-3;
    step.push_speed = 0.2;
    step.pressing = f32::INFINITY;
    step.contact_margin = 1e-4;
    step.reflection = 0.0;
    step.law = Friction::Coulomb;
    step.friction = 0.3;
    step.hold_rate = 10.0;
    step.hold_speed = 0.5;
    step.rule = Rule::None;
    step.sweeps = 1;
    step.limit_passes = 1;
    step.coarse_passes = 1;
    step.guard_passes = 2;
    step.polish = None;
    step.swept = true;
    step
}

/// What a model is made of before its arrays are derived.
#[derive(Default)]
pub struct Parts {
    pub positions: Vec<Vec3>,
    pub masses: Vec<f32>,
    pub pins: Vec<usize>,
    pub springs: Vec<Spring>,
    pub quads: Vec<[u32; 4]>,
}

impl Parts {
    pub fn model(self) -> Model {
        let count = self.positions.len();
        let links = (0..count as u32).map(|i| {
            self.springs
                .iter()
                .filter(|spring| spring.ends.contains(&i))
                .map(|spring| Link {
                    other: spring.ends[0] + spring.ends[1] - i,
                    rest_length: spring.rest_length,
                    stiffness: spring.stiffness,
                })
                .collect::<Vec<_>>()
        });
        let particle_quads = (0..count as u32).map(|i| {
            (0..self.quads.len() as u32).filter(|quad| self.quads[*quad as usize].contains(&i)).collect::<Vec<_>>()
        });
        let limits = self.springs.iter().filter(|s| s.kind <= SpringKind::Shear).map(|s| Limit {
            ends: s.ends,
            rest_length: s.rest_length,
            max_length: (1.0 + THRESHOLD) * s.rest_length,
        });
        let (limits, limit_colours) = coloured(limits.collect(), |limit| limit.ends);
        // One level, in which each limit is a cluster.
        let lengths = |length: f32| [length, f32::INFINITY, f32::INFINITY, f32::INFINITY, f32::INFINITY, f32::INFINITY];
        let cluster = |limit: &Limit| Cluster {
            nodes: [limit.ends[0], limit.ends[1], NO_CORNER, NO_CORNER],
            max_lengths: lengths(limit.max_length),
        };
        let mut arrays = Arrays::default();
        arrays.flat = vec![Vec2::ZERO; count];
        arrays.links = Csr::from_rows(links);
        arrays.particle_quads = Csr::from_rows(particle_quads);
        arrays.inverse_masses =
            (0..count).map(|i| if self.pins.contains(&i) { 0.0 } else { 1.0 / self.masses[i] }).collect();
        arrays.positions = self.positions;
        arrays.masses = self.masses;
        arrays.springs = self.springs;
        arrays.quads = self.quads;
        arrays.levels = vec![Level { nodes: 0..count as u32, colours: limit_colours.clone() }];
        arrays.clusters = limits.iter().map(cluster).collect();
        arrays.guard_lengths = limits.iter().map(|limit| lengths(2.0 * limit.max_length - limit.rest_length)).collect();
        arrays.leaders = Csr::from_rows((0..count).map(|_| []));
        arrays.limits = limits;
        arrays.limit_colours = limit_colours;
        arrays.attachments = Csr::from_rows((0..count).map(|_| []));
        Model::new(arrays).expect("parts that fit together")
    }
}

/// A value with some of its fields set.
pub fn with<T>(mut value: T, set: impl FnOnce(&mut T)) -> T {
    set(&mut value);
    value
}

/// A model of changed arrays, which still fit together.
pub fn changed(model: Model, change: impl FnOnce(&mut Arrays)) -> Model {
    model.changed(change).expect("arrays that fit together")
}

/// Items sorted by colour so that no two of a colour share an end.
pub fn coloured<T: Copy>(items: Vec<T>, ends: impl Fn(&T) -> [u32; 2]) -> (Vec<T>, Vec<Range<u32>>) {
    let mut colours: Vec<(HashSet<u32>, Vec<T>)> = Vec::new();
    for item in items {
        let free = colours.iter_mut().find(|(used, _)| ends(&item).iter().all(|end| !used.contains(end)));
        let colour = match free {
            Some(colour) => colour,
            None => {
                colours.push(Default::default());
                colours.last_mut().unwrap()
            }
        };
        colour.0.extend(ends(&item));
        colour.1.push(item);
    }
    let mut sorted = Vec::new();
    let mut ranges = Vec::new();
    for (_, members) in colours {
        let start = sorted.len() as u32;
        sorted.extend(members);
        ranges.push(start..sorted.len() as u32);
    }
    (sorted, ranges)
}

/// A square grid in the plane of `right` and `down`, with uniform masses and stiffnesses of structural, shear and bend springs.
pub struct Grid {
    pub columns: u32,
    pub rows: u32,
    pub spacing: f32,
    pub corner: Vec3,
    pub right: Vec3,
    pub down: Vec3,
    pub mass: f32,
    pub stiffnesses: [f32; 3],
    pub pins: Vec<usize>,
}

impl Grid {
    /// A horizontal sheet of 0.2 kg/m² around the origin, at height 0, its outside up.
    pub fn horizontal(count: u32, spacing: f32) -> Self {
        let half = 0.5 * spacing * (count - 1) as f32;
        Self {
            columns: count,
            rows: count,
            spacing,
            corner: Vec3::new(-half, 0.0, half),
            right: Vec3::X,
            down: Vec3::NEG_Z,
            mass: 0.2 * spacing * spacing,
            stiffnesses: [5.0, 2.5, 0.5],
            pins: Vec::new(),
        }
    }

    pub fn model(self) -> Model {
        let index = |column: u32, row: u32| row * self.columns + column;
        let mut parts = Parts { pins: self.pins, ..Parts::default() };
        for row in 0..self.rows {
            for column in 0..self.columns {
                let [x, y] = [column as f32 * self.spacing, row as f32 * self.spacing];
                parts.positions.push(self.corner + self.right * x + self.down * y);
                parts.masses.push(self.mass);
            }
        }
        let roles = [
            (SpringKind::Structural, self.stiffnesses[0], vec![(1, 0), (0, 1)]),
            (SpringKind::Shear, self.stiffnesses[1], vec![(1, 1), (-1, 1)]),
            (SpringKind::Bend, self.stiffnesses[2], vec![(2, 0), (0, 2)]),
        ];
        for (kind, stiffness, offsets) in roles {
            for (right, down) in offsets {
                for row in 0..self.rows.saturating_sub(down) {
                    for column in 0..self.columns {
                        let other = i64::from(column) + right;
                        if stiffness > 0.0 && (0..i64::from(self.columns)).contains(&other) {
                            let ends = [index(column, row), index(other as u32, row + down)];
                            let cells = ((right * right) as f32 + (down * down) as f32).sqrt();
                            parts.springs.push(Spring {
                                ends,
                                rest_length: self.spacing * cells,
                                stiffness,
                                threshold: THRESHOLD,
                                kind,
                            });
                        }
                    }
                }
            }
        }
        for row in 1..self.rows {
            for column in 1..self.columns {
                parts.quads.push([
                    index(column - 1, row - 1),
                    index(column, row - 1),
                    index(column, row),
                    index(column - 1, row),
                ]);
            }
        }
        parts.model()
    }
}

/// Sum of m·v in f64 [kg m/s].
pub fn momentum(particles: &Particles) -> DVec3 {
    particles.velocities.iter().zip(&particles.masses).map(|(v, m)| v.as_dvec3() * f64::from(*m)).sum()
}

/// Sum of m·|v| in f64 [kg m/s]: what a rounding error of the momentum is measured against.
pub fn momentum_scale(particles: &Particles) -> f64 {
    particles.velocities.iter().zip(&particles.masses).map(|(v, m)| v.as_dvec3().length() * f64::from(*m)).sum()
}

/// Centre of mass of equal masses in f64 [m].
pub fn centre(positions: &[Vec3]) -> DVec3 {
    positions.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / positions.len() as f64
}

/// Seeded numbers in 0..1 (splitmix64).
pub struct Random(pub u64);

impl Random {
    pub fn number(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }

    pub fn vector(&mut self) -> Vec3 {
        Vec3::new(self.number() - 0.5, self.number() - 0.5, self.number() - 0.5) * 2.0
    }

    pub fn index(&mut self, count: usize) -> u32 {
        ((self.number() * count as f32) as usize).min(count - 1) as u32
    }
}
