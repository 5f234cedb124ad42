// The handover from the open to the sewn model: the particles that a seam joined become one, with their mass, their
// centre of mass and their momentum.
#import shared/item
#import shared/particles writes positions velocities

@group(0) var<storage, read> open_positions: array<vec4<f32>>;
@group(0) var<storage, read> open_velocities: array<vec4<f32>>;
@group(0) var<storage, read> member_offsets: array<u32>;
@group(0) var<storage, read> members: array<u32>;

@compute @workgroup_size(64)
fn merge_particles(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i + 1u >= arrayLength(&member_offsets) {
        return;
    }
    var position = vec3<f32>(0.0);
    var velocity = vec3<f32>(0.0);
    var total_mass = 0.0;
    let end = member_offsets[i + 1u];
    for (var k = member_offsets[i]; k < end; k++) {
        let member = members[k];
        let mass = open_velocities[member].w;
        total_mass = total_mass + mass;
        position = position + open_positions[member].xyz * mass;
        velocity = velocity + open_velocities[member].xyz * mass;
    }
    set_position(i, position / total_mass);
    set_velocity(i, velocity / total_mass);
}
