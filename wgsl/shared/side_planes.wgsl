// What a point sees of the surfaces in the maps. A point is inside when it lies between the front and the back of its texel; the
// nearer side answers, as the plane through the texel's centre. The planes of the four texels around the point are blended
// bilinearly, so that the surface has no steps. The whole way of the coming move is tested: a point that starts in front of a
// surface is answered by that side, however deep the surface has gone over it. D §5.3, W §4.4.
//
// The maps show the surfaces at one time, and the surfaces move straight on: at `lag` seconds before that time a surface stood
// back by its velocity. Whoever imports this says how: `surface_velocity`, `drift` and the two lags of a step.
#import shared/point
#import struct/SideBox

@group(0) var<uniform> side_box: SideBox;
@group(0) var side_depths: texture_depth_2d_array;
@group(0) var side_normals: texture_2d_array<f32>;

const FRONT: i32 = 0;
const BACK: i32 = 1;
const INSIDE: i32 = 2;
const BESIDE: i32 = 3;
// How far in front of a surface its texels still answer, in texels: on a slope the plane through a texel's centre reaches
// out of the depth range of the texel.
const REACH: f32 = 4.0;
// How much deeper than the least deep of four texels another may be and still belong to the same surface, in texels.
const SAME_SURFACE: f32 = 2.0;
// Most places on the way of a point that are tested. Up to so many texels per step none is left out.
const WAY_PLACES: f32 = 16.0;

// Front and back of the surfaces at one texel.
struct Column {
    front: f32,     // [m]
    back: f32,      // [m]
    seen: bool,
}

// Place in the maps, in texels from their left and upper border.
fn texels_of(place: vec3<f32>) -> vec2<f32> {
    return vec2<f32>(
        (place.x - side_box.origin_x) / side_box.texel,
        (side_box.origin_y - place.y) / side_box.texel,
    );
}

fn column_at(texel: vec2<i32>) -> Column {
    let depth_front = textureLoad(side_depths, texel, FRONT, 0);
    let depth_back = textureLoad(side_depths, texel, BACK, 0);
    let range = side_box.z_front - side_box.z_back;
    let front = side_box.z_front - depth_front * range;
    let back = side_box.z_back + depth_back * range;
    return Column(front, back, depth_front < 1.0 && depth_back < 1.0);
}

// The texel that holds a place, and nothing seen where that is outside of the maps.
fn column_under(texels: vec2<f32>) -> Column {
    let column = floor(texels.x);
    let row = floor(texels.y);
    if !(column >= 0.0 && column < f32(side_box.columns) && row >= 0.0 && row < f32(side_box.rows)) {
        return Column();
    }
    return column_at(vec2<i32>(i32(column), i32(row)));
}

// Where a place stands to the surfaces.
fn standing(texels: vec2<f32>, z: f32) -> i32 {
    let column = column_under(texels);
    if !column.seen {
        return BESIDE;
    }
    if z > column.front {
        return FRONT;
    }
    if z < column.back {
        return BACK;
    }
    return INSIDE;
}

// Where the way of a point enters a surface, and from which side; its end and INSIDE when it does not.
struct Entry {
    texels: vec2<f32>,
    z: f32,
    side: i32,
}

// `way` leads from start to end; drivers shorten (start + way) - start, so it comes from the caller.
fn entry_of(start: vec3<f32>, way: vec3<f32>, end: vec3<f32>) -> Entry {
    let start_texels = texels_of(start);
    let end_texels = texels_of(end);
    let unanswered = Entry(end_texels, end.z, INSIDE);
    if step.swept == 0u {
        return unanswered;
    }
    var before = standing(start_texels, start.z);
    if before == INSIDE {
        // It may lie on the surface: it must not leave by the other side.
        let column = column_under(start_texels);
        let after = standing(end_texels, end.z);
        let near_front = column.front - start.z <= start.z - column.back;
        if near_front && after == BACK {
            return Entry(start_texels, start.z, FRONT);
        }
        if !near_front && after == FRONT {
            return Entry(start_texels, start.z, BACK);
        }
        return unanswered;
    }
    let places = clamp(ceil(length(way.xy) / side_box.texel), 1.0, WAY_PLACES);
    for (var k = 1.0; k <= places; k += 1.0) {
        var texels = end_texels;
        var z = end.z;
        if k < places {
            let place = start + way * (k / places);
            // The centre of its texel, in texels: in metres and back it would lie a rounding error beside it, on either side of
            // the border between the four texels that look() blends and the next four.
            texels = floor(texels_of(place)) + 0.5;
            z = place.z;
        }
        let now = standing(texels, z);
        let through = (before == FRONT && now == BACK) || (before == BACK && now == FRONT);
        if now == INSIDE || through {
            if before == BESIDE {
                return Entry(texels, z, INSIDE);
            }
            return Entry(texels, z, before);
        }
        before = now;
    }
    return unanswered;
}

