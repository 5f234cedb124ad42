// The vertices of a body.
#import struct/Vertices

@group(0) var<uniform> vertices: Vertices;
