// The cloth follows its coarse particles: in the coming move each particle goes as much farther as those that lead it were shifted.
#import shared/item
#import shared/step_params
#import shared/leaders
#import shared/coarse reads shifts
#import shared/particles writes velocities

@compute @workgroup_size(64)
fn lead_particles(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    set_velocity(i, velocity_of(i) + led_by(i) / step.dt);
}
