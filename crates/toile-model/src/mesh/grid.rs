//! Meshes of rectangular panels: the l × n grid of D §3.

use crate::mesh::flat_mesh::FlatMesh;
use crate::mesh::geometry::angle_range;
use crate::mesh::outline::Outline;

/// The grid of a rectangular panel whose opposite sides have the same number of particles.
pub(crate) fn mesh(outline: &Outline) -> Option<FlatMesh> {
    let rectangle = outline.rectangle.as_ref()?;
    let sides: [Vec<u32>; 4] = std::array::from_fn(|side| {
        let mut particles: Vec<u32> = Vec::new();
        for edge in rectangle.edges(side) {
            particles.pop();
            particles.extend(outline.edge(edge));
        }
        particles
    });
    let [bottom, right, top, left] = &sides;
    if bottom.len() != top.len() || right.len() != left.len() {
        return None;
    }
    let (columns, rows) = (bottom.len(), left.len());
    let mut points = outline.points.clone();
    let mut index = vec![0_u32; columns * rows];
    let at = |list: &[u32], k: usize| outline.points[list[k] as usize];
    for row in 0..rows {
        for column in 0..columns {
            index[row * columns + column] = if row == 0 {
                bottom[column]
            } else if row == rows - 1 {
                top[columns - 1 - column]
            } else if column == 0 {
                left[rows - 1 - row]
            } else if column == columns - 1 {
                right[row]
            } else {
                let s = column as f64 / (columns - 1) as f64;
                let t = row as f64 / (rows - 1) as f64;
                // A Coons patch: it follows uneven particles on the sides and is the plain grid when they are even.
                let up = at(bottom, column).lerp(at(top, columns - 1 - column), t);
                let across = at(left, rows - 1 - row).lerp(at(right, row), s);
                let low = at(bottom, 0).lerp(at(bottom, columns - 1), s);
                let high = at(top, columns - 1).lerp(at(top, 0), s);
                points.push(up + across - low.lerp(high, t));
                points.len() as u32 - 1
            };
        }
    }
    let clockwise = outline.is_clockwise();
    let mut elements = Vec::with_capacity((columns - 1) * (rows - 1));
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let first = row * columns + column;
            let corners = [first, first + 1, first + columns + 1, first + columns].map(|k| index[k]);
            elements.push(if clockwise { [corners[0], corners[3], corners[2], corners[1]] } else { corners });
        }
    }
    let even = elements.iter().all(|e| {
        let [low, high] = angle_range(e, &points);
        low > 60.0 && high < 120.0
    });
    let mut places = vec![[0.0; 2]; points.len()];
    for (k, &particle) in index.iter().enumerate() {
        places[particle as usize] = [(k / columns) as f64, (k % columns) as f64];
    }
    even.then(|| FlatMesh::new(points, elements, outline, &places))
}
