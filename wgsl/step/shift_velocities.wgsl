// The particles are to go where limits have shifted them: that is added to their velocities, and kept for the start of the next step.
#import shared/item
#import shared/step_params
#import shared/nodes reads shifts
#import shared/particles writes velocities

@group(0) var<storage, read_write> pulls: array<vec4<f32>>;

@compute @workgroup_size(64)
fn shift_velocities(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let change = node_shifts[i].xyz / step.dt;
    set_velocity(i, velocity_of(i) + change);
    pulls[i] = vec4<f32>(pulls[i].xyz + change, 0.0);
}
