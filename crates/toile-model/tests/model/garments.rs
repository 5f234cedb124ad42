//! Whole garments: the five that are shipped, and ten real ones on machines that have them beside the repository.

use crate::support::*;
use glam::Vec3;
use std::fmt::Write;
use std::path::Path;
use toile_model::{Model, NO_CORNER};
use toile_scene::{Fabric, Garment, Settings};

/// Name, boundary loops when sewn: hems, waist, neck, armholes.
const SHIPPED: [(&str, i64); 5] =
    [("dress", 4), ("shirt_sleeveless", 4), ("shirt_sleeves", 4), ("skirt", 2), ("trousers", 3)];

/// Name, boundary loops when sewn: hems, waist, neck, cuffs.
const REAL: [(&str, i64); 10] = [
    ("dress_sleeveless", 4),
    ("dress_sleeves", 4),
    ("shirt_long_sleeves", 4),
    ("shirt_sleeveless", 4),
    ("shirt_sleeves", 4),
    ("shorts", 3),
    ("skirt_2panel", 2),
    ("skirt_circle", 2),
    ("skirt_pencil", 2),
    ("trousers", 3),
];

fn shipped(name: &str) -> Garment {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/garments");
    toile_files::read_garment(&folder.join(format!("{name}.json"))).unwrap().garment
}

fn real(name: &str) -> Garment {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/patterns/garmentcode");
    assert!(folder.is_dir(), "{} is not there", folder.display());
    toile_files::read_garment(&folder.join(format!("{name}_specification.json"))).unwrap().garment
}

/// What garments are sewn into, a line for each spacing; each is checked.
fn sewn_table(garments: impl IntoIterator<Item = (Garment, &'static str, i64)>, spacings: &[f64]) -> String {
    let mut table = String::new();
    for (garment, name, loops) in garments {
        for &spacing in spacings {
            let open = build(&garment, spacing);
            check_model(&open);
            check_meshes(&open, &garment);
            let (sewn, _) = open.sewn();
            check_model(&sewn);
            // One piece, its openings, and no handle: χ = 2 − loops.
            assert_eq!(topology(&sewn), [1, loops, 2 - loops], "{name} at {spacing}");
            assert_eq!(sewn.quads.len(), open.quads.len(), "{name}: no quad collapses");
            let worst = open.panels.iter().map(|p| p.worst_angle).fold(180.0, f32::min);
            assert!(worst > 25.0, "{name} at {spacing}: {worst}°");
            let triangles = open.quads.iter().filter(|q| q[3] == NO_CORNER).count();
            writeln!(
                table,
                "{name:<18} {spacing:<4} {:>6} particles open {:>6} sewn {:>6} quads {triangles:>4} triangles {:>6} springs {:>3} and {:>2} colours for {:>2} and {:>2} limits {worst:>3.0}°",
                open.particle_count(),
                sewn.particle_count(),
                open.quads.len() - triangles,
                sewn.spring_count(),
                open.colour_count(),
                sewn.colour_count(),
                degree(&open),
                degree(&sewn),
            )
            .unwrap();
        }
    }
    table
}

#[test]
fn shipped_garments_are_sewn_into_what_they_are() {
    let garments = SHIPPED.map(|(name, loops)| (shipped(name), name, loops));
    insta::assert_snapshot!("shipped_garments", sewn_table(garments, &[0.05, 0.03, 0.02]));
}

#[test]
#[ignore = "the ten garments are not part of the repository"]
fn real_garments_are_sewn_into_what_they_are() {
    let garments = REAL.map(|(name, loops)| (real(name), name, loops));
    insta::assert_snapshot!("garments", sewn_table(garments, &[0.05, 0.03, 0.02, 0.01]));
}

/// Sum of the squared gaps of one seam.
fn spread(pairs: &[[Vec3; 2]]) -> f32 {
    pairs.iter().map(|[a, b]| a.distance_squared(*b)).sum()
}

fn check_seams(garments: impl IntoIterator<Item = (Garment, &'static str)>) {
    for (garment, name) in garments {
        let open: Model = build(&garment, 0.01);
        assert_eq!(open.seam_names.len(), garment.seams.len());
        for (index, seam) in open.seam_names.iter().enumerate() {
            let pairs: Vec<[Vec3; 2]> = open
                .seam_pairs
                .iter()
                .filter(|p| p.seam as usize == index)
                .map(|p| p.ends.map(|i| open.positions[i as usize]))
                .collect();
            // The same particles, joined the other way round: order one side along the seam, turn the other.
            let count = pairs.len();
            let Some(&[a, b]) = pairs.first() else { continue };
            let mut along = pairs.clone();
            along.sort_by(|p, q| p[0].distance(a).total_cmp(&q[0].distance(a)));
            let turned: Vec<[Vec3; 2]> = (0..count).map(|k| [along[k][0], along[count - 1 - k][1]]).collect();
            assert!(spread(&pairs) <= spread(&turned) * 1.001, "{name}: {seam} from {a} and {b}");
        }
    }
}

#[test]
fn shipped_seams_join_the_ends_that_lie_near_to_each_other() {
    // The crotches of our trousers reach across the middle, past each other: turned, their ends would lie nearer.
    let names = SHIPPED.map(|(name, _)| name).into_iter().filter(|name| *name != "trousers");
    check_seams(names.map(|name| (shipped(name), name)));
}

#[test]
#[ignore = "the ten garments are not part of the repository"]
fn real_seams_join_the_ends_that_lie_near_to_each_other() {
    check_seams(REAL.map(|(name, _)| (real(name), name)));
}

#[test]
fn a_garment_gives_the_same_model_twice() {
    let garment = shipped("shirt_sleeves");
    let [one, other] = [0, 1].map(|_| build(&garment, 0.02));
    assert_eq!(one, other);
    assert_eq!(one.sewn(), other.sewn());
}

/// A tube of two panels whose front has a dart inside of it, cut from the hem as a keyhole.
const KEYHOLE: &str = r#"{"pattern": {"panels": {
    "front": {"translation": [0, 0, 20], "rotation": [0, 0, 0],
        "vertices": [[-25, 0], [0, 0], [0, 12], [-3, 22], [0, 32], [3, 22], [0, 12], [0, 0], [25, 0], [25, 45], [-25, 45]],
        "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3]}, {"endpoints": [3, 4]},
            {"endpoints": [4, 5]}, {"endpoints": [5, 6]}, {"endpoints": [6, 7]}, {"endpoints": [7, 8]},
            {"endpoints": [8, 9]}, {"endpoints": [9, 10]}, {"endpoints": [10, 0]}]},
    "back": {"translation": [0, 0, -20], "rotation": [0, 0, 0],
        "vertices": [[-25, 0], [-25, 45], [25, 45], [25, 0]],
        "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3]}, {"endpoints": [3, 0]}]}},
    "stitches": [[{"panel": "front", "edge": 8}, {"panel": "back", "edge": 2}],
        [{"panel": "front", "edge": 10}, {"panel": "back", "edge": 0}],
        [{"panel": "front", "edge": 1}, {"panel": "front", "edge": 6}],
        [{"panel": "front", "edge": 2}, {"panel": "front", "edge": 5}],
        [{"panel": "front", "edge": 3}, {"panel": "front", "edge": 4}]]},
    "properties": {"units_in_meter": 100}}"#;

