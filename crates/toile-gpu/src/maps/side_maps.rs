//! The papers' maps: depth, normals and velocities as two cameras see them, from the front and the back. W §4.

use super::surface::{Surface, create};
use crate::contents::{Encode, uniform};
use crate::{GpuError, Kernels};
use std::sync::{Mutex, PoisonError};
use toile_kernels::{render_sides_source, structs};
use toile_model::{MapBox, SideBox};

const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const COLOUR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// The maps of everything that a cloth collides with, front and back: depth and normals, and of moving bodies velocities.
///
/// Layer 0 is seen from +z, layer 1 from −z; both have the same columns (x) and rows (−y). A texel that sees nothing has depth 1.
#[derive(Debug)]
pub(crate) struct SideMaps {
    size: wgpu::Extent3d,
    depth: Map,
    normals: Map,
    velocities: Option<Map>,
    box_uniform: wgpu::Buffer,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    cameras: Mutex<Vec<Cameras>>,
}

/// Most thicknesses whose cameras are kept: the garments of an outfit have one or a few.
const CAMERAS_KEPT: usize = 8;

/// The front and the back camera for a thickness, which never change: commands that are recorded already keep theirs.
#[derive(Debug)]
struct Cameras {
    thickness: f32,
    sides: [wgpu::BindGroup; 2],
}

/// A texture of two layers.
#[derive(Debug)]
struct Map {
    texture: wgpu::Texture,
    layers: wgpu::TextureView,
    sides: [wgpu::TextureView; 2],
}

impl Map {
    fn new(device: &wgpu::Device, label: &str, format: wgpu::TextureFormat, size: wgpu::Extent3d) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let layers = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let sides = [0, 1].map(|side| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: side,
                array_layer_count: Some(1),
                ..Default::default()
            })
        });
        Self { texture, layers, sides }
    }

    fn colour(&self, side: usize, load: wgpu::LoadOp<wgpu::Color>) -> Option<wgpu::RenderPassColorAttachment<'_>> {
        Some(wgpu::RenderPassColorAttachment {
            view: &self.sides[side],
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })
    }
}

impl SideMaps {
    /// Empty maps as large as a box, of bodies at rest or of moving ones.
    ///
    /// # Errors
    /// [`GpuError::MapTooLarge`] when the box has more texels on a side than the device's textures.
    pub(crate) fn new(kernels: &Kernels, map_box: MapBox, moving: bool) -> Result<Self, GpuError> {
        let device = kernels.device();
        let available = device.limits().max_texture_dimension_2d;
        let [columns, rows, _] = map_box.size;
        if columns.max(rows) > available {
            return Err(GpuError::MapTooLarge { columns, rows, available });
        }
        let size = wgpu::Extent3d { width: columns, height: rows, depth_or_array_layers: 2 };
        let SidePipeline { layout, pipeline } = kernels.sides(moving);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        Ok(Self {
            size,
            depth: Map::new(device, "depth map", DEPTH_FORMAT, size),
            normals: Map::new(device, "normal map", COLOUR_FORMAT, size),
            velocities: moving.then(|| Map::new(device, "velocity map", COLOUR_FORMAT, size)),
            box_uniform: create(device, "side_box", &uniform(&SideBox::of(&map_box).encode()), usage),
            pipeline,
            layout,
            cameras: Mutex::default(),
        })
    }

    /// Records the drawing of all surfaces into a box, each offset along its normals by the thickness beside it [m].
    ///
    /// # Panics
    /// When the box has another size than these maps, or a surface in maps of moving bodies has no velocities.
    pub(crate) fn record(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        map_box: MapBox,
        surfaces: &[(&Surface, f32)],
    ) {
        self.place(device, encoder, map_box);
        self.draw(device, encoder, surfaces, true);
    }

    /// Records the drawing of more surfaces over what the maps show already.
    ///
    /// # Panics
    /// When a surface in maps of moving bodies has no velocities.
    pub(crate) fn record_over(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        surfaces: &[(&Surface, f32)],
    ) {
        self.draw(device, encoder, surfaces, false);
    }

