//! A simulation under the hand of its host.

use crate::support::{advance, gpu, positions, rolling, start, walking};
use glam::{DVec3, Vec3, dvec3};
use std::collections::BTreeMap;
use toile::{Control, Error, Simulation, Stage};
use toile_lab::with;
use toile_scene::{Body, Fabric, Mesh, RigidKey, RigidMotion, Shape, ShapeMotion, Threshold, Wind};

const FRAME: f64 = 1.0 / 60.0;

fn control(simulation: &mut Simulation, change: impl Fn(&mut Control)) -> Result<(), Error> {
    let mut control = simulation.control().clone();
    change(&mut control);
    let mut done = Ok(());
    gpu().run(|encoder| done = simulation.set_control(encoder, &control));
    done
}

fn advance_for(simulation: &mut Simulation, frames: u32) {
    for _ in 0..frames {
        advance(simulation, FRAME);
    }
    simulation.stage().expect("it is finite");
}

/// Positions of a cloth [m].
fn places(simulation: &Simulation, cloth: usize) -> Vec<Vec3> {
    let worn = simulation.cloths().nth(cloth).expect("it is there");
    gpu().vec3s(&worn.cloth.frame().positions)
}

fn mean(places: &[Vec3]) -> Vec3 {
    places.iter().sum::<Vec3>() / places.len() as f32
}

#[test]
fn a_host_holds_particles_and_turns_gravity_and_wind() {
    let mut scene = rolling(2);
    scene.settings.wind = Some(Wind::new(DVec3::ZERO));
    let mut simulation = start(&scene);
    advance_for(&mut simulation, 3);
    // Uneven calls: what is held is there at the end of each of them.
    let corner = places(&simulation, 1)[0].as_dvec3();
    for (part, seconds) in [(1.0, FRAME), (2.0, 2.7 * FRAME), (3.0, 1.3 * FRAME)] {
        let target = corner + part * dvec3(0.01, 0.03, -0.01);
        control(&mut simulation, |control| control.pins[1] = BTreeMap::from([(0, target)])).expect("it is in range");
        advance(&mut simulation, seconds);
        let there = places(&simulation, 1)[0].as_dvec3();
        assert!(there.distance(target) < 1e-5, "it is at {there} and should be at {target}");
    }
    let there = places(&simulation, 1)[0];
    advance_for(&mut simulation, 10);
    assert_eq!(places(&simulation, 1)[0], there, "what is held stands still");
    control(&mut simulation, |control| {
        control.pins[1].clear();
        control.gravity = DVec3::ZERO;
        control.wind = Some(Wind::new(dvec3(-6.0, 0.0, 0.0)));
    })
    .expect("it is in range");
    let before = mean(&places(&simulation, 1));
    advance_for(&mut simulation, 15);
    let way = mean(&places(&simulation, 1)) - before;
    assert!(way.x < -0.1 && places(&simulation, 1)[0] != there, "it goes with the wind: {way}");
}

#[test]
fn what_no_cloth_has_is_an_error_and_changes_nothing() {
    let mut scene = rolling(1);
    scene.settings.velocity_modification = toile_scene::VelocityModification::new(toile_scene::Rule::None);
    let mut simulation = start(&scene);
    advance_for(&mut simulation, 2);
    let before = simulation.control().clone();
    let said = control(&mut simulation, |control| control.fabrics[0].friction = -1.0).expect_err("no fabric has it");
    assert_eq!(said.to_string(), "fabric.friction is -1 and must be 0 to 10");
    let said = control(&mut simulation, |control| control.pins[0] = BTreeMap::from([(3, DVec3::NAN)]));
    assert!(said.expect_err("it is nowhere").to_string().starts_with("pin is NaN"));
    // A rule that leaves the tension to the springs needs shorter steps for stiffer ones.
    let stiff = control(&mut simulation, |control| control.fabrics[0].structural_stiffness *= 9.0);
    let said = stiff.expect_err("the step is too long").to_string();
    assert!(said.starts_with("sheet 0: a frame would take"), "{said}");
    assert_eq!(*simulation.control(), before);
    let soft = control(&mut simulation, |control| control.fabrics[0].structural_stiffness *= 0.5);
    soft.expect("softer springs carry the step");
    advance_for(&mut simulation, 5);
    // The scene itself is held to the same ranges.
    scene.settings.fabric.thickness = 1.0;
    let error = Simulation::new(&gpu().device, &scene).expect_err("no cloth is so thick");
    assert_eq!(error.to_string(), "fabric.thickness is 1 and must be 0 to 0.05 m");
}

