// Rule Zero: both axial velocities of an over-long spring become zero. D §4.3. One colour per dispatch.
#import shared/over_long

@compute @workgroup_size(64)
fn limit_zero(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let ends = ends_of(limits[span.first + i]);
    if ends.over_long {
        change_along_axis(ends.first, ends.weight_first, ends.axis, -dot(velocity_of(ends.first), ends.axis));
        change_along_axis(ends.second, ends.weight_second, ends.axis, -dot(velocity_of(ends.second), ends.axis));
    }
}
