// The point of each quad that is tested against the bodies: mean position and velocity of its corners. D §6.
#import shared/item
#import shared/step_params
#import shared/quad
#import struct/Midpoint
#import shared/particles reads positions velocities

@group(0) var<storage, read> quads: array<vec4<u32>>;
@group(0) var<storage, read_write> midpoints: array<Midpoint>;

@compute @workgroup_size(64)
fn quad_midpoints(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.quad_count {
        return;
    }
    let corners = quads[i];
    var position = (position_of(corners.x) + position_of(corners.y)) + position_of(corners.z);
    var velocity = (velocity_of(corners.x) + velocity_of(corners.y)) + velocity_of(corners.z);
    if corners.w == NO_CORNER {
        position = position * (1.0 / 3.0);
        velocity = velocity * (1.0 / 3.0);
    } else {
        position = (position + position_of(corners.w)) * 0.25;
        velocity = (velocity + velocity_of(corners.w)) * 0.25;
    }
    midpoints[i] = Midpoint(position, velocity);
}
