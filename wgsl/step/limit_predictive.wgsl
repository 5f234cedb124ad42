// Rule Predictive: what would make a spring over-long in the coming move is removed from the velocities of its ends, by
// inverse mass. What a limit has pulled in the step it may take back, and no more: it never pushes. One colour per dispatch.
#import shared/item
#import shared/step_params
#import shared/span
#import struct/Limit
#import shared/pair

@group(0) var<storage, read> limits: array<Limit>;
@group(0) var<storage, read_write> limit_impulses: array<f32>;

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
    let pulled = limit_impulses[span.first + i];
    let pull = max((predicted_length - limit.max_length) / (step.dt * inverse_mass_sum), -pulled);
    if predicted_length > 0.0 && pull != 0.0 {
        pull_together(limit.first, limit.second, predicted * (pull / predicted_length));
        limit_impulses[span.first + i] = pulled + pull;
    }
}
