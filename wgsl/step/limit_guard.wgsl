// After the contacts of the last sweep: what would still leave a spring stretched more than twice as far as its limit, or half of it, is
// removed from the velocities of its ends, by inverse mass; so little at once that no end is flung into a body. One colour per dispatch.
#import shared/item
#import shared/step_params
#import shared/span
#import struct/Limit
#import shared/pair

@group(0) var<storage, read> limits: array<Limit>;

@compute @workgroup_size(64)
fn limit_guard(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
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
    let guard_length = 2.0 * limit.max_length - limit.rest_length;
    if predicted_length > guard_length {
        let excess = span.share * min(predicted_length - guard_length, step.guard_way);
        let pull = excess / (step.dt * inverse_mass_sum);
        pull_together(limit.first, limit.second, predicted * (pull / predicted_length));
    }
}
