// Each limit begins a step with half of the impulse that it ended the last one with: tension that lasts need not be found anew. Limits
// take it back where it is too much. One colour per dispatch.
#import shared/item
#import shared/span
#import shared/limit

@group(0) @binding(2) var<storage, read> limits: array<Limit>;
@group(0) @binding(3) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> velocities: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> limit_impulses: array<f32>;

// The largest part that cannot swing up, however slowly sweeps converge.
const CARRIED: f32 = 0.5;

@compute @workgroup_size(64)
fn warm_start(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let impulse = CARRIED * limit_impulses[span.first + i];
    if impulse == 0.0 {
        return;
    }
    let limit = limits[span.first + i];
    let a = positions[limit.first];
    let b = positions[limit.second];
    let velocity_a = velocities[limit.first];
    let velocity_b = velocities[limit.second];
    let way = b.xyz - a.xyz;
    let way_length = length(way);
    if way_length > 0.0 {
        limit_impulses[span.first + i] = impulse;
        let change = way * (impulse / way_length);
        velocities[limit.first] = vec4<f32>(velocity_a.xyz + change * a.w, velocity_a.w);
        velocities[limit.second] = vec4<f32>(velocity_b.xyz - change * b.w, velocity_b.w);
    } else {
        limit_impulses[span.first + i] = 0.0;
    }
}
