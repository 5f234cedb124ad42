//! What of a mesh is the body: each piece is turned outside out by itself, and floors, backdrops and specks are left out.

use crate::body::fused_floor;
use crate::body::pieces::{Measure, Pieces, measure};
use crate::error::rounded;
use glam::{DVec3, I64Vec3, Vec3};
use std::collections::HashSet;

/// Area of a sheet over the square of the body's length [1], below which it stays: hair, a scarf.
pub(crate) const SHEET_AREA: f64 = 0.07;

/// Part of the body's length by which a sheet must stick out of the box around the body to be no clothing.
pub(crate) const BEYOND: f64 = 0.1;

/// Thickness over length [1] below which a closed piece is a slab, as a turntable is.
const SLAB: f64 = 0.08;

/// Width of a slab over the length of the body [1] below which it stays: a sole, a hat.
const SLAB_WIDTH: f64 = 0.3;

/// Area of a body over the square of its length [1]. Persons have twice as much; the leg of a table, which has a slab on it, less.
pub(crate) const LEAST_AREA: f64 = 0.3;

/// Length of a speck over that of the body [1].
const SPECK: f64 = 0.03;

/// Distance of a speck over the length of the body [1]. What is nearer is a nail, a lash or a button.
const SPECK_DISTANCE: f64 = 0.03;

/// What was done to the pieces.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Sorted {
    /// Number of triangles that were turned over.
    pub turned_count: usize,
    /// What was left out, in sentences.
    pub left_out: Vec<String>,
}

/// Turns every piece outside out and removes floors, backdrops and specks. Triangles keep their order.
///
/// A piece is what hangs together by edges that two triangles share.
pub(crate) fn sort_out(positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) -> Sorted {
    let mut sorted = Sorted::default();
    let (mut pieces, mut measures) = measured(positions, triangles);
    if let Some(floor) = fused_floor::cut_off(positions, triangles, &pieces, &measures) {
        let [length, width] = floor.sides.map(rounded);
        sorted.left_out.push(format!(
            "floor that is one piece with the body cut off: {} of {length} m by {width} m",
            count("triangle", floor.triangle_count)
        ));
        (pieces, measures) = measured(positions, triangles);
    }
    let kinds = kinds(positions, triangles, &pieces, &measures);
    sorted.left_out.extend(sentences(&kinds, &measures));
    let mut of_triangles = pieces.of_triangle.iter().zip(&pieces.is_against);
    triangles.retain_mut(|triangle| {
        let (piece, is_against) = of_triangles.next().expect("a piece for each triangle");
        let piece = *piece as usize;
        if kinds[piece] != Kind::Part {
            return false;
        }
        if *is_against != measures[piece].is_inward() {
            triangle.swap(1, 2);
            sorted.turned_count += 1;
        }
        true
    });
    sorted
}

fn measured(positions: &[Vec3], triangles: &[[u32; 3]]) -> (Pieces, Vec<Measure>) {
    let pieces = Pieces::of(triangles);
    let measures = measure(positions, triangles, &pieces);
    (pieces, measures)
}

/// What a piece is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Part,
    Backdrop,
    Speck,
}

/// What each piece is, seen from the largest one that is neither a sheet nor a slab; without one all are parts.
fn kinds(positions: &[Vec3], triangles: &[[u32; 3]], pieces: &Pieces, measures: &[Measure]) -> Vec<Kind> {
    let mut kinds = vec![Kind::Part; measures.len()];
    let is_slab = |measure: &Measure| {
        let [thickness, _, length] = measure.extents();
        thickness < SLAB * length
    };
    let solid = |measure: &&Measure| !measure.is_sheet() && !is_slab(measure);
    let body = measures.iter().filter(solid).max_by(|a, b| a.area.total_cmp(&b.area));
    let Some(body) = body.filter(|body| body.area > LEAST_AREA * body.length().powi(2)) else { return kinds };
    let length = body.length();
    for (kind, measure) in kinds.iter_mut().zip(measures) {
        let sticks_out = (body.low - measure.low).max(measure.high - body.high).max_element() > BEYOND * length;
        let is_sheet = measure.is_sheet() && measure.area > SHEET_AREA * length * length && sticks_out;
        let stands_beside =
            (body.low - measure.high).max(measure.low - body.high).max_element() > -0.5 * BEYOND * length;
        let is_pedestal = is_slab(measure) && measure.extents()[1] > SLAB_WIDTH * length && stands_beside;
        if is_sheet || is_pedestal {
            *kind = Kind::Backdrop;
        } else if measure.length() < SPECK * length {
            *kind = Kind::Speck;
        }
    }
    if kinds.contains(&Kind::Speck) {
        keep_near(positions, triangles, pieces, &mut kinds, SPECK_DISTANCE * length);
    }
    kinds
}

