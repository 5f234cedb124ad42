//! A body that moves, on the device: posed whenever the maps are drawn anew.

use crate::contents::encoded;
use crate::hosted::{HostVertices, Hosted};
use crate::limits::check_limits;
use crate::maps::padded;
use crate::trail::{dispatch, sized, vertices_uniform};
use crate::{GpuError, Kernels, Program, Surface, Trail};
use glam::{DVec3, Vec3, Vec4};
use toile_kernels::Kernel;
use toile_scene::{Lead, MeshSequence, Motion, MovingMesh, Pose, Rig, Skin};
use wgpu::util::DeviceExt;

/// A body that moves, on the device.
#[derive(Debug)]
pub struct MovingBody {
    surface: Surface,
    trail: Trail,
    poser: Poser,
    lead: Option<Lead>,
    /// How far the body stands from where its motion has it [m].
    place: DVec3,
    /// Time of the last pose [s]; `None` before the first.
    time: Option<f64>,
    bytes: u64,
}

/// What gives the vertices their places.
#[derive(Debug)]
enum Poser {
    Joints(Box<Joints>),
    Sequence(MeshSequence),
    Hosted(Box<Hosted>),
}

/// Skinning.
#[derive(Debug)]
struct Joints {
    rig: Rig,
    joints: wgpu::Buffer,
    morph: Option<Morph>,
    skin: Program,
    group: wgpu::BindGroup,
    vertex_count: u32,
}

#[derive(Debug)]
struct Morph {
    weights: wgpu::Buffer,
    program: Program,
    group: wgpu::BindGroup,
}

impl MovingBody {
    /// Uploads a body as it stands at time 0, for texels of the edge length `texel` [m]. It has no pose and no velocity before the first [`MovingBody::record_pose`].
    ///
    /// # Errors
    /// [`GpuError::BufferTooLarge`] when it does not fit the device, [`GpuError::LimitTooLow`] when the kernels do not.
    pub fn new(kernels: impl Into<Kernels>, body: &MovingMesh, texel: f32) -> Result<Self, GpuError> {
        let kernels = &kernels.into();
        let device = kernels.device();
        check_limits(device)?;
        let available = device.limits().max_storage_buffer_binding_size;
        let vertex_count = body.mesh.positions.len() as u32;
        let size = 16 * u64::from(vertex_count);
        if size > available {
            return Err(GpuError::BufferTooLarge { name: "body_positions".to_owned(), needed: size, available });
        }
        let usage = wgpu::BufferUsages::STORAGE
            | wgpu::BufferUsages::VERTEX
            | wgpu::BufferUsages::COPY_SRC
            | wgpu::BufferUsages::COPY_DST;
        let positions = upload_vec3s(device, "body_positions", &body.mesh.positions, usage);
        let normals = upload_vec3s(device, "body_normals", &body.mesh.normals, usage);
        let trail = Trail::new(kernels, &positions, vertex_count);
        let surface = Surface {
            velocities: Some(trail.velocities().clone()),
            indices: Surface::indices(device, &body.mesh),
            index_count: 3 * body.mesh.triangles.len() as u32,
            parts: Surface::triangle_parts(device, &body.mesh, texel),
            open: false,
            positions,
            normals,
        };
        let mut bytes = 2 * size + trail.bytes() + surface.indices.size();
        let poser = match &body.motion {
            Motion::Skinned { skin, rig } => {
                let (joints, joint_bytes) = Joints::new(kernels, skin, rig, &surface, available)?;
                bytes += joint_bytes;
                Poser::Joints(Box::new(joints))
            }
            Motion::Sequence(sequence) => Poser::Sequence(sequence.clone()),
            Motion::Hosted => {
                let hosted = Hosted::new(kernels, vertex_count);
                bytes += hosted.bytes();
                Poser::Hosted(Box::new(hosted))
            }
        };
        Ok(Self { surface, trail, poser, lead: body.lead(), place: DVec3::ZERO, time: None, bytes })
    }

