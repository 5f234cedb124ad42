// Velocities from forces; positions move last. W eq. 3.
#import shared/item
#import shared/step_params

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> forces: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> velocities: array<vec4<f32>>;

@compute @workgroup_size(64)
fn euler(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count {
        return;
    }
    let velocity = velocities[i];
    let change = forces[i].xyz * (step.dt * positions[i].w);
    velocities[i] = vec4<f32>(velocity.xyz + change, velocity.w);
}
