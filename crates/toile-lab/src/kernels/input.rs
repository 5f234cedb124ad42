//! Everything a kernel may read or write, on the side of the reference, and its bytes on the device.

use super::Inputs;
use crate::Layers;
use encase::{ShaderType, StorageBuffer, UniformBuffer, internal::WriteInto};
use glam::{Vec3, Vec4};
use std::ops::Range;
use toile::gpu::{BodyMaps, step_params};
use toile::model::{Attachment, Csr, Hold, Limit, Link, Model, SeamPair, StepSettings, Strand};
use toile::scene::{Polish, Pose, Skin};
use toile_kernels::structs;
use toile_reference::step::PolishState;
use toile_reference::{Ball, Contact, Lag, Midpoints, Particles, Probe};

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
    /// Springs of each particle.
    pub links: Csr<Link>,
    /// Limits of all colours.
    pub limits: Vec<Limit>,
    /// What they pulled with [N·s].
    pub limit_impulses: Vec<f32>,
    /// Strands of all colours.
    pub strands: Vec<Strand>,
    /// Particles of the strands.
    pub strand_particles: Vec<u32>,
    /// Lengths of their limits [m].
    pub strand_lengths: Vec<f32>,
    /// Pins of each particle.
    pub attachments: Csr<Attachment>,
    /// Seam pairs of all colours.
    pub seam_pairs: Vec<SeamPair>,
    /// The items of the colour that the dispatch works on.
    pub span: Range<u32>,
    /// Part of an excess that the guard removes [1].
    pub share: f32,
    /// Held edges.
    pub holds: Vec<Hold>,
    /// Particles of the held edges.
    pub held_particles: Vec<u32>,
    /// Quads and triangles.
    pub quads: Vec<[u32; 4]>,
    /// Quads of each particle.
    pub particle_quads: Csr<u32>,
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
    /// The sphere.
    pub ball: Ball,
    /// Whether the sphere is sampled after the maps.
    pub after_maps: bool,
    /// Time from the step to that of the maps.
    pub lag: Lag,
    /// Maps of the bodies.
    pub layers: Layers,
    /// Skin of a body that moves.
    pub skin: Skin,
    /// Its pose.
    pub pose: Pose,
    /// What the kernels of a body write.
    pub body: Posed,
    /// How often the body takes a pose [1/s].
    pub rate: f32,
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
        &self.limits[self.colour()]
    }

    /// The strands of the span.
    pub fn colour_strands(&self) -> &[Strand] {
        &self.strands[self.colour()]
    }

    /// The ends of the limits of the strands of the span.
    pub fn strand_limits(&self) -> Vec<[u32; 2]> {
        let model = Model {
            strands: self.colour_strands().to_vec(),
            strand_particles: self.strand_particles.clone(),
            strand_lengths: self.strand_lengths.clone(),
            ..Model::default()
        };
        model.strand_limits().map(|(ends, _)| ends).collect()
    }

    /// The seam pairs of the span.
    pub fn colour_pairs(&self) -> &[SeamPair] {
        &self.seam_pairs[self.colour()]
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
            "step" => uniform(&structs::StepParams {
                particle_count: self.particles.positions.len() as u32,
                quad_count: self.quads.len() as u32,
                limit_count: self.limits.len() as u32,
                ..step_params(&self.settings)
            }),
            "span" => {
                let Range { start, end } = self.span;
                uniform(&structs::Span { first: start, count: end - start, share: self.share })
            }
            "ball" => uniform(&structs::Ball {
                centre: self.ball.centre,
                radius: self.ball.radius,
                velocity: self.ball.velocity,
                after_maps: u32::from(self.after_maps),
                spin: self.ball.spin,
            }),
            "lag" => uniform(&structs::Lag { start: self.lag.start, end: self.lag.end }),
            "vertices" => uniform(&structs::Vertices { count: self.skin.positions.len() as u32, rate: self.rate }),
            "bind_positions" => padded(&self.skin.positions, 1.0),
            "bind_normals" => padded(&self.skin.normals, 0.0),
            "morph_offsets" => words(&self.morphs().offsets),
            "displacements" => array(self.morphs().displacements.iter().map(|d| structs::Displacement {
                position: d.position,
                morph: d.target,
                normal: d.normal,
            })),
            "morph_weights" => bytemuck::cast_slice(&self.pose.morph_weights).to_vec(),
            "morphed_positions" => padded(&self.body.morphed_positions, 1.0),
            "morphed_normals" => padded(&self.body.morphed_normals, 0.0),
            "influence_offsets" => words(&self.skin.influence_offsets),
            "influences" => {
                array(self.skin.influences.iter().map(|i| structs::Influence { joint: i.joint, weight: i.weight }))
            }
            "joints" => bytemuck::cast_slice(&self.pose.joints).to_vec(),
            "body_positions" | "surface_positions" => padded(&self.body.positions, 1.0),
            "body_normals" => padded(&self.body.normals, 0.0),
            "last_positions" => padded(&self.body.last_positions, 1.0),
            "surface_velocities" => padded(&self.body.velocities, 0.0),
            "map_box" => {
                let map_box = self.layers.read.map_box;
                uniform(&structs::MapBox {
                    origin_x: map_box.origin_x,
                    origin_y: map_box.origin_y,
                    texel: map_box.texel,
                    z_front: map_box.z_front,
                    z_back: map_box.z_back,
                    columns: map_box.columns,
                    rows: map_box.rows,
                })
            }
            "positions" => with_w(&self.particles.positions, &self.particles.inverse_masses),
            "velocities" => with_w(&self.particles.velocities, &self.particles.masses),
            "open_positions" => with_w(&self.open.positions, &self.open.inverse_masses),
            "open_velocities" => with_w(&self.open.velocities, &self.open.masses),
            "position_copies" => with_w(&self.copies.positions, &self.copies.inverse_masses),
            "velocity_copies" => with_w(&self.copies.velocities, &self.copies.masses),
            "member_offsets" => words(&self.members.offsets),
            "members" => words(&self.members.values),
            "forces" => with_w(&self.forces, &vec![0.0; self.forces.len()]),
            "quad_winds" => with_w(&self.quad_winds, &vec![0.0; self.quad_winds.len()]),
            "normals" => with_w(&self.normals, &vec![0.0; self.normals.len()]),
            "link_offsets" => words(&self.links.offsets),
            "link_others" => words(&self.links.values.iter().map(|l| l.other).collect::<Vec<_>>()),
            "link_springs" => array(
                self.links
                    .values
                    .iter()
                    .map(|l| structs::LinkSpring { rest_length: l.rest_length, stiffness: l.stiffness }),
            ),
            "limits" => array(self.limits.iter().map(|l| structs::Limit {
                first: l.ends[0],
                second: l.ends[1],
                rest_length: l.rest_length,
                max_length: l.max_length,
            })),
            "limit_impulses" => bytemuck::cast_slice(&self.limit_impulses).to_vec(),
            "strands" => array(self.strands.iter().map(|s| structs::Strand {
                first: s.particles.start,
                count: s.particles.end - s.particles.start,
                lengths: s.lengths,
                level_count: s.level_count,
            })),
            "strand_particles" => words(&self.strand_particles),
            "strand_lengths" => bytemuck::cast_slice(&self.strand_lengths).to_vec(),
            "attachment_offsets" => words(&self.attachments.offsets),
            "attachments" => array(
                self.attachments.values.iter().map(|a| structs::Attachment { pin: a.pin, max_length: a.max_length }),
            ),
            "seam_pairs" => array(self.seam_pairs.iter().map(|s| structs::SeamPair {
                first: s.ends[0],
                second: s.ends[1],
                closing_speed: s.closing_speed,
            })),
            "holds" => array(self.holds.iter().map(|h| structs::Hold {
                first: h.particles.start,
                count: h.particles.end - h.particles.start,
                height: h.height,
            })),
            "held_particles" => words(&self.held_particles),
            "quads" => bytemuck::cast_slice(&self.quads).to_vec(),
            "particle_quad_offsets" => words(&self.particle_quads.offsets),
            "particle_quads" => words(&self.particle_quads.values),
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
            "energy_partials" => bytemuck::cast_slice(&self.energy_partials).to_vec(),
            "polish" => {
                let Polish { target, sweeps } = self.polish();
                uniform(&structs::Polish { target_elongation: target as f32, sweeps })
            }
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
            other => panic!("the kernels name a buffer {other} that the input does not know"),
        }
    }

    fn maps(&self) -> Option<&BodyMaps> {
        Some(&self.layers.maps)
    }
}

fn flag(on: bool) -> f32 {
    if on { 1.0 } else { 0.0 }
}

fn with_w(xyz: &[Vec3], w: &[f32]) -> Vec<u8> {
    let packed: Vec<Vec4> = xyz.iter().zip(w).map(|(xyz, w)| xyz.extend(*w)).collect();
    bytemuck::cast_slice(&packed).to_vec()
}

fn padded(xyz: &[Vec3], w: f32) -> Vec<u8> {
    with_w(xyz, &vec![w; xyz.len()])
}

fn words(values: &[u32]) -> Vec<u8> {
    bytemuck::cast_slice(values).to_vec()
}

fn uniform<T: ShaderType + WriteInto>(value: &T) -> Vec<u8> {
    let mut buffer = UniformBuffer::new(Vec::new());
    buffer.write(value).expect("a vector grows");
    buffer.into_inner()
}

fn array<T>(values: impl Iterator<Item = T>) -> Vec<u8>
where
    Vec<T>: ShaderType + WriteInto,
{
    let mut buffer = StorageBuffer::new(Vec::new());
    buffer.write(&values.collect::<Vec<T>>()).expect("a vector grows");
    buffer.into_inner()
}
