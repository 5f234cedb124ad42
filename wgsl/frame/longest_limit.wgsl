// The first of the structural and shear springs with the largest elongation.
#import shared/item
#import struct/Status
#import shared/elongation
#import shared/step_params

@group(0) var<storage, read_write> status: Status;

@compute @workgroup_size(64)
fn longest_limit(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.limit_count {
        return;
    }
    let elongation = elongation_of(i);
    if elongation > 0.0 && bitcast<u32>(elongation) == atomicLoad(&status.elongation_max) {
        atomicMax(&status.longest_limit, 0xffffffffu - i);
    }
}
