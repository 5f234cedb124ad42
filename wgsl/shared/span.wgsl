// The part of an array that one dispatch works on: one colour of limits or seam pairs.
struct Span {
    first: u32,
    count: u32,
}

@group(0) @binding(1) var<uniform> span: Span;
