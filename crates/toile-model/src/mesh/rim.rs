//! The irregular part of a panel: triangles and quads between the outline and the lattice.

use crate::NO_CORNER;
use crate::mesh::flat_mesh::FlatMesh;
use crate::mesh::geometry::angle_range;
use crate::mesh::lattice::Lattice;
use crate::mesh::outline::Outline;
use crate::mesh::smoothing::smooth;
use glam::DVec2;
use spade::handles::FixedFaceHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::collections::{HashSet, VecDeque};

/// Two triangles become a quad when no inner angle of it is farther from 90° than this [degrees].
const QUAD_TOLERANCE: f64 = 50.0;

/// Rounds of moving the lattice particles next to the rim and triangulating anew; fewer when none moves any more.
const ROUNDS: u32 = 4;

/// The mesh of a panel of any outline: lattice cells, and a constrained Delaunay triangulation between them and the outline.
/// `None` when the triangulation does not follow the outline.
pub(crate) fn mesh(outline: &Outline, spacing: f64) -> Option<FlatMesh> {
    let lattice = Lattice::new(&outline.points, spacing);
    let outline_count = outline.points.len() as u32;
    let cells: Vec<[u32; 4]> = lattice.cells().iter().map(|c| c.map(|i| i + outline_count)).collect();
    let mut points: Vec<DVec2> = outline.points.iter().chain(&lattice.points).copied().collect();

    let mut cell_counts = vec![0_u8; points.len()];
    for &corner in cells.iter().flatten() {
        cell_counts[corner as usize] += 1;
    }
    let rim: Vec<u32> = (0..points.len() as u32).filter(|&i| cell_counts[i as usize] < 4).collect();
    let boundary: Vec<[u32; 2]> = (0..outline_count).map(|i| [i, (i + 1) % outline_count]).collect();
    let core = core_sides(&cells);

    let mut triangles = triangulate(&points, &rim, &boundary, &core)?;
    for _ in 0..ROUNDS {
        let rim_cells = cells.iter().filter(|c| c.iter().any(|&i| cell_counts[i as usize] < 4)).copied();
        let elements: Vec<[u32; 4]> =
            rim_cells.chain(triangles.iter().map(|&[a, b, c]| [a, b, c, NO_CORNER])).collect();
        if !smooth(&mut points, &elements, &rim[outline_count as usize..], spacing) {
            break;
        }
        triangles = triangulate(&points, &rim, &boundary, &core)?;
    }
    let elements = cells.into_iter().chain(paired(&points, &triangles)).collect();
    let places: Vec<[f64; 2]> = points.iter().map(|p| [lattice.row(*p), p.x]).collect();
    Some(FlatMesh::new(points, elements, outline, &places))
}

/// Sides that belong to one cell only.
fn core_sides(cells: &[[u32; 4]]) -> Vec<[u32; 2]> {
    let mut sides: Vec<[u32; 2]> = cells.iter().flat_map(|c| (0..4).map(|k| ordered(c[k], c[(k + 1) % 4]))).collect();
    sides.sort_unstable();
    sides.chunk_by(|a, b| a == b).filter(|group| group.len() == 1).map(|group| group[0]).collect()
}

