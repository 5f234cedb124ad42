//! The immutable arrays that a solver reads.

use crate::{Csr, ModelError, NO_CORNER};
use glam::{Vec2, Vec3};
use std::ops::{Deref, Range};
use toile_scene::{Rule, Threshold};

/// One piece of cloth as the solvers read it: [`Arrays`] that fit together, and that nobody changes.
///
/// Its fields are those of the arrays. It is made of a sheet or a garment, or by [`Model::new`], which looks at every index.
#[derive(Clone, Debug, PartialEq)]
pub struct Model(Arrays);

/// What a model consists of, before anything has looked whether it fits together.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Arrays {
    /// Positions at time 0 [m], shape [particle_count].
    pub positions: Vec<Vec3>,
    /// Masses [kg], positive also for pinned particles, shape [particle_count].
    pub masses: Vec<f32>,
    /// Inverse masses [1/kg], 0 for pinned particles, shape [particle_count].
    pub inverse_masses: Vec<f32>,
    /// Flat position in the panel [m], shape [particle_count]. A merged particle keeps that of its first member.
    pub flat: Vec<Vec2>,
    /// All springs in a fixed order, shape [spring_count].
    pub springs: Vec<Spring>,
    /// For each particle its springs, in the order of `springs`; shape [particle_count] rows.
    pub links: Csr<Link>,
    /// Limits sorted by colour, shape [limit_count].
    pub limits: Vec<Limit>,
    /// Limits of each colour: no two of them share a particle.
    pub limit_colours: Vec<Range<u32>>,
    /// Coarse particles, level by level, the finest level first. Empty unless the rule is [`Rule::Hierarchical`].
    pub coarse_particles: Vec<CoarseParticle>,
    /// The cloth itself, then its levels of coarse particles, the finest first. Empty unless the rule is [`Rule::Hierarchical`].
    pub levels: Vec<Level>,
    /// Clusters of all levels, level by level, sorted by colour. Each limit of a level lies in one of its clusters at least.
    pub clusters: Vec<Cluster>,
    /// The lengths [m] beyond which the guard takes back, of the clusters of the cloth itself: twice as far stretched as limits allow.
    pub guard_lengths: Vec<[f32; 6]>,
    /// For each node those of the next coarser level that lead it. What these are moved by in a sweep it is moved by too, each part of it.
    /// What is pinned does not follow. Shape
    /// [particle_count + coarse_count] rows; empty for the coarsest level.
    pub leaders: Csr<Leader>,
    /// For each particle the pins that hold it; shape [particle_count] rows. Empty rows unless the rule is [`Rule::Hierarchical`].
    pub attachments: Csr<Attachment>,
    /// Particles that a seam pulls together, sorted by colour. Empty once merged.
    pub seam_pairs: Vec<SeamPair>,
    /// Seam pairs of each colour: no two of them share a particle.
    pub seam_colours: Vec<Range<u32>>,
    /// Labelled edges, held at their height while the garment is sewn and eases.
    pub holds: Vec<Hold>,
    /// The particles of all holds, one hold after the other; each particle at most once.
    pub held_particles: Vec<u32>,
    /// Corners of each quad, counter-clockwise seen from outside the cloth; a triangle has [`NO_CORNER`] as the fourth. Shape [quad_count].
    pub quads: Vec<[u32; 4]>,
    /// For each particle the quads it is a corner of, ascending; shape [particle_count] rows.
    pub particle_quads: Csr<u32>,
    /// Stiffness of one structural, shear and bend spring [N/m], in this order.
    pub stiffness: [f32; 3],
    /// Bending rigidity by areal density [m⁴/s²]; 0 leaves bending to the stiffness of the bend springs.
    pub bending: f64,
    /// Part of the bending rigidity that the step carries, as the mean over the cloth [1]; 1 is all of it.
    pub bending_carried: f64,
    /// Elongation that the fabric allows, by direction.
    pub threshold: Threshold,
    /// The rule that the limits are made for.
    pub rule: Rule,
    /// Longest step [s] that the links are made soft enough for; `None` when they keep the stiffness of the springs.
    pub step_wanted: Option<f64>,
    /// What each panel became.
    pub panels: Vec<PanelMesh>,
    /// Names of the seams as "panel.edge to panel.edge", for messages; indexed by [`SeamPair::seam`].
    pub seam_names: Vec<String>,
}

