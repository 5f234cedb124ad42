//! Cloths that are put on while a run goes on.

use crate::support::{advance, gpu, positions, rolling, start, walking};
use glam::{Vec3, dvec3};
use toile::{Error, Simulation, Stage};

const FRAME: f64 = 1.0 / 60.0;

fn put_on(simulation: &mut Simulation, fitting: &mut Simulation) -> Result<(), Error> {
    let mut done = Ok(());
    gpu().run(|encoder| done = simulation.put_on(encoder, fitting));
    done
}

fn refused(simulation: &mut Simulation, fitting: &mut Simulation) -> String {
    let before = positions(simulation);
    let said = put_on(simulation, fitting).expect_err("it cannot be put on").to_string();
    assert!(positions(simulation) == before, "all stays as it was");
    said
}

fn names(simulation: &Simulation) -> Vec<&str> {
    simulation.cloths().map(|worn| worn.name).collect()
}

/// What is put on at any moment goes on as if it had been there from the beginning: an inner cloth knows nothing of those over it.
#[test]
fn a_sheet_that_is_put_on_lies_there_as_if_it_had_always_been_there() {
    let mut fitting = start(&rolling(2));
    let mut simulation = start(&rolling(1));
    for _ in 0..12 {
        advance(&mut fitting, FRAME);
    }
    // In the middle of an interval, which is completed, and three intervals ahead, which are caught up with.
    for seconds in [0.1, 0.13, 0.0137] {
        advance(&mut simulation, seconds);
    }
    put_on(&mut simulation, &mut fitting).expect("it stands as it did");
    assert_eq!(names(&simulation), ["sheet 0", "sheet 1"]);
    assert_eq!(simulation.time(), 15.0 * FRAME);
    assert!(positions(&simulation) == positions(&fitting), "bit for bit");
    // Both are ahead of what was asked for: this one by less than an interval, the other by what it caught up with.
    for (ahead, seconds) in [(&mut simulation, 15.0 * FRAME - 0.2437), (&mut fitting, 3.0 * FRAME)] {
        gpu().run(|encoder| {
            let told = ahead.advance(encoder, seconds).expect("it is finite");
            assert_eq!((told.step_count, told.fraction), (0, 0.0));
        });
    }
    for _ in 0..10 {
        advance(&mut simulation, FRAME);
        advance(&mut fitting, FRAME);
    }
    assert!(positions(&simulation) == positions(&fitting), "bit for bit, ten frames later");
    let control = simulation.control();
    assert_eq!((control.fabrics.len(), control.pins.len()), (2, 2));
    // What was put on can be taken off again.
    simulation.take_off(1);
    advance(&mut simulation, FRAME);
    assert_eq!(names(&simulation), ["sheet 0"]);
}

#[test]
fn what_does_not_belong_or_stands_elsewhere_is_told() {
    let mut simulation = start(&rolling(1));
    for _ in 0..18 {
        advance(&mut simulation, FRAME);
    }
    let mut fitting = start(&rolling(2));
    let said = refused(&mut simulation, &mut fitting);
    assert!(said.ends_with("it is still being dressed"), "{said}");
    advance(&mut fitting, FRAME);
    let said = refused(&mut simulation, &mut fitting);
    assert!(said.contains("its body is 0.283 s behind"), "{said}");
    for _ in 0..19 {
        advance(&mut fitting, FRAME);
    }
    let said = refused(&mut simulation, &mut fitting);
    assert!(said.contains("its body is 0.033 s ahead"), "{said}");
    let run = |scene: &toile_scene::Scene| {
        let mut other = start(scene);
        for _ in 0..18 {
            advance(&mut other, FRAME);
        }
        other
    };
    let said = refused(&mut simulation, &mut run(&rolling(1)));
    assert!(said.ends_with("the other run has no further cloth"), "{said}");
    let mut others = rolling(2);
    others.cloths.reverse();
    let said = refused(&mut simulation, &mut run(&others));
    assert!(said.contains("here are sheet 0 with 256 particles, and it was dressed over others: sheet 1"), "{said}");
    let mut elsewhere = rolling(2);
    let toile_scene::Body::Moving(ball) = &mut elsewhere.bodies[0] else { panic!("a ball rolls") };
    ball.mesh.positions.iter_mut().for_each(|place| *place *= 1.1);
    elsewhere.bodies[0] = toile_scene::Body::Moving(toile_scene::MovingMesh::rigid(ball.mesh.clone(), Vec::new()));
    let said = refused(&mut simulation, &mut run(&elsewhere));
    assert!(said.contains("m from where this one does"), "{said}");
    let mut still = rolling(2);
    still.bodies = vec![toile_scene::Body::Mesh(toile_scene::Mesh::sphere(Vec3::ZERO, 0.25, 12))];
    let said = refused(&mut simulation, &mut run(&still));
    assert!(said.ends_with("it was dressed on other bodies"), "{said}");
    let mut slow = rolling(2);
    slow.settings.frame_rate = 30.0;
    let said = refused(&mut simulation, &mut run(&slow));
    assert!(said.contains("it runs at 30 frames per second, and this one at 60"), "{said}");
}