// What one texel says to a point at the start of its move: the plane through the texel's centre on the entered or nearer side.
fn plane_at(point: vec3<f32>, entry: Entry, column: f32, row: f32) -> Probe {
    let texel = vec2<i32>(i32(column), i32(row));
    let seen = column_at(texel);
    if !seen.seen {
        return Probe();
    }
    let reach = REACH * side_box.texel;
    let behind_front = entry.z < seen.front + reach || entry.side == BACK;
    let before_back = entry.z > seen.back - reach || entry.side == FRONT;
    if !(behind_front && before_back) {
        return Probe();
    }
    let x = side_box.origin_x + (column + 0.5) * side_box.texel;
    let y = side_box.origin_y - (row + 0.5) * side_box.texel;
    let normal_front = textureLoad(side_normals, texel, FRONT, 0).xyz;
    let normal_back = textureLoad(side_normals, texel, BACK, 0).xyz;
    let velocity_front = surface_velocity(texel, FRONT);
    let velocity_back = surface_velocity(texel, BACK);
    let distance_front = dot(normal_front, (point + velocity_front * start_lag()) - vec3<f32>(x, y, seen.front));
    let distance_back = dot(normal_back, (point + velocity_back * start_lag()) - vec3<f32>(x, y, seen.back));
    if entry.side == FRONT || (entry.side == INSIDE && distance_front >= distance_back) {
        return Probe(normal_front, distance_front, velocity_front, 1.0);
    }
    return Probe(normal_back, distance_back, velocity_back, 1.0);
}

fn look(point: vec3<f32>, velocity: vec3<f32>) -> Probe {
    let coming = velocity * step.dt;
    let next = point + coming;
    let surface_drift = drift(next, velocity);
    let way = coming + surface_drift * (end_lag() - start_lag());
    let entry = entry_of(point + surface_drift * start_lag(), way, next + surface_drift * end_lag());
    let across = entry.texels.x - 0.5;
    let down = entry.texels.y - 0.5;
    let left = floor(across);
    let top = floor(down);
    if !(left >= 0.0 && left + 1.0 < f32(side_box.columns) && top >= 0.0 && top + 1.0 < f32(side_box.rows)) {
        return Probe();
    }
    let right_share = across - left;
    let bottom_share = down - top;
    let weights = vec4<f32>(
        (1.0 - right_share) * (1.0 - bottom_share),
        right_share * (1.0 - bottom_share),
        (1.0 - right_share) * bottom_share,
        right_share * bottom_share,
    );
    var planes = array<Probe, 4>(
        plane_at(point, entry, left, top),
        plane_at(point, entry, left + 1.0, top),
        plane_at(point, entry, left, top + 1.0),
        plane_at(point, entry, left + 1.0, top + 1.0),
    );
    var nearest = -1e9;
    for (var k = 0u; k < 4u; k++) {
        if planes[k].hit > 0.0 {
            nearest = max(planes[k].distance, nearest);
        }
    }
    var weight_sum = 0.0;
    var normal = vec3<f32>(0.0);
    var distance = 0.0;
    var blended = vec3<f32>(0.0);
    for (var k = 0u; k < 4u; k++) {
        let plane = planes[k];
        if plane.hit > 0.0 && plane.distance >= nearest - SAME_SURFACE * side_box.texel {
            weight_sum = weight_sum + weights[k];
            normal = normal + plane.normal * weights[k];
            distance = distance + plane.distance * weights[k];
            blended = blended + plane.velocity * weights[k];
        }
    }
    let normal_length = length(normal);
    if !(weight_sum > 0.0 && normal_length > 0.0) {
        return Probe();
    }
    return Probe(normal / normal_length, distance / weight_sum, blended / weight_sum, 1.0);
}