/// Makes parts of the specks that have a vertex near one of another part [m].
fn keep_near(positions: &[Vec3], triangles: &[[u32; 3]], pieces: &Pieces, kinds: &mut [Kind], distance: f64) {
    // Far beyond all that has a size; sums of whole numbers must not run over.
    const FARTHEST: DVec3 = DVec3::splat(1e15);
    let cell = |vertex: u32| {
        (positions[vertex as usize].as_dvec3() / distance).floor().clamp(-FARTHEST, FARTHEST).as_i64vec3()
    };
    let of_kind = |kinds: &[Kind], kind: Kind| -> Vec<(u32, u32)> {
        let of_triangles =
            triangles.iter().zip(&pieces.of_triangle).filter(|(_, piece)| kinds[**piece as usize] == kind);
        of_triangles.flat_map(|(corners, piece)| corners.map(|corner| (corner, *piece))).collect()
    };
    let near: HashSet<I64Vec3> = of_kind(kinds, Kind::Part).into_iter().map(|(vertex, _)| cell(vertex)).collect();
    for (vertex, piece) in of_kind(kinds, Kind::Speck) {
        let at = cell(vertex);
        let around = (0..27).map(|i| at + I64Vec3::new(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
        if around.into_iter().any(|cell| near.contains(&cell)) {
            kinds[piece as usize] = Kind::Part;
        }
    }
}

/// What is left out, in sentences.
fn sentences(kinds: &[Kind], measures: &[Measure]) -> Vec<String> {
    let of_kind = |kind: Kind| -> Vec<&Measure> {
        kinds.iter().zip(measures).filter(|(is, _)| **is == kind).map(|(_, measure)| measure).collect()
    };
    let triangle_count = |measures: &[&Measure]| measures.iter().map(|measure| measure.triangle_count).sum::<usize>();
    let mut sentences = Vec::new();
    let backdrops = of_kind(Kind::Backdrop);
    if let Some(largest) = backdrops.iter().max_by(|a, b| a.area.total_cmp(&b.area)) {
        let [_, width, length] = largest.extents().map(rounded);
        sentences.push(format!(
            "floor or backdrop left out: {} of {}, the largest {length} m by {width} m",
            count("piece", backdrops.len()),
            count("triangle", triangle_count(&backdrops))
        ));
    }
    let specks = of_kind(Kind::Speck);
    if !specks.is_empty() {
        let pieces = count("piece", specks.len());
        let triangles = count("triangle", triangle_count(&specks));
        sentences.push(format!("specks far from the body left out: {pieces} of {triangles}"));
    }
    sentences
}

fn count(what: &str, count: usize) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}

#[cfg(test)]
mod tests {
    use super::{Sorted, sort_out};
    use glam::{DVec3, Quat, Vec3, vec3};
    use std::f32::consts::{PI, TAU};

    /// Positions and triangles.
    #[derive(Clone, Default)]
    struct Pile {
        positions: Vec<Vec3>,
        triangles: Vec<[u32; 3]>,
    }

    impl Pile {
        /// Adds a lattice of points, each given by its row and column as parts of the whole.
        fn add(&mut self, [rows, columns]: [u32; 2], point: impl Fn(f32, f32) -> Vec3) -> &mut Self {
            let first = self.positions.len() as u32;
            for row in 0..=rows {
                for column in 0..=columns {
                    self.positions.push(point(row as f32 / rows as f32, column as f32 / columns as f32));
                }
            }
            let at = |row: u32, column: u32| first + row * (columns + 1) + column;
            for row in 0..rows {
                for column in 0..columns {
                    let [a, b] = [at(row, column), at(row, column + 1)];
                    let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
                    self.triangles.extend([[a, c, b], [b, c, d]]);
                }
            }
            self
        }

        /// A closed ellipsoid, outside out.
        fn ball(&mut self, centre: Vec3, radii: Vec3) -> &mut Self {
            self.add([12, 16], |row, column| {
                let ((sin, cos), (east, north)) = ((PI * row).sin_cos(), (TAU * column).sin_cos());
                centre + radii * vec3(sin * east, cos, sin * north)
            })
        }

        /// A rectangle from its corner.
        fn sheet(&mut self, corner: Vec3, right: Vec3, down: Vec3) -> &mut Self {
            self.add([5, 5], |row, column| corner + column * right + row * down)
        }

        /// Welds equal places and turns over the triangles of a range.
        fn welded(&self, turned: std::ops::Range<usize>) -> (Vec<Vec3>, Vec<[u32; 3]>) {
            let place = |p: Vec3| (p * 1e4).round().as_ivec3();
            let mut places = std::collections::HashMap::new();
            let mut positions = Vec::new();
            let mut index = |vertex: u32| {
                let p = self.positions[vertex as usize];
                *places.entry(place(p)).or_insert_with(|| {
                    positions.push(p);
                    positions.len() as u32 - 1
                })
            };
            let mut triangles: Vec<[u32; 3]> = self.triangles.iter().map(|t| t.map(&mut index)).collect();
            triangles[turned].iter_mut().for_each(|triangle| triangle.swap(0, 1));
            triangles.retain(|[a, b, c]| a != b && b != c && c != a);
            (positions, triangles)
        }
    }

    const BODY: Vec3 = vec3(0.3, 0.85, 0.2);

    fn body() -> Pile {
        let mut pile = Pile::default();
        pile.ball(Vec3::Y * 0.85, BODY);
        pile
    }

    /// What is left of a pile, and what was done.
    fn sorted(pile: &Pile, turned: std::ops::Range<usize>) -> (Vec<[u32; 3]>, Vec<Vec3>, Sorted) {
        let (positions, mut triangles) = pile.welded(turned);
        let sorted = sort_out(&positions, &mut triangles);
        (triangles, positions, sorted)
    }

    fn volume(triangles: &[[u32; 3]], positions: &[Vec3]) -> f64 {
        let volume = |t: &[u32; 3]| {
            let [a, b, c]: [DVec3; 3] = t.map(|corner| positions[corner as usize].as_dvec3());
            a.dot(b.cross(c)) / 6.0
        };
        triangles.iter().map(volume).sum()
    }

    #[test]
    fn each_piece_is_turned_by_itself() {
        let mut pile = body();
        let count = pile.triangles.len();
        pile.ball(vec3(0.0, 2.0, 0.0), Vec3::splat(0.2)).ball(vec3(0.0, 0.9, 0.0), Vec3::splat(0.05));
        let whole = {
            let (triangles, positions, done) = sorted(&pile, 0..0);
            assert_eq!(done, Sorted::default());
            volume(&triangles, &positions)
        };
        // The body, the ball over it, the one within it, and a part of one.
        for turned in [0..count, count..2 * count, 2 * count..3 * count, 100..160] {
            let (triangles, positions, done) = sorted(&pile, turned);
            assert!(done.turned_count > 0 && done.left_out.is_empty(), "{done:?}");
            assert!((volume(&triangles, &positions) - whole).abs() < 1e-9);
        }
    }

    #[test]
    fn floors_and_backdrops_are_left_out() {
        let (alone, _, _) = sorted(&body(), 0..0);
        fn wall(pile: &mut Pile) -> &mut Pile {
            pile.add([16, 4], |row, column| {
                let angle = (PI * row).min(0.5 * PI);
                let up = if row < 0.5 { Vec3::ZERO } else { Vec3::Y * (row - 0.5) * 5.0 };
                vec3(2.0 * column - 1.0, 0.4 - 0.4 * angle.cos(), -0.8 - 0.4 * angle.sin()) + up
            })
        }
        let tilt = Quat::from_rotation_x(0.4) * Quat::from_rotation_z(0.7);
        let backdrops: [&dyn for<'a> Fn(&'a mut Pile) -> &'a mut Pile; 6] = [
            &|pile| pile.sheet(vec3(-2.0, 0.0, -2.0), Vec3::X * 4.0, Vec3::Z * 4.0),
            // As small as a mat, seen from below.
            &|pile| pile.sheet(vec3(-0.3, 0.0, -0.3), Vec3::Z * 0.6, Vec3::X * 0.6),
            &|pile| pile.sheet(vec3(-1.0, 2.0, -1.0), Vec3::X * 2.0, Vec3::NEG_Y * 2.0),
            &|pile| wall(pile),
            &|pile| pile.ball(vec3(0.0, -0.025, 0.0), vec3(0.6, 0.02, 0.6)),
            &|pile| {
                pile.sheet(vec3(-2.0, 0.0, -2.0), Vec3::X * 4.0, Vec3::Z * 4.0);
                pile.positions.iter_mut().for_each(|p| *p = tilt * *p);
                pile
            },
        ];
        for (number, add) in backdrops.iter().enumerate() {
            let mut pile = body();
            add(&mut pile);
            let (triangles, _, done) = sorted(&pile, 0..0);
            assert_eq!(triangles.len(), alone.len(), "{number}");
            assert_eq!(done.turned_count, 0, "{number}");
            assert!(
                done.left_out.len() == 1 && done.left_out[0].starts_with("floor or backdrop left out: 1 piece"),
                "{done:?}"
            );
        }
    }

    #[test]
    fn what_is_worn_or_is_a_thing_of_its_own_stays() {
        let kept: [&dyn for<'a> Fn(&'a mut Pile) -> &'a mut Pile; 6] = [
            // A skirt, open above and below; a cape; a hat; a tray; a head apart from its trunk; two soles.
            &|pile| {
                pile.add([6, 16], |row, column| {
                    let (sin, cos) = (TAU * column).sin_cos();
                    vec3((0.35 + 0.2 * row) * sin, 1.0 - 0.6 * row, (0.3 + 0.2 * row) * cos)
                })
            },
            &|pile| {
                pile.add([6, 8], |row, column| {
                    let (sin, cos) = (PI * (column + 0.5)).sin_cos();
                    vec3(0.35 * sin, 1.4 - row, 0.3 * cos)
                })
            },
            &|pile| pile.ball(vec3(0.0, 1.75, 0.0), vec3(0.25, 0.015, 0.25)),
            &|pile| pile.ball(vec3(0.0, 0.9, 0.0), vec3(0.55, 0.02, 0.55)),
            &|pile| pile.ball(vec3(0.0, 1.95, 0.0), vec3(0.1, 0.13, 0.12)),
            &|pile| {
                pile.ball(vec3(0.1, 0.0, 0.0), vec3(0.05, 0.008, 0.14))
                    .ball(vec3(-0.1, 0.0, 0.0), vec3(0.05, 0.008, 0.14))
            },
        ];
        for (number, add) in kept.iter().enumerate() {
            let mut pile = body();
            add(&mut pile);
            let (_, triangles) = pile.welded(0..0);
            let (left, _, done) = sorted(&pile, 0..0);
            assert_eq!((left.len(), done.left_out.len()), (triangles.len(), 0), "{number}");
        }
        // A sheet alone, a box on its table, a table of a slab and four legs.
        let mut alone = Pile::default();
        alone.sheet(Vec3::ZERO, Vec3::X, Vec3::Z);
        let mut table = Pile::default();
        table.ball(vec3(0.0, 0.72, 0.0), vec3(0.8, 0.02, 0.5));
        for x in [-0.6, 0.6] {
            for z in [-0.3, 0.3] {
                table.ball(vec3(x, 0.35, z), vec3(0.03, 0.35, 0.03));
            }
        }
        for pile in [alone, table] {
            let (_, triangles) = pile.welded(0..0);
            let (left, _, done) = sorted(&pile, 0..0);
            assert_eq!((left.len(), done), (triangles.len(), Sorted::default()));
        }
    }

    #[test]
    fn specks_are_left_out_and_nails_stay() {
        let mut pile = body();
        let count = pile.triangles.len();
        pile.ball(vec3(0.0, 0.0, 0.0), Vec3::splat(0.01)).ball(vec3(0.31, 0.85, 0.0), Vec3::splat(0.005));
        let (left, _, done) = sorted(&pile, 0..0);
        assert!(done.left_out.is_empty() && left.len() > count, "{done:?}");
        let (alone, _, _) = sorted(&body(), 0..0);
        for (at, size) in [(vec3(0.6, 0.4, 0.0), 0.01), (vec3(0.0, 2.5, 1e30), 0.02), (vec3(-9.0, 0.0, 3.0), 0.001)] {
            let mut pile = body();
            pile.positions.extend([at, at + vec3(size, 0.0, 0.0), at + vec3(0.0, size, 0.0)]);
            let first = pile.positions.len() as u32 - 3;
            pile.triangles.push([first, first + 1, first + 2]);
            let mut triangles = pile.triangles.clone();
            let done = sort_out(&pile.positions, &mut triangles);
            // At 1e30 the triangle is a point, and no reader lets it through.
            assert_eq!(done.left_out, ["specks far from the body left out: 1 piece of 1 triangle"], "{at}");
            assert!(triangles.len() >= alone.len());
        }
    }
}
