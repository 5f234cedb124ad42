//! Where the maps of a body stand in the world.

use glam::Vec3;

/// Distance that the camera planes keep from the body [m]: a surface on a plane would have the depth of nothing.
const DEPTH_PADDING: f32 = 1e-3;

/// Where the maps of a body stand in the world: orthographic along z, both sides with the same columns and rows. W §4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapBox {
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

impl MapBox {
    /// The box around the smallest and largest corner of a body [m], with one texel to spare on each side and 1 mm in
    /// front and behind. `texel` is the edge length of a texel [m].
    ///
    /// # Panics
    /// When `texel` is not positive or the bounds are not finite.
    pub fn around(bounds: [Vec3; 2], texel: f32) -> Self {
        let [low, high] = bounds;
        check(bounds, texel);
        let size = high - low;
        Self {
            origin_x: low.x - texel,
            origin_y: high.y + texel,
            texel,
            columns: ((size.x / texel).ceil() as u32).saturating_add(2),
            rows: ((size.y / texel).ceil() as u32).saturating_add(2),
            z_front: high.z + DEPTH_PADDING,
            z_back: low.z - DEPTH_PADDING,
        }
    }

    /// Columns and rows that [`MapBox::moving`] needs for bounds of a size [m].
    pub fn size_for(size: Vec3, texel: f32) -> [u32; 2] {
        [size.x, size.y].map(|length| ((length / texel).ceil() as u32).saturating_add(3))
    }

    /// The box around the bounds of a body that moves [m], with a fixed number of columns and rows. Its borders lie on whole
    /// texels of the world, so that what stands still keeps its texels.
    ///
    /// # Panics
    /// As [`MapBox::around`].
    pub fn moving(bounds: [Vec3; 2], texel: f32, [columns, rows]: [u32; 2]) -> Self {
        check(bounds, texel);
        let [low, high] = bounds;
        Self {
            origin_x: ((low.x / texel).floor() - 1.0) * texel,
            origin_y: ((high.y / texel).ceil() + 1.0) * texel,
            texel,
            columns,
            rows,
            z_front: high.z + DEPTH_PADDING,
            z_back: low.z - DEPTH_PADDING,
        }
    }
}

fn check([low, high]: [Vec3; 2], texel: f32) {
    assert!(texel > 0.0, "the texel of the maps must be positive, not {texel} m");
    assert!(low.is_finite() && high.is_finite(), "the bounds of a body must be finite");
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn a_box_leaves_one_texel_on_each_side() {
        let map_box = MapBox::around([vec3(-1.0, 0.0, -0.25), vec3(1.0, 1.75, 0.5)], 0.5);
        assert_eq!((map_box.columns, map_box.rows), (6, 6));
        assert_eq!((map_box.origin_x, map_box.origin_y), (-1.5, 2.25));
        let [right, bottom] = [map_box.origin_x + 6.0 * 0.5, map_box.origin_y - 6.0 * 0.5];
        assert!(right >= 1.0 + 0.5 && bottom <= 0.0 - 0.5);
        assert_eq!((map_box.z_front, map_box.z_back), (0.501, -0.251));
    }

    #[test]
    fn a_moving_box_covers_its_bounds_wherever_they_are() {
        let size = vec3(0.93, 1.68, 0.3);
        let columns_and_rows = MapBox::size_for(size, 0.005);
        for shift in [0.0, 0.001, 0.0049, -0.0033, 3.7] {
            let low = vec3(-0.4, 0.02, -0.1) + shift;
            let map_box = MapBox::moving([low, low + size], 0.005, columns_and_rows);
            let right = map_box.origin_x + 0.005 * map_box.columns as f32;
            let bottom = map_box.origin_y - 0.005 * map_box.rows as f32;
            assert!(map_box.origin_x < low.x - 0.004 && right > low.x + size.x, "{shift}: {map_box:?}");
            assert!(map_box.origin_y > low.y + size.y + 0.004 && bottom < low.y, "{shift}: {map_box:?}");
            let texels = map_box.origin_x / 0.005;
            assert!((texels - texels.round()).abs() < 1e-3, "{shift}: the border lies on a texel");
        }
    }

    #[test]
    fn a_flat_body_still_has_a_box() {
        let map_box = MapBox::around([Vec3::ZERO, Vec3::ZERO], 0.005);
        assert_eq!((map_box.columns, map_box.rows), (2, 2));
        assert!(map_box.z_front > map_box.z_back);
    }

    #[test]
    #[should_panic(expected = "must be positive")]
    fn a_texel_that_is_not_a_number_is_refused() {
        MapBox::around([Vec3::ZERO, Vec3::ONE], f32::NAN);
    }
}
