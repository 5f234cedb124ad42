// The test of the papers' rules: which limits are over-long now, before the coming move. D §4.3.
#import shared/item
#import shared/step_params
#import shared/span
#import struct/Limit

@group(0) @binding(2) var<storage, read> limits: array<Limit>;
@group(0) @binding(3) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> velocities: array<vec4<f32>>;

struct Ends {
    first: u32,
    second: u32,
    weight_first: f32,      // inverse mass [1/kg]
    weight_second: f32,
    difference: vec3<f32>,  // from first to second [m]
    length: f32,            // [m]
    axis: vec3<f32>,        // unit, from first to second
    over_long: bool,
}

fn ends_of(limit: Limit) -> Ends {
    let a = positions[limit.first];
    let b = positions[limit.second];
    let difference = b.xyz - a.xyz;
    let current_length = length(difference);
    let over_long = a.w + b.w > 0.0 && current_length > limit.max_length;
    return Ends(limit.first, limit.second, a.w, b.w, difference, current_length, difference / current_length, over_long);
}

fn change_along_axis(particle: u32, inverse_mass: f32, axis: vec3<f32>, change: f32) {
    if inverse_mass > 0.0 {
        let velocity = velocities[particle];
        velocities[particle] = vec4<f32>(velocity.xyz + axis * change, velocity.w);
    }
}

// W eq. 5, weighted by mass so that momentum is kept; equal masses give the equation as it stands.
fn average_along_axis(ends: Ends) {
    let speed_first = dot(velocities[ends.first].xyz, ends.axis);
    let speed_second = dot(velocities[ends.second].xyz, ends.axis);
    let mean = (speed_first * ends.weight_second + speed_second * ends.weight_first) / (ends.weight_first + ends.weight_second);
    change_along_axis(ends.first, ends.weight_first, ends.axis, mean - speed_first);
    change_along_axis(ends.second, ends.weight_second, ends.axis, mean - speed_second);
}
