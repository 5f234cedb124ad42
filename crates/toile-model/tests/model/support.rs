//! Garments for the tests, and what holds for every model.

use glam::{DQuat, DVec2, DVec3, dvec2};
use std::collections::{BTreeMap, BTreeSet};
use toile_model::{Model, NO_CORNER, SpringKind};
use toile_scene::{Curve, Edge, EdgeRef, Fabric, Garment, Panel, Placement, Rule, Seam, Settings};

pub fn settings(spacing: f64) -> Settings {
    let mut settings = Settings::new(Fabric::preset("cotton").unwrap());
    settings.spacing = spacing;
    // A rule under which the links keep the stiffness of their springs.
    settings.velocity_modification.rule = Rule::Average;
    // And their rest lengths.
    settings.fabric.bending_rigidity = 0.0;
    settings
}

/// A panel of straight edges through the given points, in the plane z = `depth`.
pub fn polygon(name: &str, points: &[DVec2], depth: f64) -> Panel {
    panel(name, points.iter().map(|&p| (p, Curve::Straight)), depth)
}

pub fn panel(name: &str, edges: impl IntoIterator<Item = (DVec2, Curve)>, depth: f64) -> Panel {
    Panel::new(
        name,
        edges.into_iter().map(|(start, curve)| Edge::new(start, curve)).collect(),
        Placement { rotation: DQuat::IDENTITY, translation: DVec3::new(0.0, 0.0, depth) },
    )
}

pub fn rectangle(name: &str, [width, height]: [f64; 2], depth: f64) -> Panel {
    polygon(name, &[dvec2(0.0, 0.0), dvec2(width, 0.0), dvec2(width, height), dvec2(0.0, height)], depth)
}

pub fn garment(panels: Vec<Panel>, seams: &[([usize; 2], [usize; 2])]) -> Garment {
    let side = |[panel, edge]: [usize; 2]| EdgeRef { panel, edge };
    Garment::new("garment", panels, seams.iter().map(|&(a, b)| Seam::new([side(a), side(b)])).collect())
}

/// Garment of one panel without seams.
pub fn alone(panel: Panel) -> Garment {
    garment(vec![panel], &[])
}

pub fn build(garment: &Garment, spacing: f64) -> Model {
    Model::from_garment(garment, &settings(spacing)).unwrap()
}

pub fn corners(quad: &[u32; 4]) -> &[u32] {
    if quad[3] == NO_CORNER { &quad[..3] } else { quad }
}

/// How many quads each side belongs to.
pub fn side_counts(quads: &[[u32; 4]]) -> BTreeMap<[u32; 2], u32> {
    let mut counts = BTreeMap::new();
    for quad in quads {
        let loop_ = corners(quad);
        for (k, &a) in loop_.iter().enumerate() {
            let b = loop_[(k + 1) % loop_.len()];
            *counts.entry([a.min(b), a.max(b)]).or_insert(0) += 1;
        }
    }
    counts
}

pub fn spring_count(model: &Model, kind: SpringKind) -> usize {
    model.springs.iter().filter(|s| s.kind == kind).count()
}

/// No two pairs of a colour share a particle, and the colours cover all pairs.
pub fn check_colours<T: AsRef<[u32]> + PartialOrd>(colours: &[std::ops::Range<u32>], groups: &[T]) {
    let mut next = 0;
    for colour in colours {
        assert_eq!(colour.start, next, "colours follow one another");
        assert!(!colour.is_empty(), "no colour is empty");
        next = colour.end;
        let groups = &groups[colour.start as usize..colour.end as usize];
        assert!(groups.is_sorted(), "a colour is sorted by particles");
        let mut touched = BTreeSet::new();
        let once = groups.iter().flat_map(|group| group.as_ref()).all(|particle| touched.insert(*particle));
        assert!(once, "no two of a colour share a particle");
    }
    assert_eq!(next as usize, groups.len());
}

