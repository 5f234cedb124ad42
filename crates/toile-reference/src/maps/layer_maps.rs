//! The layered maps of bodies, texel by texel.

use glam::Vec3;
use toile_model::MapBox;

/// The maps of bodies along the world's axes: for each texel all that its column meets.
///
/// The map along an axis has the extents of the two axes after it, in turn: that along x lies over y and z, that along y over z and
/// x, that along z over x and y. Columns of the map along x come first; within a map those along its first extent follow one another.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerMaps {
    /// Where the maps stand in the world.
    pub map_box: MapBox,
    /// The columns of all three maps.
    pub columns: Vec<Column>,
    /// Place of each layer along its axis [m].
    pub depths: Vec<f32>,
    /// Unit normals of the layers, out of the body.
    pub normals: Vec<Vec3>,
    /// Velocities of the layers [m/s]; `None` for bodies at rest.
    pub velocities: Option<Vec<Vec3>>,
}

/// What a texel's column meets, from low to high along its axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// The first of its layers: first the ends of bodies, in turn where one begins and where it ends, then the sheets.
    pub first: u32,
    /// Number of ends.
    pub end_count: u32,
    /// Number of sheets: what belongs to no closed body.
    pub sheet_count: u32,
}

impl LayerMaps {
    /// The column of the map along `axis` that a place lies in, if the map has one.
    pub fn column_under(&self, axis: usize, place: Vec3) -> Option<Column> {
        let [across, up] = extents(axis);
        let scale = 1.0 / self.map_box.texel;
        let [u, v] = [across, up].map(|extent| (place[extent] * scale).floor() - self.map_box.low[extent] as f32);
        let [u_count, v_count] = [across, up].map(|extent| self.map_box.size[extent]);
        if !(u >= 0.0 && u < u_count as f32 && v >= 0.0 && v < v_count as f32) {
            return None;
        }
        Some(self.columns[first_column(&self.map_box, axis) + v as usize * u_count as usize + u as usize])
    }
}

/// The extents of the map along an axis.
pub(crate) fn extents(axis: usize) -> [usize; 2] {
    [(axis + 1) % 3, (axis + 2) % 3]
}

/// Where the columns of the map along an axis begin.
pub(crate) fn first_column(map_box: &MapBox, axis: usize) -> usize {
    map_box.texel_counts()[..axis].iter().sum::<u64>() as usize
}
