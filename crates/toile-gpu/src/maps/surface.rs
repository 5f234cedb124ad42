//! A triangle mesh on the device, as the maps draw it.

use toile_scene::Mesh;
use wgpu::util::DeviceExt;

/// Texels of the longest edge of a triangle that one invocation draws alone.
const PART_TEXELS: f32 = 8.0;

/// A triangle mesh on the device, as the maps draw it: a body, or a garment that lies under another one.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Surface {
    /// Positions [m], vec4 each, xyz used; usage `VERTEX | STORAGE`.
    pub positions: wgpu::Buffer,
    /// Unit normals, vec4 each, xyz used; usage `VERTEX | STORAGE`.
    pub normals: wgpu::Buffer,
    /// Velocities [m/s], vec4 each, xyz used; usage `VERTEX | STORAGE`. Maps of moving bodies need them of every surface.
    pub velocities: Option<wgpu::Buffer>,
    /// Vertex indices (u32), three per triangle; usage `INDEX | STORAGE`.
    pub indices: wgpu::Buffer,
    /// Number of indices.
    pub index_count: u32,
    /// Parts of the triangles, each drawn by itself.
    pub parts: wgpu::Buffer,
    /// Whether it is open by what it is, as a garment: it bounds no body.
    pub open: bool,
}

impl Surface {
    /// Uploads a mesh at rest, for texels of the edge length `texel` [m].
    pub fn new(device: &wgpu::Device, mesh: &Mesh, texel: f32) -> Self {
        let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE;
        let vertices =
            |label, values: &[glam::Vec3]| create(device, label, bytemuck::cast_slice(&padded(values)), usage);
        Self {
            positions: vertices("surface positions", &mesh.positions),
            normals: vertices("surface normals", &mesh.normals),
            velocities: None,
            indices: Self::indices(device, mesh),
            index_count: 3 * mesh.triangles.len() as u32,
            parts: Self::triangle_parts(device, mesh, texel),
            open: false,
        }
    }

    /// The same mesh as one of maps of moving bodies sees it: with velocities, which are zero.
    pub fn at_rest(device: &wgpu::Device, mesh: &Mesh, texel: f32) -> Self {
        let zeros = vec![0; 16 * mesh.positions.len()];
        let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE;
        let velocities = create(device, "surface velocities", &zeros, usage);
        Self { velocities: Some(velocities), ..Self::new(device, mesh, texel) }
    }

    /// A garment that is on the device already, at rest: vertices and indices as the fields say, and no triangle much larger than a texel.
    pub fn of_cloth(
        device: &wgpu::Device,
        [positions, normals, indices]: [&wgpu::Buffer; 3],
        index_count: u32,
    ) -> Self {
        let parts: Vec<[u32; 2]> = (0..index_count / 3).map(|index| [index, 1 << 16]).collect();
        Self {
            positions: positions.clone(),
            normals: normals.clone(),
            velocities: None,
            indices: indices.clone(),
            index_count,
            parts: Self::parts_of(device, &parts),
            open: true,
        }
    }

    pub(crate) fn indices(device: &wgpu::Device, mesh: &Mesh) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::STORAGE;
        create(device, "surface indices", bytemuck::cast_slice(&mesh.triangles), usage)
    }

    /// Parts of the triangles of a mesh: of those much larger than a texel several, which take turns at its rows.
    pub(crate) fn triangle_parts(device: &wgpu::Device, mesh: &Mesh, texel: f32) -> wgpu::Buffer {
        let part_count = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
            let texels = a.distance(b).max(b.distance(c)).max(c.distance(a)) / texel;
            // Each part has a few rows of a small triangle, and one of a large one.
            (texels * texels / (PART_TEXELS * PART_TEXELS)).min(texels).clamp(1.0, 4096.0) as u32
        };
        let parts = (0..).zip(&mesh.triangles).flat_map(|(index, triangle)| {
            let count = part_count(triangle);
            (0..count).map(move |part| [index, part | (count << 16)])
        });
        Self::parts_of(device, &parts.collect::<Vec<[u32; 2]>>())
    }

    fn parts_of(device: &wgpu::Device, parts: &[[u32; 2]]) -> wgpu::Buffer {
        create(device, "triangle parts", bytemuck::cast_slice(parts), wgpu::BufferUsages::STORAGE)
    }
}

/// Vectors as the device holds them: four words each.
pub(crate) fn padded(values: &[glam::Vec3]) -> Vec<glam::Vec4> {
    values.iter().map(|v| v.extend(0.0)).collect()
}

pub(crate) fn create(device: &wgpu::Device, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
}
