//! Triangles as a file gives them, and the clean mesh that is made of them.

use crate::body::size;
use crate::body::sorting::{self, Sorted};
use crate::error::{Fault, Found, Place};
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use toile_scene::Mesh;

/// Triangles as a file gives them. Readers fill it; [`Soup::clean`] makes the mesh.
#[derive(Debug, Default)]
pub(crate) struct Soup {
    /// Positions in the file's unit, all finite.
    pub positions: Vec<DVec3>,
    /// Sum of the file's normals at each position; zero where it gives none.
    pub normals: Vec<DVec3>,
    /// Triangles, indices not checked before [`Soup::check_indices`].
    pub triangles: Vec<[u32; 3]>,
    /// The largest index and where it stands.
    highest: Option<(u32, Place)>,
}

/// The clean mesh with the way back to the vertices of the soup.
#[derive(Debug)]
pub(crate) struct Cleaned {
    /// The clean mesh [m].
    pub mesh: Mesh,
    /// The first vertex of the soup at the place of each vertex of the mesh.
    pub origins: Vec<u32>,
    /// The vertex of the mesh that each vertex of the soup became; `None` where no triangle is left.
    pub kept: Vec<Option<u32>>,
}

impl Soup {
    /// Adds a vertex. NaN, infinity and what f32 cannot hold are refused.
    pub fn push_vertex(&mut self, p: DVec3, place: impl FnOnce() -> Place) -> Result<(), Found> {
        if !p.as_vec3().is_finite() {
            let what = format!("the position ({:?}, {:?}, {:?})", p.x, p.y, p.z);
            return Err(Found::at(place(), Fault::NotFinite(what)));
        }
        self.positions.push(p);
        self.normals.push(DVec3::ZERO);
        Ok(())
    }

    /// Adds a polygon as a fan of triangles.
    pub fn push_polygon(&mut self, corners: &[u32], place: impl Fn() -> Place) {
        if let Some(highest) = corners.iter().max()
            && self.highest.as_ref().is_none_or(|(known, _)| highest > known)
        {
            self.highest = Some((*highest, place()));
        }
        self.triangles.extend(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]));
    }

    /// Refuses indices without a vertex; `first` is the number that the format gives to the first vertex.
    pub fn check_indices(&self, first: i64) -> Result<(), Found> {
        match &self.highest {
            Some((index, place)) if *index as usize >= self.positions.len() => Err(Found::at(
                place.clone(),
                Fault::OutOfRange { what: "vertex", index: i64::from(*index) + first, count: self.positions.len() },
            )),
            _ => Ok(()),
        }
    }

    /// Scales to metres, welds equal positions, drops what has no area or is no part of the body, turns the outside out, and
    /// gives every vertex a normal. What had to be mended is added to the warnings.
    pub fn clean(self, metres_per_unit: f64, warnings: &mut Vec<String>) -> Result<Cleaned, Found> {
        size::check_unit(&self, metres_per_unit)?;
        let file_vertex_count = self.positions.len();
        let Welded { mut positions, mut normals, remap } = self.welded(metres_per_unit)?;
        let mut triangles: Vec<[u32; 3]> = self.triangles.iter().map(|t| t.map(|i| remap[i as usize])).collect();

        let before = triangles.len();
        triangles.retain(|t| has_area(&positions, *t));
        warn(warnings, before - triangles.len(), "degenerate triangles removed");
        let before = triangles.len();
        remove_duplicates(&mut triangles);
        warn(warnings, before - triangles.len(), "duplicated triangles removed");
        if triangles.is_empty() {
            return Err(Fault::Empty(file_vertex_count).into());
        }
        warn(warnings, isolated_count(positions.len(), &triangles), "isolated vertices removed");
        let Sorted { turned_count, left_out } = sorting::sort_out(&positions, &mut triangles);
        warnings.extend(left_out);
        let renumbered = remove_isolated(&mut positions, &mut normals, &mut triangles);
        let kept: Vec<Option<u32>> = remap.iter().map(|welded| renumbered[*welded as usize]).collect();
        let mut origins = vec![u32::MAX; positions.len()];
        for (vertex, kept) in kept.iter().enumerate().rev() {
            if let Some(kept) = kept {
                origins[*kept as usize] = vertex as u32;
            }
        }

        let edges = EdgeCounts::of(&triangles);
        warn(warnings, edges.boundary, "boundary edges (the body has holes)");
        warn(warnings, edges.non_manifold, "non-manifold edges (shared by more than two triangles)");
        warn(warnings, edges.opposed, "edges whose two triangles face opposite ways");

        warn(warnings, turned_count, "triangles that faced inward turned over");

        let mut mesh = Mesh { positions, normals: Vec::new(), triangles };
        mesh.normals = mesh.area_weighted_normals();
        let replaced = take_good_normals(&mut mesh.normals, &normals);
        warn(warnings, replaced, "normals replaced (missing, not finite or against the winding)");
        Ok(Cleaned { mesh, origins, kept })
    }

    fn welded(&self, metres_per_unit: f64) -> Result<Welded, Found> {
        let mut known = HashMap::with_capacity(self.positions.len());
        let mut positions = Vec::with_capacity(self.positions.len());
        let mut normals: Vec<DVec3> = Vec::with_capacity(self.positions.len());
        let mut remap = Vec::with_capacity(self.positions.len());
        for (position, normal) in self.positions.iter().zip(&self.normals) {
            // Adding zero makes −0 equal to +0 in bits.
            let p = (*position * metres_per_unit).as_vec3() + Vec3::ZERO;
            if !p.is_finite() {
                let what = format!("the position ({:?}, {:?}, {:?}) m", p.x, p.y, p.z);
                return Err(Fault::NotFinite(what).into());
            }
            let index = *known.entry(p.to_array().map(f32::to_bits)).or_insert_with(|| {
                positions.push(p);
                normals.push(DVec3::ZERO);
                positions.len() as u32 - 1
            });
            normals[index as usize] += *normal;
            remap.push(index);
        }
        Ok(Welded { positions, normals, remap })
    }
}

