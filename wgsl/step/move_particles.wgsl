// Positions move last. W eq. 3.
#import shared/item
#import shared/step_params
#import shared/particles reads velocities writes positions

@compute @workgroup_size(64)
fn move_particles(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    set_position(i, position_of(i) + velocity_of(i) * step.dt);
}
