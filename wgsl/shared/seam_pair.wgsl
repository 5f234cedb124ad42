// Two particles that a seam pulls together.
struct SeamPair {
    first: u32,
    second: u32,
    closing_speed: f32,     // [m/s]
}
