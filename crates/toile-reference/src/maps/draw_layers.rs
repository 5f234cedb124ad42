//! The layered maps of bodies: each triangle in whole numbers, each column sorted and wound. D §8, W §7.

use super::layer_maps::{Column, LayerMaps, extents, first_column};
use super::render_sides::Surface;
use glam::Vec3;
use toile_model::MapBox;

/// Vertices lie on a lattice of so many points per texel, so that all triangles at an edge agree on whose texel is whose.
const SNAPS: i32 = 64;
/// Farthest vertex from the corner of the box along each axis, on that lattice; a triangle beyond it is left out.
const FARTHEST: f32 = (1 << 18) as f32;
/// Most crossings of a column that are told apart.
const CROSSINGS_MAX: usize = 32;

/// Layered maps, and what did not fit into them.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnLayers {
    /// The maps.
    pub maps: LayerMaps,
    /// Triangles with a vertex too far away or without a place.
    pub dropped_triangles: u32,
    /// Columns with more crossings than can be told apart; they show nothing.
    pub crowded_columns: u32,
}

/// Where a column meets a triangle.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    depth: f32,
    triangle: u32,
    /// The triangle's outside looks down along the axis: above it the body begins.
    begins: bool,
    /// It belongs to a sheet by what it is.
    sheet: bool,
    normal: Vec3,
    velocity: Vec3,
}

/// Draws all surfaces into a box. The maps have velocities when a surface has.
///
/// A column meets a triangle when its centre lies inside of it, seen along the axis, after the vertices have been moved to the nearest point
/// of a lattice; an edge belongs to the triangle on one of its sides. In a column from low to high, a triangle that
/// looks down begins a body and one that looks up ends it, and each end closes the last beginning that is still open: where none is
/// inside of another, these are the ends of the bodies. What has no partner is a sheet, as are all triangles of an open surface.
pub fn draw_layers(surfaces: &[Surface], map_box: MapBox) -> DrawnLayers {
    let moving = surfaces.iter().any(|surface| surface.velocities.is_some());
    let count = map_box.texel_counts().iter().sum::<u64>() as usize;
    let mut crossings: Vec<Vec<Crossing>> = vec![Vec::new(); count];
    let mut dropped_triangles = 0;
    let mut first = 0;
    for surface in surfaces {
        let mesh = surface.mesh;
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            let corners = triangle.map(|i| mesh.positions[i as usize]);
            let snapped = corners.map(|corner| snap(&map_box, corner));
            let [Some(a), Some(b), Some(c)] = snapped else {
                dropped_triangles += 1;
                continue;
            };
            let normals = triangle.map(|i| mesh.normals[i as usize]);
            let velocities = triangle.map(|i| surface.velocities.map_or(Vec3::ZERO, |all| all[i as usize]));
            for axis in 0..3 {
                let depths = corners.map(|corner| corner[axis]);
                cover(&map_box, axis, [a, b, c], |column, shares, begins| {
                    crossings[column].push(Crossing {
                        depth: blend(depths, shares),
                        triangle: first + index as u32,
                        begins,
                        sheet: surface.open,
                        normal: unit(blend(normals, shares), axis, begins),
                        velocity: blend(velocities, shares),
                    });
                });
            }
        }
        first += mesh.triangles.len() as u32;
    }
    let mut maps = LayerMaps {
        map_box,
        columns: Vec::with_capacity(count),
        depths: Vec::new(),
        normals: Vec::new(),
        velocities: moving.then(Vec::new),
    };
    let mut crowded_columns = 0;
    for mut column in crossings {
        if column.len() > CROSSINGS_MAX {
            crowded_columns += 1;
            column.clear();
        }
        column.sort_by(|a, b| a.depth.total_cmp(&b.depth).then(a.triangle.cmp(&b.triangle)));
        let first = maps.depths.len() as u32;
        let [ends, sheets] = wind(&column);
        for crossing in ends.iter().chain(&sheets) {
            maps.depths.push(crossing.depth);
            maps.normals.push(crossing.normal);
            if let Some(velocities) = &mut maps.velocities {
                velocities.push(crossing.velocity);
            }
        }
        let [end_count, sheet_count] = [ends.len() as u32, sheets.len() as u32];
        maps.columns.push(if column.is_empty() { Column::default() } else { Column { first, end_count, sheet_count } });
    }
    DrawnLayers { maps, dropped_triangles, crowded_columns }
}

