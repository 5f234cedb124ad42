// The numbers of one step, the same for every particle.
struct StepParams {
    gravity: vec3<f32>,         // [m/s²]
    dt: f32,                    // [s]
    damping: f32,               // viscous damping rate [1/s]
    push_speed: f32,            // largest speed on the way out of a body [m/s]
    pressing_speed: f32,        // largest change of normal speed that friction counts [m/s]
    contact_margin: f32,        // [m]
    reflection: f32,            // C_refl of W eq. 15
    friction_law: u32,          // 0 Coulomb, 1 the papers'
    friction: f32,              // Coulomb's coefficient
    velocity_kept: f32,         // C_fric of W eq. 15
    force_removed: f32,         // C_fric of W eq. 16
    hold_rate: f32,             // speed of a held edge towards its height, per metre from it [1/s]
    hold_speed: f32,            // its largest speed [m/s]
    particle_count: u32,
    quad_count: u32,
    swept: u32,                 // 1: the whole way of a point is tested against the bodies
    wind: vec3<f32>,            // velocity of the air [m/s]
    drag: f32,                  // drag coefficient of a plate across the wind
    lift: f32,                  // lift coefficient
    thickness: f32,             // distance kept from the bodies [m]
    guard_way: f32,             // how much the guard shortens a spring at once [m]
    aim: f32,                   // part of the threshold that the limits hold
    limit_count: u32,           // structural and shear springs, whose limits are the first
    after_maps: u32,            // 1: probes already hold what points see in the maps when the shapes are sampled
}

const COULOMB: u32 = 0u;

@group(0) @binding(0) var<uniform> step: StepParams;
