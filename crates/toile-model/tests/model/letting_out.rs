//! Limits of cloth that is too tight for them.

use crate::support::*;
use glam::{Vec3, vec3};
use toile_model::Piece;
use toile_scene::{Cloth, Rule, Scene};

/// Cotton, which allows 5 %; its limits aim at 3 %.
const ALLOWED: f32 = 0.05;
const AIM: f32 = 0.03;

/// A square of 16 × 16 cells.
fn square() -> Piece {
    let mut settings = settings(0.05);
    settings.velocity_modification.rule = Rule::Hierarchical;
    let cloth = Cloth::Garment(alone(rectangle("a", [0.8, 0.8], 0.0)));
    let mut scene = Scene::new("square", settings);
    scene.cloths = vec![cloth];
    Piece::all(&scene).expect("it meshes").remove(0)
}

/// The square drawn out along x, by `stretch` of the place from side to side [1].
fn drawn(piece: &Piece, stretch: impl Fn(f32) -> f32) -> Vec<Vec3> {
    let sum = |x: f32| (0..(x / 0.05).round() as u32).map(|cell| stretch(0.05 * cell as f32)).sum::<f32>();
    piece.model.flat.iter().map(|flat| vec3(flat.x + 0.05 * sum(flat.x), flat.y, 0.0)).collect()
}

/// Largest and smallest elongation that limits along x allow, and the largest of those along y [1].
fn allowed(piece: &Piece) -> [f32; 3] {
    let mut along = [f32::NEG_INFINITY, f32::INFINITY, f32::NEG_INFINITY];
    for limit in &piece.model.limits {
        let [a, b] = limit.ends.map(|end| piece.model.flat[end as usize]);
        let elongation = limit.max_length / limit.rest_length - 1.0;
        if (a.y - b.y).abs() < 1e-6 {
            along[0] = along[0].max(elongation);
            along[1] = along[1].min(elongation);
        } else if (a.x - b.x).abs() < 1e-6 {
            along[2] = along[2].max(elongation);
        }
    }
    along
}

#[test]
fn cloth_is_let_out_along_what_is_stretched_and_nowhere_else() {
    let mut piece = square();
    let digest = piece.model.digest();
    let within = drawn(&piece, |_| ALLOWED - 0.005);
    piece.let_out_at(&within);
    assert!(piece.room().is_empty() && piece.model.digest() == digest, "within its threshold it keeps its limits");
    let positions = drawn(&piece, |_| 0.2);
    piece.let_out_at(&positions);
    let [most, least, across] = allowed(&piece);
    assert!((most - 0.2).abs() < 1e-4 && (least - 0.2).abs() < 1e-4, "{least} to {most}");
    assert!((across - AIM).abs() < 1e-4, "along y it keeps its limits: {across}");
    piece.let_out(&[]);
    assert_eq!(piece.model.digest(), digest, "taken back, to the bit");
}

#[test]
fn what_every_second_spring_has_is_shared_by_both() {
    let mut piece = square();
    let positions = drawn(&piece, |x| if ((x / 0.05).round() as u32).is_multiple_of(2) { 0.05 } else { 0.25 });
    piece.let_out_at(&positions);
    let [most, least, _] = allowed(&piece);
    assert!(least > 0.12 && most < 0.18, "{least} to {most}");
}

/// Limits of the level of every second particle, or of every fourth and so on: their ends in the flat cloth, and their maximum lengths [m].
fn coarse_limits(piece: &Piece, level: usize) -> Vec<([glam::Vec2; 2], f32)> {
    let model = &piece.model;
    let limits = model.level_limits(&model.levels[level]).into_iter();
    limits.map(|(ends, length)| (ends.map(|node| model.flat[model.site(node) as usize]), length)).collect()
}

#[test]
fn limits_between_coarse_particles_are_let_out_as_the_single_ones_around_them() {
    let mut piece = square();
    let before = coarse_limits(&piece, 1);
    let positions = drawn(&piece, |x| if x < 0.4 { 0.0 } else { 0.2 });
    piece.let_out_at(&positions);
    let mut halves = [0; 2];
    for ((ends, was), (_, is)) in before.iter().zip(coarse_limits(&piece, 1)) {
        let [left, right] = [ends[0].x.min(ends[1].x), ends[0].x.max(ends[1].x)];
        // What is evened out between both halves reaches four cells into each.
        let (half, expected) = match (left, right) {
            (_, right) if right < 0.16 => (0, 1.0),
            (left, _) if left > 0.64 => (1, (1.0 + 0.2) / (1.0 + AIM)),
            _ => continue,
        };
        halves[half] += 1;
        assert!((is / was - expected).abs() < 1e-4, "from {left} to {right} m: {} times as long", is / was);
    }
    assert!(halves.iter().all(|count| *count > 10), "{halves:?}");
}

#[test]
fn no_limit_of_any_level_is_left_much_too_short() {
    let mut piece = square();
    // One row of springs that is torn, and cloth around it that is not.
    let positions = drawn(&piece, |x| if (x - 0.4).abs() < 0.01 { 0.6 } else { 0.0 });
    piece.let_out_at(&positions);
    let model = &piece.model;
    let mut torn = 0;
    for (level, k) in model.levels.iter().zip(0..) {
        for (ends, length) in model.level_limits(level) {
            let [a, b] = ends.map(|node| positions[model.site(node) as usize]);
            let over = a.distance(b) / length - 1.0;
            assert!(over < 0.1, "{ends:?} of level {k} is over by {over}");
            torn += u32::from(over > 0.05);
        }
    }
    assert!(torn >= 17, "the springs that are torn are still what gives the most: {torn}");
}
