// What each point sees of bodies at rest in the layered maps. D §8, W §7.
#import shared/layer_planes

const MOVING: bool = false;

fn start_lag() -> f32 {
    return 0.0;
}

fn end_lag() -> f32 {
    return 0.0;
}

fn layer_velocity(at: vec2<u32>) -> vec3<f32> {
    return vec3<f32>(0.0);
}

@compute @workgroup_size(64)
fn sample_layers(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.particle_count + step.quad_count {
        let point = point_at(i);
        probes[i] = look(point.position, point.velocity);
    }
}
