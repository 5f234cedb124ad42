//! Where the two cameras of the papers' maps stand.

use crate::MapBox;

/// Where the papers' maps stand in the world: orthographic along z, both sides with the same columns and rows. W §4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideBox {
    /// Left border x [m]: that of column 0.
    pub origin_x: f32,
    /// Top border y [m]: that of row 0.
    pub origin_y: f32,
    /// Edge length of a texel [m]. D eq. 11.
    pub texel: f32,
    /// Number of columns; column c spans origin_x + texel·[c, c + 1].
    pub columns: u32,
    /// Number of rows; row r spans origin_y − texel·[r, r + 1].
    pub rows: u32,
    /// Plane of the front camera z [m], where its depth is 0.
    pub z_front: f32,
    /// Plane of the back camera z [m], where its depth is 0. Below `z_front`.
    pub z_back: f32,
}

impl SideBox {
    /// The cameras that see a box from its front and its back.
    pub fn of(map_box: &MapBox) -> Self {
        let [low, high] = [map_box.corner(), map_box.far_corner()];
        let [columns, rows, _] = map_box.size;
        Self { origin_x: low.x, origin_y: high.y, texel: map_box.texel, columns, rows, z_front: high.z, z_back: low.z }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cameras_see_the_whole_box() {
        let map_box = MapBox { low: [-4, 2, -1], size: [8, 6, 3], texel: 0.5 };
        let expected =
            SideBox { origin_x: -2.0, origin_y: 4.0, texel: 0.5, columns: 8, rows: 6, z_front: 1.0, z_back: -0.5 };
        assert_eq!(SideBox::of(&map_box), expected);
    }
}
