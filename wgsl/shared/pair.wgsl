// Two particles that a limit or a seam pulls together.
#import shared/particles reads positions writes velocities

fn inverse_mass_sum_of(first: u32, second: u32) -> f32 {
    return inverse_mass_of(first) + inverse_mass_of(second);
}

// From the first to the second after a move of `dt` [m].
fn after_move(first: u32, second: u32, dt: f32) -> vec3<f32> {
    return (position_of(second) - position_of(first)) + (velocity_of(second) - velocity_of(first)) * dt;
}

// Gives both an impulse towards each other [N·s].
fn pull_together(first: u32, second: u32, impulse: vec3<f32>) {
    set_velocity(first, velocity_of(first) + impulse * inverse_mass_of(first));
    set_velocity(second, velocity_of(second) - impulse * inverse_mass_of(second));
}
