// A triangle into the layered map along an axis, in whole numbers: the vertices move to the nearest point of a lattice, so that all
// triangles at an edge agree on whose centres are whose. D §8, W §7.
#import shared/item
#import shared/layer_box
#import shared/packed
#import shared/crossings
#import struct/Drawn

@group(0) var<uniform> drawn: Drawn;
@group(0) var<storage, read> triangle_parts: array<vec2<u32>>;
@group(0) var<storage, read> surface_indices: array<u32>;
@group(0) var<storage, read> surface_positions: array<vec4<f32>>;
@group(0) var<storage, read> surface_normals: array<vec4<f32>>;
@group(0) var drawn_normals: texture_storage_2d<rgba32float, write>;

// Points of the lattice per texel.
const SNAPS: i32 = 64;
// Farthest vertex from the corner of the box along each axis, on the lattice.
const FARTHEST: f32 = 262144.0;
// A product of two differences takes more than a word: it is a multiple of this and a rest.
const PART: i32 = 1024;

// A whole number: high times PART, and low, from 0 to PART - 1.
struct Wide {
    high: i32,
    low: i32,
}

// Twice the area of the triangle a, b, c; positive when it turns to the left.
fn cross_of(a: vec2<i32>, b: vec2<i32>, c: vec2<i32>) -> Wide {
    let one = b - a;
    let other = c - a;
    // Shifts round down, also below zero.
    let high = other >> vec2<u32>(10u);
    let low = other & vec2<i32>(PART - 1);
    let low_sum = one.x * low.y - one.y * low.x;
    let high_sum = one.x * high.y - one.y * high.x;
    return Wide(high_sum + (low_sum >> 10u), low_sum & (PART - 1));
}

fn is_negative(value: Wide) -> bool {
    return value.high < 0;
}

fn is_zero(value: Wide) -> bool {
    return value.high == 0 && value.low == 0;
}

fn float_of(value: Wide) -> f32 {
    return f32(value.high) * 1024.0 + f32(value.low);
}

// Whether a centre on an edge belongs to the triangle to the left of it. Of an edge and its reverse one does.
fn owns(start: vec2<i32>, end: vec2<i32>) -> bool {
    return end.y < start.y || (end.y == start.y && end.x < start.x);
}

fn covers(value: Wide, start: vec2<i32>, end: vec2<i32>) -> bool {
    return !is_negative(value) && (!is_zero(value) || owns(start, end));
}

// Texels whose centres lie between two points of the lattice, within the map: the first and the last.
fn texels_between(low: i32, high: i32, size: u32) -> vec2<i32> {
    let first = max((low + SNAPS / 2 - 1) >> 6u, 0);
    let last = min((high - SNAPS / 2) >> 6u, i32(size) - 1);
    return vec2<i32>(first, last);
}

fn along(vector: vec3<f32>, axis: u32) -> f32 {
    return select(select(vector.z, vector.y, axis == 1u), vector.x, axis == 0u);
}

fn flattened(corner: vec3<i32>, axis: u32) -> vec2<i32> {
    return select(select(corner.xy, corner.zx, vec2<bool>(axis == 1u)), corner.yz, vec2<bool>(axis == 0u));
}

// Draws a part of the rows of a triangle.
fn draw_part(item: u32) {
    // Neighbours draw along the same axis.
    let axis = item / drawn.part_count;
    let triangle_part = triangle_parts[item % drawn.part_count];
    let triangle = triangle_part.x;
    let part = i32(triangle_part.y & 0xffffu);
    let part_count = i32(triangle_part.y >> 16u);
    let corners = vec3<u32>(
        surface_indices[3u * triangle],
        surface_indices[3u * triangle + 1u],
        surface_indices[3u * triangle + 2u],
    );
    let positions = array<vec3<f32>, 3>(
        surface_positions[corners.x].xyz,
        surface_positions[corners.y].xyz,
        surface_positions[corners.z].xyz,
    );
    var snapped = array<vec3<i32>, 3>();
    var near = true;
    for (var k = 0u; k < 3u; k++) {
        let place = round(positions[k] * (layer_box.texels_per_metre * f32(SNAPS))) - layer_box.low * f32(SNAPS);
        let distance = abs(place);
        // Not all(): what is no number must fail.
        near = near && distance.x <= FARTHEST && distance.y <= FARTHEST && distance.z <= FARTHEST;
        snapped[k] = vec3<i32>(place);
    }
    if !near {
        if axis == 0u && part == 0 {
            atomicAdd(&layer_counts.dropped_triangles, 1u);
        }
        return;
    }
    let a = flattened(snapped[0], axis);
    var b = flattened(snapped[1], axis);
    var c = flattened(snapped[2], axis);
    let turned = is_negative(cross_of(a, b, c));
    if turned {
        let kept = b;
        b = c;
        c = kept;
    }
    let area = cross_of(a, b, c);
    if is_zero(area) {
        return;
    }
    let size = layer_size();
    let across = size[across_of(axis)];
    let columns = texels_between(min(min(a.x, b.x), c.x), max(max(a.x, b.x), c.x), across);
    let rows = texels_between(min(min(a.y, b.y), c.y), max(max(a.y, b.y), c.y), size[up_of(axis)]);
    for (var row = rows.x + part; row <= rows.y; row += part_count) {
        for (var column = columns.x; column <= columns.y; column++) {
            let centre = vec2<i32>(column, row) * SNAPS + SNAPS / 2;
            let at_a = cross_of(b, c, centre);
            let at_b = cross_of(c, a, centre);
            let at_c = cross_of(a, b, centre);
            if covers(at_a, b, c) && covers(at_b, c, a) && covers(at_c, a, b) {
                var shares = vec3<f32>(float_of(at_a), float_of(at_b), float_of(at_c)) / float_of(area);
                if turned {
                    shares = shares.xzy;
                }
                let place = atomicAdd(&layer_counts.crossing_count, 1u);
                if place >= arrayLength(&crossings) {
                    continue;
                }
                var normal = surface_normals[corners.x].xyz * shares.x + surface_normals[corners.y].xyz * shares.y
                    + surface_normals[corners.z].xyz * shares.z;
                let normal_length = length(normal);
                if normal_length > 0.0 {
                    normal = normal / normal_length;
                } else {
                    let towards = select(1.0, -1.0, turned);
                    normal = vec3<f32>(vec3<u32>(0u, 1u, 2u) == vec3<u32>(axis)) * towards;
                }
                textureStore(drawn_normals, packed_at(place), vec4<f32>(normal, 0.0));
                store_velocity(place, corners, shares);
                let depth = along(positions[0], axis) * shares.x + along(positions[1], axis) * shares.y
                    + along(positions[2], axis) * shares.z;
                let list = first_column(axis) + u32(row) * across + u32(column);
                let next = atomicExchange(&crossing_lists[list], place + 1u);
                let kind = select(0u, BEGINS, turned) | select(0u, OPEN, drawn.is_open != 0u);
                crossings[place] = Crossing(depth, drawn.first_triangle + triangle, kind, next);
            }
        }
    }
}
