// What each point sees of the analytic sphere, exactly; it answers where it is nearer than what the point sees so far.
#import shared/point

struct Ball {
    centre: vec3<f32>,      // [m]
    radius: f32,            // with the thickness of the cloth [m]
    velocity: vec3<f32>,    // [m/s]
    after_maps: u32,        // 1 when the probes already hold what the points see in the maps
}

@group(0) @binding(6) var<uniform> ball: Ball;

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
    let centre_distance = length(from_centre);
    if centre_distance > 0.0 {
        let normal = from_centre / centre_distance;
        let distance = centre_distance - ball.radius;
        let approach = dot(point.velocity - ball.velocity, normal);
        let near = distance + approach * step.dt < step.contact_margin;
        if near && (!(nearest.hit > 0.0) || distance < nearest.distance) {
            nearest = Probe(normal, distance, ball.velocity, 1.0);
        }
    }
    probes[i] = nearest;
}