/// What holds for every model, open or sewn.
pub fn check_model(model: &Model) {
    let count = model.positions.len();
    assert!(model.positions.iter().all(|p| p.is_finite()));
    assert!(model.masses.iter().all(|&m| m > 0.0));
    assert!(model.springs.iter().map(|s| s.ends).is_sorted(), "springs are sorted and each pair has one");
    assert!(model.springs.windows(2).all(|s| s[0].ends < s[1].ends));
    for spring in &model.springs {
        assert!(spring.ends[0] < spring.ends[1]);
        assert_eq!(spring.kind == SpringKind::Seam, spring.rest_length == 0.0, "{spring:?}");
        for (here, other) in [(0, 1), (1, 0)] {
            let row = model.links.row(spring.ends[here] as usize);
            let links = row.iter().filter(|l| l.other == spring.ends[other]);
            assert_eq!(
                links.map(|l| (l.rest_length, l.stiffness)).collect::<Vec<_>>(),
                [(spring.rest_length, spring.stiffness)]
            );
        }
    }
    assert_eq!(model.links.values.len(), 2 * model.springs.len());
    let limited: BTreeMap<[u32; 2], f32> = model
        .springs
        .iter()
        .filter(|s| matches!(s.kind, SpringKind::Structural | SpringKind::Shear))
        .map(|s| (s.ends, s.rest_length))
        .collect();
    assert_eq!(model.limits.len(), limited.len());
    for limit in &model.limits {
        assert_eq!(limited[&limit.ends], limit.rest_length);
        assert!((limit.max_length / limit.rest_length - 1.05).abs() < 1e-6);
    }
    check_colours(&model.limit_colours, &model.limits.iter().map(|l| l.ends).collect::<Vec<_>>());
    check_colours(&model.seam_colours, &model.seam_pairs.iter().map(|p| p.ends).collect::<Vec<_>>());
    assert_eq!(model.particle_quads.row_count(), count);
    for particle in 0..count {
        let row = model.particle_quads.row(particle);
        assert!(!row.is_empty(), "particle {particle} belongs to a quad");
        assert!(row.is_sorted());
        assert!(row.iter().all(|&q| model.quads[q as usize].contains(&(particle as u32))));
    }
    let corner_count: usize = model.quads.iter().map(|q| corners(q).len()).sum();
    assert_eq!(model.particle_quads.values.len(), corner_count);
    let limit_degree = degree(model);
    assert!(model.limit_colours.len() <= limit_degree.max(8) + 1, "few colours");
}

/// Largest number of limits at one particle.
pub fn degree(model: &Model) -> usize {
    let mut degrees = vec![0; model.positions.len()];
    model.limits.iter().flat_map(|l| l.ends).for_each(|i| degrees[i as usize] += 1);
    degrees.into_iter().max().unwrap_or(0)
}

/// What holds for the flat mesh of each panel of an open model: nothing inverted, doubled or missing, the outline followed.
pub fn check_meshes(model: &Model, garment: &Garment) {
    let mut first = 0;
    for (mesh, panel) in model.panels.iter().zip(&garment.panels) {
        assert_eq!(mesh.particles.start, first);
        first = mesh.particles.end;
        let quads = &model.quads[mesh.quads.start as usize..mesh.quads.end as usize];
        let flat = |i: u32| model.flat[i as usize].as_dvec2();
        let outline = outline(panel);
        let winding = loop_area(&outline).signum();
        let mut area = 0.0;
        let mut worst = 360.0_f64;
        for quad in quads {
            assert!(corners(quad).iter().all(|i| mesh.particles.contains(i)));
            let points: Vec<DVec2> = corners(quad).iter().map(|&i| flat(i)).collect();
            for (k, &p) in points.iter().enumerate() {
                let next = points[(k + 1) % points.len()] - p;
                let previous = points[(k + points.len() - 1) % points.len()] - p;
                assert!(next.perp_dot(previous) * winding > 0.0, "{}: no corner is inverted", panel.name);
                worst = worst.min(next.angle_to(previous).abs().to_degrees());
            }
            area += loop_area(&points);
        }
        assert!((worst - f64::from(mesh.worst_angle)).abs() < 0.05, "{worst} {}", mesh.worst_angle);
        let places: BTreeSet<[u32; 2]> =
            mesh.particles.clone().map(|i| model.flat[i as usize].to_array().map(f32::to_bits)).collect();
        assert_eq!(places.len(), mesh.particles.len(), "no two particles at one place");

        // The sides that belong to one quad are one loop, and it encloses just what the quads cover.
        let counts = side_counts(quads);
        assert!(counts.values().all(|&c| c <= 2));
        let rim: Vec<[u32; 2]> = counts.iter().filter(|(_, c)| **c == 1).map(|(&s, _)| s).collect();
        let loop_ = walk(&rim);
        assert_eq!(loop_.len(), rim.len(), "{}: the rim is one loop", panel.name);
        let points: Vec<DVec2> = loop_.iter().map(|&i| flat(i)).collect();
        assert!((loop_area(&points).abs() - area.abs()).abs() < 1e-5 * area.abs());
        assert!((area * winding) > 0.0);
        for p in points {
            let distance = (0..outline.len())
                .map(|k| segment_distance(p, outline[k], outline[(k + 1) % outline.len()]))
                .fold(f64::INFINITY, f64::min);
            assert!(distance < 0.003, "{}: {p} lies on the outline, not {distance} m beside it", panel.name);
        }
    }
    assert_eq!(first, model.particle_count());
}

