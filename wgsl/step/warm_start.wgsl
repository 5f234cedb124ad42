// Each particle begins a step with half of what limits gave it in the last one: tension that lasts need not be found anew.
#import shared/item
#import shared/step_params
#import shared/particles writes velocities

// [m/s]
@group(0) var<storage, read_write> pulls: array<vec4<f32>>;

// The largest part that cannot swing up, however slowly sweeps converge.
const CARRIED: f32 = 0.5;

@compute @workgroup_size(64)
fn warm_start(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let pull = pulls[i].xyz * CARRIED;
    pulls[i] = vec4<f32>(pull, 0.0);
    set_velocity(i, velocity_of(i) + pull);
}
