//! The layered maps: along each axis all that a texel's column meets, drawn and sorted by compute passes. D §8, W §7.

use super::surface::{Surface, create};
use super::{MapSpace, MapsFault};
use crate::contents::{Encode, uniform};
use crate::slot::Slot;
use crate::{GpuError, Kernels, Pass, Program};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};
use toile_kernels::{Kernel, structs};
use toile_model::MapBox;

/// Items in a row of a texture that holds a list.
const PACKED_WIDTH: u32 = 2048;
/// Bytes of a crossing, of the counts, and where the count of the layers lies in them.
const CROSSING_BYTES: u64 = 16;
const COUNTS_BYTES: u64 = 16;
const LAYER_COUNT_PLACE: u64 = 4;
/// Most bind groups of surfaces that are kept: those that are drawn at each pose.
const DRAWN_KEPT: usize = 16;

/// The layered maps of everything that a cloth collides with.
#[derive(Debug)]
pub(crate) struct LayerMaps {
    space: MapSpace,
    box_uniform: wgpu::Buffer,
    columns: wgpu::Texture,
    depths: wgpu::Texture,
    normals: wgpu::Texture,
    velocities: Option<wgpu::Texture>,
    lists: wgpu::Buffer,
    crossings: wgpu::Buffer,
    counts: wgpu::Buffer,
    views: Views,
    draw: (Kernel, Program),
    sort: Program,
    sort_group: wgpu::BindGroup,
    /// Surfaces that were drawn, so that the next pose makes nothing anew.
    drawn: Mutex<Vec<DrawnSurface>>,
    /// Triangles that the maps show.
    triangle_count: AtomicU32,
    report: Slot,
    fault: Mutex<Option<MapsFault>>,
}

#[derive(Clone, Debug)]
struct Views {
    columns: wgpu::TextureView,
    depths: wgpu::TextureView,
    normals: wgpu::TextureView,
    velocities: Option<wgpu::TextureView>,
}

/// A surface and where its triangles begin among all.
#[derive(Debug)]
struct DrawnSurface {
    positions: wgpu::Buffer,
    first_triangle: u32,
    group: wgpu::BindGroup,
    part_count: u32,
}

impl LayerMaps {
    /// Empty maps.
    ///
    /// # Errors
    /// [`GpuError::MapTooLarge`] and [`GpuError::BufferTooLarge`] when they do not fit the device.
    pub(crate) fn new(kernels: &Kernels, space: &MapSpace) -> Result<Self, GpuError> {
        let draw = if space.moving { Kernel::DrawMovingLayers } else { Kernel::DrawLayers };
        let sort = kernels.program(Kernel::SortLayers);
        Self::with_programs(kernels.device(), space, (draw, kernels.program(draw)), sort)
    }

    /// Empty maps that are drawn and sorted by other WGSL with the interface of the kernels.
    ///
    /// # Errors
    /// As [`LayerMaps::new`].
    pub(crate) fn of_sources(device: &wgpu::Device, space: &MapSpace, sources: [&str; 2]) -> Result<Self, GpuError> {
        let kernels = [if space.moving { Kernel::DrawMovingLayers } else { Kernel::DrawLayers }, Kernel::SortLayers];
        let [draw, sort] = [0, 1].map(|k| Program::of_source(device, kernels[k], sources[k], &[]));
        Self::with_programs(device, space, (kernels[0], draw), sort)
    }