/// What a spring resists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SpringKind {
    /// Stretching along warp or weft: sides of the cells.
    Structural,
    /// Shearing: diagonals of the cells.
    Shear,
    /// Bending: spans two cells (the papers' flexion).
    Bend,
    /// An open seam: rest length zero.
    Seam,
}

/// A spring between two particles. D §3, eq. 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// The two particles, the lower index first.
    pub ends: [u32; 2],
    /// Rest length [m], from the flat panel.
    pub rest_length: f32,
    /// Stiffness [N/m].
    pub stiffness: f32,
    /// Elongation that the fabric allows along it [1]; 0 of a seam spring, which has no limit.
    pub threshold: f32,
    /// What it resists.
    pub kind: SpringKind,
}

/// A spring as one of its ends sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The particle at the other end.
    pub other: u32,
    /// Rest length [m]. With a bending rigidity that of a bend spring is longer than in the flat panel and that of a structural spring
    /// shorter, also below 0, so that they push and pull in the flat cloth.
    pub rest_length: f32,
    /// Stiffness [N/m].
    pub stiffness: f32,
}

/// A unilateral maximum length: shortening is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// The two particles.
    pub ends: [u32; 2],
    /// Rest length of the spring [m].
    pub rest_length: f32,
    /// Maximum length [m]: (1 + threshold)·rest length, by the threshold along it; under [`Rule::Hierarchical`] a little less, so that what the sweeps leave
    /// of the excess stays under the threshold.
    pub max_length: f32,
}

/// A particle that stands for those around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoarseParticle {
    /// The particle of the cloth where it is.
    pub site: u32,
    /// Inverse of the mass that it carries [1/kg]: the part of each node that it leads. So what keeps momentum among coarse particles keeps it
    /// among those that they lead. Where its site is pinned nothing moves it.
    pub inverse_mass: f32,
}

/// Most nodes of a level that is small: those of a coarse sheet of 33 × 33.
const SMALL_LEVEL_NODES: u32 = 1280;

/// Nodes and the limits between them: the cloth itself, or coarse particles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Level {
    /// Its nodes. Of those of the level below no two neighbours.
    pub nodes: Range<u32>,
    /// Clusters of each colour in [`Arrays::clusters`]: no two of them share a node.
    pub colours: Vec<Range<u32>>,
}

/// Up to four nodes and the limits between them. A node is a particle, by its index, or a coarse particle, by its index plus particle_count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cluster {
    /// The nodes; [`NO_CORNER`] is none.
    pub nodes: [u32; 4],
    /// Maximum lengths [m] in the order of [`CLUSTER_PAIRS`], as [`Limit::max_length`]; [`f32::INFINITY`] where there is no limit.
    pub max_lengths: [f32; 6],
}

/// The pairs of nodes of a cluster between which limits lie, in the order in which they are held. Of a cell of a grid the diagonals come first:
/// where cloth whips around, each limit is drawn out again by those after it, and diagonals least by warp and weft.
pub const CLUSTER_PAIRS: [[usize; 2]; 6] = [[0, 1], [2, 3], [0, 2], [1, 3], [0, 3], [1, 2]];

/// A node that leads another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leader {
    /// The node.
    pub node: u32,
    /// Part that it has in what the other is moved by [1]. The parts of all leaders of a node sum to 1.
    pub part: f32,
}

/// A maximum distance of a particle from a pin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// The pinned particle.
    pub pin: u32,
    /// Maximum distance [m]: as [`Limit::max_length`], of the distance inside the flat panel.
    pub max_length: f32,
}

/// Two particles that a seam pulls together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeamPair {
    /// The two particles.
    pub ends: [u32; 2],
    /// Speed at which the pair closes [m/s].
    pub closing_speed: f32,
    /// Index into [`Arrays::seam_names`].
    pub seam: u32,
}

