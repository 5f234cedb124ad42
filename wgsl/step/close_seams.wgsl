// An open seam as a limit that shrinks: each pair of particles comes nearer at its closing speed. One colour per dispatch.
#import shared/item
#import shared/step_params
#import shared/span
#import struct/SeamPair
#import shared/pair

@group(0) var<storage, read> seam_pairs: array<SeamPair>;

@compute @workgroup_size(64)
fn close_seams(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let pair = seam_pairs[span.first + i];
    let inverse_mass_sum = inverse_mass_sum_of(pair.first, pair.second);
    if !(inverse_mass_sum > 0.0) {
        return;
    }
    let gap = length(position_of(pair.second) - position_of(pair.first));
    let target_length = max(gap - pair.closing_speed * step.dt, 0.0);
    let predicted = after_move(pair.first, pair.second, step.dt);
    let predicted_length = length(predicted);
    if predicted_length > target_length {
        let share = (predicted_length - target_length) / ((predicted_length * step.dt) * inverse_mass_sum);
        pull_together(pair.first, pair.second, predicted * share);
    }
}