    /// Has the next poses be those of vertices that the host skins: they show the body at `time` [s], and `seconds` after the positions before. A pose at another
    /// time goes ahead or back by the motion of the vertices.
    ///
    /// # Errors
    /// [`GpuError::BufferTooLarge`] when a device cannot bind all vertices at once.
    ///
    /// # Panics
    /// When the body is none that the host skins, or a buffer is not as [`HostAttribute`](crate::HostAttribute) says.
    pub fn give(
        &mut self,
        device: &wgpu::Device,
        vertices: &HostVertices,
        time: f64,
        seconds: f64,
    ) -> Result<(), GpuError> {
        match &mut self.poser {
            Poser::Hosted(hosted) => hosted.give(device, vertices, time, seconds),
            _ => panic!("only a body whose motion is Motion::Hosted takes vertices of the host"),
        }
    }

    /// Records the question where the vertices of a body are that the host skins; whether it was asked: one at a time is under way.
    pub fn record_bounds(&self, encoder: &mut wgpu::CommandEncoder) -> bool {
        match &self.poser {
            Poser::Hosted(hosted) => hosted.record_bounds(encoder, &self.surface),
            _ => false,
        }
    }

    /// The answer, smallest and largest corner [m], once, when it has arrived. Nothing waits.
    pub fn take_bounds(&self) -> Option<[Vec3; 2]> {
        match &self.poser {
            Poser::Hosted(hosted) => hosted.take_bounds(),
            _ => None,
        }
    }

    /// Has the body stand so far from where its motion has it [m]. Its next pose stands still, as the first does. What the host skins stands where the host has
    /// it.
    pub fn set_place(&mut self, place: DVec3) {
        self.place = place;
        self.time = None;
    }

    /// Records the pose at a time [s], and the velocities since the pose before; the first pose stands still. A body that [jumps](Lead::jump)
    /// between the two has velocities as if the pose before had been where it jumps to.
    pub fn record_pose(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, time: f64) {
        let jump = self.time.zip(self.lead.as_ref()).and_then(|(last, lead)| Some((last, lead.jump(last, time)?)));
        if let (Some((last, jump)), Poser::Joints(joints)) = (jump, &self.poser) {
            joints.record(device, encoder, &joints.rig.carried_pose(last, jump.matrix()), self.place);
        }
        self.trail.record_leaving(encoder);
        match &self.poser {
            Poser::Joints(joints) => joints.record(device, encoder, &joints.rig.pose(time), self.place),
            Poser::Sequence(sequence) => {
                let [mut positions, normals] = sequence.at(time).unwrap_or_default();
                positions.iter_mut().for_each(|position| *position += self.place.as_vec3());
                for (values, target) in [(positions, &self.surface.positions), (normals, &self.surface.normals)] {
                    let upload = upload_vec3s(device, "sequence upload", &values, wgpu::BufferUsages::COPY_SRC);
                    encoder.copy_buffer_to_buffer(&upload, 0, target, 0, upload.size());
                }
            }
            Poser::Hosted(hosted) => hosted.record(device, encoder, &self.surface, time),
        }
        let seconds = self.time.map_or(0.0, |last| time - last);
        self.trail.record_arrival(device, encoder, seconds);
        self.time = Some(time);
    }

