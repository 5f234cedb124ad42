// What each point sees of moving bodies in the layered maps, which show them at the end of the recorded steps: in the steps before,
// every surface stands back by its velocity, so that no step sees it jump. D §8, W §4.3 and §7.
#import shared/layer_planes
#import struct/Lag

@group(0) var<uniform> lag: Lag;
@group(0) var layer_velocities: texture_2d<f32>;

const MOVING: bool = true;

fn start_lag() -> f32 {
    return lag.start;
}

fn end_lag() -> f32 {
    return lag.end;
}

fn layer_velocity(at: vec2<u32>) -> vec3<f32> {
    return textureLoad(layer_velocities, at, 0).xyz;
}

@compute @workgroup_size(64)
fn sample_moving_layers(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.particle_count + step.quad_count {
        let point = point_at(i);
        probes[i] = look(point.position, point.velocity);
    }
}
