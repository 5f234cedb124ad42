// Counts particles that are not finite or run away, finds the largest speed and sums the kinetic energy of each workgroup.
#import shared/item
#import shared/step_params
#import struct/Status
#import shared/reduction
#import shared/particles reads positions velocities

@group(0) var<storage, read_write> status: Status;
@group(0) var<storage, read_write> energy_partials: array<f32>;

// No cloth moves faster than this [m/s]: a particle that does counts as not finite, before it is.
const RUNAWAY_SPEED: f32 = 1000.0;

fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

@compute @workgroup_size(64)
fn particle_status(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(num_workgroups) groups: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_index) local: u32,
) {
    let i = item_index(id, groups);
    var energy = 0.0;
    if i < step.particle_count {
        let position = position_of(i);
        let velocity = velocity_of(i);
        let finite = is_finite(position.x) && is_finite(position.y) && is_finite(position.z)
            && is_finite(velocity.x) && is_finite(velocity.y) && is_finite(velocity.z);
        let speed_squared = dot(velocity, velocity);
        if finite && speed_squared < RUNAWAY_SPEED * RUNAWAY_SPEED {
            let speed = bitcast<u32>(sqrt(speed_squared));
            // Few are faster than what is known already, so few wait for the one word.
            if speed > atomicLoad(&status.speed_max) {
                atomicMax(&status.speed_max, speed);
            }
            if inverse_mass_of(i) > 0.0 {
                energy = 0.5 * (mass_of(i) * speed_squared);
            }
        } else {
            atomicAdd(&status.non_finite_count, 1u);
            atomicMax(&status.first_non_finite, 0xffffffffu - i);
        }
    }
    let sum = workgroup_sum(local, energy);
    let partial = group.x + group.y * groups.x;
    if local == 0u && partial < arrayLength(&energy_partials) {
        energy_partials[partial] = sum;
    }
}
