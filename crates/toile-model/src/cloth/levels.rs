//! Levels of coarse particles: limits between them hold over many cells what single springs would take a sweep per cell to hold.

use crate::cloth::assemble::{aim, stretched};
use crate::cloth::clusters::clusters;
use crate::cloth::flat_cloth::Cloth;
use crate::cloth::flat_spans::{FlatSpan, FlatSpans};
use crate::{Arrays, CLUSTER_PAIRS, Cluster, CoarseParticle, Csr, Leader, Level, SpringKind};
use glam::DVec2;
use std::collections::BTreeMap;

/// How much farther than limits allow single springs may be stretched once all sweeps are done [1].
const GUARD: f32 = 2.0;

/// Imbalance from which on a particle is led from one side alone [1].
const ONE_SIDED: f64 = 0.75;
/// Imbalance up to which a particle is led from all around [1].
const BALANCED: f64 = 0.25;
/// Lengths that differ by less than this factor are the same [1].
const AS_FAR: f64 = 1.05;

impl Arrays {
    /// Fills the levels of a cloth that has its springs and masses.
    pub(crate) fn add_levels(&mut self, cloth: &Cloth<'_>) {
        let spans = FlatSpans::new(cloth);
        let aim = aim(self.rule);
        let mut graph = self.graph();
        self.add_level(&graph, 0, aim);
        let guard = |cluster: &Cluster| graph.lengths(cluster.nodes, GUARD * aim);
        self.guard_lengths = self.clusters.iter().map(guard).collect();
        let mut rows: Vec<Vec<Leader>> = Vec::new();
        loop {
            let step = graph.coarser(&spans);
            // What is left of a cloth that is led from its corners does not become less.
            if step.graph.edges.is_empty() || 4 * step.graph.sites.len() > 3 * graph.sites.len() {
                break;
            }
            let first = self.particle_count() + self.coarse_particles.len() as u32;
            let lead = |row: Vec<(u32, f64)>| {
                row.into_iter().map(|(leader, part)| Leader { node: first + leader, part: part as f32 }).collect()
            };
            rows.extend(step.leaders.into_iter().map(lead));
            graph = step.graph;
            self.coarse_particles
                .extend(graph.sites.iter().map(|site| CoarseParticle { site: *site, inverse_mass: f32::INFINITY }));
            self.add_level(&graph, first, aim);
        }
        // Nothing is coarser than the last level.
        rows.resize_with(self.positions.len() + self.coarse_particles.len(), Vec::new);
        self.leaders = Csr::from_rows(rows);
        self.weigh_coarse_particles();
    }

    /// Gives the coarse particles the masses of what they lead: after masses or pins have changed.
    pub fn weigh_coarse_particles(&mut self) {
        let particle_count = self.positions.len();
        let mut masses: Vec<f64> = self.masses.iter().map(|mass| f64::from(*mass)).collect();
        masses.resize(particle_count + self.coarse_particles.len(), 0.0);
        for node in 0..self.leaders.row_count() {
            // A pin follows nobody, but what stands where it is has its mass.
            let is_pinned = self.inverse_masses[self.site(node as u32) as usize] == 0.0;
            for leader in self.leaders.row(node).iter().filter(|leader| !is_pinned || leader.part == 1.0) {
                masses[leader.node as usize] += f64::from(leader.part) * masses[node];
            }
        }
        for (coarse, mass) in self.coarse_particles.iter_mut().zip(&masses[particle_count..]) {
            coarse.inverse_mass = (1.0 / mass) as f32;
        }
    }

    /// Adds a level whose first node is `first` and whose limits hold `aim` of the threshold.
    fn add_level(&mut self, graph: &Graph, first: u32, aim: f32) {
        let first_cluster = self.clusters.len() as u32;
        let ends: Vec<[u32; 2]> = graph.edges.iter().map(|edge| edge.ends).collect();
        let lengths: Vec<f64> = graph.edges.iter().map(|edge| edge.span.length).collect();
        let (clusters, colours) = clusters(&ends, &lengths, graph.sites.len());
        self.clusters.extend(clusters.into_iter().map(|nodes| Cluster {
            nodes: nodes.map(|node| node.saturating_add(first)),
            max_lengths: graph.lengths(nodes, aim),
        }));
        self.levels.push(Level {
            nodes: first..first + graph.sites.len() as u32,
            colours: colours.into_iter().map(|c| first_cluster + c.start..first_cluster + c.end).collect(),
        });
    }

