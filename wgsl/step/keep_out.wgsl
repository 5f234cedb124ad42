// After the guard: no particle goes deeper into a body than the thickness of the cloth.
#import shared/item
#import shared/step_params
#import struct/Probe

@group(0) @binding(1) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> probes: array<Probe>;
@group(0) @binding(3) var<storage, read_write> velocities: array<vec4<f32>>;

@compute @workgroup_size(64)
fn keep_out(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let probe = probes[i];
    if !(probe.hit > 0.0 && positions[i].w > 0.0) {
        return;
    }
    let velocity = velocities[i];
    let approach = dot(velocity.xyz - probe.velocity, probe.normal);
    let wanted = min(-(probe.distance + step.thickness) / step.dt, 0.0);
    if approach < wanted {
        velocities[i] = vec4<f32>(velocity.xyz + probe.normal * (wanted - approach), velocity.w);
    }
}
