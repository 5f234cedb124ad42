//! The depth, normal and velocity maps of the bodies: rendered on the GPU, never leaving it in a run. W §4.

use crate::GpuError;
use crate::buffers::uniform_bytes;
use crate::limits::check_limits;
use toile_kernels::{render_maps_source, structs};
use toile_model::MapBox;
use toile_scene::Mesh;
use wgpu::util::DeviceExt;

const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const COLOUR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// A triangle mesh on the device, as the maps draw it: a body, or a garment that lies under another one.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Positions [m], vec4 each, xyz used; usage `VERTEX`.
    pub positions: wgpu::Buffer,
    /// Unit normals, vec4 each, xyz used; usage `VERTEX`.
    pub normals: wgpu::Buffer,
    /// Velocities [m/s], vec4 each, xyz used; usage `VERTEX`. Maps of moving bodies need them of every surface.
    pub velocities: Option<wgpu::Buffer>,
    /// Vertex indices (u32), three per triangle; usage `INDEX`.
    pub indices: wgpu::Buffer,
    /// Number of indices.
    pub index_count: u32,
}

impl Surface {
    /// Uploads a mesh at rest.
    pub fn new(device: &wgpu::Device, mesh: &Mesh) -> Self {
        let vertices = |label, values: &[glam::Vec3]| {
            create(device, label, bytemuck::cast_slice(&padded(values)), wgpu::BufferUsages::VERTEX)
        };
        Self {
            positions: vertices("surface positions", &mesh.positions),
            normals: vertices("surface normals", &mesh.normals),
            velocities: None,
            indices: Self::indices(device, mesh),
            index_count: 3 * mesh.triangles.len() as u32,
        }
    }

    /// The same mesh as one of maps of moving bodies sees it: with velocities, which are zero.
    pub fn at_rest(device: &wgpu::Device, mesh: &Mesh) -> Self {
        let zeros = vec![0; 16 * mesh.positions.len()];
        let velocities = create(device, "surface velocities", &zeros, wgpu::BufferUsages::VERTEX);
        Self { velocities: Some(velocities), ..Self::new(device, mesh) }
    }

    pub(crate) fn indices(device: &wgpu::Device, mesh: &Mesh) -> wgpu::Buffer {
        create(device, "surface indices", bytemuck::cast_slice(&mesh.triangles), wgpu::BufferUsages::INDEX)
    }
}

/// Vectors as the device holds them: four words each.
pub(crate) fn padded(values: &[glam::Vec3]) -> Vec<glam::Vec4> {
    values.iter().map(|v| v.extend(0.0)).collect()
}

fn create(device: &wgpu::Device, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
}

/// The maps of everything that a cloth collides with, front and back: depth and normals, and of moving bodies velocities.
///
/// Layer 0 is seen from +z, layer 1 from −z; both have the same columns (x) and rows (−y). A texel that sees nothing has depth 1.
#[derive(Debug)]
pub struct BodyMaps {
    size: wgpu::Extent3d,
    depth: Map,
    normals: Map,
    velocities: Option<Map>,
    map_box_uniform: wgpu::Buffer,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
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

impl BodyMaps {
    /// Empty maps as large as a box, of bodies at rest or of moving ones.
    ///
    /// # Errors
    /// [`GpuError::MapTooLarge`] when the box has more texels on a side than the device's textures, [`GpuError::LimitTooLow`] when the
    /// device has less than the render pass needs.
    pub fn new(device: &wgpu::Device, map_box: MapBox, moving: bool) -> Result<Self, GpuError> {
        check_limits(device)?;
        let available = device.limits().max_texture_dimension_2d;
        if map_box.columns.max(map_box.rows) > available {
            return Err(GpuError::MapTooLarge { columns: map_box.columns, rows: map_box.rows, available });
        }
        let size = wgpu::Extent3d { width: map_box.columns, height: map_box.rows, depth_or_array_layers: 2 };
        let (layout, pipeline) = create_pipeline(device, moving);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        Ok(Self {
            size,
            depth: Map::new(device, "depth map", DEPTH_FORMAT, size),
            normals: Map::new(device, "normal map", COLOUR_FORMAT, size),
            velocities: moving.then(|| Map::new(device, "velocity map", COLOUR_FORMAT, size)),
            map_box_uniform: create(device, "map_box", &map_box_bytes(&map_box), usage),
            pipeline,
            layout,
        })
    }

    /// Empty maps of the same size and kind, which share the pipeline of these.
    pub fn new_alike(&self, device: &wgpu::Device) -> Self {
        let map = |label, format| Map::new(device, label, format, self.size);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        Self {
            size: self.size,
            depth: map("depth map", DEPTH_FORMAT),
            normals: map("normal map", COLOUR_FORMAT),
            velocities: self.is_moving().then(|| map("velocity map", COLOUR_FORMAT)),
            map_box_uniform: create(device, "map_box", &vec![0; self.map_box_uniform.size() as usize], usage),
            pipeline: self.pipeline.clone(),
            layout: self.layout.clone(),
        }
    }