    /// The limits of a level, each once: its two nodes, the lower first, and its maximum length [m].
    pub fn level_limits(&self, level: &Level) -> BTreeMap<[u32; 2], f32> {
        let clusters = level.colours.iter().flat_map(|colour| colour.clone()).map(|cluster| cluster as usize);
        let limits = clusters.flat_map(|cluster| {
            let Cluster { nodes, max_lengths } = self.clusters[cluster];
            CLUSTER_PAIRS.iter().zip(max_lengths).map(move |(pair, length)| {
                let [a, b] = pair.map(|corner| nodes[corner]);
                ([a.min(b), a.max(b)], length)
            })
        });
        limits.filter(|(_, length)| length.is_finite()).collect()
    }

    /// The particle where a node is.
    pub fn site(&self, node: u32) -> u32 {
        let coarse = (node as usize).checked_sub(self.positions.len());
        coarse.map_or(node, |coarse| self.coarse_particles[coarse].site)
    }

    /// The particles themselves, and the springs that have a limit.
    fn graph(&self) -> Graph {
        let threshold = |spring: &crate::Spring| f64::from(spring.threshold);
        let edges = self
            .springs
            .iter()
            .filter(|s| matches!(s.kind, SpringKind::Structural | SpringKind::Shear))
            .map(|s| Edge {
                ends: s.ends,
                span: FlatSpan { length: f64::from(s.rest_length), threshold: threshold(s), way: None },
            })
            .collect();
        Graph {
            sites: (0..self.particle_count()).collect(),
            is_pinned: self.inverse_masses.iter().map(|&w| w == 0.0).collect(),
            edges,
        }
    }
}

/// The particles of a level and which of them limits connect.
struct Graph {
    /// The particle of the cloth where each of them is.
    sites: Vec<u32>,
    is_pinned: Vec<bool>,
    /// The lower end first; sorted by their ends.
    edges: Vec<Edge>,
}

struct Edge {
    ends: [u32; 2],
    span: FlatSpan,
}

/// The next coarser level, and for each particle those of it that lead it, with the part of each.
struct Coarsening {
    graph: Graph,
    leaders: Vec<Vec<(u32, f64)>>,
}

#[derive(Clone, Copy)]
struct Neighbour {
    other: u32,
    /// [m]
    length: f64,
    threshold: f64,
}

impl Graph {
    /// What the limits between the nodes of a cluster hold [m], with `aim` of the threshold.
    fn lengths(&self, nodes: [u32; 4], aim: f32) -> [f32; 6] {
        CLUSTER_PAIRS.map(|pair| {
            let [a, b] = pair.map(|corner| nodes[corner]);
            let found = self.edges.binary_search_by_key(&[a.min(b), a.max(b)], |edge| edge.ends);
            found.map_or(f32::INFINITY, |k| {
                let span = &self.edges[k].span;
                stretched(span.length as f32, aim * span.threshold as f32)
            })
        })
    }

    fn neighbours(&self) -> Csr<Neighbour> {
        let mut rows = vec![Vec::new(); self.sites.len()];
        for Edge { ends: [a, b], span } in &self.edges {
            for (here, other) in [(a, b), (b, a)] {
                let neighbour = Neighbour { other: *other, length: span.length, threshold: span.threshold };
                rows[*here as usize].push(neighbour);
            }
        }
        Csr::from_rows(rows)
    }

    /// Of the particles an independent set that no other fits into, pinned ones before all, else in their order: of a grid every second
    /// one along warp and weft.
    fn chosen(&self, neighbours: &Csr<Neighbour>) -> Vec<bool> {
        let count = self.sites.len();
        let mut chosen = vec![false; count];
        let pinned = (0..count).filter(|&i| self.is_pinned[i]);
        let free = (0..count).filter(|&i| !self.is_pinned[i]);
        for i in pinned.chain(free) {
            chosen[i] = neighbours.row(i).iter().all(|n| !chosen[n.other as usize]);
        }
        chosen
    }

    /// How far the mean of those that lead a particle is from it, as part of how far they are [1]: 0 where they are all around it, 1 where
    /// they are all on one side. Those of several panels are on both sides of a seam.
    fn imbalance(&self, i: usize, leading: &[Neighbour], spans: &FlatSpans<'_>) -> f64 {
        let ways: Option<Vec<(u32, DVec2)>> =
            leading.iter().map(|n| spans.way(self.sites[i], self.sites[n.other as usize])).collect();
        let Some(ways) = ways else { return 0.0 };
        if ways.windows(2).any(|pair| pair[0].0 != pair[1].0) {
            return 0.0;
        }
        let weight: f64 = leading.iter().map(|n| 1.0 / n.length).sum();
        let mean: DVec2 = leading.iter().zip(&ways).map(|(n, (_, way))| *way / (n.length * weight)).sum();
        let distance = leading.iter().zip(&ways).map(|(n, (_, way))| way.length() / (n.length * weight)).sum::<f64>();
        mean.length() / distance
    }

