// The largest elongation, and how many structural and shear springs are over-long.
#import shared/item
#import struct/Status
#import shared/elongation
#import shared/step_params

@group(0) var<storage, read_write> status: Status;

@compute @workgroup_size(64)
fn limit_status(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.limit_count {
        return;
    }
    let elongation = elongation_of(i);
    // Few are longer than what is known already, so few wait for the one word.
    if elongation > 0.0 && bitcast<u32>(elongation) > atomicLoad(&status.elongation_max) {
        atomicMax(&status.elongation_max, bitcast<u32>(elongation));
    }
    // The threshold along a spring is what its limit allows, by the part of it that limits hold.
    if elongation * step.aim > limits[i].max_length / limits[i].rest_length - 1.0 {
        atomicAdd(&status.over_long_count, 1u);
    }
}