    /// Records a copy of maps of the same size, which show the bodies in `map_box`.
    ///
    /// # Panics
    /// When the other maps have another size, or only one of both shows velocities.
    pub(crate) fn record_copy(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        other: &SideMaps,
        map_box: MapBox,
    ) {
        assert_eq!(self.size, other.size, "maps are copied into maps of the same size");
        assert_eq!(self.is_moving(), other.is_moving(), "maps with and without velocities");
        self.place(device, encoder, map_box);
        let mut copy = |from: &Map, to: &Map| {
            encoder.copy_texture_to_texture(from.texture.as_image_copy(), to.texture.as_image_copy(), self.size);
        };
        copy(&other.depth, &self.depth);
        copy(&other.normals, &self.normals);
        if let (Some(from), Some(to)) = (&other.velocities, &self.velocities) {
            copy(from, to);
        }
    }

    fn place(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, map_box: MapBox) {
        let size = [self.size.width, self.size.height];
        assert_eq!(map_box.size[..2], size, "the box has the size of the maps");
        // A buffer of its own, not a queue write: the caller may record several frames before submitting any.
        let upload =
            create(device, "side_box upload", &uniform(&SideBox::of(&map_box).encode()), wgpu::BufferUsages::COPY_SRC);
        encoder.copy_buffer_to_buffer(&upload, 0, &self.box_uniform, 0, upload.size());
    }

    fn draw(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        surfaces: &[(&Surface, f32)],
        anew: bool,
    ) {
        let colour_load = if anew { wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT) } else { wgpu::LoadOp::Load };
        let depth_load = if anew { wgpu::LoadOp::Clear(1.0) } else { wgpu::LoadOp::Load };
        let cameras: Vec<_> = surfaces.iter().map(|(_, thickness)| self.cameras(device, *thickness)).collect();
        for side in 0..2 {
            let normals = self.normals.colour(side, colour_load);
            let velocities = self.velocities.as_ref().and_then(|map| map.colour(side, colour_load));
            let colours: Vec<_> = [normals, velocities].into_iter().filter(Option::is_some).collect();
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("render_sides"),
                color_attachments: &colours,
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &self.depth.sides[side],
                    depth_ops: Some(wgpu::Operations { load: depth_load, store: wgpu::StoreOp::Store }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            for ((surface, _), cameras) in surfaces.iter().zip(&cameras) {
                pass.set_bind_group(0, &cameras[side], &[]);
                pass.set_vertex_buffer(0, surface.positions.slice(..));
                pass.set_vertex_buffer(1, surface.normals.slice(..));
                if self.is_moving() {
                    let velocities = surface.velocities.as_ref().expect("maps of moving bodies need velocities");
                    pass.set_vertex_buffer(2, velocities.slice(..));
                }
                pass.set_index_buffer(surface.indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..surface.index_count, 0, 0..1);
            }
        }
    }

    /// Whether the maps show velocities.
    pub(crate) fn is_moving(&self) -> bool {
        self.velocities.is_some()
    }

    /// The depth map, `Depth32Float`, two layers; 0 at the camera's plane, 1 at the other camera's plane or where nothing is seen.
    pub(crate) fn depths(&self) -> &wgpu::Texture {
        &self.depth.texture
    }

    /// The normal map, `Rgba32Float`, two layers; xyz is the unit normal facing the camera.
    pub(crate) fn normals(&self) -> &wgpu::Texture {
        &self.normals.texture
    }

    /// The velocity map, `Rgba32Float`, two layers; xyz is the velocity [m/s]. `None` for bodies at rest.
    pub(crate) fn velocities(&self) -> Option<&wgpu::Texture> {
        self.velocities.as_ref().map(|map| &map.texture)
    }

    /// Bytes that maps over a box have. It needs no device.
    pub(crate) fn bytes_over(map_box: &MapBox, moving: bool) -> u64 {
        bytes_of(map_box.size[0], map_box.size[1], moving)
    }

