//! When a garment is sewn, and when it is at rest.

use crate::support::*;
use glam::Vec3;
use toile_model::{Dressing, DressingStage, Model, Motion, Status, StepSettings};
use toile_scene::Rule;

const DT: f32 = 1.0 / 960.0;
/// Steps of a frame.
const FRAME: u64 = 16;

/// Two squares that one seam joins, on their way.
fn dressing() -> Dressing {
    dressing_under(Rule::Hierarchical)
}

fn dressing_under(rule: Rule) -> Dressing {
    let garment = garment(vec![rectangle("a", [0.2, 0.2], 0.1), rectangle("b", [0.2, 0.2], -0.1)], &[([0, 1], [1, 1])]);
    let mut settings = settings(0.05);
    settings.velocity_modification.rule = rule;
    let model = Model::from_garment(&garment, &settings).expect("it meshes");
    let mut step = StepSettings::new(&settings, &model);
    step.dt = DT;
    Dressing::new(&model, &step)
}

/// Sews until the seams count as closed or stuck, their widest gap [m] after so many frames being `gap`; frames that it took.
fn sew(dressing: &mut Dressing, gap: impl Fn(u64) -> f32) -> u64 {
    for frame in 1..2000 {
        let status = status(frame * FRAME, gap(frame));
        if dressing.advance(&status, &Motion::default()) != DressingStage::Sewing {
            return frame;
        }
    }
    panic!("it is sewn for ever");
}

fn status(step: u64, seam_gap_max: f32) -> Status {
    Status {
        step,
        non_finite_count: 0,
        first_non_finite: None,
        speed_max: 0.0,
        kinetic_energy: 1.0,
        elongation_max: 0.0,
        over_long_count: 0,
        longest_limit: None,
        seam_gap_max,
        further_sweeps: 0,
        missed_steps: 0,
    }
}

#[test]
fn seams_have_the_time_that_they_use_and_stuck_ones_do_not_wait() {
    let mut slow = dressing();
    // 5 mm a frame, from one metre.
    assert_eq!(sew(&mut slow, |frame| 1.0 - 0.005 * frame as f32), 200);
    assert!(!slow.is_left_open());
    let mut narrow = dressing();
    let frames = sew(&mut narrow, |frame| (0.1 - 0.005 * frame as f32).max(0.004));
    assert!((30..45).contains(&frames), "a quarter of a second after it is stuck, in frame {frames}");
    assert!(!narrow.is_left_open(), "4 mm are merged");
    let mut wide = dressing();
    let frames = sew(&mut wide, |frame| (0.1 - 0.005 * frame as f32).max(0.03));
    assert!((25..40).contains(&frames) && wide.is_left_open(), "3 cm are not, in frame {frames}");
    let mut endless = dressing();
    let frames = sew(&mut endless, |frame| 100.0 - 0.05 * frame as f32);
    assert!((590..=602).contains(&frames) && endless.is_left_open(), "ten seconds are the longest, {frames} frames");
}

/// What comes after easing when the largest elongation is so much [1], and the frame of it since it was sewn.
fn after_easing(dressing: &mut Dressing, elongation_max: f32) -> (DressingStage, u64) {
    let sewn = sew(dressing, |_| 0.0);
    for frame in 1..1000 {
        let status = Status { elongation_max, ..status((sewn + frame) * FRAME, 0.0) };
        let stage = dressing.advance(&status, &Motion::default());
        if stage != DressingStage::Easing {
            return (stage, frame);
        }
    }
    panic!("it eases for ever");
}

