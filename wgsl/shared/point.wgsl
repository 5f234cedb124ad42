// The points that are tested against the bodies: first the particles, then the quad midpoints.
#import shared/item
#import shared/step_params
#import struct/Midpoint
#import struct/Probe

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> velocities: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> midpoints: array<Midpoint>;
@group(0) @binding(5) var<storage, read_write> probes: array<Probe>;

fn point_at(index: u32) -> Midpoint {
    if index < step.particle_count {
        return Midpoint(positions[index].xyz, velocities[index].xyz);
    }
    return midpoints[index - step.particle_count];
}
