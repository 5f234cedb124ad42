// Positions move last. W eq. 3.
#import shared/item
#import shared/step_params

@group(0) @binding(2) var<storage, read> velocities: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read_write> positions: array<vec4<f32>>;

@compute @workgroup_size(64)
fn move_particles(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let position = positions[i];
    positions[i] = vec4<f32>(position.xyz + velocities[i].xyz * step.dt, position.w);
}
