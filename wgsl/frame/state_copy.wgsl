// The unit of cost: position and velocity of every particle read and written once.
#import shared/item
#import shared/step_params

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> velocities: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> position_copies: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> velocity_copies: array<vec4<f32>>;

@compute @workgroup_size(64)
fn state_copy(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.particle_count {
        position_copies[i] = positions[i];
        velocity_copies[i] = velocities[i];
    }
}
