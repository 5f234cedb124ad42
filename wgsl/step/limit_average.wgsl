// Rule Average: both axial velocities of an over-long spring become their mean. W eq. 5. One colour per dispatch.
#import shared/over_long

@compute @workgroup_size(64)
fn limit_average(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let ends = ends_of(limits[span.first + i]);
    if ends.over_long {
        average_along_axis(ends);
    }
}
