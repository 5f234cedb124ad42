// Vertices follow their joints: the joints' matrices are blended by weight. The normal goes by the cofactors, which also
// hold where a joint scales.
#import shared/item
#import shared/vertices
#import struct/Influence
#import struct/Joint

@group(0) var<storage, read> morphed_positions: array<vec4<f32>>;
@group(0) var<storage, read> morphed_normals: array<vec4<f32>>;
@group(0) var<storage, read> influence_offsets: array<u32>;
@group(0) var<storage, read> influences: array<Influence>;
@group(0) var<storage, read> joints: array<Joint>;
@group(0) var<storage, read_write> body_positions: array<vec4<f32>>;
@group(0) var<storage, read_write> body_normals: array<vec4<f32>>;

@compute @workgroup_size(64)
fn skin_body(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= vertices.count {
        return;
    }
    var row_x = vec4<f32>(0.0);
    var row_y = vec4<f32>(0.0);
    var row_z = vec4<f32>(0.0);
    let end = influence_offsets[i + 1u];
    for (var k = influence_offsets[i]; k < end; k++) {
        let weight = influences[k].weight;
        let joint = joints[influences[k].joint];
        row_x = row_x + joint.row_x * weight;
        row_y = row_y + joint.row_y * weight;
        row_z = row_z + joint.row_z * weight;
    }
    let position = morphed_positions[i].xyz;
    body_positions[i] = vec4<f32>(
        dot(row_x.xyz, position) + row_x.w,
        dot(row_y.xyz, position) + row_y.w,
        dot(row_z.xyz, position) + row_z.w,
        1.0,
    );
    let normal = morphed_normals[i].xyz;
    let turned = vec3<f32>(
        dot(cross(row_y.xyz, row_z.xyz), normal),
        dot(cross(row_z.xyz, row_x.xyz), normal),
        dot(cross(row_x.xyz, row_y.xyz), normal),
    );
    let turned_length = length(turned);
    var unit = vec3<f32>(0.0, 1.0, 0.0);
    if turned_length > 0.0 {
        unit = turned / turned_length;
    }
    body_normals[i] = vec4<f32>(unit, 0.0);
}
