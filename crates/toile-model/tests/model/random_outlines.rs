//! Random star-shaped outlines: always a valid mesh.

use crate::support::*;
use glam::DVec2;
use proptest::prelude::*;
use std::f64::consts::TAU;

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_star_shaped_outline_becomes_a_valid_mesh(
        radii in prop::collection::vec(0.03_f64..0.4, 3..14),
        turn in 0.0..TAU,
        spacing in prop::sample::select(vec![0.2, 0.05, 0.02, 0.013]),
        clockwise in any::<bool>(),
    ) {
        let count = radii.len() as f64;
        let mut points: Vec<DVec2> = radii
            .iter()
            .enumerate()
            .map(|(k, r)| DVec2::from_angle(turn + TAU * k as f64 / count) * *r)
            .collect();
        if clockwise {
            points.reverse();
        }
        let garment = alone(polygon("star", &points, 0.0));
        let model = build(&garment, spacing);
        check_model(&model);
        check_meshes(&model, &garment);
        // Negligible edges aside, the quads cover the outline exactly.
        let shortest = (0..points.len()).map(|k| points[k].distance(points[(k + 1) % points.len()])).fold(f64::INFINITY, f64::min);
        if shortest > 0.35 * spacing {
            let area = loop_area(&points).abs();
            prop_assert!((flat_area(&model) - area).abs() < 1e-5 * area);
        }
    }
}
