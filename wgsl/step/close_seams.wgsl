// An open seam as a limit that shrinks: each pair of particles comes nearer at its closing speed. One colour per dispatch.
#import shared/item
#import shared/step_params
#import shared/span
#import shared/seam_pair

@group(0) @binding(2) var<storage, read> positions: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> seam_pairs: array<SeamPair>;
@group(0) @binding(4) var<storage, read_write> velocities: array<vec4<f32>>;

@compute @workgroup_size(64)
fn close_seams(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let pair = seam_pairs[span.first + i];
    let a = positions[pair.first];
    let b = positions[pair.second];
    let inverse_mass_sum = a.w + b.w;
    if !(inverse_mass_sum > 0.0) {
        return;
    }
    let velocity_a = velocities[pair.first];
    let velocity_b = velocities[pair.second];
    let gap = b.xyz - a.xyz;
    let target_length = max(length(gap) - pair.closing_speed * step.dt, 0.0);
    let predicted = gap + (velocity_b.xyz - velocity_a.xyz) * step.dt;
    let predicted_length = length(predicted);
    if predicted_length > target_length {
        let change = predicted * ((predicted_length - target_length) / ((predicted_length * step.dt) * inverse_mass_sum));
        velocities[pair.first] = vec4<f32>(velocity_a.xyz + change * a.w, velocity_a.w);
        velocities[pair.second] = vec4<f32>(velocity_b.xyz - change * b.w, velocity_b.w);
    }
}
