// How a point answers a collision. W §5, eq. 15.
#import shared/step_params
#import shared/probe

struct Response {
    change: vec3<f32>,      // of the velocity [m/s]
    touching: f32,            // 1 in contact, 0 not
    push: vec3<f32>,        // of the position, the way out of the body [m]
    padding: f32,
}

fn respond(velocity: vec3<f32>, probe: Probe) -> Response {
    if !(probe.hit > 0.0) {
        return Response();
    }
    let normal = probe.normal;
    let relative = velocity - probe.velocity;
    let normal_speed = dot(relative, normal);
    if !(probe.distance + normal_speed * step.dt < step.contact_margin) {
        return Response();
    }
    // The way out moves the particle but gives it no velocity, so that it does not bounce off.
    let push = normal * min(max(-probe.distance, 0.0), step.push_speed * step.dt);
    // The fastest approach that does not enter within this step.
    let wanted_speed = min(-probe.distance / step.dt, 0.0);
    if !(normal_speed < wanted_speed) {
        return Response(vec3<f32>(0.0), 1.0, push, 0.0);
    }
    let new_normal_speed = max(wanted_speed, -(step.reflection * normal_speed));
    let tangential = relative - normal * normal_speed;
    var new_tangential = vec3<f32>(0.0);
    if step.friction_law == COULOMB {
        let speed = length(tangential);
        let stopped = step.friction * (new_normal_speed - normal_speed);
        if speed > stopped {
            new_tangential = tangential * ((speed - stopped) / speed);
        }
    } else {
        new_tangential = tangential * step.velocity_kept;
    }
    let change = (new_tangential + normal * new_normal_speed) - relative;
    return Response(change, 1.0, push, 0.0);
}
