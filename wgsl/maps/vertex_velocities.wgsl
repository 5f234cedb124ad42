// Velocities of the vertices of a moving surface, from where they were and where they are. W §4.3.
#import shared/item
#import shared/vertices

@group(0) var<storage, read> last_positions: array<vec4<f32>>;
@group(0) var<storage, read> surface_positions: array<vec4<f32>>;
@group(0) var<storage, read_write> surface_velocities: array<vec4<f32>>;

@compute @workgroup_size(64)
fn vertex_velocities(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= vertices.count {
        return;
    }
    let way = surface_positions[i].xyz - last_positions[i].xyz;
    surface_velocities[i] = vec4<f32>(way * vertices.rate, 0.0);
}
