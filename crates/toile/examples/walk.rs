//! A host with a renderer of its own: dresses a woman in a skirt, has her walk, and draws both offscreen with its own pipeline, straight
//! from the buffers of the simulation. It writes `out/walk.png`: four moments of the walk.
//!
//! `cargo run --release --example walk`

use glam::camera::rh::{proj::directx::perspective, view::look_at_mat4};
use glam::{Vec3, vec3};
use std::error::Error;
use std::path::Path;
use toile::files::{BodyOptions, read_garment, read_moving_body};
use toile::scene::{Body, Cloth, Fabric, Scene, Settings};
use toile::{Simulation, Stage};
use wgpu::util::DeviceExt;

/// Size of one moment in the picture [px]; a row of it is a multiple of 256 bytes.
const SIZE: [u32; 2] = [256, 512];
/// Moments of the walk that are drawn.
const MOMENTS: u32 = 4;
/// Frames of 1/60 s from one moment to the next.
const FRAMES: u32 = 12;

const SHADER: &str = "
struct Camera { view_projection: mat4x4<f32>, colour: vec4<f32> }
@group(0) @binding(0) var<uniform> camera: Camera;
struct Corner { @builtin(position) place: vec4<f32>, @location(0) normal: vec3<f32> }
@vertex fn corner(@location(0) position: vec4<f32>, @location(1) normal: vec4<f32>) -> Corner {
    return Corner(camera.view_projection * vec4<f32>(position.xyz, 1.0), normal.xyz);
}
@fragment fn shade(corner: Corner) -> @location(0) vec4<f32> {
    let light = abs(dot(normalize(corner.normal), normalize(vec3<f32>(0.4, 0.5, 1.0))));
    return vec4<f32>(camera.colour.rgb * (0.25 + 0.75 * light), 1.0);
}";

fn main() -> Result<(), Box<dyn Error>> {
    // The device is the host's: a renderer brings the one that it draws with.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;

    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    let mut options = BodyOptions::default();
    options.clip = Some("walk_loop".to_owned());
    let body = read_moving_body(&fixtures.join("bodies/walking_woman.glb"), &options)?.body;
    let cotton = Fabric::preset("cotton").ok_or("cotton is a preset")?;
    let mut settings = Settings::new(cotton);
    settings.spacing = 0.03;
    let mut scene = Scene::new("walk", settings);
    scene.cloths = vec![Cloth::Garment(read_garment(&fixtures.join("garments/skirt.json"))?.garment)];
    scene.bodies = vec![Body::Moving(body)];
    let mut simulation = Simulation::new(&device, &scene)?;
    let renderer = Renderer::new(&device);

    let mut stage = None;
    while stage != Some(Stage::Running) {
        let mut encoder = device.create_command_encoder(&Default::default());
        simulation.advance(&mut encoder, 1.0 / 60.0)?;
        queue.submit([encoder.finish()]);
        // A renderer presents the frame here. This host has no display to wait for, so it waits for the device.
        device.poll(wgpu::PollType::wait_indefinitely())?;
        let now = simulation.stage()?;
        if stage.replace(now) != Some(now) {
            println!("{now:?}");
        }
    }
    let mut moments = Vec::new();
    for _ in 0..MOMENTS {
        for _ in 0..FRAMES {
            let mut encoder = device.create_command_encoder(&Default::default());
            simulation.advance(&mut encoder, 1.0 / 60.0)?;
            queue.submit([encoder.finish()]);
            device.poll(wgpu::PollType::wait_indefinitely())?;
        }
        moments.push(renderer.draw(&device, &queue, &simulation)?);
        println!("{:.1} s", simulation.time());
    }
    let mut picture = image::RgbaImage::new(MOMENTS * SIZE[0], SIZE[1]);
    for (moment, left) in moments.iter().zip((0..).step_by(SIZE[0] as usize)) {
        image::imageops::replace(&mut picture, moment, left, 0);
    }
    std::fs::create_dir_all("out")?;
    picture.save("out/walk.png")?;
    println!("wrote out/walk.png");
    Ok(())
}

/// The host's own pipeline.
struct Renderer {
    pipeline: wgpu::RenderPipeline,
    colour: wgpu::Texture,
    depth: wgpu::TextureView,
}

impl Renderer {
    fn new(device: &wgpu::Device) -> Self {
        let texture = |format, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some("picture"),
                size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("cloth and body"),
            source: wgpu::ShaderSource::Wgsl(SHADER.into()),
        });
        // Positions and normals are vec4 each, in buffers of their own.
        let buffer = |attributes| {
            Some(wgpu::VertexBufferLayout { array_stride: 16, step_mode: wgpu::VertexStepMode::Vertex, attributes })
        };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("cloth and body"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &shader,
                entry_point: Some("corner"),
                compilation_options: Default::default(),
                buffers: &[
                    buffer(&wgpu::vertex_attr_array![0 => Float32x4]),
                    buffer(&wgpu::vertex_attr_array![1 => Float32x4]),
                ],
            },
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: wgpu::TextureFormat::Depth32Float,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &shader,
                entry_point: Some("shade"),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::TextureFormat::Rgba8UnormSrgb.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let depth = texture(wgpu::TextureFormat::Depth32Float, wgpu::TextureUsages::empty());
        let colour = texture(wgpu::TextureFormat::Rgba8UnormSrgb, wgpu::TextureUsages::COPY_SRC);
        Self { pipeline, colour, depth: depth.create_view(&Default::default()) }
    }

    /// Draws the bodies and the cloths of a simulation, and reads the picture back.
    fn draw(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        simulation: &Simulation,
    ) -> Result<image::RgbaImage, Box<dyn Error>> {
        let view = look_at_mat4(vec3(1.6, 1.3, 3.0), vec3(0.0, 0.85, 0.0), Vec3::Y);
        let projection = perspective(0.55, SIZE[0] as f32 / SIZE[1] as f32, 0.1, 10.0);
        let camera = |colour: [f32; 4]| {
            let numbers = [&(projection * view).to_cols_array()[..], &colour].concat();
            let uniform = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("camera"),
                contents: bytemuck::cast_slice(&numbers),
                usage: wgpu::BufferUsages::UNIFORM,
            });
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("camera"),
                layout: &self.pipeline.get_bind_group_layout(0),
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() }],
            })
        };
        let [skin, cotton] = [camera([0.8, 0.6, 0.5, 1.0]), camera([0.15, 0.3, 0.7, 1.0])];
        let bodies =
            simulation.bodies().map(|body| (&skin, &body.positions, &body.normals, &body.indices, body.index_count));
        let cloths = simulation.cloths().map(|worn| {
            let frame = worn.cloth.frame();
            (&cotton, &frame.positions, &frame.normals, &frame.indices, frame.index_count)
        });
        let target = self.colour.create_view(&Default::default());
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::WHITE), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        for (group, positions, normals, indices, index_count) in bodies.chain(cloths) {
            pass.set_bind_group(0, group, &[]);
            pass.set_vertex_buffer(0, positions.slice(..));
            pass.set_vertex_buffer(1, normals.slice(..));
            pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..index_count, 0, 0..1);
        }
        drop(pass);
        let read = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size: u64::from(4 * SIZE[0] * SIZE[1]),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * SIZE[0]), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            self.colour.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &read, layout },
            self.colour.size(),
        );
        queue.submit([encoder.finish()]);
        let bytes = toile::gpu::readback::read_buffer(device, queue, &read)?;
        Ok(image::RgbaImage::from_raw(SIZE[0], SIZE[1], bytes).ok_or("a picture has four bytes per pixel")?)
    }
}
