// What each point sees of the analytic sphere, exactly; it answers where it is nearer than what the point sees so far. The whole
// way of the coming move is tested, relative to the sphere: a point that would enter meets the sphere where its way does.
#import shared/point

// The sphere at the start of the step, going straight on to its end.
struct Ball {
    centre: vec3<f32>,      // [m]
    radius: f32,            // with the thickness of the cloth [m]
    velocity: vec3<f32>,    // [m/s]
    after_maps: u32,        // 1 when the probes already hold what the points see in the maps
    spin: vec3<f32>,        // angular velocity [rad/s]
}

@group(0) @binding(6) var<uniform> ball: Ball;

// Where the way from a place outside of the sphere first meets it, relative to the centre; the place itself when it does not.
fn meeting(start: vec3<f32>, way: vec3<f32>) -> vec3<f32> {
    let outside = dot(start, start) - ball.radius * ball.radius;
    let closing = dot(start, way);
    let way_squared = dot(way, way);
    let discriminant = closing * closing - way_squared * outside;
    if step.swept == 1u && outside > 0.0 && closing < 0.0 && discriminant > 0.0 {
        let share = (-closing - sqrt(discriminant)) / way_squared;
        if share < 1.0 {
            return start + way * share;
        }
    }
    return start;
}

@compute @workgroup_size(64)
fn sample_sphere(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.particle_count + step.quad_count {
        return;
    }
    let point = point_at(i);
    var nearest = Probe();
    if ball.after_maps == 1u {
        nearest = probes[i];
    }
    let from_centre = point.position - ball.centre;
    let met = meeting(from_centre, (point.velocity - ball.velocity) * step.dt);
    let met_length = length(met);
    if met_length > 0.0 {
        let normal = met / met_length;
        let distance = dot(normal, from_centre) - ball.radius;
        let surface_velocity = (ball.velocity + ball.spin.yzx * met.zxy) - ball.spin.zxy * met.yzx;
        let approach = dot(point.velocity - surface_velocity, normal);
        let near = distance + approach * step.dt < step.contact_margin;
        if near && (!(nearest.hit > 0.0) || distance < nearest.distance) {
            nearest = Probe(normal, distance, surface_velocity, 1.0);
        }
    }
    probes[i] = nearest;
}
