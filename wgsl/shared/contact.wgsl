// What a particle touched at the end of a step.
struct Contact {
    normal: vec3<f32>,      // unit, out of the body
    touching: f32,            // 1 in contact, 0 not
    velocity: vec3<f32>,    // of the body at the contact [m/s]
    padding: f32,
}
