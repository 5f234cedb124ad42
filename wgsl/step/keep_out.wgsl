// After the guard: no particle goes deeper into a body than the thickness of the cloth.
#import shared/item
#import shared/step_params
#import struct/Probe
#import shared/particles reads positions writes velocities

@group(0) var<storage, read> probes: array<Probe>;

@compute @workgroup_size(64)
fn keep_out(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let probe = probes[i];
    if !(probe.hit > 0.0 && inverse_mass_of(i) > 0.0) {
        return;
    }
    let velocity = velocity_of(i);
    let approach = dot(velocity - probe.velocity, probe.normal);
    let wanted = min(-(probe.distance + step.thickness) / step.dt, 0.0);
    if approach < wanted {
        set_velocity(i, velocity + probe.normal * (wanted - approach));
    }
}
