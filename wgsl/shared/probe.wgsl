// What a point sees of the bodies.
struct Probe {
    normal: vec3<f32>,      // unit, out of the body
    distance: f32,          // to the surface, negative inside [m]
    velocity: vec3<f32>,    // of the surface [m/s]
    hit: f32,               // 1 near enough to matter, 0 not
}
