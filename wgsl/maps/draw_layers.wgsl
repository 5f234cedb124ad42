// Where the columns of the layered maps meet the triangles of a surface at rest. D §8, W §7.
#import shared/layer_raster

fn store_velocity(place: u32, corners: vec3<u32>, shares: vec3<f32>) {}

@compute @workgroup_size(64)
fn draw_layers(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < AXIS_COUNT * drawn.part_count {
        draw_part(i);
    }
}
