// Velocities from forces; positions move last. W eq. 3.
#import shared/item
#import shared/step_params
#import shared/particles reads positions writes velocities

@group(0) var<storage, read> forces: array<vec4<f32>>;

@compute @workgroup_size(64)
fn euler(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let change = forces[i].xyz * (step.dt * inverse_mass_of(i));
    set_velocity(i, velocity_of(i) + change);
}
