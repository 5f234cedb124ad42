// The vertices of a body.
#import struct/Vertices

@group(0) @binding(0) var<uniform> vertices: Vertices;
