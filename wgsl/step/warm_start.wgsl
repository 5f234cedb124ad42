// Each limit begins a step with half of the impulse that it ended the last one with: tension that lasts need not be found anew. Limits
// take it back where it is too much. One colour per dispatch.
#import shared/item
#import shared/span
#import struct/Limit
#import shared/pair

@group(0) var<storage, read> limits: array<Limit>;
@group(0) var<storage, read_write> limit_impulses: array<f32>;

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
    let way = position_of(limit.second) - position_of(limit.first);
    let way_length = length(way);
    if way_length > 0.0 {
        pull_together(limit.first, limit.second, way * (impulse / way_length));
        limit_impulses[span.first + i] = impulse;
    } else {
        limit_impulses[span.first + i] = 0.0;
    }
}
