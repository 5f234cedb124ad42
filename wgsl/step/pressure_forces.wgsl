// Each particle takes an equal share of the pressure on its quads, which acts along their areas, out of the cloth; gathered in their fixed
// order.
#import shared/item
#import shared/step_params
#import shared/area

@group(0) var<storage, read> quads: array<vec4<u32>>;
@group(0) var<storage, read> particle_quad_offsets: array<u32>;
@group(0) var<storage, read> particle_quads: array<u32>;
@group(0) var<storage, read_write> forces: array<vec4<f32>>;

@compute @workgroup_size(64)
fn pressure_forces(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    var force = forces[i].xyz;
    let end = particle_quad_offsets[i + 1u];
    for (var k = particle_quad_offsets[i]; k < end; k++) {
        let corners = quads[particle_quads[k]];
        var share = 0.125;
        if corners.w == NO_CORNER {
            share = 1.0 / 6.0;
        }
        force = force + doubled_area(corners) * (step.pressure * share);
    }
    forces[i] = vec4<f32>(force, 0.0);
}
