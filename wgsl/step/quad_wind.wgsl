// The force of the air on each quad as on a flat plate: drag along the relative wind, lift across it. W §2.2.
#import shared/item
#import shared/step_params
#import shared/area
#import shared/particles reads velocities

@group(0) var<storage, read> quads: array<vec4<u32>>;
@group(0) var<storage, read> particle_quad_offsets: array<u32>;
@group(0) var<storage, read_write> quad_winds: array<vec4<f32>>;

const AIR_DENSITY: f32 = 1.2;   // [kg/m³]

// The part of a particle's mass that each of its quads carries.
fn mass_share(particle: u32) -> f32 {
    return mass_of(particle) / f32(particle_quad_offsets[particle + 1u] - particle_quad_offsets[particle]);
}

@compute @workgroup_size(64)
fn quad_wind(@builtin(global_invocation_id) id: vec3<u32>, @builtin(num_workgroups) groups: vec3<u32>) {
    let i = item_index(id, groups);
    if i >= step.quad_count {
        return;
    }
    let corners = quads[i];
    var velocity = (velocity_of(corners.x) + velocity_of(corners.y)) + velocity_of(corners.z);
    var mass = (mass_share(corners.x) + mass_share(corners.y)) + mass_share(corners.z);
    if corners.w == NO_CORNER {
        velocity = velocity * (1.0 / 3.0);
    } else {
        velocity = (velocity + velocity_of(corners.w)) * 0.25;
        mass = mass + mass_share(corners.w);
    }
    let area_vector = doubled_area(corners) * 0.5;
    let wind = step.wind - velocity;
    let speed = length(wind);
    let area = length(area_vector);
    var force = vec3<f32>(0.0);
    if area > 0.0 && speed > 0.0 {
        var normal = area_vector / area;
        var through = dot(wind, normal);
        if through < 0.0 {
            normal = -normal;
            through = -through;
        }
        // Mass of the air that meets the quad in one second, halved [kg/s].
        let flow = ((0.5 * AIR_DENSITY) * area) * through;
        let crosswise = normal * speed - wind * (through / speed);
        // An explicit step longer than 1/rate would overshoot the wind.
        let rate = (flow * (step.drag + step.lift)) / mass;
        force = (wind * step.drag + crosswise * step.lift) * (flow / (1.0 + step.dt * rate));
    }
    quad_winds[i] = vec4<f32>(force, 0.0);
}
