// Two particles that a limit or a seam pulls together.
@group(0) @binding(3) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> velocities: array<vec4<f32>>;

fn inverse_mass_sum_of(first: u32, second: u32) -> f32 {
    return positions[first].w + positions[second].w;
}

// From the first to the second after a move of `dt` [m].
fn after_move(first: u32, second: u32, dt: f32) -> vec3<f32> {
    return (positions[second].xyz - positions[first].xyz) + (velocities[second].xyz - velocities[first].xyz) * dt;
}

// Gives both an impulse towards each other [N·s].
fn pull_together(first: u32, second: u32, impulse: vec3<f32>) {
    let velocity_a = velocities[first];
    let velocity_b = velocities[second];
    velocities[first] = vec4<f32>(velocity_a.xyz + impulse * positions[first].w, velocity_a.w);
    velocities[second] = vec4<f32>(velocity_b.xyz - impulse * positions[second].w, velocity_b.w);
}
