// The part of an array that one dispatch works on: one colour of limits, clusters or seam pairs.
#import struct/Span

@group(0) var<uniform> span: Span;
