// Springs, gravity and viscous damping, gathered by each particle in the fixed order of its links. D §3, eq. 2.
#import shared/item
#import shared/step_params
#import struct/LinkSpring

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> velocities: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read> link_offsets: array<u32>;
@group(0) @binding(5) var<storage, read> link_others: array<u32>;
@group(0) @binding(6) var<storage, read> link_springs: array<LinkSpring>;
@group(0) @binding(7) var<storage, read_write> forces: array<vec4<f32>>;

@compute @workgroup_size(64)
fn spring_forces(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let position = positions[i].xyz;
    let velocity = velocities[i].xyz;
    let mass = velocities[i].w;
    var force = step.gravity * mass;
    force = force - velocity * (step.damping * mass);
    let end = link_offsets[i + 1u];
    for (var k = link_offsets[i]; k < end; k++) {
        let spring = link_springs[k];
        let difference = positions[link_others[k]].xyz - position;
        let current_length = length(difference);
        if current_length > 0.0 {
            force = force + difference * ((spring.stiffness * (current_length - spring.rest_length)) / current_length);
        }
    }
    forces[i] = vec4<f32>(force, 0.0);
}