#[test]
fn a_dart_inside_of_a_panel_is_sewn_shut() {
    let garment = toile_files::parse_garment(KEYHOLE, "keyhole").unwrap().garment;
    // Waist and hem; the cut and the dart are closed.
    let table = sewn_table([(garment, "keyhole", 2)], &[0.03, 0.02, 0.013, 0.008]);
    assert_eq!(table.lines().count(), 4);
}

/// A colour is a dispatch. As many are needed as clusters meet at a node; hardly any more are had, but where a level is so small that all of its
/// clusters meet.
#[test]
fn levels_have_hardly_more_colours_than_they_need() {
    for name in ["skirt", "dress", "shirt_sleeves"] {
        let mut settings = Settings::new(Fabric::preset("cotton").expect("a preset"));
        settings.spacing = 0.03;
        let (model, _) = Model::from_garment(&shipped(name), &settings).expect("it meshes").sewn();
        assert!(model.levels.len() > 3, "{name}");
        for (index, level) in model.levels.iter().enumerate().filter(|(_, level)| level.nodes.len() > 50) {
            let mut met = vec![0; model.positions.len() + model.coarse_particles.len()];
            let clusters = level.colours.iter().flat_map(|colour| colour.clone());
            for node in clusters.flat_map(|cluster| model.clusters[cluster as usize].nodes) {
                met.get_mut(node as usize).into_iter().for_each(|count| *count += 1);
            }
            let [needed, count] = [met.iter().copied().max().unwrap_or(0), level.colours.len()];
            let most = if index == 0 { needed } else { needed + 1 };
            assert!(
                (needed..=most).contains(&count),
                "{name}, level {index}: {count} colours, where {needed} are needed"
            );
        }
    }
}