/// Follows sides from the first one round.
fn walk(sides: &[[u32; 2]]) -> Vec<u32> {
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &[a, b] in sides {
        next.entry(a).or_default().push(b);
        next.entry(b).or_default().push(a);
    }
    assert!(next.values().all(|n| n.len() == 2), "two sides meet at each particle of the rim");
    let start = sides[0][0];
    let mut loop_ = vec![start];
    let mut here = sides[0][1];
    while here != start {
        let before = loop_[loop_.len() - 1];
        loop_.push(here);
        here = *next[&here].iter().find(|&&n| n != before).unwrap();
    }
    loop_
}

/// Finely sampled outline of a panel.
pub fn outline(panel: &Panel) -> Vec<DVec2> {
    (0..panel.edges.len())
        .flat_map(|e| {
            let mut points = panel.polyline(e, 1e-5);
            points.pop();
            points
        })
        .collect()
}

pub fn loop_area(points: &[DVec2]) -> f64 {
    (0..points.len()).map(|k| 0.5 * points[k].perp_dot(points[(k + 1) % points.len()])).sum()
}

fn segment_distance(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    p.distance(a.lerp(b, t))
}

/// Area of all quads in the flat panels [m²].
pub fn flat_area(model: &Model) -> f64 {
    model
        .quads
        .iter()
        .map(|q| loop_area(&corners(q).iter().map(|&i| model.flat[i as usize].as_dvec2()).collect::<Vec<_>>()).abs())
        .sum()
}

/// Connected pieces, boundary loops and Euler characteristic of the quads.
pub fn topology(model: &Model) -> [i64; 3] {
    let counts = side_counts(&model.quads);
    assert!(counts.values().all(|&c| c <= 2), "no side has more than two quads");
    let pieces = |sides: &mut dyn Iterator<Item = [u32; 2]>| {
        let mut roots: BTreeMap<u32, u32> = BTreeMap::new();
        fn root(roots: &mut BTreeMap<u32, u32>, i: u32) -> u32 {
            let parent = *roots.entry(i).or_insert(i);
            if parent == i {
                return i;
            }
            let top = root(roots, parent);
            roots.insert(i, top);
            top
        }
        for [a, b] in sides {
            let (a, b) = (root(&mut roots, a), root(&mut roots, b));
            roots.insert(a.max(b), a.min(b));
        }
        roots.iter().filter(|(a, b)| a == b).count() as i64
    };
    [
        pieces(&mut counts.keys().copied()),
        pieces(&mut counts.iter().filter(|(_, c)| **c == 1).map(|(&s, _)| s)),
        i64::from(model.particle_count()) - counts.len() as i64 + i64::from(model.quad_count()),
    ]
}

/// A value with some of its fields set.
pub fn with<T>(mut value: T, set: impl FnOnce(&mut T)) -> T {
    set(&mut value);
    value
}
