// What each point sees of moving bodies in the depth, normal and velocity maps, which show them at the end of the recorded
// steps: in the steps before, every surface stands back by its velocity, so that no step sees it jump. W §4.3-4.4.
#import shared/side_planes
#import struct/Lag

@group(0) var<uniform> lag: Lag;
@group(0) var side_velocities: texture_2d_array<f32>;

fn start_lag() -> f32 {
    return lag.start;
}

fn end_lag() -> f32 {
    return lag.end;
}

fn surface_velocity(texel: vec2<i32>, side: i32) -> vec3<f32> {
    return textureLoad(side_velocities, texel, side, 0).xyz;
}

// How the surface near a point moves: where the point lies on it now, it will not lie in the maps.
fn drift(next: vec3<f32>, velocity: vec3<f32>) -> vec3<f32> {
    let texels = texels_of(next);
    let column = column_under(texels);
    if !column.seen {
        // A cloth that is carried along goes the way of its surface.
        return velocity;
    }
    let texel = vec2<i32>(floor(texels));
    if abs(next.z - column.front) <= abs(next.z - column.back) {
        return surface_velocity(texel, FRONT);
    }
    return surface_velocity(texel, BACK);
}

@compute @workgroup_size(64)
fn sample_moving_sides(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.particle_count + step.quad_count {
        let point = point_at(i);
        probes[i] = look(point.position, point.velocity);
    }
}
