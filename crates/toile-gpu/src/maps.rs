//! The depth and normal maps of the bodies: rendered on the GPU, never leaving it in a run. W §4.

use crate::GpuError;
use crate::buffers::uniform_bytes;
use toile_kernels::{render_maps_source, structs};
use toile_model::MapFrame;
use toile_scene::Mesh;
use wgpu::util::DeviceExt;

const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const NORMAL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// A triangle mesh on the device, as the maps draw it: a body, or a garment that lies under another one.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Positions [m], vec4 each, xyz used; usage `VERTEX`.
    pub positions: wgpu::Buffer,
    /// Unit normals, vec4 each, xyz used; usage `VERTEX`.
    pub normals: wgpu::Buffer,
    /// Vertex indices (u32), three per triangle; usage `INDEX`.
    pub indices: wgpu::Buffer,
    /// Number of indices.
    pub index_count: u32,
}

impl Surface {
    /// Uploads a mesh.
    pub fn new(device: &wgpu::Device, mesh: &Mesh) -> Self {
        let vertices = |label, values: &[glam::Vec3]| {
            let padded: Vec<_> = values.iter().map(|v| v.extend(0.0)).collect();
            create(device, label, bytemuck::cast_slice(&padded), wgpu::BufferUsages::VERTEX)
        };
        Self {
            positions: vertices("surface positions", &mesh.positions),
            normals: vertices("surface normals", &mesh.normals),
            indices: create(
                device,
                "surface indices",
                bytemuck::cast_slice(&mesh.triangles),
                wgpu::BufferUsages::INDEX,
            ),
            index_count: 3 * mesh.triangles.len() as u32,
        }
    }
}

fn create(device: &wgpu::Device, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
}

/// The depth and normal maps of everything that a cloth collides with, front and back.
///
/// Layer 0 is seen from +z, layer 1 from −z; both have the same columns (x) and rows (−y). A texel that sees nothing has depth 1.
#[derive(Debug)]
pub struct BodyMaps {
    frame: MapFrame,
    depth: wgpu::Texture,
    normals: wgpu::Texture,
    depth_view: wgpu::TextureView,
    normal_view: wgpu::TextureView,
    frame_uniform: wgpu::Buffer,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl BodyMaps {
    /// Empty maps over a frame.
    ///
    /// # Errors
    /// [`GpuError::MapTooLarge`] when the frame has more texels on a side than the device's textures.
    pub fn new(device: &wgpu::Device, frame: MapFrame) -> Result<Self, GpuError> {
        let available = device.limits().max_texture_dimension_2d;
        if frame.columns.max(frame.rows) > available {
            return Err(GpuError::MapTooLarge { columns: frame.columns, rows: frame.rows, available });
        }
        let texture = |label, format| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: frame.columns, height: frame.rows, depth_or_array_layers: 2 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                    | wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        };
        let depth = texture("depth map", DEPTH_FORMAT);
        let normals = texture("normal map", NORMAL_FORMAT);
        let all_layers =
            wgpu::TextureViewDescriptor { dimension: Some(wgpu::TextureViewDimension::D2Array), ..Default::default() };
        let uniform = structs::MapFrame {
            origin_x: frame.origin_x,
            origin_y: frame.origin_y,
            texel: frame.texel,
            z_front: frame.z_front,
            z_back: frame.z_back,
            columns: frame.columns,
            rows: frame.rows,
        };
        let (layout, pipeline) = create_pipeline(device);
        Ok(Self {
            frame,
            depth_view: depth.create_view(&all_layers),
            normal_view: normals.create_view(&all_layers),
            depth,
            normals,
            frame_uniform: create(device, "map_frame", &uniform_bytes(&uniform), wgpu::BufferUsages::UNIFORM),
            pipeline,
            layout,
        })
    }

    /// Records the drawing of all surfaces, each offset along its normals by the thickness beside it [m].
    pub fn record(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, surfaces: &[(&Surface, f32)]) {
        for side in 0..2 {
            let groups: Vec<_> = surfaces.iter().map(|(_, thickness)| self.camera(device, side, *thickness)).collect();
            let layer = |texture: &wgpu::Texture| {
                texture.create_view(&wgpu::TextureViewDescriptor {
                    dimension: Some(wgpu::TextureViewDimension::D2),
                    base_array_layer: side,
                    array_layer_count: Some(1),
                    ..Default::default()
                })
            };
            let (depth, normals) = (layer(&self.depth), layer(&self.normals));
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("render_maps"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &normals,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &depth,
                    depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            for ((surface, _), group) in surfaces.iter().zip(&groups) {
                pass.set_bind_group(0, group, &[]);
                pass.set_vertex_buffer(0, surface.positions.slice(..));
                pass.set_vertex_buffer(1, surface.normals.slice(..));
                pass.set_index_buffer(surface.indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..surface.index_count, 0, 0..1);
            }
        }
    }

    /// Where the maps stand.
    pub fn frame(&self) -> MapFrame {
        self.frame
    }

    /// The depth map, `Depth32Float`, two layers; 0 at the camera's plane, 1 at the other camera's plane or where nothing is seen.
    pub fn depth(&self) -> &wgpu::Texture {
        &self.depth
    }

    /// The normal map, `Rgba32Float`, two layers; xyz is the unit normal facing the camera.
    pub fn normals(&self) -> &wgpu::Texture {
        &self.normals
    }

    /// Bytes of the textures and of what the kernels know of their frame.
    pub fn bytes(&self) -> u64 {
        Self::bytes_over(&self.frame)
    }

    /// Bytes that maps over a frame have. It needs no device.
    pub fn bytes_over(frame: &MapFrame) -> u64 {
        let texels = 2 * u64::from(frame.columns) * u64::from(frame.rows);
        texels * (4 + 16) + <structs::MapFrame as encase::ShaderType>::min_size().get()
    }

    /// The resource that the kernels know by this name, if it is one of the maps.
    pub(crate) fn resource(&self, name: &str) -> Option<wgpu::BindingResource<'_>> {
        match name {
            "map_frame" => Some(self.frame_uniform.as_entire_binding()),
            "depth_map" => Some(wgpu::BindingResource::TextureView(&self.depth_view)),
            "normal_map" => Some(wgpu::BindingResource::TextureView(&self.normal_view)),
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
                wgpu::BindGroupEntry { binding: 0, resource: self.frame_uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: camera.as_entire_binding() },
            ],
        })
    }
}

fn create_pipeline(device: &wgpu::Device) -> (wgpu::BindGroupLayout, wgpu::RenderPipeline) {
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
    let attributes = [attribute(0), attribute(1)];
    let buffers = attributes.each_ref().map(|attributes| {
        Some(wgpu::VertexBufferLayout { array_stride: 16, step_mode: wgpu::VertexStepMode::Vertex, attributes })
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label,
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("draw_surface"),
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
            entry_point: Some("write_normal"),
            compilation_options: Default::default(),
            targets: &[Some(NORMAL_FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    (layout, pipeline)
}
