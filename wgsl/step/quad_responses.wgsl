// How the midpoint of each quad answers a collision. D §6, W eq. 15.
#import shared/item
#import shared/response
#import shared/midpoint

@group(0) @binding(2) var<storage, read> midpoints: array<Midpoint>;
@group(0) @binding(3) var<storage, read> probes: array<Probe>;
@group(0) @binding(4) var<storage, read_write> responses: array<Response>;

@compute @workgroup_size(64)
fn quad_responses(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < step.quad_count {
        responses[i] = respond(midpoints[i].velocity, probes[step.particle_count + i]);
    }
}
