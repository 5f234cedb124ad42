// Up to four nodes and the limits between them.
#import struct/Cluster

@group(0) var<storage, read> clusters: array<Cluster>;

const NO_NODE: u32 = 0xffffffffu;