    fn with_programs(
        device: &wgpu::Device,
        space: &MapSpace,
        draw: (Kernel, Program),
        sort: Program,
    ) -> Result<Self, GpuError> {
        let column_count: u64 = space.map_box.texel_counts().iter().sum();
        let capacity = space.crossing_capacity();
        let rows = |items: u64| items.div_ceil(u64::from(PACKED_WIDTH)).max(1);
        let available = device.limits().max_texture_dimension_2d;
        let most = rows(column_count.max(capacity));
        if most > u64::from(available) {
            return Err(GpuError::MapTooLarge { columns: PACKED_WIDTH, rows: most as u32, available });
        }
        let available = device.limits().max_storage_buffer_binding_size;
        if CROSSING_BYTES * capacity > available {
            let needed = CROSSING_BYTES * capacity;
            return Err(GpuError::BufferTooLarge { name: "crossings".to_owned(), needed, available });
        }
        let texture = |label, format, items| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: PACKED_WIDTH, height: rows(items) as u32, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::STORAGE_BINDING
                    | wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::COPY_DST
                    | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        };
        let buffer = |label, size| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            })
        };
        let [whole, floats] = [wgpu::TextureFormat::Rg32Uint, wgpu::TextureFormat::Rgba32Float];
        let columns = texture("layer columns", whole, column_count);
        let depths = texture("layer depths", whole, capacity);
        let normals = texture("layer normals", floats, capacity);
        let velocities = space.moving.then(|| texture("layer velocities", floats, capacity));
        let view = |texture: &wgpu::Texture| texture.create_view(&Default::default());
        let views = Views {
            columns: view(&columns),
            depths: view(&depths),
            normals: view(&normals),
            velocities: velocities.as_ref().map(view),
        };
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let box_uniform = create(device, "layer_box", &uniform(&space.map_box.encode()), usage);
        let lists = buffer("crossing_lists", 4 * column_count);
        let crossings = buffer("crossings", CROSSING_BYTES * capacity);
        let counts = buffer("layer_counts", COUNTS_BYTES);
        let sort_group = sort.bind(device, |binding| match binding.name.as_str() {
            "layer_box" => box_uniform.as_entire_binding(),
            "crossing_lists" => lists.as_entire_binding(),
            "crossings" => crossings.as_entire_binding(),
            "layer_counts" => counts.as_entire_binding(),
            "drawn_columns" => wgpu::BindingResource::TextureView(&views.columns),
            "drawn_depths" => wgpu::BindingResource::TextureView(&views.depths),
            other => panic!("layered maps have no {other}"),
        });
        Ok(Self {
            space: space.clone(),
            box_uniform,
            columns,
            depths,
            normals,
            velocities,
            lists,
            crossings,
            counts,
            views,
            draw,
            sort,
            sort_group,
            drawn: Mutex::default(),
            triangle_count: AtomicU32::new(0),
            report: Slot::new(device, "layer counts readback", COUNTS_BYTES),
            fault: Mutex::default(),
        })
    }

    /// Records the drawing of all surfaces into a box.
    ///
    /// # Panics
    /// When the box has another size than these maps, or a surface in maps of moving bodies has no velocities.
    pub(crate) fn record<'a>(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        map_box: MapBox,
        surfaces: impl IntoIterator<Item = &'a Surface>,
    ) {
        self.place(device, encoder, map_box);
        encoder.clear_buffer(&self.lists, 0, None);
        encoder.clear_buffer(&self.counts, 0, None);
        self.triangle_count.store(0, Ordering::Relaxed);
        self.draw(device, encoder, surfaces);
    }

    /// Records the drawing of more surfaces over what the maps show already.
    ///
    /// # Panics
    /// When a surface in maps of moving bodies has no velocities.
    pub(crate) fn record_over<'a>(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        surfaces: impl IntoIterator<Item = &'a Surface>,
    ) {
        // Columns get their layers anew; crossings stay.
        encoder.clear_buffer(&self.counts, LAYER_COUNT_PLACE, Some(4));
        self.draw(device, encoder, surfaces);
    }

    /// Records a copy of maps of the same size.
    ///
    /// # Panics
    /// When the other maps have another size, or only one of both shows velocities.
    pub(crate) fn record_copy(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        other: &LayerMaps,
        map_box: MapBox,
    ) {
        assert_eq!(self.space.moving, other.space.moving, "maps with and without velocities");
        self.place(device, encoder, map_box);
        let mut copy = |from: &wgpu::Texture, to: &wgpu::Texture| {
            assert_eq!(from.size(), to.size(), "maps are copied into maps of the same size");
            encoder.copy_texture_to_texture(from.as_image_copy(), to.as_image_copy(), from.size());
        };
        copy(&other.columns, &self.columns);
        copy(&other.depths, &self.depths);
        copy(&other.normals, &self.normals);
        if let (Some(from), Some(to)) = (&other.velocities, &self.velocities) {
            copy(from, to);
        }
        for (from, to) in
            [(&other.lists, &self.lists), (&other.crossings, &self.crossings), (&other.counts, &self.counts)]
        {
            encoder.copy_buffer_to_buffer(from, 0, to, 0, from.size());
        }
        self.triangle_count.store(other.triangle_count.load(Ordering::Relaxed), Ordering::Relaxed);
    }

    fn place(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, map_box: MapBox) {
        assert_eq!(map_box.size, self.space.map_box.size, "the box has the size of the maps");
        // A buffer of its own, not a queue write: the caller may record several frames before submitting any.
        let upload = create(device, "layer_box upload", &uniform(&map_box.encode()), wgpu::BufferUsages::COPY_SRC);
        encoder.copy_buffer_to_buffer(&upload, 0, &self.box_uniform, 0, upload.size());
    }

    fn draw<'a>(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        surfaces: impl IntoIterator<Item = &'a Surface>,
    ) {
        let mut drawn = self.drawn.lock().unwrap_or_else(PoisonError::into_inner);
        let mut compute = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("layered maps"), timestamp_writes: None });
        compute.set_pipeline(self.draw.1.pipeline());
        for surface in surfaces {
            let first_triangle = self.triangle_count.fetch_add(surface.index_count / 3, Ordering::Relaxed);
            let known = drawn
                .iter()
                .position(|known| known.positions == surface.positions && known.first_triangle == first_triangle);
            let place = known.unwrap_or_else(|| {
                if drawn.len() == DRAWN_KEPT {
                    drawn.remove(0);
                }
                drawn.push(self.bind(device, surface, first_triangle));
                drawn.len() - 1
            });
            let [x, y] = Pass::over(self.draw.0, 3 * drawn[place].part_count).workgroups();
            compute.set_bind_group(0, &drawn[place].group, &[]);
            compute.dispatch_workgroups(x, y, 1);
        }
        let column_count: u64 = self.space.map_box.texel_counts().iter().sum();
        let [x, y] = Pass::over(Kernel::SortLayers, column_count as u32).workgroups();
        compute.set_pipeline(self.sort.pipeline());
        compute.set_bind_group(0, &self.sort_group, &[]);
        compute.dispatch_workgroups(x, y, 1);
        drop(compute);
        self.collect();
        if self.report.is_free() {
            self.report.record(encoder, |encoder, target| {
                encoder.copy_buffer_to_buffer(&self.counts, 0, target, 0, COUNTS_BYTES);
            });
        }
    }

    fn bind(&self, device: &wgpu::Device, surface: &Surface, first_triangle: u32) -> DrawnSurface {
        let part_count = (surface.parts.size() / 8) as u32;
        let drawn = structs::Drawn { part_count, first_triangle, is_open: u32::from(surface.open) };
        let drawn = create(device, "drawn", &uniform(&drawn), wgpu::BufferUsages::UNIFORM);
        let group = self.draw.1.bind(device, |binding| match binding.name.as_str() {
            "layer_box" => self.box_uniform.as_entire_binding(),
            "drawn" => drawn.as_entire_binding(),
            "triangle_parts" => surface.parts.as_entire_binding(),
            "surface_indices" => surface.indices.as_entire_binding(),
            "surface_positions" => surface.positions.as_entire_binding(),
            "surface_normals" => surface.normals.as_entire_binding(),
            "surface_velocities" => {
                surface.velocities.as_ref().expect("maps of moving bodies need velocities").as_entire_binding()
            }
            "crossing_lists" => self.lists.as_entire_binding(),
            "crossings" => self.crossings.as_entire_binding(),
            "layer_counts" => self.counts.as_entire_binding(),
            "drawn_normals" => wgpu::BindingResource::TextureView(&self.views.normals),
            "drawn_velocities" => {
                wgpu::BindingResource::TextureView(self.views.velocities.as_ref().expect("maps of moving bodies"))
            }
            other => panic!("layered maps have no {other}"),
        });
        DrawnSurface { positions: surface.positions.clone(), first_triangle, group, part_count }
    }

    /// What did not fit into the maps the last time that they reported, without waiting.
    pub(crate) fn fault(&self) -> Option<MapsFault> {
        self.collect();
        *self.fault.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn collect(&self) {
        let capacity = self.space.crossing_capacity();
        let counts = self.report.take(|bytes| {
            let [crossing_count, _, dropped_triangles, crowded_columns] =
                bytemuck::pod_collect_to_vec::<u8, u32>(bytes).try_into().ok()?;
            let lost_crossings = u64::from(crossing_count).saturating_sub(capacity);
            Some(MapsFault { lost_crossings, dropped_triangles, crowded_columns })
        });
        if let Some(counts) = counts {
            let fault = (counts != MapsFault::default()).then_some(counts);
            *self.fault.lock().unwrap_or_else(PoisonError::into_inner) = fault;
        }
    }

    /// First layer and numbers of ends and of sheets of each column, `Rg32Uint`: the second word is ends | sheets << 16.
    pub(crate) fn columns(&self) -> &wgpu::Texture {
        &self.columns
    }

    /// Depth of each layer as bits, and the place of its normal and velocity, `Rg32Uint`.
    pub(crate) fn depths(&self) -> &wgpu::Texture {
        &self.depths
    }

    /// Normals, `Rgba32Float`.
    pub(crate) fn normals(&self) -> &wgpu::Texture {
        &self.normals
    }

    /// Velocities [m/s], `Rgba32Float`; `None` for bodies at rest.
    pub(crate) fn velocities(&self) -> Option<&wgpu::Texture> {
        self.velocities.as_ref()
    }

    /// The resource that the kernels know by this name, if it is one of the maps.
    pub(crate) fn resource(&self, name: &str) -> Option<wgpu::BindingResource<'_>> {
        match name {
            "layer_box" => Some(self.box_uniform.as_entire_binding()),
            "layer_columns" => Some(wgpu::BindingResource::TextureView(&self.views.columns)),
            "layer_depths" => Some(wgpu::BindingResource::TextureView(&self.views.depths)),
            "layer_normals" => Some(wgpu::BindingResource::TextureView(&self.views.normals)),
            "layer_velocities" => self.views.velocities.as_ref().map(wgpu::BindingResource::TextureView),
            _ => None,
        }
    }

    /// Bytes of maps over a space.
    pub(crate) fn bytes_over(space: &MapSpace) -> u64 {
        let columns: u64 = space.map_box.texel_counts().iter().sum();
        let colours = if space.moving { 2 } else { 1 };
        columns * (8 + 4) + space.crossing_capacity() * (8 + 16 * colours + CROSSING_BYTES) + COUNTS_BYTES
    }
}
