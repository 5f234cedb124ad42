// The edges of one label (a waistband, a collar, an armhole) keep their mean height while the garment is sewn, so that it does
// not slide away; each of their particles stays free to go where its seam wants it. One workgroup per label.
#import shared/step_params
#import shared/reduction
#import struct/Hold

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> holds: array<Hold>;
@group(0) @binding(4) var<storage, read> held_particles: array<u32>;
@group(0) @binding(5) var<storage, read_write> velocities: array<vec4<f32>>;

@compute @workgroup_size(64)
fn hold_edges(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let hold = holds[group.x];
    var height = 0.0;
    var rise = 0.0;
    for (var k = local; k < hold.count; k += 64u) {
        let particle = held_particles[hold.first + k];
        height = height + positions[particle].y;
        rise = rise + velocities[particle].y;
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
        velocities[particle].y = velocities[particle].y + change;
    }
}