    /// The resource that the kernels know by this name, if it is one of the maps.
    pub(crate) fn resource(&self, name: &str) -> Option<wgpu::BindingResource<'_>> {
        match name {
            "side_box" => Some(self.box_uniform.as_entire_binding()),
            "side_depths" => Some(wgpu::BindingResource::TextureView(&self.depth.layers)),
            "side_normals" => Some(wgpu::BindingResource::TextureView(&self.normals.layers)),
            "side_velocities" => self.velocities.as_ref().map(|map| wgpu::BindingResource::TextureView(&map.layers)),
            _ => None,
        }
    }

    /// Both cameras for a thickness, made once.
    fn cameras(&self, device: &wgpu::Device, thickness: f32) -> [wgpu::BindGroup; 2] {
        let mut kept = self.cameras.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = kept.iter().find(|known| known.thickness == thickness) {
            return known.sides.clone();
        }
        let sides = [0, 1].map(|side| self.camera(device, side, thickness));
        if kept.len() == CAMERAS_KEPT {
            kept.remove(0);
        }
        kept.push(Cameras { thickness, sides: sides.clone() });
        sides
    }

    fn camera(&self, device: &wgpu::Device, side: u32, thickness: f32) -> wgpu::BindGroup {
        let camera = uniform(&structs::Side { side, thickness });
        let camera = create(device, "camera", &camera, wgpu::BufferUsages::UNIFORM);
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("render_sides"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: self.box_uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: camera.as_entire_binding() },
            ],
        })
    }
}

fn bytes_of(columns: u32, rows: u32, moving: bool) -> u64 {
    let texels = 2 * u64::from(columns) * u64::from(rows);
    let colours = if moving { 2 } else { 1 };
    texels * (4 + 16 * colours) + <structs::SideBox as encase::ShaderType>::min_size().get()
}

/// What draws the papers' maps.
#[derive(Clone, Debug)]
pub(crate) struct SidePipeline {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
}

impl SidePipeline {
    /// Compiles it, or takes it from a cache, for bodies at rest or for those that move.
    pub(crate) fn new(device: &wgpu::Device, moving: bool, cache: Option<&wgpu::PipelineCache>) -> Self {
        let (layout, pipeline) = create_pipeline(device, moving, cache);
        Self { layout, pipeline }
    }
}

fn create_pipeline(
    device: &wgpu::Device,
    moving: bool,
    cache: Option<&wgpu::PipelineCache>,
) -> (wgpu::BindGroupLayout, wgpu::RenderPipeline) {
    let label = Some("render_sides");
    let uniform = |binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let layout =
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries: &[uniform(0), uniform(1)] });
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label,
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label,
        source: wgpu::ShaderSource::Wgsl(render_sides_source().into()),
    });
    let attribute = |location| {
        [wgpu::VertexAttribute { format: wgpu::VertexFormat::Float32x3, offset: 0, shader_location: location }]
    };
    let (vertex_entry, fragment_entry, colour_count) = if moving {
        ("draw_moving_surface", "write_normal_and_velocity", 2)
    } else {
        ("draw_surface", "write_normal", 1)
    };
    // Positions, normals, and one more with velocities: as many as there are colours, and one.
    let attributes: Vec<_> = (0..=colour_count).map(attribute).collect();
    let buffers: Vec<_> = attributes
        .iter()
        .map(|attributes| {
            Some(wgpu::VertexBufferLayout { array_stride: 16, step_mode: wgpu::VertexStepMode::Vertex, attributes })
        })
        .collect();
    let targets = vec![Some(COLOUR_FORMAT.into()); colour_count as usize];
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label,
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(vertex_entry),
            compilation_options: Default::default(),
            buffers: &buffers,
        },
        // Nothing is culled: a scanned body with holes shows its inside rather than nothing.
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(fragment_entry),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache,
    });
    (layout, pipeline)
}