fn ordered(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Where a triangle lies.
#[derive(Clone, Copy, PartialEq)]
enum Region {
    Outside,
    Rim,
    Core,
}

/// Counter-clockwise triangles between the outline and the lattice cells. `None` when a side of either is missing.
fn triangulate(points: &[DVec2], rim: &[u32], boundary: &[[u32; 2]], core: &[[u32; 2]]) -> Option<Vec<[u32; 3]>> {
    let mut local = vec![0_usize; points.len()];
    for (k, &i) in rim.iter().enumerate() {
        local[i as usize] = k;
    }
    let vertices = rim.iter().map(|&i| Point2::new(points[i as usize].x, points[i as usize].y)).collect();
    let constraints = boundary.iter().chain(core).map(|side| side.map(|i| local[i as usize])).collect();
    let mut conflicts = 0;
    let triangulation: ConstrainedDelaunayTriangulation<Point2<f64>> =
        ConstrainedDelaunayTriangulation::try_bulk_load_cdt(vertices, constraints, |_| conflicts += 1).ok()?;
    // More constraints than sides: a particle lies on a side of the outline and split it.
    if conflicts > 0
        || triangulation.num_vertices() != rim.len()
        || triangulation.num_constraints() != boundary.len() + core.len()
    {
        return None;
    }
    let outline: HashSet<[u32; 2]> = boundary.iter().map(|&[a, b]| ordered(a, b)).collect();
    let side = |[a, b]: [usize; 2]| ordered(rim[a], rim[b]);
    let mut regions: Vec<Option<Region>> = vec![None; triangulation.num_all_faces()];
    let mut queue: VecDeque<(FixedFaceHandle<_>, Region)> =
        VecDeque::from([(triangulation.outer_face().fix(), Region::Outside)]);
    regions[0] = Some(Region::Outside);
    while let Some((face, region)) = queue.pop_front() {
        let face = triangulation.face(face);
        let edges: Vec<_> = match face.as_inner() {
            Some(inner) => inner.adjacent_edges().to_vec(),
            None => triangulation.convex_hull().collect(),
        };
        for edge in edges {
            let neighbour = edge.rev().face();
            if regions[neighbour.index()].is_some() {
                continue;
            }
            let next = if !edge.is_constraint_edge() {
                region
            } else if outline.contains(&side([edge.from().index(), edge.to().index()])) {
                if region == Region::Outside { Region::Rim } else { Region::Outside }
            } else if region == Region::Rim {
                Region::Core
            } else {
                Region::Rim
            };
            regions[neighbour.index()] = Some(next);
            queue.push_back((neighbour.fix(), next));
        }
    }
    let triangles = triangulation
        .inner_faces()
        .filter(|f| regions[f.index()] == Some(Region::Rim))
        .map(|f| f.vertices().map(|v| rim[v.index()]))
        .collect();
    Some(triangles)
}

/// Triangles merged in pairs into well-shaped quads, the best first; the rest stay triangles.
fn paired(points: &[DVec2], triangles: &[[u32; 3]]) -> Vec<[u32; 4]> {
    let mut sides: Vec<([u32; 2], u32, u32)> = triangles
        .iter()
        .enumerate()
        .flat_map(|(t, c)| (0..3).map(move |k| (ordered(c[k], c[(k + 1) % 3]), t as u32, c[(k + 2) % 3])))
        .collect();
    sides.sort_unstable();
    let mut candidates: Vec<(f64, [u32; 2], [u32; 4])> = sides
        .windows(2)
        .filter(|pair| pair[0].0 == pair[1].0)
        .filter_map(|pair| {
            let ([_, one, tip], [_, other, opposite]) = ([0, pair[0].1, pair[0].2], [0, pair[1].1, pair[1].2]);
            let corners = triangles[one as usize];
            let k = corners.iter().position(|&c| c == tip)?;
            let quad = [tip, corners[(k + 1) % 3], opposite, corners[(k + 2) % 3]];
            let [low, high] = angle_range(&quad, points);
            let deviation = (90.0 - low).max(high - 90.0);
            (deviation <= QUAD_TOLERANCE).then_some((deviation, [one, other], quad))
        })
        .collect();
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut used = vec![false; triangles.len()];
    let mut elements = Vec::new();
    for (_, pair, quad) in candidates {
        if pair.iter().all(|&t| !used[t as usize]) {
            pair.iter().for_each(|&t| used[t as usize] = true);
            elements.push(quad);
        }
    }
    let left = triangles.iter().zip(&used).filter(|(_, used)| !**used);
    elements.extend(left.map(|(&[a, b, c], _)| [a, b, c, NO_CORNER]));
    elements
}