/// Air, a pressure and shapes come and go in a run that began without any. What lasts no time leaves no trace, to the last bit.
#[test]
fn a_scene_need_not_begin_with_wind_or_shapes() {
    let scene = rolling(2);
    let mut undisturbed = start(&scene);
    let mut simulation = start(&scene);
    for simulation in [&mut undisturbed, &mut simulation] {
        advance_for(simulation, 3);
        // Within an interval of the maps, and a particle is held on the way.
        control(simulation, |control| control.pins[1].extend([(0, DVec3::new(-0.5, 0.3, 0.5))]))
            .expect("it is in range");
        advance(simulation, 0.7 * FRAME);
    }
    let before = positions(&simulation);
    let far = Shape::sphere(dvec3(0.0, -9.0, 0.0), 0.1);
    control(&mut simulation, |control| {
        control.wind = Some(with(Wind::new(dvec3(-6.0, 0.0, 0.0)), |wind| wind.pressure = 3.0));
        control.shapes = vec![far.clone(), far.clone()];
    })
    .expect("it fits the device");
    assert_eq!(positions(&simulation), before);
    assert_eq!((simulation.time(), simulation.control().shapes.len()), (undisturbed.time(), 2));
    let steps = |simulation: &Simulation| simulation.cloths().map(|worn| worn.cloth.step()).collect::<Vec<_>>();
    assert_eq!(steps(&simulation), steps(&undisturbed), "shapes move on this clock");
    control(&mut simulation, |control| {
        control.wind = None;
        control.shapes.clear();
    })
    .expect("it fits the device");
    for simulation in [&mut undisturbed, &mut simulation] {
        for _ in 0..4 {
            advance(simulation, 1.3 * FRAME);
        }
    }
    assert_eq!(positions(&simulation), positions(&undisturbed), "what is not there any more did nothing");
    // What stays acts: the air takes the cloth along, and a sphere lifts it.
    let mut checkpoint = None;
    gpu().run(|encoder| checkpoint = Some(simulation.checkpoint(encoder)));
    let start = places(&simulation, 1);
    // Below a corner of the inner sheet, which hangs down and will meet it.
    let centre = places(&simulation, 0)[0] - 0.15 * Vec3::Y;
    control(&mut simulation, |control| {
        control.pins[1].clear();
        control.wind = Some(Wind::new(dvec3(0.0, 0.0, 9.0)));
        control.shapes = vec![Shape::sphere(centre.as_dvec3(), 0.12)];
    })
    .expect("it fits the device");
    advance_for(&mut simulation, 12);
    control(&mut undisturbed, |control| control.pins[1].clear()).expect("it is in range");
    advance_for(&mut undisturbed, 12);
    assert!(places(&simulation, 1)[0].distance(start[0]) > 0.01, "what was held is let go");
    let [blown, calm] = [&simulation, &undisturbed].map(|simulation| mean(&places(simulation, 1)));
    assert!(blown.z > calm.z + 0.05, "the air takes it along: {blown} and {calm}");
    let nearest = |simulation: &Simulation| {
        places(simulation, 0).iter().map(|place| place.distance(centre)).fold(f32::MAX, f32::min)
    };
    let [with, without] = [&simulation, &undisturbed].map(nearest);
    assert!((0.12..0.15).contains(&with), "the corner lies on the sphere: {with} m from its centre");
    assert!(without > 0.3, "without it, it falls past: {without} m");
    // A checkpoint from before knows neither.
    let checkpoint = checkpoint.expect("it was made");
    gpu().run(|encoder| simulation.reset(encoder, &checkpoint).expect("it goes back"));
    assert_eq!(places(&simulation, 1), start);
    assert_eq!((simulation.control().wind, simulation.control().shapes.len()), (None, 0));
}

