// Unit normals out of the cloth, from the area vectors of the quads around each particle.
#import shared/item
#import shared/step_params
#import shared/area

@group(0) var<storage, read> quads: array<vec4<u32>>;
@group(0) var<storage, read> particle_quad_offsets: array<u32>;
@group(0) var<storage, read> particle_quads: array<u32>;
@group(0) var<storage, read_write> normals: array<vec4<f32>>;

@compute @workgroup_size(64)
fn particle_normals(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    var sum = vec3<f32>(0.0);
    let end = particle_quad_offsets[i + 1u];
    for (var k = particle_quad_offsets[i]; k < end; k++) {
        sum = sum + doubled_area(quads[particle_quads[k]]);
    }
    let area = length(sum);
    var normal = vec3<f32>(0.0, 1.0, 0.0);
    if area > 0.0 {
        normal = sum / area;
    }
    normals[i] = vec4<f32>(normal, 0.0);
}
