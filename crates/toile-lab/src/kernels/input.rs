//! Everything a kernel may read or write, on the side of the reference, and its bytes on the device.

use super::Inputs;
use crate::DrawnMaps;
use encase::{ShaderType, StorageBuffer, internal::WriteInto};
use glam::{Vec3, Vec4};
use std::ops::Range;
use toile::gpu::BodyMaps;
use toile::gpu::contents::{Encode, constant, encoded, floats, uniform, with_w, words};
use toile::model::{Arrays, Csr, Limit, PinTarget, SeamPair, ShapeStep, StepSettings};
use toile::scene::{Polish, Pose, Skin};
use toile_kernels::structs;
use toile_reference::step::PolishState;
use toile_reference::{Contact, Lag, Midpoints, Nodes, Particles, Probe};

/// Everything a kernel may read or write.
#[derive(Clone, Debug)]
pub struct Input {
    /// Number of invocations that the kernel under test needs.
    pub invocations: u32,
    /// Numbers of the step.
    pub settings: StepSettings,
    /// The particles.
    pub particles: Particles,
    /// Particles of the open model, for the handover.
    pub open: Particles,
    /// For each particle the open particles that it is made of.
    pub members: Csr<u32>,
    /// Where the state is copied to.
    pub copies: Particles,
    /// Force on each particle [N].
    pub forces: Vec<Vec3>,
    /// Force of the air on each quad [N].
    pub quad_winds: Vec<Vec3>,
    /// What does not change: springs, limits, seams and cells. Where its particles are at rest does not matter.
    pub model: Arrays,
    /// What limits gave the particles [m/s].
    pub pulls: Vec<Vec3>,
    /// The items of the colour that the dispatch works on.
    pub span: Range<u32>,
    /// Part of its excess, or how much more than that, a limit takes [1].
    pub share: f32,
    /// Nodes in a sweep.
    pub nodes: Nodes,
    /// Midpoints of the quads.
    pub midpoints: Midpoints,
    /// Of the particles, then of the quads.
    pub probes: Vec<Probe>,
    /// Contacts of the last step.
    pub contacts: Vec<Contact>,
    /// Normals of the particles.
    pub normals: Vec<Vec3>,
    /// Energies of groups [J].
    pub energy_partials: Vec<f32>,
    /// What the polish knows.
    pub polish_state: PolishState,
    /// Workgroups of the passes that a grant is for.
    pub sweep_workgroups: Vec<[u32; 4]>,
    /// Those that they get.
    pub sweep_dispatches: Vec<[u32; 4]>,
    /// What the frame reports.
    pub status: structs::Status,
    /// The shapes.
    pub shapes: Vec<ShapeStep>,
    /// Whether the shapes are sampled after the maps.
    pub after_maps: bool,
    /// Time from the step to that of the maps.
    pub lag: Lag,
    /// The papers' maps of the bodies.
    pub sides: DrawnMaps,
    /// Layered maps of the bodies.
    pub layers: DrawnMaps,
    /// Skin of a body that moves.
    pub skin: Skin,
    /// Its pose.
    pub pose: Pose,
    /// What the kernels of a body write.
    pub body: Posed,
    /// Words of a buffer in which a host has the vertices of its body, and where.
    pub host: (Vec<f32>, structs::Gather),
    /// How often the body takes a pose [1/s].
    pub rate: f32,
    /// First three rows of the transform of a jump.
    pub carry: [Vec4; 3],
    /// Particles that the host holds or lets go, each once.
    pub pins: Vec<PinTarget>,
}

/// What the kernels of a body write, shape [vertex_count] each.
#[derive(Clone, Debug, Default)]
pub struct Posed {
    /// After the morph targets [m].
    pub morphed_positions: Vec<Vec3>,
    /// After the morph targets.
    pub morphed_normals: Vec<Vec3>,
    /// In the pose before [m].
    pub last_positions: Vec<Vec3>,
    /// In the pose [m].
    pub positions: Vec<Vec3>,
    /// In the pose.
    pub normals: Vec<Vec3>,
    /// From the pose before to this [m/s].
    pub velocities: Vec<Vec3>,
}

impl Input {
    /// The span as indices.
    pub fn colour(&self) -> Range<usize> {
        self.span.start as usize..self.span.end as usize
    }

    /// The limits of the span.
    pub fn colour_limits(&self) -> &[Limit] {
        &self.model.limits[self.colour()]
    }

    /// The seam pairs of the span.
    pub fn colour_pairs(&self) -> &[SeamPair] {
        &self.model.seam_pairs[self.colour()]
    }

    /// Number of particles.
    pub fn particle_count(&self) -> usize {
        self.particles.positions.len()
    }

    /// Positions and velocities of all points: the particles, then the quad midpoints.
    pub fn points(&self) -> [Vec<Vec3>; 2] {
        [
            [self.particles.positions.as_slice(), &self.midpoints.positions].concat(),
            [self.particles.velocities.as_slice(), &self.midpoints.velocities].concat(),
        ]
    }

    /// The morph targets of the body.
    pub fn morphs(&self) -> &toile::scene::Morphs {
        self.skin.morphs.as_ref().expect("the seeded body has morph targets")
    }

