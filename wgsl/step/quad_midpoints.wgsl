// The point of each quad that is tested against the bodies: mean position and velocity of its corners. D §6.
#import shared/item
#import shared/step_params
#import shared/quad
#import struct/Midpoint

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> velocities: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> quads: array<vec4<u32>>;
@group(0) @binding(5) var<storage, read_write> midpoints: array<Midpoint>;

@compute @workgroup_size(64)
fn quad_midpoints(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.quad_count {
        return;
    }
    let corners = quads[i];
    var position = (positions[corners.x].xyz + positions[corners.y].xyz) + positions[corners.z].xyz;
    var velocity = (velocities[corners.x].xyz + velocities[corners.y].xyz) + velocities[corners.z].xyz;
    if corners.w == NO_CORNER {
        position = position * (1.0 / 3.0);
        velocity = velocity * (1.0 / 3.0);
    } else {
        position = (position + positions[corners.w].xyz) * 0.25;
        velocity = (velocity + velocities[corners.w].xyz) * 0.25;
    }
    midpoints[i] = Midpoint(position, velocity);
}