#[test]
fn what_is_too_tight_yields_before_it_drapes() {
    // Cotton allows 5 %.
    assert_eq!(after_easing(&mut dressing(), 0.14), (DressingStage::Draping, 30), "its thickness has room for it");
    assert_eq!(after_easing(&mut dressing_under(Rule::Predictive), 0.3).0, DressingStage::Draping, "all springs share");
    let mut tight = dressing();
    let (stage, eased) = after_easing(&mut tight, 0.16);
    assert_eq!(stage, DressingStage::Yielding);
    let mut frame = tight.sewing_steps() / FRAME + eased;
    let mut motion = Motion::default();
    let mut go = |tight: &mut Dressing, motion: &Motion| {
        frame += 1;
        tight.advance(&status(frame * FRAME, 0.0), motion)
    };
    assert!((0..100).all(|_| go(&mut tight, &motion) == DressingStage::Yielding), "nobody saw where it lies");
    let yielded = tight.sewing_steps() + (eased + 30) * FRAME;
    motion.see(yielded - FRAME, vec![Vec3::ZERO; 8], DT);
    assert_eq!(go(&mut tight, &motion), DressingStage::Yielding);
    motion.see(yielded, vec![Vec3::ZERO; 8], DT);
    assert_eq!(go(&mut tight, &motion), DressingStage::Draping);
}

#[test]
fn what_is_sewn_far_too_tight_yields_at_once() {
    let sewn = |rule, gap, elongation_max| {
        let mut dressing = dressing_under(rule);
        let stuck = (0..40).map(|frame| Status { elongation_max, ..status(frame * FRAME, gap) });
        let stage = |status: Status| dressing.advance(&status, &Motion::default());
        stuck.map(stage).find(|stage| *stage != DressingStage::Sewing).expect("seams that do not move are stuck")
    };
    // Cotton allows 5 %.
    assert_eq!(sewn(Rule::Hierarchical, 0.0, 0.44), DressingStage::Easing);
    assert_eq!(sewn(Rule::Hierarchical, 0.0, 0.46), DressingStage::Yielding);
    assert_eq!(sewn(Rule::Hierarchical, 0.03, 0.46), DressingStage::Easing, "what is left open has no sewn cloth yet");
    assert_eq!(sewn(Rule::Predictive, 0.0, 0.46), DressingStage::Easing, "all springs share");
}

#[test]
fn rest_is_where_particles_stay_whatever_their_velocities_say() {
    let mut dressing = dressing();
    let sewn = sew(&mut dressing, |_| 0.0);
    let mut motion = Motion::default();
    let mut frame = sewn;
    let mut go = |dressing: &mut Dressing, way: f32| {
        frame += 1;
        let place = Vec3::X * way * (frame % 2) as f32;
        motion.see(frame * FRAME, vec![place; 8], DT);
        // The kinetic energy that the status tells stays that of 1 J.
        dressing.advance(&status(frame * FRAME, 0.0), &motion)
    };
    for _ in 0..40 {
        go(&mut dressing, 0.001);
    }
    assert_eq!(dressing.stage(), DressingStage::Draping, "6 cm/s are no rest");
    let calm = (1..100).find(|_| go(&mut dressing, 0.0002) == DressingStage::Dressed);
    assert_eq!(calm, Some(10 + 1), "ten frames of 1.2 cm/s, after one on the way from the last place");
    assert!(dressing.is_at_rest());
}

#[test]
fn motion_is_told_by_places_and_begins_anew_with_other_cloth() {
    let mut motion = Motion::begin(16, vec![Vec3::ZERO, Vec3::X]);
    assert_eq!((motion.speed(), motion.velocities()), (None, [].as_slice()));
    motion.see(48, vec![Vec3::Y, Vec3::X], 0.5);
    assert_eq!(motion.velocities(), [Vec3::Y / 16.0, Vec3::ZERO]);
    assert_eq!((motion.step(), motion.speed()), (48, Some((0.5f32 / 256.0).sqrt())));
    motion.see(64, vec![Vec3::ZERO; 3], 0.5);
    assert_eq!((motion.step(), motion.speed()), (64, None), "another number of particles");
    motion.see(64, vec![Vec3::ONE; 3], 0.5);
    assert_eq!(motion.speed(), None, "no time between");
}
