// Rule Hierarchical between the coarse particles of a level: what is over-long after the coming move is taken back, by inverse mass. One
// colour per dispatch.
#import shared/item
#import shared/span
#import struct/Limit
#import shared/coarse reads places writes shifts

@group(0) var<storage, read> coarse_limits: array<Limit>;

// How much more than its excess a limit takes: what is behind its ends follows later.
const OVER_RELAXATION: f32 = 1.5;

@compute @workgroup_size(64)
fn limit_coarse(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let limit = coarse_limits[span.first + i];
    let place_a = coarse_places[limit.first];
    let place_b = coarse_places[limit.second];
    let shift_a = coarse_shifts[limit.first].xyz;
    let shift_b = coarse_shifts[limit.second].xyz;
    let chord = (place_b.xyz + shift_b) - (place_a.xyz + shift_a);
    let chord_length = length(chord);
    let inverse_mass_sum = place_a.w + place_b.w;
    if chord_length > limit.max_length && inverse_mass_sum > 0.0 {
        let pull = chord * (OVER_RELAXATION * (chord_length - limit.max_length) / (chord_length * inverse_mass_sum));
        coarse_shifts[limit.first] = vec4<f32>(shift_a + pull * place_a.w, 0.0);
        coarse_shifts[limit.second] = vec4<f32>(shift_b - pull * place_b.w, 0.0);
    }
}