/// The edges of one label, held at their mean height.
#[derive(Clone, Debug, PartialEq)]
pub struct Hold {
    /// The label.
    pub label: String,
    /// Where its particles stand in [`Arrays::held_particles`]; never empty.
    pub particles: Range<u32>,
    /// Mean height y at time 0 [m].
    pub height: f32,
}

/// What a panel became.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PanelMesh {
    /// Name of the panel or sheet.
    pub name: String,
    /// Its particles. Empty once merged: particles of different panels are then one.
    pub particles: Range<u32>,
    /// Its quads.
    pub quads: Range<u32>,
    /// Smallest angle in any of its flat quads and triangles [degrees].
    pub worst_angle: f32,
}

/// How the particles of an open model become those of a sewn one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Merge {
    /// For each particle of the sewn model its members in the open model, ascending.
    pub members: Csr<u32>,
}

impl Level {
    /// Whether its nodes are coarse particles.
    pub fn is_coarse(&self) -> bool {
        self.nodes.start > 0
    }

    /// Whether it has so few nodes that one workgroup goes over them faster than dispatches would follow one another.
    pub fn is_small(&self) -> bool {
        self.nodes.end - self.nodes.start <= SMALL_LEVEL_NODES
    }
}

impl Model {
    /// A model of these arrays.
    ///
    /// # Errors
    /// [`ModelError::Arrays`] with the first thing that does not fit: a shape, an index, a number that is none, or a colour in which two share a
    /// particle.
    pub fn new(arrays: Arrays) -> Result<Self, ModelError> {
        arrays.check().map_err(|what| ModelError::Arrays { what })?;
        Ok(Self(arrays))
    }

    /// A model of arrays that were made here, and fit together.
    pub(crate) fn of(arrays: Arrays) -> Self {
        debug_assert_eq!(arrays.check(), Ok(()));
        Self(arrays)
    }

    /// For what is told to an open model once it is worn; indices stay.
    pub(crate) fn arrays_mut(&mut self) -> &mut Arrays {
        &mut self.0
    }

    /// The same with changed arrays.
    ///
    /// # Errors
    /// As [`Model::new`].
    pub fn changed(self, change: impl FnOnce(&mut Arrays)) -> Result<Self, ModelError> {
        let mut arrays = self.0;
        change(&mut arrays);
        Self::new(arrays)
    }
}

impl Deref for Model {
    type Target = Arrays;

    fn deref(&self) -> &Arrays {
        &self.0
    }
}

impl Arrays {
    /// Particles that nothing joins, at these positions [m] and with these masses [kg]: a start for what is put together by hand.
    pub fn of_particles(positions: Vec<Vec3>, masses: Vec<f32>) -> Self {
        let count = positions.len();
        Self {
            inverse_masses: masses.iter().map(|mass| 1.0 / mass).collect(),
            flat: positions.iter().map(|position| position.truncate()).collect(),
            links: Csr::from_rows((0..count).map(|_| [])),
            attachments: Csr::from_rows((0..count).map(|_| [])),
            particle_quads: Csr::from_rows((0..count).map(|_| [])),
            positions,
            masses,
            ..Self::default()
        }
    }

    /// Number of particles.
    pub fn particle_count(&self) -> u32 {
        self.positions.len() as u32
    }

    /// Number of springs of all kinds.
    pub fn spring_count(&self) -> u32 {
        self.springs.len() as u32
    }

    /// Number of quads and triangles.
    pub fn quad_count(&self) -> u32 {
        self.quads.len() as u32
    }

    /// Number of colours of the limits.
    pub fn colour_count(&self) -> u32 {
        self.limit_colours.len() as u32
    }

    /// Number of seam pairs.
    pub fn seam_pair_count(&self) -> u32 {
        self.seam_pairs.len() as u32
    }

    /// Vertex indices of the triangles to draw, counter-clockwise seen from outside; a quad gives two.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let mut triangles = Vec::with_capacity(2 * self.quads.len());
        for &[a, b, c, d] in &self.quads {
            triangles.push([a, b, c]);
            if d != NO_CORNER {
                triangles.push([a, c, d]);
            }
        }
        triangles
    }
}
