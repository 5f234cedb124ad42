//! Whether arrays fit together, so that no solver reads beyond them and no two writes race.

use crate::{Arrays, Csr, NO_CORNER};
use std::ops::Range;

/// What does not fit, in words.
type Fits = Result<(), String>;

impl Arrays {
    /// The first thing that does not fit, if any.
    pub(crate) fn check(&self) -> Fits {
        let particle_count = self.positions.len();
        if particle_count == 0 || u32::try_from(particle_count).is_err() {
            return Err(format!("positions has {particle_count} particles, and a cloth has 1 to {}", u32::MAX));
        }
        self.check_shapes(particle_count)?;
        self.check_numbers()?;
        self.check_particles()?;
        self.check_levels(particle_count)?;
        let limits: Vec<[u32; 2]> = self.limits.iter().map(|limit| limit.ends).collect();
        check_colours("limit_colours", &self.limit_colours, 0..limits.len(), particle_count, |at| limits[at].to_vec())?;
        let pairs: Vec<[u32; 2]> = self.seam_pairs.iter().map(|pair| pair.ends).collect();
        check_colours("seam_colours", &self.seam_colours, 0..pairs.len(), particle_count, |at| pairs[at].to_vec())
    }

    fn check_shapes(&self, particle_count: usize) -> Fits {
        let is = |name: &str, length: usize, expected: usize| {
            (length == expected)
                .then_some(())
                .ok_or_else(|| format!("{name} has {length} entries, expected {expected}"))
        };
        is("masses", self.masses.len(), particle_count)?;
        is("inverse_masses", self.inverse_masses.len(), particle_count)?;
        is("flat", self.flat.len(), particle_count)?;
        check_rows("links", &self.links, particle_count)?;
        check_rows("attachments", &self.attachments, particle_count)?;
        check_rows("particle_quads", &self.particle_quads, particle_count)
    }

    fn check_numbers(&self) -> Fits {
        let all = |name: &str, fits: Option<usize>| {
            fits.map_or(Ok(()), |at| Err(format!("{name} {at} is no number that it may be")))
        };
        let mass = |mass: &f32| *mass > 0.0 && mass.is_finite();
        all("positions", self.positions.iter().position(|position| !position.is_finite()))?;
        all("flat", self.flat.iter().position(|place| !place.is_finite()))?;
        all("masses", self.masses.iter().position(|value| !mass(value)))?;
        all("inverse_masses", self.inverse_masses.iter().position(|value| !(*value == 0.0 || mass(value))))?;
        let links = self.links.values.iter();
        all("links", links.clone().position(|link| !(link.rest_length.is_finite() && is_amount(link.stiffness))))?;
        let springs = self.springs.iter();
        all(
            "springs",
            springs.clone().position(|s| ![s.rest_length, s.stiffness, s.threshold].into_iter().all(is_amount)),
        )?;
        let limits = self.limits.iter();
        all("limits", limits.clone().position(|l| !(is_amount(l.rest_length) && is_amount(l.max_length))))?;
        all("attachments", self.attachments.values.iter().position(|attachment| !is_amount(attachment.max_length)))?;
        all("seam_pairs", self.seam_pairs.iter().position(|pair| !is_amount(pair.closing_speed)))?;
        all("holds", self.holds.iter().position(|hold| !hold.height.is_finite()))?;
        let length = |length: &f32| *length >= 0.0;
        all("clusters", self.clusters.iter().position(|cluster| !cluster.max_lengths.iter().all(length)))?;
        all("guard_lengths", self.guard_lengths.iter().position(|lengths| !lengths.iter().all(length)))?;
        all("leaders", self.leaders.values.iter().position(|leader| !leader.part.is_finite()))?;
        let is_light = |inverse_mass: f32| inverse_mass >= 0.0;
        all("coarse_particles", self.coarse_particles.iter().position(|coarse| !is_light(coarse.inverse_mass)))
    }

    /// Every index of a particle, a quad or a seam.
    fn check_particles(&self) -> Fits {
        let particle_count = self.positions.len();
        let particles = |name: &str, each: &mut dyn Iterator<Item = u32>| check_indices(name, each, particle_count);
        particles("springs", &mut self.springs.iter().flat_map(|spring| spring.ends))?;
        particles("links", &mut self.links.values.iter().map(|link| link.other))?;
        particles("limits", &mut self.limits.iter().flat_map(|limit| limit.ends))?;
        particles("attachments", &mut self.attachments.values.iter().map(|attachment| attachment.pin))?;
        particles("seam_pairs", &mut self.seam_pairs.iter().flat_map(|pair| pair.ends))?;
        particles("held_particles", &mut self.held_particles.iter().copied())?;
        particles("coarse_particles", &mut self.coarse_particles.iter().map(|coarse| coarse.site))?;
        let corners =
            |quad: &[u32; 4]| [quad[0], quad[1], quad[2], if quad[3] == NO_CORNER { quad[2] } else { quad[3] }];
        particles("quads", &mut self.quads.iter().flat_map(corners))?;
        check_indices("particle_quads", self.particle_quads.values.iter().copied(), self.quads.len())?;
        if !self.seam_names.is_empty() {
            check_indices("seam_pairs", self.seam_pairs.iter().map(|pair| pair.seam), self.seam_names.len())?;
        }
        let holds = self.holds.iter().map(|hold| hold.particles.clone());
        check_parts("holds", holds, 0..self.held_particles.len())?;
        let within = |range: &Range<u32>, count: usize| range.start <= range.end && range.end as usize <= count;
        match self.panels.iter().find(|p| !within(&p.particles, particle_count) || !within(&p.quads, self.quads.len()))
        {
            Some(panel) => Err(format!("panel {} has particles or quads that do not exist", panel.name)),
            None => Ok(()),
        }
    }

