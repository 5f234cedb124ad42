// The largest elongation above the target of a polish that the coming move would give a structural or shear spring.
#import shared/item
#import shared/step_params
#import struct/Limit
#import shared/polish
#import shared/particles reads positions velocities

@group(0) var<storage, read> limits: array<Limit>;

@compute @workgroup_size(64)
fn measure_excess(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.limit_count {
        return;
    }
    let limit = limits[i];
    let difference = position_of(limit.second) - position_of(limit.first);
    let predicted = difference + (velocity_of(limit.second) - velocity_of(limit.first)) * step.dt;
    let elongation = length(predicted) / limit.rest_length - 1.0;
    // Few springs are above it, so few wait for the one word.
    if elongation > polish.target_elongation {
        atomicMax(&polish_state.elongation_max, bitcast<u32>(elongation));
    }
}