    /// The polish of the settings.
    pub fn polish(&self) -> Polish {
        self.settings.polish.expect("the input has a polish")
    }
}

impl Inputs for Input {
    fn bytes(&self, name: &str) -> Vec<u8> {
        match name {
            "positions" => with_w(&self.particles.positions, &self.particles.inverse_masses),
            "velocities" => with_w(&self.particles.velocities, &self.particles.masses),
            "span" => {
                let Range { start, end } = self.span;
                uniform(&structs::Span { first: start, count: end - start, share: self.share })
            }
            "shapes" => encoded(&self.shapes),
            "lag" => uniform(&structs::Lag { start: self.lag.start, end: self.lag.end }),
            "vertices" => uniform(&structs::Vertices { count: self.skin.positions.len() as u32, rate: self.rate }),
            "gather" => uniform(&self.host.1),
            "host_positions" | "host_normals" | "host_motions" => floats(&self.host.0),
            "carry" => {
                let [row_x, row_y, row_z] = self.carry;
                uniform(&structs::Carry { row_x, row_y, row_z })
            }
            "pins" => encoded(&self.pins),
            "bind_positions" => padded(&self.skin.positions, 1.0),
            "bind_normals" => padded(&self.skin.normals, 0.0),
            "morph_offsets" => words(&self.morphs().offsets),
            "displacements" => encoded(&self.morphs().displacements),
            "morph_weights" => floats(&self.pose.morph_weights),
            "morphed_positions" => padded(&self.body.morphed_positions, 1.0),
            "morphed_normals" => padded(&self.body.morphed_normals, 0.0),
            "influence_offsets" => words(&self.skin.influence_offsets),
            "influences" => encoded(&self.skin.influences),
            "joints" => bytemuck::cast_slice(&self.pose.joints).to_vec(),
            "body_positions" | "surface_positions" => padded(&self.body.positions, 1.0),
            "body_normals" => padded(&self.body.normals, 0.0),
            "last_positions" => padded(&self.body.last_positions, 1.0),
            "surface_velocities" => padded(&self.body.velocities, 0.0),
            "side_box" => uniform(&self.sides.sides().map_box.encode()),
            "layer_box" => uniform(&self.layers.layers().map_box.encode()),
            "open_positions" => with_w(&self.open.positions, &self.open.inverse_masses),
            "open_velocities" => with_w(&self.open.velocities, &self.open.masses),
            "position_copies" => with_w(&self.copies.positions, &self.copies.inverse_masses),
            "velocity_copies" => with_w(&self.copies.velocities, &self.copies.masses),
            "member_offsets" => words(&self.members.offsets),
            "members" => words(&self.members.values),
            "forces" => with_w(&self.forces, &vec![0.0; self.forces.len()]),
            "quad_winds" => with_w(&self.quad_winds, &vec![0.0; self.quad_winds.len()]),
            "normals" => with_w(&self.normals, &vec![0.0; self.normals.len()]),
            "pulls" => padded(&self.pulls, 0.0),
            "node_places" => with_w(&self.nodes.places, &self.nodes.inverse_masses),
            "node_shifts" => padded(&self.nodes.shifts, 0.0),
            "midpoints" => {
                let both = self.midpoints.positions.iter().zip(&self.midpoints.velocities);
                array(both.map(|(position, velocity)| structs::Midpoint { position: *position, velocity: *velocity }))
            }
            "probes" => array(self.probes.iter().map(|p| structs::Probe {
                normal: p.normal,
                distance: p.distance,
                velocity: p.velocity,
                hit: flag(p.hit),
            })),
            "contacts" => array(self.contacts.iter().map(|c| structs::Contact {
                normal: c.normal,
                touching: flag(c.touching),
                velocity: c.velocity,
                padding: 0.0,
            })),
            "energy_partials" => floats(&self.energy_partials),
            "polish_state" => array(
                [structs::PolishState {
                    elongation_max: self.polish_state.elongation_max.to_bits(),
                    granted: self.polish_state.granted,
                    further_sweeps: self.polish_state.further_sweeps,
                    missed_steps: self.polish_state.missed_steps,
                }]
                .into_iter(),
            ),
            "sweep_workgroups" => bytemuck::cast_slice(&self.sweep_workgroups).to_vec(),
            "sweep_dispatches" => bytemuck::cast_slice(&self.sweep_dispatches).to_vec(),
            "status" => array([self.status].into_iter()),
            other => constant(other, &self.model, &self.settings, self.after_maps)
                .unwrap_or_else(|| panic!("the kernels name a buffer {other} that the input does not know")),
        }
    }

    fn maps(&self, name: &str) -> Option<&BodyMaps> {
        Some(if name.starts_with("side") { &self.sides.maps } else { &self.layers.maps })
    }
}

fn flag(on: bool) -> f32 {
    if on { 1.0 } else { 0.0 }
}

fn padded(xyz: &[Vec3], w: f32) -> Vec<u8> {
    with_w(xyz, &vec![w; xyz.len()])
}

fn array<T>(values: impl Iterator<Item = T>) -> Vec<u8>
where
    Vec<T>: ShaderType + WriteInto,
{
    let mut buffer = StorageBuffer::new(Vec::new());
    buffer.write(&values.collect::<Vec<T>>()).expect("a vector grows");
    buffer.into_inner()
}