fn warn(warnings: &mut Vec<String>, count: usize, what: &str) {
    if count > 0 {
        warnings.push(format!("{what}: {count}"));
    }
}

/// A soup without equal positions.
struct Welded {
    /// Distinct positions [m].
    positions: Vec<Vec3>,
    /// Sums of their normals.
    normals: Vec<DVec3>,
    /// The new index of each old vertex.
    remap: Vec<u32>,
}

fn has_area(positions: &[Vec3], triangle: [u32; 3]) -> bool {
    let [a, b, c] = triangle.map(|i| positions[i as usize].as_dvec3());
    (b - a).cross(c - a) != DVec3::ZERO
}

fn remove_duplicates(triangles: &mut Vec<[u32; 3]>) {
    let sorted = |mut t: [u32; 3]| {
        t.sort_unstable();
        t
    };
    let mut order: Vec<([u32; 3], u32)> = triangles.iter().zip(0..).map(|(t, i)| (sorted(*t), i)).collect();
    order.sort_unstable();
    order.dedup_by_key(|(corners, _)| *corners);
    if order.len() < triangles.len() {
        let mut kept: Vec<u32> = order.into_iter().map(|(_, i)| i).collect();
        kept.sort_unstable();
        *triangles = kept.into_iter().map(|i| triangles[i as usize]).collect();
    }
}

fn isolated_count(vertex_count: usize, triangles: &[[u32; 3]]) -> usize {
    let mut used = vec![false; vertex_count];
    triangles.iter().flatten().for_each(|i| used[*i as usize] = true);
    used.iter().filter(|used| !**used).count()
}

/// Removes vertices of no triangle: a stray point would enlarge the maps. Returns the new index of each vertex.
fn remove_isolated(
    positions: &mut Vec<Vec3>,
    normals: &mut Vec<DVec3>,
    triangles: &mut [[u32; 3]],
) -> Vec<Option<u32>> {
    let mut used = vec![false; positions.len()];
    triangles.iter().flatten().for_each(|i| used[*i as usize] = true);
    let mut flags = used.iter();
    positions.retain(|_| *flags.next().expect("one flag per vertex"));
    let mut flags = used.iter();
    normals.retain(|_| *flags.next().expect("one flag per vertex"));
    let mut next = 0..;
    let renumbered: Vec<Option<u32>> = used.into_iter().map(|used| used.then(|| next.next()).flatten()).collect();
    triangles.iter_mut().flatten().for_each(|i| *i = renumbered[*i as usize].expect("a used vertex"));
    renumbered
}

/// What is unusual about the edges of a mesh.
struct EdgeCounts {
    boundary: usize,
    non_manifold: usize,
    opposed: usize,
}

impl EdgeCounts {
    fn of(triangles: &[[u32; 3]]) -> Self {
        // The direction is the lowest bit, so that sorting brings the sides of an edge together.
        let mut keys: Vec<(u64, bool)> = triangles
            .iter()
            .flat_map(|[a, b, c]| [(*a, *b), (*b, *c), (*c, *a)])
            .map(|(a, b)| ((u64::from(a.min(b)) << 32) | u64::from(a.max(b)), a < b))
            .collect();
        keys.sort_unstable();
        let mut counts = Self { boundary: 0, non_manifold: 0, opposed: 0 };
        for sides in keys.chunk_by(|a, b| a.0 == b.0) {
            match sides {
                [_] => counts.boundary += 1,
                [a, b] => counts.opposed += usize::from(a.1 == b.1),
                _ => counts.non_manifold += 1,
            }
        }
        counts
    }
}

/// Puts the file's normals over the computed ones where they are usable; returns how many of a file that has normals
/// are not.
fn take_good_normals(computed: &mut [Vec3], given: &[DVec3]) -> usize {
    if given.iter().all(|n| *n == DVec3::ZERO) {
        return 0;
    }
    let mut replaced = 0;
    for (normal, given) in computed.iter_mut().zip(given) {
        match given.try_normalize().map(DVec3::as_vec3) {
            Some(given) if given.dot(*normal) > 0.0 => *normal = given,
            _ => replaced += 1,
        }
    }
    replaced
}