/// A vertex on the lattice, from the corner of the box; `None` where it is too far away.
fn snap(map_box: &MapBox, position: Vec3) -> Option<[i32; 3]> {
    let scale = SNAPS as f32 / map_box.texel;
    let mut snapped = [0; 3];
    for axis in 0..3 {
        let place = (position[axis] * scale).round_ties_even() - (map_box.low[axis] * SNAPS) as f32;
        if !(place.abs() <= FARTHEST) {
            return None;
        }
        snapped[axis] = place as i32;
    }
    Some(snapped)
}

/// Calls `meet` for each column of the map along `axis` whose centre a triangle covers: with its index, the shares of the corners there, and
/// whether the triangle looks down along the axis.
fn cover(map_box: &MapBox, axis: usize, corners: [[i32; 3]; 3], mut meet: impl FnMut(usize, [f32; 3], bool)) {
    let [across, up] = extents(axis);
    let [a, mut b, mut c] = corners.map(|corner| [corner[across], corner[up]]);
    let turned = cross(a, b, c) < 0;
    if turned {
        std::mem::swap(&mut b, &mut c);
    }
    let area = cross(a, b, c);
    if area == 0 {
        return;
    }
    let texels = |extent: usize, size: u32| {
        let places = [a[extent], b[extent], c[extent]];
        let low = places.iter().min().expect("a triangle has corners");
        let high = places.iter().max().expect("a triangle has corners");
        // A centre lies half a texel from its border.
        let first = (low + SNAPS / 2 - 1).div_euclid(SNAPS).max(0);
        let last = (high - SNAPS / 2).div_euclid(SNAPS).min(size as i32 - 1);
        first..=last
    };
    let [u_count, v_count] = [across, up].map(|extent| map_box.size[extent]);
    for v in texels(1, v_count) {
        for u in texels(0, u_count) {
            let centre = [u * SNAPS + SNAPS / 2, v * SNAPS + SNAPS / 2];
            let opposite = [[b, c], [c, a], [a, b]].map(|[from, to]| (cross(from, to, centre), owns(from, to)));
            if opposite.iter().all(|(side, owned)| *side > 0 || (*side == 0 && *owned)) {
                let [s, mut t, mut w] = opposite.map(|(side, _)| float(side) / float(area));
                if turned {
                    std::mem::swap(&mut t, &mut w);
                }
                let column = first_column(map_box, axis) + (v as u32 * u_count + u as u32) as usize;
                meet(column, [s, t, w], turned);
            }
        }
    }
}

/// Twice the area of the triangle a, b, c; positive when it turns to the left.
fn cross(a: [i32; 2], b: [i32; 2], c: [i32; 2]) -> i64 {
    let [bu, bv, cu, cv] = [b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]].map(i64::from);
    bu * cv - bv * cu
}

/// Whether a centre on an edge belongs to the triangle to the left of it. Of an edge and its reverse one does.
fn owns(from: [i32; 2], to: [i32; 2]) -> bool {
    to[1] < from[1] || (to[1] == from[1] && to[0] < from[0])
}

/// A whole number as a float, from its upper part and its lower ten bits: a device has no larger ones.
fn float(value: i64) -> f32 {
    (value >> 10) as f32 * 1024.0 + (value & 1023) as f32
}

fn blend<T: std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T> + Copy>(corners: [T; 3], shares: [f32; 3]) -> T {
    corners[0] * shares[0] + corners[1] * shares[1] + corners[2] * shares[2]
}

/// A normal of length 1; one without length looks along the axis.
fn unit(normal: Vec3, axis: usize, begins: bool) -> Vec3 {
    let length = normal.length();
    if length > 0.0 { normal / length } else { Vec3::AXES[axis] * if begins { -1.0 } else { 1.0 } }
}

/// The ends of the bodies and the sheets in a sorted column.
fn wind(column: &[Crossing]) -> [Vec<Crossing>; 2] {
    // Which crossings have a partner: an end that closes a beginning before it, and a beginning that is closed by an end after it.
    let mut partnered = vec![false; column.len()];
    let mut open = Vec::new();
    for (index, crossing) in column.iter().enumerate().filter(|(_, crossing)| !crossing.sheet) {
        if crossing.begins {
            open.push(index);
        } else if let Some(begun) = open.pop() {
            partnered[begun] = true;
            partnered[index] = true;
        }
    }
    let (mut ends, mut sheets) = (Vec::new(), Vec::new());
    let mut depth = 0;
    for (crossing, partnered) in column.iter().zip(partnered) {
        if !partnered {
            sheets.push(*crossing);
            continue;
        }
        if crossing.begins {
            depth += 1;
        }
        if depth == 1 {
            ends.push(*crossing);
        }
        if !crossing.begins {
            depth -= 1;
        }
    }
    [ends, sheets]
}
