//! A cut through a mesh at a height, and the rings of skin in it.

use crate::union_find::UnionFind;
use glam::{DMat3, DVec2, DVec3};
use std::collections::{BTreeMap, HashMap};
use toile_scene::Mesh;

/// A mesh whose vertices at one place are one vertex.
pub(crate) struct Skin {
    /// Places [m].
    pub(crate) places: Vec<DVec3>,
    /// Index into `places` of each vertex of the mesh.
    pub(crate) of_vertex: Vec<u32>,
    /// Indices into `places` of the corners of each triangle.
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// One piece of a cut: the outline of a limb, a trunk or a head. Its plane has the axes x and z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Ring {
    /// Enclosed area [m²].
    pub(crate) area: f64,
    /// Centre of the area [m].
    pub(crate) centre: DVec2,
    /// Smallest and largest corner of its box [m].
    pub(crate) bounds: [DVec2; 2],
    /// Mean of xx, xz and zz over the area about the centre [m²].
    pub(crate) spread: [f64; 3],
}

impl Skin {
    /// The surface of a mesh.
    pub(crate) fn of(mesh: &Mesh) -> Self {
        Self::turned(mesh, DMat3::IDENTITY)
    }

    /// The surface of a mesh that is turned.
    pub(crate) fn turned(mesh: &Mesh, turn: DMat3) -> Self {
        let mut places = Vec::new();
        let mut known = HashMap::new();
        let mut index_of = |place: DVec3| {
            *known.entry(place.to_array().map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                places.push(place);
                places.len() as u32 - 1
            })
        };
        let of_vertex: Vec<u32> = mesh.positions.iter().map(|place| index_of(turn * place.as_dvec3())).collect();
        let triangles =
            mesh.triangles.iter().map(|triangle| triangle.map(|vertex| of_vertex[vertex as usize])).collect();
        Self { places, of_vertex, triangles }
    }

    /// Smallest and largest height [m].
    pub(crate) fn heights(&self) -> [f64; 2] {
        let heights = || self.places.iter().map(|place| place.y);
        [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// The rings of a cut at a height [m], the largest first.
    pub(crate) fn rings(&self, height: f64) -> Vec<Ring> {
        let mut numbers: HashMap<[u32; 2], u32> = HashMap::new();
        let mut segments: Vec<([u32; 2], [DVec2; 2])> = Vec::new();
        for triangle in &self.triangles {
            let above = triangle.map(|vertex| self.places[vertex as usize].y >= height);
            if above[0] == above[1] && above[1] == above[2] {
                continue;
            }
            let mut ends = [None; 2];
            for side in 0..3 {
                let [from, to] = [side, (side + 1) % 3];
                if above[from] == above[to] {
                    continue;
                }
                let edge = [triangle[from], triangle[to]];
                let edge = [edge[0].min(edge[1]), edge[0].max(edge[1])];
                let [a, b] = edge.map(|vertex| self.places[vertex as usize]);
                let place = a.lerp(b, (height - a.y) / (b.y - a.y));
                let count = numbers.len() as u32;
                let number = *numbers.entry(edge).or_insert(count);
                // The surface lies on one side of every segment, whichever triangle it comes from.
                ends[usize::from(above[to])] = Some((number, DVec2::new(place.x, place.z)));
            }
            if let [Some((first, from)), Some((second, to))] = ends {
                segments.push(([first, second], [from, to]));
            }
        }
        let mut joined = UnionFind::new(numbers.len());
        for ([first, second], _) in &segments {
            joined.unite(*first, *second);
        }
        let mut outlines: BTreeMap<u32, Vec<[DVec2; 2]>> = BTreeMap::new();
        for ([first, _], ends) in &segments {
            outlines.entry(joined.root(*first)).or_default().push(*ends);
        }
        let mut rings: Vec<Ring> = outlines.values().filter_map(|outline| Ring::of(outline)).collect();
        rings.sort_by(|a, b| b.area.total_cmp(&a.area));
        rings
    }
}

impl Ring {
    /// The ring of an outline's segments; `None` where they enclose nothing.
    fn of(outline: &[[DVec2; 2]]) -> Option<Self> {
        let ends = || outline.iter().flatten().copied();
        let bounds = [ends().reduce(DVec2::min)?, ends().reduce(DVec2::max)?];
        // From within, so that an outline with a gap lacks little.
        let origin = bounds[0].midpoint(bounds[1]);
        let (mut area, mut first, mut second) = (0.0, DVec2::ZERO, [0.0; 3]);
        for [a, b] in outline.iter().map(|ends| ends.map(|end| end - origin)) {
            let twice = a.perp_dot(b);
            area += 0.5 * twice;
            first += twice / 6.0 * (a + b);
            second[0] += twice / 12.0 * (a.x * a.x + a.x * b.x + b.x * b.x);
            second[1] += twice / 24.0 * (2.0 * a.x * a.y + a.x * b.y + b.x * a.y + 2.0 * b.x * b.y);
            second[2] += twice / 12.0 * (a.y * a.y + a.y * b.y + b.y * b.y);
        }
        if area == 0.0 || !area.is_finite() {
            return None;
        }
        let centre = first / area;
        let spread = [
            second[0] / area - centre.x * centre.x,
            second[1] / area - centre.x * centre.y,
            second[2] / area - centre.y * centre.y,
        ];
        Some(Self { area: area.abs(), centre: origin + centre, bounds, spread })
    }
}
