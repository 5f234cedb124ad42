// The part of an array that one dispatch works on: one colour of limits, strands or seam pairs.
struct Span {
    first: u32,
    count: u32,
    share: f32,     // part of an excess that a pass of the guard removes
}

@group(0) @binding(1) var<uniform> span: Span;
