//! A host that skins its own character: its compute shader bends a woman to the music, in a vertex buffer of its own layout, and a skirt goes along. It prints
//! how far she sways and how the skirt is stretched.
//!
//! `cargo run --release -p toile --example character`

use std::error::Error;
use std::path::Path;
use toile::files::{BodyOptions, read_garment, read_moving_body};
use toile::gpu::{HostAttribute, HostMotion, HostVertices};
use toile::scene::{Body, Cloth, Fabric, Mesh, MovingMesh, Scene, Settings};
use toile::{Simulation, Stage};
use wgpu::util::DeviceExt;

/// Bytes of a vertex: position, normal, and the position before, as this host's own shader for motion blur wants it.
const STRIDE: u64 = 36;
/// The rate of the host [1/s], and how long it dances [s].
const RATE: f64 = 90.0;
const SECONDS: f64 = 3.0;

/// Stands for the skinning of a character: it turns and sways with height.
const SKINNING: &str = "
struct Moment { time: f32, count: u32 }
@group(0) @binding(0) var<uniform> moment: Moment;
@group(0) @binding(1) var<storage, read> rest: array<f32>;
@group(0) @binding(2) var<storage, read_write> posed: array<f32>;
fn bend(place: vec3<f32>, turn: f32) -> vec3<f32> {
    let along = vec2<f32>(cos(turn), sin(turn));
    return vec3<f32>(along.x * place.x + along.y * place.z, place.y, along.x * place.z - along.y * place.x);
}
@compute @workgroup_size(64) fn skin(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = 9u * id.x;
    if id.x >= moment.count { return; }
    let eased = smoothstep(0.0, 1.0, moment.time);
    let beat = eased * sin(6.0 * moment.time);
    for (var part = 0u; part < 2u; part++) {
        let k = first + 3u * part;
        let at = vec3<f32>(rest[k], rest[k + 1u], rest[k + 2u]);
        var moved = bend(at, 0.5 * beat * rest[first + 1u]);
        if part == 0u {
            moved.x += 0.1 * beat * at.y;
            for (var axis = 0u; axis < 3u; axis++) { posed[first + 6u + axis] = posed[first + axis]; }
        }
        for (var axis = 0u; axis < 3u; axis++) { posed[k + axis] = moved[axis]; }
    }
}";

/// A character as a renderer has it: what it is made of, and its posed vertices.
struct Character {
    pipeline: wgpu::ComputePipeline,
    rest: wgpu::Buffer,
    posed: wgpu::Buffer,
    count: u32,
}

impl Character {
    fn new(device: &wgpu::Device, mesh: &Mesh) -> Self {
        let vertices = mesh.positions.iter().zip(&mesh.normals);
        let words: Vec<f32> = vertices.flat_map(|(p, n)| [p.to_array(), n.to_array(), p.to_array()].concat()).collect();
        let buffer = |usage| {
            let contents = bytemuck::cast_slice(&words);
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("character"), contents, usage })
        };
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("skinning"),
            source: wgpu::ShaderSource::Wgsl(SKINNING.into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("skinning"),
            layout: None,
            module: &module,
            entry_point: Some("skin"),
            compilation_options: Default::default(),
            cache: None,
        });
        // It is drawn from, too; the library asks for STORAGE alone.
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::VERTEX;
        Self {
            pipeline,
            rest: buffer(wgpu::BufferUsages::STORAGE),
            posed: buffer(usage),
            count: mesh.positions.len() as u32,
        }
    }

    /// Poses the character.
    fn skin(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, time: f64) {
        let contents = [(time as f32).to_le_bytes(), self.count.to_le_bytes()].concat();
        let usage = wgpu::BufferUsages::UNIFORM;
        let moment = wgpu::util::BufferInitDescriptor { label: Some("moment"), contents: &contents, usage };
        let moment = device.create_buffer_init(&moment);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("skinning"),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: moment.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: self.rest.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 2, resource: self.posed.as_entire_binding() },
            ],
        });
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(self.count.div_ceil(64), 1, 1);
    }

    /// Where the library finds the vertices.
    fn vertices(&self) -> HostVertices {
        let attribute = |offset| HostAttribute::new(&self.posed, offset, STRIDE);
        let mut vertices = HostVertices::new(attribute(0), attribute(12));
        vertices.motion = Some(HostMotion::LastPositions(attribute(24)));
        vertices
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    // The device is the host's: a renderer brings the one that it draws with.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;

    // The mesh in the pose to dress in, vertex by vertex as the host has them; here it is read from a file.
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut options = BodyOptions::default();
    options.clip = Some("apose_to_walk".to_owned());
    let mesh = read_moving_body(&fixtures.join("bodies/walking_woman.glb"), &options)?.body.mesh;
    let character = Character::new(&device, &mesh);
    let mut settings = Settings::new(Fabric::preset("cotton").ok_or("cotton is a preset")?);
    settings.spacing = 0.03;
    let mut scene = Scene::new("character", settings);
    scene.cloths = vec![Cloth::Garment(read_garment(&fixtures.join("garments/skirt.json"))?.garment)];
    scene.bodies = vec![Body::Moving(MovingMesh::hosted(mesh))];
    let mut simulation = Simulation::new(&device, &scene)?;
    // The same buffers at every frame, so once is enough.
    simulation.set_vertices(character.vertices());

    let mut time = 0.0;
    let mut told = 0;
    while time < SECONDS {
        let is_running = simulation.stage()? == Stage::Running;
        let mut encoder = device.create_command_encoder(&Default::default());
        // She holds her pose while she is dressed, and then begins.
        if is_running {
            time += 1.0 / RATE;
            character.skin(&device, &mut encoder, time);
        }
        simulation.advance(&mut encoder, 1.0 / RATE)?;
        queue.submit([encoder.finish()]);
        // A renderer presents the frame here. This host has no display to wait for, so it waits for the device.
        device.poll(wgpu::PollType::wait_indefinitely())?;
        if is_running
            && time >= 0.5 * f64::from(told)
            && let Some(worn) = simulation.cloths().next()
            && let Some(strain) = worn.cloth.strain()?
        {
            let stretched = 100.0 * strain.elongation_max;
            println!(
                "{time:.1} s: the skirt of {} particles is stretched by {stretched:.1} % at most",
                worn.model.particle_count()
            );
            told += 1;
        }
    }
    Ok(())
}
