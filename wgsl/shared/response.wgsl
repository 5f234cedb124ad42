// How a point answers a surface. W §5, eq. 15.
#import shared/step_params
#import struct/Probe

// Whether a point is in contact with its probe at the end of the coming move.
fn touches(velocity: vec3<f32>, probe: Probe) -> bool {
    let approach = dot(velocity - probe.velocity, probe.normal);
    return probe.hit > 0.0 && probe.distance + approach * step.dt < step.contact_margin;
}

// By how much the normal speed of a point must grow so that the coming move does not enter the surface.
fn missing_speed(velocity: vec3<f32>, probe: Probe) -> f32 {
    let approach = dot(velocity - probe.velocity, probe.normal);
    let wanted = min(-probe.distance / step.dt, 0.0);
    if approach < wanted {
        // No max: drivers differ in what it makes of NaN, which an endless approach gives here.
        let returned = -(step.reflection * approach);
        if returned > wanted {
            return returned - approach;
        }
        return wanted - approach;
    }
    return 0.0;
}

// Change of velocity when the normal speed of a point grows by so much, with the friction that goes with it.
fn change_by(gain: f32, velocity: vec3<f32>, probe: Probe) -> vec3<f32> {
    let relative = velocity - probe.velocity;
    let approach = dot(relative, probe.normal);
    let tangential = relative - probe.normal * approach;
    var slip = vec3<f32>(0.0);
    if step.friction_law == COULOMB {
        let speed = length(tangential);
        let stopped = step.friction * min(gain, step.pressing_speed);
        if speed > stopped {
            slip = tangential * ((speed - stopped) / speed);
        }
    } else {
        slip = tangential * step.velocity_kept;
    }
    return (slip + probe.normal * (approach + gain)) - relative;
}
