// Rule Position: both ends of an over-long spring are moved together after the step. Provot; W §3.1. One colour per dispatch.
#import shared/item
#import shared/span
#import struct/Limit

@group(0) @binding(2) var<storage, read> limits: array<Limit>;
@group(0) @binding(3) var<storage, read_write> positions: array<vec4<f32>>;

@compute @workgroup_size(64)
fn limit_position(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let limit = limits[span.first + i];
    let a = positions[limit.first];
    let b = positions[limit.second];
    let inverse_mass_sum = a.w + b.w;
    if !(inverse_mass_sum > 0.0) {
        return;
    }
    let difference = b.xyz - a.xyz;
    let current_length = length(difference);
    if current_length > limit.max_length {
        let change = difference * ((current_length - limit.max_length) / (current_length * inverse_mass_sum));
        positions[limit.first] = vec4<f32>(a.xyz + change * a.w, a.w);
        positions[limit.second] = vec4<f32>(b.xyz - change * b.w, b.w);
    }
}
