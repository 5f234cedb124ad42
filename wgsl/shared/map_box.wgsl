// Where the two map cameras stand: a box of texels over x and y, and two planes across z. W §4, fig. 3.
struct MapBox {
    origin_x: f32,      // left edge [m]
    origin_y: f32,      // top edge [m]
    texel: f32,         // edge length of a texel [m]
    z_front: f32,       // plane of the front camera [m]
    z_back: f32,        // plane of the back camera [m]
    columns: u32,
    rows: u32,
}