/// A sheet that has met nothing when a checkpoint is made, and then lies on a sphere.
#[test]
fn a_checkpoint_from_before_any_shape_is_gone_back_to() {
    let mut scene = rolling(1);
    scene.bodies.clear();
    let mut simulation = start(&scene);
    advance_for(&mut simulation, 2);
    let mut checkpoint = None;
    gpu().run(|encoder| checkpoint = Some(simulation.checkpoint(encoder)));
    let checkpoint = checkpoint.expect("it was made");
    let mut ends = Vec::new();
    for with_sphere in [false, true, false] {
        if with_sphere {
            let sphere = Shape::sphere(DVec3::ZERO, 0.25);
            control(&mut simulation, |control| control.shapes = vec![sphere.clone()]).expect("it fits the device");
        }
        advance_for(&mut simulation, 6);
        ends.push(places(&simulation, 0));
        gpu().run(|encoder| simulation.reset(encoder, &checkpoint).expect("it goes back"));
    }
    let lowest = |places: &[Vec3]| places.iter().map(|place| place.length()).fold(f32::MAX, f32::min);
    assert!(lowest(&ends[1]) > 0.25 && lowest(&ends[0]) < 0.25, "{} and {}", lowest(&ends[1]), lowest(&ends[0]));
    assert_eq!(ends[0], ends[2], "bit for bit");
}

#[test]
fn air_that_comes_while_a_body_is_dressed_is_felt_from_the_run_on() {
    let mut simulation = start(&walking(&["skirt"], "walk_loop"));
    advance(&mut simulation, FRAME);
    control(&mut simulation, |control| control.wind = Some(Wind::new(DVec3::X)))
        .expect("garments are dressed without it");
    advance(&mut simulation, FRAME);
    assert_eq!(simulation.stage().expect("it is finite"), Stage::Sewing);
}

#[test]
fn each_cloth_has_a_fabric_of_its_own() {
    let mut scene = rolling(2);
    let silk = Fabric::preset("silk").expect("a preset");
    scene.cloths[1].set_fabric(silk.clone());
    let mut simulation = start(&scene);
    assert_eq!(simulation.control().fabrics, [scene.settings.fabric.clone(), silk.clone()]);
    let seen = |simulation: &Simulation| -> Vec<(f32, f32, f32)> {
        let step = |worn: toile::Worn<'_>| {
            let (step, limit) = (worn.cloth.settings(), &worn.model.limits[0]);
            (step.thickness, step.friction, limit.max_length / limit.rest_length)
        };
        simulation.cloths().map(step).collect()
    };
    advance_for(&mut simulation, 2);
    let before = seen(&simulation);
    assert_eq!(before[0].0, scene.settings.fabric.thickness as f32);
    assert_eq!((before[1].0, before[1].1), (silk.thickness as f32, silk.friction as f32));
    let masses = |index: usize| simulation.cloths().nth(index).expect("it is there").model.masses[17];
    let ratio = (silk.areal_density / scene.settings.fabric.areal_density) as f32;
    assert!((masses(1) / masses(0) - ratio).abs() < 1e-4, "{} kg and {} kg", masses(0), masses(1));
    // What is changed of one leaves the other as it is.
    control(&mut simulation, |control| {
        control.fabrics[1].friction = 0.7;
        control.fabrics[1].threshold = Threshold::even(0.1);
    })
    .expect("it is in range");
    advance_for(&mut simulation, 2);
    let after = seen(&simulation);
    assert_eq!(after[0], before[0]);
    assert_eq!((after[1].0, after[1].1), (silk.thickness as f32, 0.7));
    assert!(after[1].2 > before[1].2 + 0.02, "{:?}", after[1]);
    // Taking one off leaves the fabric of the other.
    simulation.take_off(0);
    assert_eq!(simulation.control().fabrics[0].friction, 0.7);
    control(&mut simulation, |control| control.fabrics[0].friction = 0.6).expect("it is in range");
    assert_eq!(seen(&simulation), [(after[1].0, 0.6, after[1].2)]);
    // A fabric that no cloth has is refused by the name of its cloth.
    scene.cloths[1].set_fabric(with(silk, |fabric| fabric.thickness = 1.0));
    let error = Simulation::new(&gpu().device, &scene).expect_err("no cloth is so thick");
    assert_eq!(error.to_string(), "sheet 1.fabric.thickness is 1 and must be 0 to 0.05 m");
}

#[test]
#[should_panic(expected = "density and thickness of a cloth stay")]
fn the_thickness_of_no_cloth_changes_while_it_runs() {
    let mut simulation = start(&rolling(2));
    advance_for(&mut simulation, 1);
    let _ = control(&mut simulation, |control| control.fabrics[1].thickness *= 2.0);
}

