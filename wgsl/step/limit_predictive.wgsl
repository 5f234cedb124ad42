// Rule Predictive: what would make a spring over-long in the coming move is removed from the velocities of its ends, by
// inverse mass, and kept for the start of the next step. One colour per dispatch.
#import shared/item
#import shared/step_params
#import shared/span
#import struct/Limit
#import shared/pair

@group(0) var<storage, read> limits: array<Limit>;
@group(0) var<storage, read_write> pulls: array<vec4<f32>>;

@compute @workgroup_size(64)
fn limit_predictive(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let limit = limits[span.first + i];
    let inverse_mass_sum = inverse_mass_sum_of(limit.first, limit.second);
    if !(inverse_mass_sum > 0.0) {
        return;
    }
    let predicted = after_move(limit.first, limit.second, step.dt);
    let predicted_length = length(predicted);
    if predicted_length > limit.max_length {
        let pull = (predicted_length - limit.max_length) / (step.dt * inverse_mass_sum);
        let impulse = predicted * (pull / predicted_length);
        pull_together(limit.first, limit.second, impulse);
        let pulled_first = pulls[limit.first].xyz + impulse * inverse_mass_of(limit.first);
        let pulled_second = pulls[limit.second].xyz - impulse * inverse_mass_of(limit.second);
        pulls[limit.first] = vec4<f32>(pulled_first, 0.0);
        pulls[limit.second] = vec4<f32>(pulled_second, 0.0);
    }
}
