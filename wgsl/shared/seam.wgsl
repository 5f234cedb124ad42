// An open seam is a limit that shrinks.
#import shared/step_params
#import struct/SeamPair
#import shared/pair

// A pair that is nearer is shut [m]: the square of much less vanishes on a driver that flushes denormal numbers.
const SHUT: f32 = 1e-12;

// Removes from the velocities of a pair what would leave its gap, after the coming move, wider than a closing speed [m/s] allows.
fn close_pair(pair: SeamPair, speed: f32) {
    let inverse_mass_sum = inverse_mass_sum_of(pair.first, pair.second);
    if !(inverse_mass_sum > 0.0) {
        return;
    }
    let gap = length(position_of(pair.second) - position_of(pair.first));
    let target_length = max(gap - speed * step.dt, SHUT);
    let predicted = after_move(pair.first, pair.second, step.dt);
    let predicted_length = length(predicted);
    if predicted_length > target_length {
        let share = (predicted_length - target_length) / ((predicted_length * step.dt) * inverse_mass_sum);
        pull_together(pair.first, pair.second, predicted * share);
    }
}
