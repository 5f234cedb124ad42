// The vertices of a body that the host skins, out of the host's own buffers, as they will be at the time of the maps.
#import shared/item
#import struct/Gather

@group(0) var<uniform> gather: Gather;
@group(0) var<storage, read> host_positions: array<f32>;
@group(0) var<storage, read> host_normals: array<f32>;
@group(0) var<storage, read> host_motions: array<f32>;
@group(0) var<storage, read_write> body_positions: array<vec4<f32>>;
@group(0) var<storage, read_write> body_normals: array<vec4<f32>>;

@compute @workgroup_size(64)
fn gather_body(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= gather.count {
        return;
    }
    let p = gather.first_position + i * gather.position_stride;
    let position = vec3<f32>(host_positions[p], host_positions[p + 1u], host_positions[p + 2u]);
    let m = gather.first_motion + i * gather.motion_stride;
    var way = vec3<f32>(host_motions[m], host_motions[m + 1u], host_motions[m + 2u]);
    if gather.is_last == 1u {
        way = position - way;
    }
    body_positions[i] = vec4<f32>(position + way * gather.ahead, 1.0);
    let n = gather.first_normal + i * gather.normal_stride;
    let normal = vec3<f32>(host_normals[n], host_normals[n + 1u], host_normals[n + 2u]);
    let normal_length = length(normal);
    var unit = vec3<f32>(0.0, 1.0, 0.0);
    if normal_length > 0.0 {
        unit = normal / normal_length;
    }
    body_normals[i] = vec4<f32>(unit, 0.0);
}
