// What each point sees of the bodies in the depth and normal maps. A point is inside when it lies between the front and
// the back depth of its texel; the nearer surface answers, as the plane through its texel's centre. D §5.3, W §4.4.
#import shared/point
#import shared/map_frame

@group(0) @binding(6) var<uniform> map_frame: MapFrame;
@group(0) @binding(7) var depth_map: texture_depth_2d_array;
@group(0) @binding(8) var normal_map: texture_2d_array<f32>;

const FRONT: i32 = 0;
const BACK: i32 = 1;

fn look(point: Midpoint) -> Probe {
    let next = point.position + point.velocity * step.dt;
    let column = floor((next.x - map_frame.origin_x) / map_frame.texel);
    let row = floor((map_frame.origin_y - next.y) / map_frame.texel);
    if !(column >= 0.0 && column < f32(map_frame.columns) && row >= 0.0 && row < f32(map_frame.rows)) {
        return Probe();
    }
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
    if !(next.z < front + step.contact_margin && next.z > back - step.contact_margin) {
        return Probe();
    }
    let centre = vec2<f32>(
        map_frame.origin_x + (column + 0.5) * map_frame.texel,
        map_frame.origin_y - (row + 0.5) * map_frame.texel,
    );
    let normal_front = textureLoad(normal_map, texel, FRONT, 0).xyz;
    let normal_back = textureLoad(normal_map, texel, BACK, 0).xyz;
    let distance_front = dot(normal_front, point.position - vec3<f32>(centre, front));
    let distance_back = dot(normal_back, point.position - vec3<f32>(centre, back));
    if distance_front >= distance_back {
        return Probe(normal_front, distance_front, vec3<f32>(0.0), 1.0);
    }
    return Probe(normal_back, distance_back, vec3<f32>(0.0), 1.0);
}

@compute @workgroup_size(64)
fn sample_maps(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.particle_count + step.quad_count {
        probes[i] = look(point_at(i));
    }
}
