// The coarse particles that lead each particle of the cloth, and then each coarse particle.
#import struct/Leader
#import shared/coarse reads shifts

@group(0) var<storage, read> leader_offsets: array<u32>;
@group(0) var<storage, read> leaders: array<Leader>;

// What the leaders of a row move a particle by [m].
fn led_by(row: u32) -> vec3<f32> {
    var shift = vec3<f32>(0.0);
    let end = leader_offsets[row + 1u];
    for (var k = leader_offsets[row]; k < end; k += 1u) {
        let leader = leaders[k];
        shift = shift + coarse_shifts[leader.coarse].xyz * leader.part;
    }
    return shift;
}