/// An outer sheet of one thickness on an inner one of another, on a ball: each keeps its own from what is below.
#[test]
fn an_outfit_mixes_thicknesses() {
    let clearances = |thicknesses: [f64; 2]| -> [f32; 2] {
        let mut scene = rolling(2);
        scene.bodies = vec![Body::Mesh(Mesh::sphere(Vec3::ZERO, 0.25, 48))];
        for (cloth, thickness) in scene.cloths.iter_mut().zip(thicknesses) {
            cloth.set_fabric(with(scene.settings.fabric.clone(), |fabric| {
                fabric.thickness = thickness;
                fabric.damping = 5.0;
            }));
        }
        let mut simulation = start(&scene);
        advance_for(&mut simulation, 40);
        [0, 1]
            .map(|cloth| places(&simulation, cloth).iter().map(|place| place.length() - 0.25).fold(f32::MAX, f32::min))
    };
    for [inner, outer] in [[0.001, 0.001], [0.008, 0.001], [0.001, 0.008], [0.008, 0.008]] {
        let [below, above] = clearances([inner, outer]);
        assert!((below - inner as f32).abs() < 1e-3, "{inner} m and {outer} m: the inner is {below} m away");
        // A thinner one stays outside of the outer face of a thicker one, which is as far from its particles as these from the body.
        let expected = (inner + inner.max(outer)) as f32;
        assert!((above - expected).abs() < 2e-3, "{inner} m and {outer} m: the outer is {above} m away");
    }
}

/// The same while garments are dressed: a shirt of 3 mm sees the outer face of a skirt of 9 mm, not its particles.
#[test]
fn a_thin_garment_is_dressed_over_the_outer_face_of_a_thick_one() {
    let mut scene = walking(&["skirt", "shirt_sleeves"], "apose_to_walk");
    for (cloth, thickness) in scene.cloths.iter_mut().zip([0.009, 0.003]) {
        cloth.set_fabric(with(scene.settings.fabric.clone(), |fabric| fabric.thickness = thickness));
    }
    let mut simulation = start(&scene);
    while simulation.cloths().count() < 2 {
        advance(&mut simulation, FRAME);
        simulation.stage().expect("it is finite");
    }
    let worn: Vec<_> = simulation.cloths().collect();
    let [places, normals] = [&worn[0].cloth.frame().positions, &worn[0].cloth.frame().normals].map(|b| gpu().vec3s(b));
    let maps = worn[1].cloth.maps().expect("there are maps");
    let maps = toile_lab::read_maps(gpu(), maps, maps.space().map_box).expect("the device answers");
    let mut settings = worn[1].cloth.settings().clone();
    settings.swept = false;
    let points: Vec<Vec3> = places.iter().zip(&normals).map(|(place, normal)| *place + 0.014 * *normal).collect();
    let still = vec![Vec3::ZERO; points.len()];
    let probes = toile_reference::step::sample_body_maps(&points, &still, &maps, Default::default(), &settings);
    // What is free of the shirt's thickness, beyond the 9 mm of the skirt: where the nearest is the skirt.
    let mut free: Vec<f32> = probes.iter().filter(|probe| probe.hit).map(|probe| probe.distance).collect();
    free.sort_by(f32::total_cmp);
    let median = free[free.len() / 2];
    assert!(free.len() > places.len() / 2, "{} of {} see it", free.len(), places.len());
    assert!((median - 0.005).abs() < 1e-3, "14 mm from its particles the shirt has {median} m to go");
}

#[test]
fn shapes_follow_the_host_and_a_reset_undoes_all_of_it() {
    let mut scene = rolling(2);
    scene.bodies.push(Body::Shape(Shape::sphere(dvec3(0.0, 0.0, 3.0), 0.15)));
    let mut simulation = start(&scene);
    advance_for(&mut simulation, 10);
    let mut checkpoint = None;
    gpu().run(|encoder| checkpoint = Some(simulation.checkpoint(encoder)));
    let checkpoint = checkpoint.expect("it was just made");
    let (time, at_the_checkpoint) = (simulation.time(), positions(&simulation));
    let mut ends = Vec::new();
    for _ in 0..2 {
        // A sphere comes from aside and pushes the cloth.
        let key = |time, z| RigidKey { time, translation: dvec3(0.0, 0.0, z), rotation: Default::default() };
        let keys = vec![key(time, -2.2), key(time + 0.3, -2.9)];
        let motion = ShapeMotion::Keys(RigidMotion { keys });
        control(&mut simulation, |control| {
            control.shapes[0].motion = motion.clone();
            control.pins[0].insert(5, DVec3::Y);
        })
        .expect("it is in range");
        advance_for(&mut simulation, 20);
        ends.push(positions(&simulation));
        gpu().run(|encoder| simulation.reset(encoder, &checkpoint).expect("it was in range"));
        assert_eq!(positions(&simulation), at_the_checkpoint);
        assert_eq!(simulation.time(), time);
        assert!(simulation.control().pins[0].is_empty());
    }
    assert_eq!(ends[0], ends[1], "bit for bit");
    advance_for(&mut simulation, 20);
    assert_ne!(positions(&simulation), ends[0], "neither sphere nor pin is there now");
}

