// The kinetic energy of all workgroups. One workgroup.
#import struct/Status
#import shared/reduction

@group(0) var<storage, read> energy_partials: array<f32>;
@group(0) var<storage, read_write> status: Status;

@compute @workgroup_size(64)
fn total_energy(@builtin(local_invocation_index) local: u32) {
    var energy = 0.0;
    for (var k = local; k < arrayLength(&energy_partials); k += 64u) {
        energy = energy + energy_partials[k];
    }
    let sum = workgroup_sum(local, energy);
    if local == 0u {
        status.kinetic_energy = sum;
    }
}
