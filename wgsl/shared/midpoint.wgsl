// Mean position [m] and velocity [m/s] of the corners of a quad.
struct Midpoint {
    position: vec3<f32>,
    velocity: vec3<f32>,
}
