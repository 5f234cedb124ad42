// What each point sees of bodies at rest in the depth and normal maps. D §5.3, W §4.4.
#import shared/side_planes

fn start_lag() -> f32 {
    return 0.0;
}

fn end_lag() -> f32 {
    return 0.0;
}

fn surface_velocity(texel: vec2<i32>, side: i32) -> vec3<f32> {
    return vec3<f32>(0.0);
}

fn drift(next: vec3<f32>, velocity: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(0.0);
}

@compute @workgroup_size(64)
fn sample_sides(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.particle_count + step.quad_count {
        let point = point_at(i);
        probes[i] = look(point.position, point.velocity);
    }
}
