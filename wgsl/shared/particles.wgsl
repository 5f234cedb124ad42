// Where the particles are and how they move: no other file says how that lies in memory. An import names what it reads and what it writes,
// and gets only that.

#section positions
// With the inverse masses.
@group(0) var<storage, $access> positions: array<vec4<f32>>;

// [m]
fn position_of(particle: u32) -> vec3<f32> {
    return positions[particle].xyz;
}

// [1/kg]; 0 of a particle that is pinned.
fn inverse_mass_of(particle: u32) -> f32 {
    return positions[particle].w;
}

#section written positions
fn set_position(particle: u32, position: vec3<f32>) {
    positions[particle] = vec4<f32>(position, positions[particle].w);
}

fn set_inverse_mass(particle: u32, inverse_mass: f32) {
    positions[particle] = vec4<f32>(positions[particle].xyz, inverse_mass);
}

#section velocities
// With the masses.
@group(0) var<storage, $access> velocities: array<vec4<f32>>;

// [m/s]
fn velocity_of(particle: u32) -> vec3<f32> {
    return velocities[particle].xyz;
}

// [kg], also of a particle that is pinned.
fn mass_of(particle: u32) -> f32 {
    return velocities[particle].w;
}

#section written velocities
fn set_velocity(particle: u32, velocity: vec3<f32>) {
    velocities[particle] = vec4<f32>(velocity, velocities[particle].w);
}
