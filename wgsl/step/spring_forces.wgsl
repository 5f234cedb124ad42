// Springs, gravity and viscous damping, gathered by each particle in the fixed order of its links. D §3, eq. 2.
#import shared/item
#import shared/step_params
#import struct/LinkSpring
#import shared/particles reads positions velocities

@group(0) var<storage, read> link_offsets: array<u32>;
@group(0) var<storage, read> link_others: array<u32>;
@group(0) var<storage, read> link_springs: array<LinkSpring>;
@group(0) var<storage, read_write> forces: array<vec4<f32>>;

@compute @workgroup_size(64)
fn spring_forces(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let position = position_of(i);
    let velocity = velocity_of(i);
    let mass = mass_of(i);
    var force = step.gravity * mass;
    force = force - velocity * (step.damping * mass);
    let end = link_offsets[i + 1u];
    for (var k = link_offsets[i]; k < end; k++) {
        let spring = link_springs[k];
        let difference = position_of(link_others[k]) - position;
        let current_length = length(difference);
        if current_length > 0.0 {
            force = force + difference * ((spring.stiffness * (current_length - spring.rest_length)) / current_length);
        }
    }
    forces[i] = vec4<f32>(force, 0.0);
}
