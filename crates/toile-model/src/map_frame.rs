//! Where the maps of a body stand in the world.

use glam::Vec3;

/// Distance that the camera planes keep from the body [m]: a surface on a plane would have the depth of nothing.
const DEPTH_PADDING: f32 = 1e-3;

/// Where the maps of a body stand in the world: orthographic along z, both sides with the same columns and rows. W §4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapFrame {
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

impl MapFrame {
    /// The frame around the smallest and largest corner of a body [m], with one texel to spare on each side and 1 mm in
    /// front and behind. `texel` is the edge length of a texel [m].
    ///
    /// # Panics
    /// When `texel` is not positive or the bounds are not finite.
    pub fn around(bounds: [Vec3; 2], texel: f32) -> Self {
        let [low, high] = bounds;
        assert!(texel > 0.0, "the texel of the maps must be positive, not {texel} m");
        assert!(low.is_finite() && high.is_finite(), "the bounds of a body must be finite");
        let size = high - low;
        Self {
            origin_x: low.x - texel,
            origin_y: high.y + texel,
            texel,
            columns: (size.x / texel).ceil() as u32 + 2,
            rows: (size.y / texel).ceil() as u32 + 2,
            z_front: high.z + DEPTH_PADDING,
            z_back: low.z - DEPTH_PADDING,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn a_frame_leaves_one_texel_on_each_side() {
        let frame = MapFrame::around([vec3(-1.0, 0.0, -0.25), vec3(1.0, 1.75, 0.5)], 0.5);
        assert_eq!((frame.columns, frame.rows), (6, 6));
        assert_eq!((frame.origin_x, frame.origin_y), (-1.5, 2.25));
        let [right, bottom] = [frame.origin_x + 6.0 * 0.5, frame.origin_y - 6.0 * 0.5];
        assert!(right >= 1.0 + 0.5 && bottom <= 0.0 - 0.5);
        assert_eq!((frame.z_front, frame.z_back), (0.501, -0.251));
    }

    #[test]
    fn a_flat_body_still_has_a_frame() {
        let frame = MapFrame::around([Vec3::ZERO, Vec3::ZERO], 0.005);
        assert_eq!((frame.columns, frame.rows), (2, 2));
        assert!(frame.z_front > frame.z_back);
    }

    #[test]
    #[should_panic(expected = "must be positive")]
    fn a_texel_that_is_not_a_number_is_refused() {
        MapFrame::around([Vec3::ZERO, Vec3::ONE], f32::NAN);
    }
}
