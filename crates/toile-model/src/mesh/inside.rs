//! Which points are inside a mesh.

use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use toile_scene::Mesh;

/// Edge length of a cell of the grid in which triangles are looked up [m].
const CELL: f64 = 0.02;
/// Points are looked at from so far beside them [m], so that none lies above an edge of a triangle that was drawn on round coordinates.
const ASIDE: DVec2 = DVec2::new(3.1e-8, 1.7e-8);

/// Which points are inside a mesh, by its winding number: how often the surface goes around a point. Parts that overlap and holes that no
/// point looks through do no harm.
#[derive(Clone, Debug)]
pub struct Inside {
    triangles: Vec<[DVec3; 3]>,
    /// The triangles over each cell of the plane z = 0.
    cells: BTreeMap<[i64; 2], Vec<u32>>,
}

impl Inside {
    /// The inside of a mesh whose triangles are counter-clockwise seen from outside.
    pub fn of(mesh: &Mesh) -> Self {
        let corners = |triangle: &[u32; 3]| triangle.map(|vertex| mesh.positions[vertex as usize].as_dvec3());
        let triangles: Vec<[DVec3; 3]> = mesh.triangles.iter().map(corners).collect();
        let mut cells: BTreeMap<[i64; 2], Vec<u32>> = BTreeMap::new();
        for (triangle, index) in triangles.iter().zip(0..) {
            let [a, b, c] = triangle.map(DVec3::truncate);
            let ([left, low], [right, high]) = (cell(a.min(b).min(c)), cell(a.max(b).max(c)));
            for x in left..=right {
                for y in low..=high {
                    cells.entry([x, y]).or_default().push(index);
                }
            }
        }
        Self { triangles, cells }
    }

    /// Whether a point [m] is inside.
    pub fn holds(&self, point: DVec3) -> bool {
        let above = point.truncate() + ASIDE;
        let over = self.cells.get(&cell(above)).into_iter().flatten();
        over.map(|triangle| crossing(&self.triangles[*triangle as usize], above, point.z)).sum::<i32>() != 0
    }
}

fn cell(place: DVec2) -> [i64; 2] {
    [place.x, place.y].map(|x| (x / CELL).floor() as i64)
}

/// How a triangle is crossed on the way from a point along +z: 1 from inside, −1 from outside, 0 not at all.
fn crossing(&[a, b, c]: &[DVec3; 3], place: DVec2, z: f64) -> i32 {
    let side = |from: DVec3, to: DVec3| (to - from).truncate().perp_dot(place - from.truncate());
    let (of_a, of_b, of_c) = (side(b, c), side(c, a), side(a, b));
    let faces_up = of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0;
    let faces_down = of_a <= 0.0 && of_b <= 0.0 && of_c <= 0.0;
    let area = of_a + of_b + of_c;
    if area == 0.0 || !(faces_up || faces_down) {
        return 0;
    }
    let surface = (a.z * of_a + b.z * of_b + c.z * of_c) / area;
    match (surface > z, faces_up) {
        (false, _) => 0,
        (true, true) => 1,
        (true, false) => -1,
    }
}

#[cfg(test)]
mod tests {
    use super::Inside;
    use glam::{Vec3, dvec3};
    use toile_scene::Mesh;

    #[test]
    fn points_of_a_ball_are_inside_and_others_not() {
        let inside = Inside::of(&Mesh::sphere(Vec3::new(0.5, 1.0, -0.25), 0.25, 48));
        for turn in 0..200 {
            let angle = f64::from(turn) * 0.7;
            let direction = dvec3(angle.cos(), (0.37 * angle).sin(), angle.sin()).normalize();
            let at = |radius: f64| inside.holds(dvec3(0.5, 1.0, -0.25) + direction * radius);
            assert!(at(0.24) && at(0.01) && !at(0.26) && !at(2.0), "{direction}");
        }
    }

    #[test]
    fn round_coordinates_and_parts_that_overlap_do_no_harm() {
        let mut both = Mesh::cuboid(Vec3::splat(-0.5), Vec3::splat(0.5));
        let other = Mesh::cuboid(Vec3::splat(-0.25), Vec3::splat(0.75));
        let first = both.positions.len() as u32;
        both.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
        both.positions.extend(other.positions);
        let inside = Inside::of(&both);
        for x in [-0.25, 0.0, 0.25] {
            assert!(inside.holds(dvec3(x, x, 0.0)), "{x}");
            assert!(!inside.holds(dvec3(x, x, -0.75)) && !inside.holds(dvec3(x, x, 0.9)), "{x}");
        }
        assert!(inside.holds(dvec3(0.6, 0.6, 0.6)) && !inside.holds(dvec3(0.6, 0.6, -0.4)));
    }
}
