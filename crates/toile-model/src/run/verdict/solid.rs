//! A body as a solid: whether a point is inside it, and how far its surface is.

use crate::union_find::UnionFind;
use glam::{DVec3, Vec3};
use std::collections::{BTreeMap, HashMap};
use std::f64::consts::TAU;
use toile_scene::Mesh;

/// A part of a mesh whose area, added up with its directions, is more than this part of its plain area encloses nothing [1]: 0 for a closed
/// surface, 1 for a flat sheet, 1/2 for half a ball.
const SHEET: f64 = 0.25;
/// Triangles of a leaf.
const LEAF: usize = 8;
/// A group of triangles answers as one where it is farther than this many times its radius. Its error is then below 1 % of a turn.
const FAR: f64 = 2.0;

/// A body as a solid, in f64.
///
/// A point is inside where the surfaces go around it by more than half a turn (generalised winding number: Jacobson 2013, in groups as Barill
/// 2018). Holes blur the border beside them and nothing else; parts that overlap count once. Each connected part is turned outward by its
/// volume, and open sheets, which have no inside, are left out.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    triangles: Vec<[DVec3; 3]>,
    nodes: Vec<Node>,
}

/// Triangles that lie together.
#[derive(Clone, Debug)]
struct Node {
    low: DVec3,
    high: DVec3,
    /// Mean of the triangles by area.
    middle: DVec3,
    /// Of a ball around it that holds them.
    radius: f64,
    /// Sum of their areas with their directions [m²].
    area: DVec3,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    Leaf { first: usize, count: usize },
    Fork([usize; 2]),
}

impl Solid {
    /// Meshes as one solid; without triangles nothing is inside.
    pub fn of<'a>(meshes: impl IntoIterator<Item = &'a Mesh>) -> Self {
        let triangles = meshes.into_iter().flat_map(solid_parts).collect();
        let mut solid = Self { triangles, nodes: Vec::new() };
        if !solid.triangles.is_empty() {
            solid.grow(0, solid.triangles.len());
        }
        solid
    }

    /// Whether a point [m] is inside.
    pub fn holds(&self, point: DVec3) -> bool {
        self.winding(point) > 0.5
    }

    /// Distance of a point from the surface [m]; infinite without one.
    pub fn distance(&self, point: DVec3) -> f64 {
        let mut nearest = f64::INFINITY;
        let mut open: Vec<usize> = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            if node.distance_squared(point) >= nearest {
                continue;
            }
            match node.kind {
                Kind::Leaf { first, count } => {
                    let squared = |triangle: &[DVec3; 3]| nearest_point(triangle, point).distance_squared(point);
                    nearest = self.triangles[first..first + count].iter().map(squared).fold(nearest, f64::min);
                }
                Kind::Fork([one, other]) => {
                    let [a, b] = [one, other].map(|child| self.nodes[child].distance_squared(point));
                    // The nearer one is looked at first.
                    open.extend(if a < b { [other, one] } else { [one, other] });
                }
            }
        }
        nearest.sqrt()
    }

    /// How often the surfaces go around a point [1].
    fn winding(&self, point: DVec3) -> f64 {
        let mut angle = 0.0;
        let mut open: Vec<usize> = if self.nodes.is_empty() { Vec::new() } else { vec![0] };
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            let way = node.middle - point;
            let distance = way.length();
            if distance > FAR * node.radius {
                angle += node.area.dot(way) / distance.powi(3);
                continue;
            }
            match node.kind {
                Kind::Leaf { first, count } => {
                    let seen = |triangle: &[DVec3; 3]| solid_angle(triangle.map(|corner| corner - point));
                    angle += self.triangles[first..first + count].iter().map(seen).sum::<f64>();
                }
                Kind::Fork(children) => open.extend(children),
            }
        }
        angle / (2.0 * TAU)
    }

    /// Makes a node of some triangles, which it sorts; its index.
    fn grow(&mut self, first: usize, count: usize) -> usize {
        let triangles = &mut self.triangles[first..first + count];
        let corners = || triangles.iter().flatten().copied();
        let low = corners().fold(DVec3::INFINITY, DVec3::min);
        let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        let [mut area, mut moment, mut plain] = [DVec3::ZERO, DVec3::ZERO, DVec3::ZERO];
        for triangle in triangles.iter() {
            let own = area_of(triangle);
            area += own;
            moment += own.length() * centre(triangle);
            plain.x += own.length();
        }
        let middle = if plain.x > 0.0 { moment / plain.x } else { low.midpoint(high) };
        let radius = corners().map(|corner| corner.distance(middle)).fold(0.0, f64::max);
        let index = self.nodes.len();
        let kind = Kind::Leaf { first, count };
        if count > LEAF {
            let size = high - low;
            let axis = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().max_by(|a, b| a.dot(size).total_cmp(&b.dot(size)));
            let axis = axis.unwrap_or(DVec3::X);
            let along = |triangle: &[DVec3; 3]| centre(triangle).dot(axis);
            triangles.select_nth_unstable_by(count / 2, |a, b| along(a).total_cmp(&along(b)));
        }
        self.nodes.push(Node { low, high, middle, radius, area, kind });
        if count > LEAF {
            let one = self.grow(first, count / 2);
            let other = self.grow(first + count / 2, count - count / 2);
            self.nodes[index].kind = Kind::Fork([one, other]);
        }
        index
    }
}

impl Node {
    fn distance_squared(&self, point: DVec3) -> f64 {
        point.clamp(self.low, self.high).distance_squared(point)
    }
}

