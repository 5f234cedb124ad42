// Where the columns of the layered maps meet the triangles of a moving surface, and how fast it moves there. D §8, W §4.3 and §7.
#import shared/layer_raster

@group(0) var<storage, read> surface_velocities: array<vec4<f32>>;
@group(0) var drawn_velocities: texture_storage_2d<rgba32float, write>;

fn store_velocity(place: u32, corners: vec3<u32>, shares: vec3<f32>) {
    let velocity = surface_velocities[corners.x].xyz * shares.x + surface_velocities[corners.y].xyz * shares.y
        + surface_velocities[corners.z].xyz * shares.z;
    textureStore(drawn_velocities, packed_at(place), vec4<f32>(velocity, 0.0));
}

@compute @workgroup_size(64)
fn draw_moving_layers(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i < AXIS_COUNT * drawn.part_count {
        draw_part(i);
    }
}
