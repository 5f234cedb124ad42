// What each point sees of the bodies in the depth and normal maps. A point is inside when it lies between the front and the
// back of its texel; the nearer side answers, as the plane through the texel's centre. The planes of the four texels around the
// point are blended bilinearly, so that the surface has no steps. D §5.3, W §4.4.
#import shared/point
#import shared/map_frame

@group(0) @binding(6) var<uniform> map_frame: MapFrame;
@group(0) @binding(7) var depth_map: texture_depth_2d_array;
@group(0) @binding(8) var normal_map: texture_2d_array<f32>;

const FRONT: i32 = 0;
const BACK: i32 = 1;
// How far in front of a surface its texels still answer, in texels: on a slope the plane through a texel's centre reaches
// out of the depth range of the texel.
const REACH: f32 = 4.0;
// How much deeper than the least deep of four texels another may be and still belong to the same surface, in texels.
const SAME_SURFACE: f32 = 2.0;

// What one texel says: the plane through its centre on the nearer side.
fn plane_at(point: vec3<f32>, next: vec3<f32>, column: f32, row: f32) -> Probe {
    let texel = vec2<i32>(i32(column), i32(row));
    let depth_front = textureLoad(depth_map, texel, FRONT, 0);
    if !(depth_front < 1.0) {
        return Probe();
    }
    let depth_back = textureLoad(depth_map, texel, BACK, 0);
    if !(depth_back < 1.0) {
        return Probe();
    }
    let range = map_frame.z_front - map_frame.z_back;
    let front = map_frame.z_front - depth_front * range;
    let back = map_frame.z_back + depth_back * range;
    let reach = REACH * map_frame.texel;
    if !(next.z < front + reach && next.z > back - reach) {
        return Probe();
    }
    let x = map_frame.origin_x + (column + 0.5) * map_frame.texel;
    let y = map_frame.origin_y - (row + 0.5) * map_frame.texel;
    let normal_front = textureLoad(normal_map, texel, FRONT, 0).xyz;
    let normal_back = textureLoad(normal_map, texel, BACK, 0).xyz;
    let distance_front = dot(normal_front, point - vec3<f32>(x, y, front));
    let distance_back = dot(normal_back, point - vec3<f32>(x, y, back));
    if distance_front >= distance_back {
        return Probe(normal_front, distance_front, vec3<f32>(0.0), 1.0);
    }
    return Probe(normal_back, distance_back, vec3<f32>(0.0), 1.0);
}

fn look(point: vec3<f32>, velocity: vec3<f32>) -> Probe {
    let next = point + velocity * step.dt;
    let across = (next.x - map_frame.origin_x) / map_frame.texel - 0.5;
    let down = (map_frame.origin_y - next.y) / map_frame.texel - 0.5;
    let left = floor(across);
    let top = floor(down);
    if !(left >= 0.0 && left + 1.0 < f32(map_frame.columns) && top >= 0.0 && top + 1.0 < f32(map_frame.rows)) {
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
        plane_at(point, next, left, top),
        plane_at(point, next, left + 1.0, top),
        plane_at(point, next, left, top + 1.0),
        plane_at(point, next, left + 1.0, top + 1.0),
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
    for (var k = 0u; k < 4u; k++) {
        let plane = planes[k];
        if plane.hit > 0.0 && plane.distance >= nearest - SAME_SURFACE * map_frame.texel {
            weight_sum = weight_sum + weights[k];
            normal = normal + plane.normal * weights[k];
            distance = distance + plane.distance * weights[k];
        }
    }
    let normal_length = length(normal);
    if !(weight_sum > 0.0 && normal_length > 0.0) {
        return Probe();
    }
    return Probe(normal / normal_length, distance / weight_sum, vec3<f32>(0.0), 1.0);
}

@compute @workgroup_size(64)
fn sample_maps(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.particle_count + step.quad_count {
        let point = point_at(i);
        probes[i] = look(point.position, point.velocity);
    }
}