#[test]
#[should_panic(expected = "a cloth is put on once the run has begun")]
fn nothing_is_put_on_while_it_is_dressed() {
    let _ = put_on(&mut start(&walking(&["skirt"], "walk_loop")), &mut start(&rolling(1)));
}

/// A woman walks in a skirt, several metres from where her motion has her, and gets a shirt that was dressed over the same skirt.
#[test]
fn a_shirt_is_put_on_who_walks() {
    let dressed = |garments: &[&str]| {
        let mut simulation = start(&walking(garments, "walk_loop"));
        while simulation.stage().expect("she can be dressed") != Stage::Running {
            advance(&mut simulation, FRAME);
        }
        simulation
    };
    let mut simulation = dressed(&["skirt"]);
    let mut fitting = dressed(&["skirt", "shirt_sleeves"]);
    let way = dvec3(2.0, 0.0, -1.0);
    gpu().run(|encoder| simulation.teleport(encoder, way));
    // A whole round and a bit, so that the other is a round behind.
    let toile_scene::Body::Moving(woman) = &walking(&["skirt"], "walk_loop").bodies[0] else { panic!("she walks") };
    let round = woman.duration();
    for _ in 0..(round / FRAME).round() as u32 + 8 {
        advance(&mut simulation, FRAME);
    }
    let skirt = positions(&simulation)[0].clone();
    put_on(&mut simulation, &mut fitting).expect("she stands as she did a round ago");
    assert_eq!(names(&simulation), names(&fitting));
    assert!(positions(&simulation)[0] == skirt, "the skirt stays as it is");
    let places = |simulation: &Simulation| {
        let shirt = simulation.cloths().nth(1).expect("a shirt");
        gpu().vec3s(&shirt.cloth.frame().positions)
    };
    let apart = |simulation: &Simulation, fitting: &Simulation| {
        let pairs = places(simulation).into_iter().zip(places(fitting));
        pairs.map(|(here, there)| (here - there - way.as_vec3()).length()).fold(0.0, f32::max)
    };
    let farthest = apart(&simulation, &fitting);
    assert!(farthest < 1e-5, "it goes to where she is: {farthest} m");
    for _ in 0..20 {
        advance(&mut simulation, FRAME);
        advance(&mut fitting, FRAME);
    }
    simulation.stage().expect("it is finite, and all of it is in the maps");
    // It lies over another skirt's folds, so it is near to what it was, not the same.
    let pairs: Vec<f32> =
        places(&simulation).iter().zip(places(&fitting)).map(|(a, b)| (*a - b - way.as_vec3()).length()).collect();
    let mean = pairs.iter().sum::<f32>() / pairs.len() as f32;
    assert!(mean < 0.02, "{mean} m from where it is worn in the fitting room");
}