    /// Records the drawing of all surfaces into a box, each offset along its normals by the thickness beside it [m].
    ///
    /// # Panics
    /// When the box has another size than these maps, or a surface in maps of moving bodies has no velocities.
    pub fn record(
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
    pub fn record_over(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, surfaces: &[(&Surface, f32)]) {
        self.draw(device, encoder, surfaces, false);
    }

    /// Records a copy of maps of the same size, which show the bodies in `map_box`.
    ///
    /// # Panics
    /// When the other maps have another size, or only one of both shows velocities.
    pub fn record_copy(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        other: &BodyMaps,
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
        assert_eq!([map_box.columns, map_box.rows], size, "the box has the size of the maps");
        // A buffer of its own, not a queue write: the caller may record several frames before submitting any.
        let upload = create(device, "map_box upload", &map_box_bytes(&map_box), wgpu::BufferUsages::COPY_SRC);
        encoder.copy_buffer_to_buffer(&upload, 0, &self.map_box_uniform, 0, upload.size());
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
        for side in 0..2 {
            let groups: Vec<_> =
                surfaces.iter().map(|(_, thickness)| self.camera(device, side as u32, *thickness)).collect();
            let normals = self.normals.colour(side, colour_load);
            let velocities = self.velocities.as_ref().and_then(|map| map.colour(side, colour_load));
            let colours: Vec<_> = [normals, velocities].into_iter().filter(Option::is_some).collect();
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("render_maps"),
                color_attachments: &colours,
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &self.depth.sides[side],
                    depth_ops: Some(wgpu::Operations { load: depth_load, store: wgpu::StoreOp::Store }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            for ((surface, _), group) in surfaces.iter().zip(&groups) {
                pass.set_bind_group(0, group, &[]);
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
    pub fn is_moving(&self) -> bool {
        self.velocities.is_some()
    }

    /// The depth map, `Depth32Float`, two layers; 0 at the camera's plane, 1 at the other camera's plane or where nothing is seen.
    pub fn depth(&self) -> &wgpu::Texture {
        &self.depth.texture
    }

    /// The normal map, `Rgba32Float`, two layers; xyz is the unit normal facing the camera.
    pub fn normals(&self) -> &wgpu::Texture {
        &self.normals.texture
    }

    /// The velocity map, `Rgba32Float`, two layers; xyz is the velocity [m/s]. `None` for bodies at rest.
    pub fn velocities(&self) -> Option<&wgpu::Texture> {
        self.velocities.as_ref().map(|map| &map.texture)
    }

    /// Bytes of the textures and of what the kernels know of their box.
    pub fn bytes(&self) -> u64 {
        bytes_of(self.size.width, self.size.height, self.is_moving())
    }

    /// Bytes that maps over a box have. It needs no device.
    pub fn bytes_over(map_box: &MapBox, moving: bool) -> u64 {
        bytes_of(map_box.columns, map_box.rows, moving)
    }

    /// The resource that the kernels know by this name, if it is one of the maps.
    pub(crate) fn resource(&self, name: &str) -> Option<wgpu::BindingResource<'_>> {
        match name {
            "map_box" => Some(self.map_box_uniform.as_entire_binding()),
            "depth_map" => Some(wgpu::BindingResource::TextureView(&self.depth.layers)),
            "normal_map" => Some(wgpu::BindingResource::TextureView(&self.normals.layers)),
            "velocity_map" => self.velocities.as_ref().map(|map| wgpu::BindingResource::TextureView(&map.layers)),
            _ => None,
        }
    }

    fn camera(&self, device: &wgpu::Device, side: u32, thickness: f32) -> wgpu::BindGroup {
        let camera = uniform_bytes(&structs::Side { side, thickness });
        let camera = create(device, "camera", &camera, wgpu::BufferUsages::UNIFORM);
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("render_maps"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: self.map_box_uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: camera.as_entire_binding() },
            ],
        })
    }
}

fn bytes_of(columns: u32, rows: u32, moving: bool) -> u64 {
    let texels = 2 * u64::from(columns) * u64::from(rows);
    let colours = if moving { 2 } else { 1 };
    texels * (4 + 16 * colours) + <structs::MapBox as encase::ShaderType>::min_size().get()
}

fn map_box_bytes(map_box: &MapBox) -> Vec<u8> {
    uniform_bytes(&structs::MapBox {
        origin_x: map_box.origin_x,
        origin_y: map_box.origin_y,
        texel: map_box.texel,
        z_front: map_box.z_front,
        z_back: map_box.z_back,
        columns: map_box.columns,
        rows: map_box.rows,
    })
}

fn create_pipeline(device: &wgpu::Device, moving: bool) -> (wgpu::BindGroupLayout, wgpu::RenderPipeline) {
    let label = Some("render_maps");
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
        source: wgpu::ShaderSource::Wgsl(render_maps_source().into()),
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
        cache: None,
    });
    (layout, pipeline)
}
