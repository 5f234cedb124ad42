// Where columns of the layered maps meet triangles: a list for each column, in no order.
#import struct/Crossing
#import struct/LayerCounts

// First of the list of each column, and of nothing: one more than its place, 0 at the end.
@group(0) var<storage, read_write> crossing_lists: array<atomic<u32>>;
@group(0) var<storage, read_write> crossings: array<Crossing>;
@group(0) var<storage, read_write> layer_counts: LayerCounts;

// The triangle looks down along the axis: above it the body begins.
const BEGINS: u32 = 1u;
// It belongs to an open surface.
const OPEN: u32 = 2u;
