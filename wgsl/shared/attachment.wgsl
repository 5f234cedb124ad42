// A maximum distance of a particle from a pin.
struct Attachment {
    pin: u32,
    max_length: f32,    // [m]
}
