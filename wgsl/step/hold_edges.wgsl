// The edges of one label (a waistband, a collar, an armhole) keep their mean height while the garment is sewn, so that it does
// not slide away; each of their particles stays free to go where its seam wants it. One workgroup per label.
#import shared/step_params
#import shared/reduction
#import struct/Hold
#import shared/particles reads positions writes velocities

@group(0) var<storage, read> holds: array<Hold>;
@group(0) var<storage, read> held_particles: array<u32>;

@compute @workgroup_size(64)
fn hold_edges(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let hold = holds[group.x];
    var height = 0.0;
    var rise = 0.0;
    for (var k = local; k < hold.count; k += 64u) {
        let particle = held_particles[hold.first + k];
        height = height + position_of(particle).y;
        rise = rise + velocity_of(particle).y;
    }
    let height_sum = workgroup_sum(local, height);
    let rise_sum = workgroup_sum(local, rise);
    let wanted = step.hold_rate * (hold.height - height_sum / f32(hold.count));
    // No min and max: drivers differ in what they make of NaN.
    var speed = -step.hold_speed;
    if wanted > speed {
        speed = wanted;
    }
    if speed > step.hold_speed {
        speed = step.hold_speed;
    }
    let change = speed - rise_sum / f32(hold.count);
    for (var k = local; k < hold.count; k += 64u) {
        let particle = held_particles[hold.first + k];
        var velocity = velocity_of(particle);
        velocity.y = velocity.y + change;
        set_velocity(particle, velocity);
    }
}
