// Rule Position: both ends of an over-long spring are moved together after the step. Provot; W §3.1. One colour per dispatch.
#import shared/item
#import shared/span
#import struct/Limit
#import shared/particles writes positions

@group(0) var<storage, read> limits: array<Limit>;

@compute @workgroup_size(64)
fn limit_position(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let limit = limits[span.first + i];
    let weight_first = inverse_mass_of(limit.first);
    let weight_second = inverse_mass_of(limit.second);
    let inverse_mass_sum = weight_first + weight_second;
    if !(inverse_mass_sum > 0.0) {
        return;
    }
    let first = position_of(limit.first);
    let second = position_of(limit.second);
    let difference = second - first;
    let current_length = length(difference);
    if current_length > limit.max_length {
        let change = difference * ((current_length - limit.max_length) / (current_length * inverse_mass_sum));
        set_position(limit.first, first + change * weight_first);
        set_position(limit.second, second - change * weight_second);
    }
}
