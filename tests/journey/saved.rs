//! The whole state as bytes: a simulation goes on bit for bit, and only with its own.

use crate::support::{advance, gpu, positions, rolling, standing, start, walking};
use toile::{Error, Simulation, Stage};
use toile_scene::Scene;

const FRAME: f64 = 1.0 / 60.0;

fn save(simulation: &Simulation) -> Vec<u8> {
    simulation.save(&gpu().queue).unwrap_or_else(|error| panic!("{error}"))
}

fn restore(scene: &Scene, bytes: &[u8]) -> Result<Simulation, Error> {
    let mut simulation = start(scene);
    simulation.restore(&gpu().queue, bytes)?;
    Ok(simulation)
}

/// Goes on for three uneven calls and gives the state then.
fn go_on(simulation: &mut Simulation) -> (Stage, Vec<Vec<u32>>) {
    for seconds in [FRAME, 0.4 * FRAME, 1.6 * FRAME] {
        advance(simulation, seconds);
    }
    (simulation.stage().expect("it is finite"), positions(simulation))
}

#[test]
fn every_stage_goes_on_bit_for_bit() {
    let scene = walking(&["skirt", "shirt_sleeveless"], "walk_loop");
    let mut simulation = start(&scene);
    let mut kept: Vec<(Stage, usize, Vec<u8>)> = Vec::new();
    loop {
        advance(&mut simulation, FRAME);
        let key = (simulation.stage().expect("it can be dressed"), simulation.cloths().count());
        let age = kept.iter().filter(|(stage, count, _)| (*stage, *count) == key).count();
        // Twice in each stage of each garment: as it begins and a frame later.
        if age < 2 {
            kept.push((key.0, key.1, save(&simulation)));
        } else if key.0 == Stage::Running {
            break;
        }
    }
    let seen = |stage, count| kept.iter().any(|(known, cloths, _)| (*known, *cloths) == (stage, count));
    for stage in [Stage::Sewing, Stage::Easing, Stage::Draping] {
        assert!(seen(stage, 1) && seen(stage, 2), "{stage:?}");
    }
    assert!(seen(Stage::Posing, 2) && seen(Stage::Running, 2));
    // As if nothing had happened: a frame later each is where the one that was never saved is.
    let pairs = kept.windows(2).filter(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1));
    let mut compared = 0;
    for pair in pairs {
        let (stage, cloths, first) = &pair[0];
        let mut resumed = restore(&scene, first).unwrap_or_else(|error| panic!("{stage:?}: {error}"));
        assert!(save(&resumed) == *first, "{stage:?} of {cloths} cloths is saved as it was");
        advance(&mut resumed, FRAME);
        resumed.stage().expect("it is finite");
        assert!(save(&resumed) == pair[1].2, "a frame of {stage:?} with {cloths} cloths");
        compared += 1;
    }
    assert!(compared > 6, "{compared} pairs of frames");
}

/// Its limits are no longer those of its scene.
#[test]
fn a_garment_that_is_let_out_goes_on_bit_for_bit() {
    let (scene, _) = standing("skirt", 1.15);
    let mut simulation = start(&scene);
    advance(&mut simulation, FRAME);
    let longest = |simulation: &Simulation| {
        let worn = simulation.cloths().next().expect("a skirt");
        worn.model.limits.iter().map(|limit| limit.max_length / limit.rest_length).fold(0.0, f32::max)
    };
    let beginning = save(&simulation);
    while longest(&simulation) < 1.06 {
        assert_ne!(simulation.stage().expect("it is finite"), Stage::Dressed, "it is never let out");
        advance(&mut simulation, FRAME);
    }
    advance(&mut simulation, FRAME);
    let saved = save(&simulation);
    let mut resumed = restore(&scene, &saved).unwrap_or_else(|error| panic!("{error}"));
    assert!(save(&resumed) == saved);
    assert_eq!(longest(&resumed), longest(&simulation));
    assert!(go_on(&mut resumed) == go_on(&mut simulation));
    resumed.restore(&gpu().queue, &beginning).unwrap_or_else(|error| panic!("{error}"));
    assert!(longest(&resumed) < 1.06, "what was let out later is taken back");
}

#[test]
fn a_run_goes_on_within_an_interval_of_its_maps() {
    let scene = rolling(1);
    let mut simulation = start(&scene);
    advance(&mut simulation, 20.3 * FRAME);
    let mut resumed = restore(&scene, &save(&simulation)).expect("its own state");
    assert_eq!(resumed.time(), simulation.time());
    assert!(go_on(&mut resumed) == go_on(&mut simulation));
}

#[test]
fn a_state_of_another_scene_is_refused_by_name() {
    let skirt = start(&walking(&["skirt"], "apose_to_walk"));
    let bytes = save(&skirt);
    let refused = |scene: &Scene, bytes: &[u8]| restore(scene, bytes).expect_err("it is another one").to_string();
    let other = refused(&walking(&["trousers"], "apose_to_walk"), &bytes);
    assert!(other.contains("it is of skirt with ") && other.contains("the scene has trousers with "), "{other}");
    let mut finer = walking(&["skirt"], "apose_to_walk");
    finer.settings.spacing = 0.05;
    assert!(refused(&finer, &bytes).contains("it is of skirt with "));
    let mut wool = walking(&["skirt"], "apose_to_walk");
    wool.settings.fabric = toile_scene::Fabric::preset("wool").expect("a preset");
    assert!(refused(&wool, &bytes).contains("of other numbers"));
    let more = refused(&walking(&["skirt", "trousers"], "apose_to_walk"), &bytes);
    assert!(more.contains("it has 1 cloths, and the scene has 2"), "{more}");
    let own = walking(&["skirt"], "apose_to_walk");
    assert!(refused(&own, &bytes[..bytes.len() - 1]).contains("damaged"));
    assert!(refused(&own, b"a picture").contains("this version"));
    for place in [20, bytes.len() / 2, bytes.len() - 1] {
        let mut broken = bytes.clone();
        broken[place] ^= 4;
        assert!(refused(&own, &broken).contains("damaged"), "byte {place}");
    }
}
