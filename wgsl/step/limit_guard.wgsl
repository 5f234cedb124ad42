// After the contacts of the last sweep: what would still leave a spring stretched more than twice as far as its limit is removed
// from the velocities of its ends, by inverse mass. One colour per dispatch.
#import shared/item
#import shared/step_params
#import shared/span
#import shared/limit

@group(0) @binding(2) var<storage, read> limits: array<Limit>;
@group(0) @binding(3) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(4) var<storage, read_write> velocities: array<vec4<f32>>;

@compute @workgroup_size(64)
fn limit_guard(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let limit = limits[span.first + i];
    let a = positions[limit.first];
    let b = positions[limit.second];
    let inverse_mass_sum = a.w + b.w;
    if !(inverse_mass_sum > 0.0) {
        return;
    }
    let velocity_a = velocities[limit.first];
    let velocity_b = velocities[limit.second];
    let predicted = (b.xyz - a.xyz) + (velocity_b.xyz - velocity_a.xyz) * step.dt;
    let predicted_length = length(predicted);
    let guard_length = 2.0 * limit.max_length - limit.rest_length;
    if predicted_length > guard_length {
        let pull = (predicted_length - guard_length) / (step.dt * inverse_mass_sum);
        let change = predicted * (pull / predicted_length);
        velocities[limit.first] = vec4<f32>(velocity_a.xyz + change * a.w, velocity_a.w);
        velocities[limit.second] = vec4<f32>(velocity_b.xyz - change * b.w, velocity_b.w);
    }
}
