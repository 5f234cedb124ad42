//! The maps of a body by casting a ray through every texel's centre. W §4.1 to §4.3.

use super::side_maps::SideMaps;
use glam::{DVec2, Vec3, dvec2};
use std::ops::RangeInclusive;
use toile_model::{MapBox, SideBox};
use toile_scene::Mesh;

/// A mesh that the maps show.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// Distance [m] by which every vertex is moved out along its normal.
    pub thickness: f32,
    /// Velocities of its vertices [m/s], shape [vertex_count]; `None` at rest.
    pub velocities: Option<&'a [Vec3]>,
    /// Whether it is open by what it is, as a garment: it bounds no body.
    pub open: bool,
}

/// Renders the maps of all surfaces together with texels of the edge length `texel` [m]. W §4.1 and §4.2.
///
/// A texel shows a triangle when its centre lies inside or on the border of it, seen along z; of several the one nearest to
/// the camera. Both sides of a triangle are seen, so that holes and turned triangles do not open the body.
///
/// # Panics
/// When no surface has a vertex.
pub fn render_sides(surfaces: &[Surface], texel: f32) -> SideMaps {
    render_sides_in(surfaces, box_around(surfaces, texel))
}

/// The box around surfaces that are moved out by their thickness.
pub(crate) fn box_around(surfaces: &[Surface], texel: f32) -> MapBox {
    let offset: Vec<Vec<Vec3>> = surfaces.iter().map(offset_positions).collect();
    MapBox::around(bounds(&offset), texel)
}

/// Renders the maps of all surfaces into a box. They have velocities when a surface has.
pub fn render_sides_in(surfaces: &[Surface], map_box: MapBox) -> SideMaps {
    let map_box = SideBox::of(&map_box);
    let count = map_box.columns as usize * map_box.rows as usize;
    let moving = surfaces.iter().any(|surface| surface.velocities.is_some());
    let mut maps = SideMaps {
        map_box,
        depth: [vec![1.0; count], vec![1.0; count]],
        normals: [vec![Vec3::ZERO; count], vec![Vec3::ZERO; count]],
        velocities: moving.then(|| [vec![Vec3::ZERO; count], vec![Vec3::ZERO; count]]),
    };
    for surface in surfaces {
        let positions = offset_positions(surface);
        for triangle in &surface.mesh.triangles {
            let corners = triangle.map(|i| positions[i as usize]);
            let normals = triangle.map(|i| surface.mesh.normals[i as usize]);
            let velocities = triangle.map(|i| surface.velocities.map_or(Vec3::ZERO, |all| all[i as usize]));
            draw(&mut maps, corners, normals, velocities);
        }
    }
    maps
}

fn offset_positions(surface: &Surface) -> Vec<Vec3> {
    let mesh = surface.mesh;
    mesh.positions.iter().zip(&mesh.normals).map(|(p, n)| *p + *n * surface.thickness).collect()
}

fn bounds(surfaces: &[Vec<Vec3>]) -> [Vec3; 2] {
    surfaces
        .iter()
        .flatten()
        .map(|p| [*p, *p])
        .reduce(|[low, high], [p, _]| [low.min(p), high.max(p)])
        .expect("maps need a surface with a vertex")
}

/// Draws one triangle into both layers.
fn draw(maps: &mut SideMaps, corners: [Vec3; 3], normals: [Vec3; 3], velocities: [Vec3; 3]) {
    let map_box = maps.map_box;
    let [a, b, c] = corners.map(|corner| texel_position(&map_box, corner));
    let area = (b - a).perp_dot(c - a);
    if !(area.abs() > 0.0) {
        return;
    }
    let low = a.min(b).min(c);
    let high = a.max(b).max(c);
    for row in centres(low.y, high.y, map_box.rows) {
        for column in centres(low.x, high.x, map_box.columns) {
            let centre = dvec2(f64::from(column), f64::from(row));
            let shares = [
                (c - b).perp_dot(centre - b) / area,
                (a - c).perp_dot(centre - c) / area,
                (b - a).perp_dot(centre - a) / area,
            ];
            if shares.iter().all(|share| *share >= 0.0) {
                let texel = row as usize * map_box.columns as usize + column as usize;
                plot(maps, texel, shares.map(|share| share as f32), corners.map(|p| p.z), normals, velocities);
            }
        }
    }
}

/// Position in the maps where texel centres are the whole numbers: x is the column, y the row. In f64, so that two triangles
/// with a common edge leave no centre between them.
fn texel_position(map_box: &SideBox, position: Vec3) -> DVec2 {
    dvec2(
        (f64::from(position.x) - f64::from(map_box.origin_x)) / f64::from(map_box.texel) - 0.5,
        (f64::from(map_box.origin_y) - f64::from(position.y)) / f64::from(map_box.texel) - 0.5,
    )
}

/// The whole numbers from `low` to `high` that are below `count`.
fn centres(low: f64, high: f64, count: u32) -> RangeInclusive<u32> {
    // A float that is negative becomes 0 here, so the empty range of a triangle left of the maps must be spelt out.
    if high < 0.0 {
        return RangeInclusive::new(1, 0);
    }
    low.ceil().max(0.0) as u32..=(high.floor() as u32).min(count - 1)
}

/// Writes a point of the surface into each layer where it is nearer to the camera than what is there.
fn plot(
    maps: &mut SideMaps,
    texel: usize,
    shares: [f32; 3],
    heights: [f32; 3],
    normals: [Vec3; 3],
    velocities: [Vec3; 3],
) {
    let [s, t, u] = shares;
    let range = maps.map_box.z_front - maps.map_box.z_back;
    let z = heights[0] * s + heights[1] * t + heights[2] * u;
    let normal = normals[0] * s + normals[1] * t + normals[2] * u;
    let depth = [(maps.map_box.z_front - z) / range, (z - maps.map_box.z_back) / range];
    for (layer, towards_camera) in [1.0, -1.0].into_iter().enumerate() {
        if depth[layer] < maps.depth[layer][texel] {
            maps.depth[layer][texel] = depth[layer];
            maps.normals[layer][texel] = facing(normal, towards_camera);
            if let Some(layers) = &mut maps.velocities {
                layers[layer][texel] = velocities[0] * s + velocities[1] * t + velocities[2] * u;
            }
        }
    }
}

/// A unit normal that faces the camera at z = ±∞: one that looks away is reflected.
fn facing(normal: Vec3, towards_camera: f32) -> Vec3 {
    let faced = Vec3::new(normal.x, normal.y, normal.z.abs() * towards_camera);
    let length = faced.length();
    if length > 0.0 { faced / length } else { Vec3::Z * towards_camera }
}
