// Rule Directional: the rear end of an over-long spring takes the axial velocity of its front end, seen along v_dir, so
// that it catches up. W §3.2, eq. 6. One colour per dispatch.
#import shared/step_params
#import shared/over_long
#import struct/Contact

@group(0) var<storage, read> contacts: array<Contact>;

fn object_velocity(first: u32, second: u32) -> vec3<f32> {
    let a = contacts[first];
    let b = contacts[second];
    if a.touching > 0.0 && b.touching > 0.0 {
        return (a.velocity + b.velocity) * 0.5;
    }
    if a.touching > 0.0 {
        return a.velocity;
    }
    if b.touching > 0.0 {
        return b.velocity;
    }
    return vec3<f32>(0.0);
}

@compute @workgroup_size(64)
fn limit_directional(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= span.count {
        return;
    }
    let ends = ends_of(limits[span.first + i]);
    if !ends.over_long {
        return;
    }
    let direction = step.gravity * step.dt + object_velocity(ends.first, ends.second);
    let speed = length(direction);
    if !(speed > 0.0) {
        average_along_axis(ends);
        return;
    }
    let cosine = dot(ends.difference, direction) / (ends.length * speed);
    let speed_first = dot(velocity_of(ends.first), ends.axis);
    let speed_second = dot(velocity_of(ends.second), ends.axis);
    if abs(cosine) < 0.3 {
        average_along_axis(ends);
    } else if cosine > 0.0 {
        change_along_axis(ends.first, ends.weight_first, ends.axis, speed_second - speed_first);
    } else {
        change_along_axis(ends.second, ends.weight_second, ends.axis, speed_first - speed_second);
    }
}
