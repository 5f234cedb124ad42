// Bind positions and normals as the morph targets of a pose change them.
#import shared/item
#import shared/vertices
#import struct/Displacement

@group(0) var<storage, read> bind_positions: array<vec4<f32>>;
@group(0) var<storage, read> bind_normals: array<vec4<f32>>;
@group(0) var<storage, read> morph_offsets: array<u32>;
@group(0) var<storage, read> displacements: array<Displacement>;
@group(0) var<storage, read> morph_weights: array<f32>;
@group(0) var<storage, read_write> morphed_positions: array<vec4<f32>>;
@group(0) var<storage, read_write> morphed_normals: array<vec4<f32>>;

@compute @workgroup_size(64)
fn morph_body(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= vertices.count {
        return;
    }
    var position = bind_positions[i].xyz;
    var normal = bind_normals[i].xyz;
    let end = morph_offsets[i + 1u];
    for (var k = morph_offsets[i]; k < end; k++) {
        let weight = morph_weights[displacements[k].morph];
        position = position + displacements[k].position * weight;
        normal = normal + displacements[k].normal * weight;
    }
    morphed_positions[i] = vec4<f32>(position, 1.0);
    morphed_normals[i] = vec4<f32>(normal, 0.0);
}