#[test]
fn a_cloth_that_is_taken_off_leaves_its_place_to_the_others() {
    let mut simulation = start(&rolling(2));
    advance_for(&mut simulation, 20);
    let (time, upper) = (simulation.time(), places(&simulation, 1));
    simulation.take_off(0);
    assert_eq!(simulation.cloths().map(|worn| worn.name).collect::<Vec<_>>(), ["sheet 1"]);
    assert_eq!(places(&simulation, 0), upper);
    assert!((simulation.time() - time).abs() < 1e-9, "time goes on: {} and {time}", simulation.time());
    let advance = advance(&mut simulation, FRAME);
    assert!(advance.step_count > 0 && (simulation.time() - time - FRAME).abs() < 2e-3);
    advance_for(&mut simulation, 6);
    // It lies on the ball, whose centre rolls along x at 1 m/s and up at 0.1 m/s.
    let ball = Vec3::new(simulation.time() as f32, 0.1 * simulation.time() as f32, 0.0);
    let nearest = places(&simulation, 0).iter().map(|p| p.distance(ball)).fold(f32::MAX, f32::min);
    assert!((0.249..0.27).contains(&nearest), "its nearest particle is {nearest} m from the centre");
}

#[test]
#[should_panic(expected = "a cloth is taken off once the run has begun")]
fn nothing_is_taken_off_while_it_is_dressed() {
    start(&walking(&["skirt", "shirt_sleeveless"], "walk_loop")).take_off(0);
}

/// A woman in a skirt is set elsewhere by whole texels: she goes on as if she had always been there.
#[test]
fn who_is_set_elsewhere_walks_on_in_the_same_skirt() {
    let scene = walking(&["skirt"], "walk_loop");
    let mut here = start(&scene);
    while here.stage().expect("she can be dressed") != Stage::Running {
        advance(&mut here, FRAME);
    }
    advance_for(&mut here, 3);
    let state = here.save(&gpu().queue).expect("a device");
    let set = |way: DVec3| {
        let mut there = start(&scene);
        there.restore(&gpu().queue, &state).expect("the same skirt");
        gpu().run(|encoder| there.teleport(encoder, way));
        there
    };
    let apart = |here: &[Vec3], there: &Simulation, way: DVec3| {
        let there = places(there, 0);
        let apart = || here.iter().zip(&there).map(|(a, b)| (*b - *a - way.as_vec3()).length());
        [apart().sum::<f32>() / here.len() as f32, apart().fold(0.0, f32::max)]
    };
    // Ten metres from the origin a place is told to a micrometre, and cloth that moves spreads that as it spreads any other nudge.
    let (way, nudge) = (dvec3(10.0, 0.0, -4.0), dvec3(1e-6, 0.0, 0.0));
    let (mut there, mut beside) = (set(way), set(nudge));
    for (simulation, way) in [(&there, way), (&beside, nudge)] {
        let [_, farthest] = apart(&places(&here, 0), simulation, way);
        assert!(farthest < 2e-6, "{farthest} m from where it was set");
    }
    for _ in 0..20 {
        for simulation in [&mut here, &mut there, &mut beside] {
            advance(simulation, FRAME);
        }
        let here = places(&here, 0);
        let [mean, farthest] = apart(&here, &there, way);
        let [nudged_mean, _] = apart(&here, &beside, nudge);
        assert!(
            mean < 3.0 * nudged_mean,
            "{mean} m, at most {farthest} m from where it should be; {nudged_mean} m of a nudge"
        );
    }
    there.stage().expect("it is finite");
    assert_eq!(there.place(), way);
    // Where she stands is part of a saved state.
    let state = there.save(&gpu().queue).expect("a device");
    let mut again = start(&scene);
    again.restore(&gpu().queue, &state).expect("the same skirt");
    advance(&mut there, FRAME);
    advance(&mut again, FRAME);
    assert_eq!(positions(&again), positions(&there));
}