/// The triangles of all parts of a mesh that enclose something, facing outward.
fn solid_parts(mesh: &Mesh) -> Vec<[DVec3; 3]> {
    // Vertices at the same place are one: a mesh has several where its texture is cut.
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    let place = |p: &Vec3| (*p + Vec3::ZERO).to_array().map(f32::to_bits);
    let own: Vec<u32> =
        mesh.positions.iter().zip(0..).map(|(p, index)| *known.entry(place(p)).or_insert(index)).collect();
    let mut sets = UnionFind::new(mesh.positions.len());
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| own[vertex as usize]);
        sets.unite(a, b);
        sets.unite(b, c);
    }
    let mut parts: BTreeMap<u32, Vec<[DVec3; 3]>> = BTreeMap::new();
    for triangle in &mesh.triangles {
        let corners = triangle.map(|vertex| mesh.positions[vertex as usize].as_dvec3());
        parts.entry(sets.root(own[triangle[0] as usize])).or_default().push(corners);
    }
    let solid = parts.into_values().filter_map(|mut part| {
        let area: DVec3 = part.iter().map(area_of).sum();
        let plain: f64 = part.iter().map(|triangle| area_of(triangle).length()).sum();
        if area.length() > SHEET * plain {
            return None;
        }
        let middle = part.iter().map(centre).sum::<DVec3>() / part.len() as f64;
        let volume: f64 = part.iter().map(|triangle| area_of(triangle).dot(centre(triangle) - middle)).sum();
        if volume < 0.0 {
            part.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        Some(part)
    });
    solid.flatten().collect()
}

fn area_of([a, b, c]: &[DVec3; 3]) -> DVec3 {
    0.5 * (*b - *a).cross(*c - *a)
}

fn centre([a, b, c]: &[DVec3; 3]) -> DVec3 {
    (*a + *b + *c) / 3.0
}

/// Solid angle of a triangle seen from the origin. Van Oosterom and Strackee 1983, eq. 8.
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let [la, lb, lc] = [a, b, c].map(DVec3::length);
    let spread = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * a.dot(b.cross(c)).atan2(spread)
}

/// The point of a triangle that is nearest to another one. Ericson 2005, §5.1.5.
fn nearest_point(&[a, b, c]: &[DVec3; 3], point: DVec3) -> DVec3 {
    let ([ab, ac], [ap, bp, cp]) = ([b - a, c - a], [a, b, c].map(|corner| point - corner));
    let ([d1, d2], [d3, d4], [d5, d6]) = ([ab.dot(ap), ac.dot(ap)], [ab.dot(bp), ac.dot(bp)], [ab.dot(cp), ac.dot(cp)]);
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    a + ab * (vb / sum) + ac * (vc / sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{dvec3, vec3};

    fn both(one: Mesh, other: Mesh) -> Mesh {
        let mut mesh = one;
        let first = mesh.positions.len() as u32;
        mesh.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|vertex| vertex + first)));
        mesh.positions.extend(other.positions);
        mesh
    }

    fn turned(mut mesh: Mesh) -> Mesh {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        mesh
    }

    #[test]
    fn a_ball_is_as_far_as_its_radius_says() {
        let centre = dvec3(0.5, 1.0, -0.25);
        let ball = Mesh::sphere(centre.as_vec3(), 0.25, 48);
        for solid in [Solid::of([&ball]), Solid::of([&turned(ball.clone())])] {
            for turn in 0..200 {
                let angle = f64::from(turn) * 0.7;
                let direction = dvec3(angle.cos(), (0.37 * angle).sin(), angle.sin()).normalize();
                for radius in [0.01, 0.24, 0.26, 2.0] {
                    let point = centre + radius * direction;
                    assert_eq!(solid.holds(point), radius < 0.25, "{point}");
                    assert!((solid.distance(point) - (radius - 0.25_f64).abs()).abs() < 5e-4, "{point}");
                }
            }
        }
    }

    #[test]
    fn parts_that_overlap_or_face_inward_and_sheets_do_not_fool_it() {
        let one = Mesh::cuboid(Vec3::splat(-0.5), Vec3::splat(0.5));
        let other = turned(Mesh::cuboid(Vec3::splat(-0.25), Vec3::splat(0.75)));
        let mut sheet = Mesh::cuboid(vec3(-2.0, -1.0, -2.0), vec3(2.0, -0.8, 2.0));
        sheet.triangles.truncate(2);
        let solid = Solid::of([&both(both(one, other), sheet.clone())]);
        for inside in [DVec3::ZERO, DVec3::splat(-0.45), DVec3::splat(0.7), DVec3::splat(0.3)] {
            assert!(solid.holds(inside), "{inside}");
        }
        for outside in [dvec3(0.6, -0.4, 0.0), dvec3(0.0, -0.85, 0.0), dvec3(0.0, 0.8, 0.0), dvec3(1.99, 0.0, 0.0)] {
            assert!(!solid.holds(outside), "{outside}");
        }
        let alone = Solid::of([&sheet]);
        assert!(!alone.holds(dvec3(1.999, -0.9, 0.0)) && alone.distance(DVec3::ZERO) == f64::INFINITY);
    }

    #[test]
    fn a_hole_does_not_let_the_inside_out() {
        let mut open = Mesh::cuboid(Vec3::splat(-0.5), Vec3::splat(0.5));
        // The side towards +x is gone.
        open.triangles.retain(|triangle| triangle.iter().any(|vertex| open.positions[*vertex as usize].x < 0.0));
        let solid = Solid::of([&open]);
        assert!(solid.holds(DVec3::ZERO) && solid.holds(dvec3(0.2, 0.3, -0.3)));
        assert!(!solid.holds(dvec3(0.8, 0.0, 0.0)) && !solid.holds(dvec3(-0.6, 0.0, 0.0)));
    }
}