    /// The body as the maps draw it.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}

impl Joints {
    fn new(
        kernels: &Kernels,
        skin: &Skin,
        rig: &Rig,
        surface: &Surface,
        available: u64,
    ) -> Result<(Self, u64), GpuError> {
        let device = kernels.device();
        let vertex_count = skin.positions.len() as u32;
        let size = 16 * u64::from(vertex_count);
        let storage = wgpu::BufferUsages::STORAGE;
        let mut bytes = 0;
        let mut upload = |label: &str, contents: &[u8]| {
            let needed = contents.len() as u64;
            if needed > available {
                return Err(GpuError::BufferTooLarge { name: label.to_owned(), needed, available });
            }
            bytes += needed.max(16);
            Ok(create(device, label, contents, storage | wgpu::BufferUsages::COPY_DST))
        };
        let vertices = vertices_uniform(device, vertex_count, 0.0);
        let bind_positions = upload("bind_positions", bytemuck::cast_slice(&padded(&skin.positions)))?;
        let bind_normals = upload("bind_normals", bytemuck::cast_slice(&padded(&skin.normals)))?;
        let influence_offsets = upload("influence_offsets", bytemuck::cast_slice(&skin.influence_offsets))?;
        let influences = upload("influences", &encoded(&skin.influences))?;
        let pose = rig.pose(0.0);
        let joints = upload("joints", bytemuck::cast_slice(&pose.joints))?;
        let mut morphed = [bind_positions.clone(), bind_normals.clone()];
        let morph = match &skin.morphs {
            None => None,
            Some(morphs) => {
                let offsets = upload("morph_offsets", bytemuck::cast_slice(&morphs.offsets))?;
                let displacements = upload("displacements", &encoded(&morphs.displacements))?;
                let weights = upload("morph_weights", bytemuck::cast_slice(&pose.morph_weights))?;
                let zeros = vec![0; size as usize];
                morphed = [upload("morphed_positions", &zeros)?, upload("morphed_normals", &zeros)?];
                let program = kernels.program(Kernel::MorphBody);
                let group = program.bind(device, |binding| match binding.name.as_str() {
                    "vertices" => vertices.as_entire_binding(),
                    "bind_positions" => bind_positions.as_entire_binding(),
                    "bind_normals" => bind_normals.as_entire_binding(),
                    "morph_offsets" => offsets.as_entire_binding(),
                    "displacements" => displacements.as_entire_binding(),
                    "morph_weights" => weights.as_entire_binding(),
                    "morphed_positions" => morphed[0].as_entire_binding(),
                    "morphed_normals" => morphed[1].as_entire_binding(),
                    other => panic!("a morphed body has no {other}"),
                });
                Some(Morph { weights, program, group })
            }
        };
        let program = kernels.program(Kernel::SkinBody);
        let group = program.bind(device, |binding| match binding.name.as_str() {
            "vertices" => vertices.as_entire_binding(),
            "morphed_positions" => morphed[0].as_entire_binding(),
            "morphed_normals" => morphed[1].as_entire_binding(),
            "influence_offsets" => influence_offsets.as_entire_binding(),
            "influences" => influences.as_entire_binding(),
            "joints" => joints.as_entire_binding(),
            "body_positions" => sized(&surface.positions, size),
            "body_normals" => sized(&surface.normals, size),
            other => panic!("a skinned body has no {other}"),
        });
        Ok((Self { rig: rig.clone(), joints, morph, skin: program, group, vertex_count }, bytes))
    }

    fn record(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, pose: &Pose, place: DVec3) {
        let mut write = |contents: &[u8], target: &wgpu::Buffer| {
            let upload = create(device, "pose upload", contents, wgpu::BufferUsages::COPY_SRC);
            encoder.copy_buffer_to_buffer(&upload, 0, target, 0, upload.size().min(target.size()));
        };
        // The shares of a vertex in its joints add up to one, so that all of it goes along.
        let [x, y, z] = place.as_vec3().to_array();
        let placed = |[a, b, c]: &[Vec4; 3]| [*a + Vec4::W * x, *b + Vec4::W * y, *c + Vec4::W * z];
        let joints: Vec<[Vec4; 3]> = pose.joints.iter().map(placed).collect();
        write(bytemuck::cast_slice(&joints), &self.joints);
        if let Some(morph) = &self.morph {
            write(bytemuck::cast_slice(&pose.morph_weights), &morph.weights);
        }
        let mut compute = encoder.begin_compute_pass(&Default::default());
        if let Some(morph) = &self.morph {
            dispatch(&mut compute, &morph.program, &morph.group, Kernel::MorphBody, self.vertex_count);
        }
        dispatch(&mut compute, &self.skin, &self.group, Kernel::SkinBody, self.vertex_count);
    }
}

/// A buffer with these contents, and not less than a vec4: a binding cannot be empty.
fn create(device: &wgpu::Device, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let mut contents = contents.to_vec();
    contents.resize(contents.len().next_multiple_of(4).max(16), 0);
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents: &contents, usage })
}

fn upload_vec3s(device: &wgpu::Device, label: &str, values: &[Vec3], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    create(device, label, bytemuck::cast_slice(&padded(values)), usage)
}