    fn check_levels(&self, particle_count: usize) -> Fits {
        if self.levels.is_empty() {
            let (clusters, coarse) = (self.clusters.len(), self.coarse_particles.len());
            return if clusters + coarse == 0 {
                Ok(())
            } else {
                Err(format!("there are {clusters} clusters and {coarse} coarse particles, and no level"))
            };
        }
        let node_count = particle_count + self.coarse_particles.len();
        check_parts("levels", self.levels.iter().map(|level| level.nodes.clone()), 0..node_count)?;
        check_rows("leaders", &self.leaders, node_count)?;
        let finest = self.levels[0].nodes.clone();
        if finest.end as usize != particle_count {
            return Err(format!("the finest level has {} nodes, expected {particle_count}", finest.end));
        }
        let mut first_cluster = 0;
        for (index, level) in self.levels.iter().enumerate() {
            for node in level.nodes.clone() {
                let above = self.levels.get(index + 1).map_or(0..0, |above| above.nodes.clone());
                if let Some(leader) =
                    self.leaders.row(node as usize).iter().find(|leader| !above.contains(&leader.node))
                {
                    return Err(format!("node {node} is led by node {}, which is none of the next level", leader.node));
                }
            }
            let end_cluster = level.colours.last().map_or(first_cluster, |colour| colour.end as usize);
            if end_cluster > self.clusters.len() {
                return Err(format!("level {index} has clusters up to {end_cluster} of {}", self.clusters.len()));
            }
            let clusters = &self.clusters[first_cluster.min(end_cluster)..end_cluster];
            let mut nodes = clusters.iter().flat_map(|cluster| cluster.nodes).filter(|node| *node != NO_CORNER);
            if let Some(node) = nodes.find(|node| !level.nodes.contains(node)) {
                return Err(format!("a cluster of level {index} has node {node}, which is none of the level"));
            }
            let members = |at: usize| self.clusters[at].nodes.into_iter().filter(|node| *node != NO_CORNER).collect();
            check_colours("colours of a level", &level.colours, first_cluster..end_cluster, node_count, members)?;
            if index == 0 && self.guard_lengths.len() != end_cluster {
                return Err(format!("guard_lengths has {} entries, expected {end_cluster}", self.guard_lengths.len()));
            }
            first_cluster = end_cluster;
        }
        let count = self.clusters.len();
        (first_cluster == count)
            .then_some(())
            .ok_or_else(|| format!("{} of {count} clusters are of no level", count - first_cluster))
    }
}

/// A number that is not negative and not endless.
fn is_amount(value: f32) -> bool {
    value >= 0.0 && value.is_finite()
}

/// Rows that follow one another to the end of their values.
fn check_rows<T>(name: &str, rows: &Csr<T>, row_count: usize) -> Fits {
    let offsets = &rows.offsets;
    if rows.row_count() != row_count {
        return Err(format!("{name} has {} rows, expected {row_count}", rows.row_count()));
    }
    let ends = offsets.first() == Some(&0) && offsets.last().is_some_and(|end| *end as usize == rows.values.len());
    (ends && offsets.is_sorted()).then_some(()).ok_or_else(|| format!("the rows of {name} do not follow one another"))
}

fn check_indices(name: &str, mut indices: impl Iterator<Item = u32>, count: usize) -> Fits {
    match indices.find(|index| *index as usize >= count) {
        Some(index) => Err(format!("{name} leads to {index} of {count}")),
        None => Ok(()),
    }
}

/// Ranges that follow one another from the start of a whole to its end.
fn check_parts(name: &str, parts: impl Iterator<Item = Range<u32>>, whole: Range<usize>) -> Fits {
    let mut end = whole.start;
    for part in parts {
        if part.start as usize != end || part.end < part.start {
            return Err(format!("{name} has a part {part:?} where {end} comes next"));
        }
        end = part.end as usize;
    }
    (end == whole.end).then_some(()).ok_or_else(|| format!("{name} ends at {end} of {}", whole.end))
}

/// Colours of which each has no node twice; together they have everything once.
fn check_colours(
    name: &str,
    colours: &[Range<u32>],
    whole: Range<usize>,
    node_count: usize,
    nodes: impl Fn(usize) -> Vec<u32>,
) -> Fits {
    check_parts(name, colours.iter().cloned(), whole)?;
    let mut last_colour = vec![usize::MAX; node_count];
    for (index, colour) in colours.iter().enumerate() {
        for node in colour.clone().flat_map(|at| nodes(at as usize)) {
            if std::mem::replace(&mut last_colour[node as usize], index) == index {
                return Err(format!("{name}: two of colour {index} share {node}"));
            }
        }
    }
    Ok(())
}
