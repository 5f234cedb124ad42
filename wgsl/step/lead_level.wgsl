// The nodes of a level begin. One level per dispatch, the coarsest first.
#import shared/item
#import shared/span
#import shared/lead

@compute @workgroup_size(64)
fn lead_level(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let item = item_index(id, groups);
    if item >= span.count {
        return;
    }
    lead(span.first + item);
}
