// A unilateral maximum length between two particles.
struct Limit {
    first: u32,
    second: u32,
    rest_length: f32,   // [m]
    max_length: f32,    // [m]
}