    /// The nearest of those that lead a particle, as many as are all around it, or all of them.
    fn nearest(&self, i: usize, mut leading: Vec<Neighbour>, spans: &FlatSpans<'_>) -> Vec<Neighbour> {
        leading.sort_by(|a, b| a.length.total_cmp(&b.length));
        let is_enough = |count: &usize| {
            let ends = leading[*count].length > AS_FAR * leading[*count - 1].length;
            ends && self.imbalance(i, &leading[..*count], spans) < BALANCED
        };
        let enough = (2..leading.len()).find(is_enough);
        leading.truncate(enough.unwrap_or(leading.len()));
        leading
    }

    fn coarser(&self, spans: &FlatSpans<'_>) -> Coarsening {
        let neighbours = self.neighbours();
        let mut chosen = self.chosen(&neighbours);
        let leading = |chosen: &[bool], i: usize| -> Vec<Neighbour> {
            neighbours.row(i).iter().filter(|n| chosen[n.other as usize]).copied().collect()
        };
        // What no two sides lead would be led beyond them, as the last column of a grid of an even number.
        for i in 0..self.sites.len() {
            chosen[i] = chosen[i] || self.imbalance(i, &leading(&chosen, i), spans) > ONE_SIDED;
        }
        let mut index = vec![u32::MAX; self.sites.len()];
        let mut kept = Vec::new();
        for i in (0..self.sites.len()).filter(|&i| chosen[i]) {
            index[i] = kept.len() as u32;
            kept.push(i);
        }
        // A way to each leader; of one that leads itself none at all.
        let ways: Vec<Vec<Neighbour>> = (0..self.sites.len())
            .map(|i| match chosen[i] {
                true => vec![Neighbour { other: index[i], length: 0.0, threshold: 0.0 }],
                false => {
                    let all = self.nearest(i, leading(&chosen, i), spans).into_iter();
                    all.map(|n| Neighbour { other: index[n.other as usize], ..n }).collect()
                }
            })
            .collect();
        let leaders = ways.iter().map(|ways| parts(ways)).collect();
        let sites: Vec<u32> = kept.iter().map(|&i| self.sites[i]).collect();
        let followers = followers(&ways, kept.len());
        let mut edges = Vec::new();
        let mut met: Vec<Neighbour> = Vec::new();
        for a in 0..kept.len() as u32 {
            met.clear();
            for follower in followers.row(a as usize) {
                for step in neighbours.row(follower.other as usize) {
                    for way in ways[step.other as usize].iter().filter(|way| way.other > a) {
                        let length = follower.length + step.length + way.length;
                        let threshold = (follower.length * follower.threshold
                            + step.length * step.threshold
                            + way.length * way.threshold)
                            / length;
                        met.push(Neighbour { other: way.other, length, threshold });
                    }
                }
            }
            met.sort_by(|one, other| one.other.cmp(&other.other).then(one.length.total_cmp(&other.length)));
            met.dedup_by_key(|n| n.other);
            edges.extend(met.iter().map(|n| {
                let way = FlatSpan { length: n.length, threshold: n.threshold, way: None };
                let ends = [a, n.other];
                Edge { ends, span: spans.between(ends.map(|end| sites[end as usize]), way) }
            }));
        }
        let is_pinned = kept.iter().map(|&i| self.is_pinned[i]).collect();
        Coarsening { graph: Graph { sites, is_pinned, edges }, leaders }
    }
}

/// For each chosen particle those that follow it, by their number among all, and the ways to them.
fn followers(ways: &[Vec<Neighbour>], count: usize) -> Csr<Neighbour> {
    let mut rows = vec![Vec::new(); count];
    for (ways, follower) in ways.iter().zip(0..) {
        for way in ways {
            rows[way.other as usize].push(Neighbour { other: follower, ..*way });
        }
    }
    Csr::from_rows(rows)
}

/// Parts that sum to one: the nearer, the larger.
fn parts(ways: &[Neighbour]) -> Vec<(u32, f64)> {
    let [one] = ways else {
        let all: f64 = ways.iter().map(|way| 1.0 / way.length).sum();
        return ways.iter().map(|way| (way.other, 1.0 / (way.length * all))).collect();
    };
    vec![(one.other, 1.0)]
}
