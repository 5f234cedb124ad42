//! Blocking reads of buffers and maps, for tests and for programs that write files. Never in a frame loop, and not in a
//! browser, where nothing can wait.

use crate::{BodyMaps, GpuError};
use glam::{Vec3, Vec4};

/// Copies a buffer to the CPU and waits for it. The buffer needs usage `COPY_SRC`.
///
/// # Errors
/// [`GpuError::Device`] when the device is lost or does not answer.
pub fn read_buffer(device: &wgpu::Device, queue: &wgpu::Queue, buffer: &wgpu::Buffer) -> Result<Vec<u8>, GpuError> {
    read(device, queue, buffer.size(), |encoder, staging| {
        encoder.copy_buffer_to_buffer(buffer, 0, staging, 0, buffer.size());
    })
}

/// The vec4 values of a buffer, for example positions with inverse masses.
///
/// # Errors
/// As [`read_buffer`].
pub fn read_vec4s(device: &wgpu::Device, queue: &wgpu::Queue, buffer: &wgpu::Buffer) -> Result<Vec<Vec4>, GpuError> {
    Ok(bytemuck::pod_collect_to_vec(&read_buffer(device, queue, buffer)?))
}

/// Both layers of the papers' depth map, front then back, each rows × columns from the top left.
///
/// # Errors
/// As [`read_buffer`].
pub fn read_depth(device: &wgpu::Device, queue: &wgpu::Queue, maps: &BodyMaps) -> Result<[Vec<f32>; 2], GpuError> {
    let texels: Vec<f32> = read_texture(device, queue, maps.depths(), 4, wgpu::TextureAspect::DepthOnly)?;
    Ok(split(texels))
}

/// Both layers of the papers' normal map, front then back, each rows × columns from the top left.
///
/// # Errors
/// As [`read_buffer`].
pub fn read_normals(device: &wgpu::Device, queue: &wgpu::Queue, maps: &BodyMaps) -> Result<[Vec<Vec3>; 2], GpuError> {
    let texels: Vec<Vec4> = read_texture(device, queue, maps.normals(), 16, wgpu::TextureAspect::All)?;
    Ok(split(texels.into_iter().map(Vec4::truncate).collect()))
}

/// Both layers of the papers' velocity map, front then back, each rows × columns from the top left; `None` for bodies at rest.
///
/// # Errors
/// As [`read_buffer`].
pub fn read_velocities(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    maps: &BodyMaps,
) -> Result<Option<[Vec<Vec3>; 2]>, GpuError> {
    let Some(texture) = maps.velocities() else { return Ok(None) };
    let texels: Vec<Vec4> = read_texture(device, queue, texture, 16, wgpu::TextureAspect::All)?;
    Ok(Some(split(texels.into_iter().map(Vec4::truncate).collect())))
}

/// The columns of layered maps, each with the place of its first layer and its numbers of ends and of sheets.
///
/// # Errors
/// As [`read_buffer`].
///
/// # Panics
/// When the maps have none.
pub fn read_columns(device: &wgpu::Device, queue: &wgpu::Queue, maps: &BodyMaps) -> Result<Vec<[u32; 3]>, GpuError> {
    let texture = maps.columns().expect("layered maps have columns");
    let texels: Vec<[u32; 2]> = read_texture(device, queue, texture, 8, wgpu::TextureAspect::All)?;
    let count: u64 = maps.space().map_box.texel_counts().iter().sum();
    Ok(texels[..count as usize].iter().map(|[first, counts]| [*first, counts & 0xffff, counts >> 16]).collect())
}

/// A layer of layered maps.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ReadLayer {
    /// Place along the axis [m].
    pub depth: f32,
    /// Unit normal out of the body.
    pub normal: Vec3,
    /// Velocity [m/s]; zero in maps of bodies at rest.
    pub velocity: Vec3,
}

/// As many layers of layered maps as their columns have.
///
/// # Errors
/// As [`read_buffer`].
pub fn read_layers(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    maps: &BodyMaps,
    columns: &[[u32; 3]],
) -> Result<Vec<ReadLayer>, GpuError> {
    let count = columns.iter().map(|[first, ends, sheets]| first + ends + sheets).max().unwrap_or(0);
    let depths: Vec<[u32; 2]> = read_texture(device, queue, maps.depths(), 8, wgpu::TextureAspect::All)?;
    let normals: Vec<Vec4> = read_texture(device, queue, maps.normals(), 16, wgpu::TextureAspect::All)?;
    let velocities: Option<Vec<Vec4>> = match maps.velocities() {
        Some(texture) => Some(read_texture(device, queue, texture, 16, wgpu::TextureAspect::All)?),
        None => None,
    };
    let layer = |[depth, place]: &[u32; 2]| ReadLayer {
        depth: f32::from_bits(*depth),
        normal: normals[*place as usize].truncate(),
        velocity: velocities.as_ref().map_or(Vec3::ZERO, |all| all[*place as usize].truncate()),
    };
    Ok(depths[..count as usize].iter().map(layer).collect())
}

fn split<T>(mut layers: Vec<T>) -> [Vec<T>; 2] {
    let back = layers.split_off(layers.len() / 2);
    [layers, back]
}

fn read_texture<T: bytemuck::Pod>(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
    texel_bytes: u32,
    aspect: wgpu::TextureAspect,
) -> Result<Vec<T>, GpuError> {
    let size = texture.size();
    let row_bytes = size.width * texel_bytes;
    let padded_row_bytes = row_bytes.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let rows = u64::from(size.height) * u64::from(size.depth_or_array_layers);
    let bytes = read(device, queue, rows * u64::from(padded_row_bytes), |encoder, staging| {
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo { texture, mip_level: 0, origin: wgpu::Origin3d::ZERO, aspect },
            wgpu::TexelCopyBufferInfo {
                buffer: staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded_row_bytes),
                    rows_per_image: Some(size.height),
                },
            },
            size,
        );
    })?;
    let rows = bytes.chunks_exact(padded_row_bytes as usize).flat_map(|row| &row[..row_bytes as usize]);
    Ok(bytemuck::pod_collect_to_vec(&rows.copied().collect::<Vec<u8>>()))
}

fn read(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    size: u64,
    record: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer),
) -> Result<Vec<u8>, GpuError> {
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("readback"),
        size,
        usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("readback") });
    record(&mut encoder, &staging);
    let (sender, receiver) = std::sync::mpsc::channel();
    encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., move |result| {
        // The receiver waits below; it is gone only when waiting itself failed.
        let _ = sender.send(result);
    });
    let submission_index = Some(queue.submit([encoder.finish()]));
    let failed = |error: &dyn std::fmt::Display| GpuError::Device(error.to_string());
    // For this alone: others may have submitted more since.
    device.poll(wgpu::PollType::Wait { submission_index, timeout: None }).map_err(|e| failed(&e))?;
    receiver.recv().map_err(|e| failed(&e))?.map_err(|e| failed(&e))?;
    let view = staging.get_mapped_range(..).map_err(|e| failed(&e))?;
    Ok(view.to_vec())
}
