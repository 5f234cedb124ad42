// The test of the papers' rules: which limits are over-long now, before the coming move. D §4.3.
#import shared/item
#import shared/span
#import struct/Limit
#import shared/particles reads positions writes velocities

@group(0) var<storage, read> limits: array<Limit>;

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
    let weight_first = inverse_mass_of(limit.first);
    let weight_second = inverse_mass_of(limit.second);
    let difference = position_of(limit.second) - position_of(limit.first);
    let current_length = length(difference);
    let over_long = weight_first + weight_second > 0.0 && current_length > limit.max_length;
    let axis = difference / current_length;
    return Ends(limit.first, limit.second, weight_first, weight_second, difference, current_length, axis, over_long);
}

fn change_along_axis(particle: u32, inverse_mass: f32, axis: vec3<f32>, change: f32) {
    if inverse_mass > 0.0 {
        set_velocity(particle, velocity_of(particle) + axis * change);
    }
}

// W eq. 5, weighted by mass so that momentum is kept; equal masses give the equation as it stands.
fn average_along_axis(ends: Ends) {
    let speed_first = dot(velocity_of(ends.first), ends.axis);
    let speed_second = dot(velocity_of(ends.second), ends.axis);
    let mean = (speed_first * ends.weight_second + speed_second * ends.weight_first) / (ends.weight_first + ends.weight_second);
    change_along_axis(ends.first, ends.weight_first, ends.axis, mean - speed_first);
    change_along_axis(ends.second, ends.weight_second, ends.axis, mean - speed_second);
}
