// The handover from the open to the sewn model: the particles that a seam joined become one, with their mass, their
// centre of mass and their momentum.
#import shared/item

@group(0) @binding(0) var<storage, read> open_positions: array<vec4<f32>>;
@group(0) @binding(1) var<storage, read> open_velocities: array<vec4<f32>>;
@group(0) @binding(2) var<storage, read> member_offsets: array<u32>;
@group(0) @binding(3) var<storage, read> members: array<u32>;
@group(0) @binding(4) var<storage, read_write> positions: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> velocities: array<vec4<f32>>;

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
    positions[i] = vec4<f32>(position / total_mass, positions[i].w);
    velocities[i] = vec4<f32>(velocity / total_mass, velocities[i].w);
}
