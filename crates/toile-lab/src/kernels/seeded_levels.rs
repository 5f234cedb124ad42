//! Seeded levels of coarse particles, their clusters and what leads whom.

use crate::Random;
use glam::Vec3;
use std::ops::Range;
use toile::model::{CLUSTER_PAIRS, Cluster, CoarseParticle, Csr, Leader, Level, NO_CORNER};
use toile_kernels::Kernel;
use toile_reference::{Nodes, Particles};

/// Nodes or clusters beside those of a level or colour, on both sides.
pub(super) const BESIDE: u32 = 2;

/// Levels above a cloth.
#[derive(Default)]
pub(super) struct Levels {
    pub(super) nodes: Nodes,
    pub(super) leaders: Csr<Leader>,
    pub(super) coarse_particles: Vec<CoarseParticle>,
    pub(super) levels: Vec<Level>,
    pub(super) clusters: Vec<Cluster>,
}

/// Coarse particles beside the cloth, the last eight of which lead all others and the cloth; disjoint clusters, with others before and after the span of
/// the colour. Small levels are three, of two colours each. Nothing where a kernel reads none.
pub(super) fn levels(random: &mut Random, kernel: Kernel, particles: &Particles, items: u32, dt: f32) -> Levels {
    let mut levels = Levels::default();
    let particle_count = particles.positions.len() as u32;
    let coarse_count = match kernel {
        Kernel::LeadLevel => BESIDE + items + 8,
        Kernel::LimitLevel => 2 * items,
        Kernel::LimitSmallLevels => items / 2 + 16,
        Kernel::ShiftVelocities => 8,
        Kernel::LimitGuard => 0,
        _ => return levels,
    };
    for _ in 0..coarse_count {
        let inverse_mass = random.between(100.0, 5000.0);
        levels.coarse_particles.push(CoarseParticle { site: random.below(particle_count), inverse_mass });
    }
    let node_count = particle_count + coarse_count;
    for k in 0..node_count {
        let weight = if k % 7 == 3 || k % 11 == 4 { 0.0 } else { random.between(100.0, 5000.0) };
        levels.nodes.inverse_masses.push(weight);
        let place = if random.one_in(60) { Vec3::splat(f32::NAN) } else { random.vector(0.6) };
        levels.nodes.places.push(place);
        levels.nodes.shifts.push(if random.one_in(3) { Vec3::ZERO } else { random.vector(0.05) });
    }
    let coarsest = node_count - 8;
    match kernel {
        Kernel::LeadLevel | Kernel::ShiftVelocities => {
            levels.leaders = Csr::from_rows((0..node_count).map(|_| leaders(random, coarsest..node_count)));
        }
        Kernel::LimitSmallLevels => {
            let borders = [0, particle_count, coarsest, node_count];
            let row = |node| {
                let above = borders.iter().position(|border| node < *border).expect("it is a node");
                if above == 3 { Vec::new() } else { leaders(random, borders[above]..borders[above + 1]) }
            };
            levels.leaders = Csr::from_rows((0..node_count).map(row).collect::<Vec<_>>());
            for level in borders.windows(2) {
                levels.add_level(random, level[0]..level[1], particles, dt);
            }
        }
        _ => {
            let order = random.shuffled(node_count);
            for k in 0..items + 2 * BESIDE {
                let inside = (BESIDE..BESIDE + items).contains(&k);
                // Those of other colours may share nodes: nothing may touch them.
                let first = if inside { 4 * (k - BESIDE) as usize } else { 0 };
                let place = |node: usize| match kernel {
                    Kernel::LimitGuard => particles.positions[node] + particles.velocities[node] * dt,
                    _ => levels.nodes.places[node] + levels.nodes.shifts[node],
                };
                let cluster = cluster(random, &order[first..first + 4], place);
                levels.clusters.push(cluster);
            }
        }
    }
    levels
}

impl Levels {
    /// Clusters of two colours between the nodes of a level, about as far apart as the cloth where they are.
    fn add_level(&mut self, random: &mut Random, nodes: Range<u32>, particles: &Particles, dt: f32) {
        let first = nodes.start;
        let particle_count = particles.positions.len();
        let mut colours = Vec::new();
        for _ in 0..2 {
            let order = random.shuffled(nodes.end - first);
            let start = self.clusters.len() as u32;
            for corners in order.chunks_exact(4) {
                let place = |node: usize| {
                    let coarse = node.checked_sub(particle_count);
                    let site = coarse.map_or(node, |coarse| self.coarse_particles[coarse].site as usize);
                    particles.positions[site] + particles.velocities[site] * dt
                };
                let corners: Vec<u32> = corners.iter().map(|corner| first + corner).collect();
                let cluster = cluster(random, &corners, place);
                self.clusters.push(cluster);
            }
            colours.push(start..self.clusters.len() as u32);
        }
        self.levels.push(Level { nodes, colours });
    }
}

/// None to four of some nodes, with parts.
fn leaders(random: &mut Random, among: Range<u32>) -> Vec<Leader> {
    let count = random.below(5);
    let node = |random: &mut Random| among.start + random.below(among.end - among.start);
    (0..count).map(|_| Leader { node: node(random), part: random.between(0.1, 0.9) }).collect()
}

/// A cluster of two to four nodes, and lengths a little more or less than how far their places are apart.
fn cluster(random: &mut Random, corners: &[u32], place: impl Fn(usize) -> Vec3) -> Cluster {
    let mut nodes = [0, 1, 2, 3].map(|corner| corners[corner]);
    nodes[2 + random.below(3) as usize..].fill(NO_CORNER);
    let max_lengths = CLUSTER_PAIRS.map(|pair| {
        let ends = pair.map(|corner| nodes[corner]);
        if ends.contains(&NO_CORNER) || random.one_in(7) {
            return f32::INFINITY;
        }
        let [a, b] = ends.map(|end| place(end as usize));
        let distance = a.distance(b);
        match random.below(9) {
            // Exactly as long as it may be, and a hair too long.
            0 if distance > 0.0 => distance,
            1 if distance > 0.0 => distance - 1e-4,
            _ if distance > 0.0 => distance * random.between(0.7, 1.3),
            _ => 0.1,
        }
    });
    Cluster { nodes, max_lengths }
}
