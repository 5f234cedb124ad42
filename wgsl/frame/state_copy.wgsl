// The unit of cost: position and velocity of every particle read and written once.
#import shared/item
#import shared/step_params
#import shared/particles reads positions velocities

@group(0) var<storage, read_write> position_copies: array<vec4<f32>>;
@group(0) var<storage, read_write> velocity_copies: array<vec4<f32>>;

@compute @workgroup_size(64)
fn state_copy(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.particle_count {
        position_copies[i] = vec4<f32>(position_of(i), inverse_mass_of(i));
        velocity_copies[i] = vec4<f32>(velocity_of(i), mass_of(i));
    }
}
