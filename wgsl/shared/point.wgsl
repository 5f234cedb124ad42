// The points that are tested against the bodies: first the particles, then the quad midpoints.
#import shared/item
#import shared/step_params
#import struct/Midpoint
#import struct/Probe
#import shared/particles reads positions velocities

@group(0) var<storage, read> midpoints: array<Midpoint>;
@group(0) var<storage, read_write> probes: array<Probe>;

fn point_at(index: u32) -> Midpoint {
    if index < step.particle_count {
        return Midpoint(position_of(index), velocity_of(index));
    }
    return midpoints[index - step.particle_count];
}
