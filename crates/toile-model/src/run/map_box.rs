//! Where the maps of a body stand in the world.

use crate::Model;
use glam::Vec3;

/// How much larger than its pattern cloth may be [1].
const STRETCHED_AREA: f64 = 1.5;

/// Where the maps of a body stand in the world: a box of whole texels, whose borders lie on whole texels of the world, so that what
/// stands still keeps its texels. W §4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapBox {
    /// Smallest corner along x, y and z, in texels from the origin of the world.
    pub low: [i32; 3],
    /// Texels along x, y and z.
    pub size: [u32; 3],
    /// Edge length of a texel [m]. D eq. 11.
    pub texel: f32,
}

/// Texels to spare around a body on each side.
const SPARE: u32 = 1;

impl MapBox {
    /// The box around the smallest and largest corner of a body [m], with at least one texel to spare on each side. `texel` is the
    /// edge length of a texel [m].
    ///
    /// # Panics
    /// When `texel` is not positive or the bounds are not finite.
    pub fn around(bounds: [Vec3; 2], texel: f32) -> Self {
        let [low, high] = texels(bounds, texel);
        let size = [0, 1, 2].map(|axis| (high[axis] - low[axis]) as u32 + 2 * SPARE);
        Self { low: low.map(|first| first - SPARE as i32), size, texel }
    }

    /// Texels along x, y and z that [`MapBox::moving`] needs for bounds of a size [m].
    pub fn size_for(size: Vec3, texel: f32) -> [u32; 3] {
        size.to_array().map(|length| ((length / texel).ceil() as u32).saturating_add(1 + 2 * SPARE))
    }

    /// The box around the bounds of a body that moves [m], with a fixed number of texels.
    ///
    /// # Panics
    /// As [`MapBox::around`].
    pub fn moving(bounds: [Vec3; 2], texel: f32, size: [u32; 3]) -> Self {
        Self { low: texels(bounds, texel)[0].map(|first| first - SPARE as i32), size, texel }
    }

    /// Its smallest corner [m].
    pub fn corner(&self) -> Vec3 {
        Vec3::from(self.low.map(|first| first as f32)) * self.texel
    }

    /// Its largest corner [m].
    pub fn far_corner(&self) -> Vec3 {
        let end = [0, 1, 2].map(|axis| (self.low[axis] + self.size[axis] as i32) as f32);
        Vec3::from(end) * self.texel
    }

    /// Texels of the map along each axis: that of `axis` has the extents of the two axes after it, in turn.
    pub fn texel_counts(&self) -> [u64; 3] {
        let [x, y, z] = self.size.map(u64::from);
        [y * z, z * x, x * y]
    }
}

impl Model {
    /// Largest area for which maps of the cloth make room [m²], from its areal density [kg/m²].
    pub fn area_max(&self, areal_density: f64) -> f64 {
        STRETCHED_AREA * self.masses.iter().map(|mass| f64::from(*mass)).sum::<f64>() / areal_density
    }
}

/// The texels of both corners.
fn texels([low, high]: [Vec3; 2], texel: f32) -> [[i32; 3]; 2] {
    assert!(texel > 0.0, "the texel of the maps must be positive, not {texel} m");
    assert!(low.is_finite() && high.is_finite(), "the bounds of a body must be finite");
    [(low / texel).floor(), (high / texel).floor() + 1.0].map(|corner| corner.to_array().map(|at| at as i32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn a_box_leaves_one_texel_on_each_side() {
        let map_box = MapBox::around([vec3(-1.0, 0.0, -0.25), vec3(1.0, 1.75, 0.5)], 0.5);
        assert_eq!((map_box.low, map_box.size), ([-3, -1, -2], [7, 6, 5]));
        assert_eq!((map_box.corner(), map_box.far_corner()), (vec3(-1.5, -0.5, -1.0), vec3(2.0, 2.5, 1.5)));
        assert_eq!(map_box.texel_counts(), [30, 35, 42]);
    }

    #[test]
    fn a_moving_box_covers_its_bounds_wherever_they_are() {
        let size = vec3(0.93, 1.68, 0.3);
        let texels = MapBox::size_for(size, 0.005);
        for shift in [0.0, 0.001, 0.0049, -0.0033, 3.7] {
            let low = vec3(-0.4, 0.02, -0.1) + shift;
            let map_box = MapBox::moving([low, low + size], 0.005, texels);
            let spare = [low - map_box.corner(), map_box.far_corner() - (low + size)];
            assert!(spare.iter().all(|spare| spare.min_element() > 0.0049), "{shift}: {spare:?}");
        }
    }

    #[test]
    fn a_flat_body_still_has_a_box() {
        assert_eq!(MapBox::around([Vec3::ZERO, Vec3::ZERO], 0.005).size, [3, 3, 3]);
    }

    #[test]
    #[should_panic(expected = "must be positive")]
    fn a_texel_that_is_not_a_number_is_refused() {
        MapBox::around([Vec3::ZERO, Vec3::ONE], f32::NAN);
    }
}
