// After the contacts of the last sweep: what would still leave a spring stretched more than twice as far as its limit, or half of it, is
// removed from the velocities of its ends, by inverse mass; so little at once that no end is flung into a body. One colour of clusters per dispatch.
#import shared/item
#import shared/step_params
#import shared/span
#import shared/cluster
#import shared/particles reads positions writes velocities

@group(0) var<storage, read> guard_lengths: array<f32>;

const PAIR_COUNT: u32 = 6u;

// Where a particle is, with its inverse mass. What is no particle has no mass that limits could move.
fn place_of(particle: u32) -> vec4<f32> {
    if particle == NO_NODE {
        return vec4<f32>(0.0);
    }
    return vec4<f32>(position_of(particle), inverse_mass_of(particle));
}

fn speed_of(particle: u32) -> vec3<f32> {
    if particle == NO_NODE {
        return vec3<f32>(0.0);
    }
    return velocity_of(particle);
}

fn set_speed(particle: u32, velocity: vec3<f32>) {
    if particle != NO_NODE {
        set_velocity(particle, velocity);
    }
}

fn guard(
    place_a: vec4<f32>,
    place_b: vec4<f32>,
    velocity_a: ptr<function, vec3<f32>>,
    velocity_b: ptr<function, vec3<f32>>,
    guard_length: f32,
) {
    let predicted = (place_b.xyz - place_a.xyz) + (*velocity_b - *velocity_a) * step.dt;
    let predicted_length = length(predicted);
    let inverse_mass_sum = place_a.w + place_b.w;
    if predicted_length > guard_length && inverse_mass_sum > 0.0 {
        let excess = span.share * min(predicted_length - guard_length, step.guard_way);
        let pull = excess / (step.dt * inverse_mass_sum);
        let impulse = predicted * (pull / predicted_length);
        *velocity_a = *velocity_a + impulse * place_a.w;
        *velocity_b = *velocity_b - impulse * place_b.w;
    }
}

@compute @workgroup_size(64)
fn limit_guard(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let item = item_index(id, groups);
    if item >= span.count {
        return;
    }
    let index = span.first + item;
    let cluster = clusters[index];
    let lengths = PAIR_COUNT * index;
    let place_a = place_of(cluster.a);
    let place_b = place_of(cluster.b);
    let place_c = place_of(cluster.c);
    let place_d = place_of(cluster.d);
    var velocity_a = speed_of(cluster.a);
    var velocity_b = speed_of(cluster.b);
    var velocity_c = speed_of(cluster.c);
    var velocity_d = speed_of(cluster.d);
    guard(place_a, place_b, &velocity_a, &velocity_b, guard_lengths[lengths]);
    guard(place_c, place_d, &velocity_c, &velocity_d, guard_lengths[lengths + 1u]);
    guard(place_a, place_c, &velocity_a, &velocity_c, guard_lengths[lengths + 2u]);
    guard(place_b, place_d, &velocity_b, &velocity_d, guard_lengths[lengths + 3u]);
    guard(place_a, place_d, &velocity_a, &velocity_d, guard_lengths[lengths + 4u]);
    guard(place_b, place_c, &velocity_b, &velocity_c, guard_lengths[lengths + 5u]);
    set_speed(cluster.a, velocity_a);
    set_speed(cluster.b, velocity_b);
    set_speed(cluster.c, velocity_c);
    set_speed(cluster.d, velocity_d);
}
