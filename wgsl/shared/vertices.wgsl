// The vertices of a body.
struct Vertices {
    count: u32,
    rate: f32,      // 1 / time since the last pose, 0 when there was none [1/s]
}

@group(0) @binding(0) var<uniform> vertices: Vertices;
