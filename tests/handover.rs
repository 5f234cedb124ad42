//! The handover from the open to the sewn model, and what a host gets of a frame.

use glam::{DVec3, Vec3};
use toile::{Cloth, Colliders};
use toile_gpu::Solver;
use toile_lab::fixtures::{garment, settings};
use toile_lab::{DrawnMaps, read_maps};
use toile_model::{Merge, Model, StepSettings};
use toile_scene::{MapKind, Mesh};
use toile_workspace::{advance, arrived, finish_frame, gpu};

/// The skirt, its models and the steps of both.
struct Skirt {
    open: Model,
    sewn: Model,
    merge: Merge,
    sewing: StepSettings,
    draping: StepSettings,
}

fn skirt() -> Skirt {
    let settings = settings(0.03);
    let open = Model::from_garment(&garment("skirt"), &settings).unwrap_or_else(|error| panic!("{error}"));
    let (sewn, merge) = open.sewn();
    let sewing = StepSettings::new(&settings, &open).sewing();
    let draping = StepSettings::new(&settings, &sewn).draping();
    Skirt { open, sewn, merge, sewing, draping }
}

/// Mass-weighted mean of some vectors.
fn mean(vectors: &[Vec3], masses: &[f32]) -> DVec3 {
    let total: f64 = masses.iter().map(|m| f64::from(*m)).sum();
    vectors.iter().zip(masses).map(|(v, m)| v.as_dvec3() * f64::from(*m)).sum::<DVec3>() / total
}

/// State of an open solver after some frames, and of the sewn one right after the handover: positions and velocities.
fn hand_over(skirt: &Skirt) -> [[Vec<Vec3>; 2]; 2] {
    let device = &gpu().device;
    let mut open = Solver::new(device, &skirt.open, &skirt.sewing, None, Vec::new()).expect("it fits the device");
    let mut sewn = Solver::new(device, &skirt.sewn, &skirt.draping, None, Vec::new()).expect("it fits the device");
    gpu().run(|encoder| {
        open.record_frame(device, encoder);
        open.record_frame(device, encoder);
        sewn.record_merge(device, encoder, &open, &skirt.merge);
    });
    assert_eq!(sewn.step(), open.step(), "time goes on");
    [&open, &sewn].map(|solver| [solver.positions(), solver.velocities()].map(|buffer| gpu().vec3s(buffer)))
}

#[test]
fn the_handover_keeps_mass_and_momentum_and_means() {
    let skirt = skirt();
    let [open, sewn] = hand_over(&skirt);
    assert!(skirt.sewn.particle_count() < skirt.open.particle_count());
    let total = |masses: &[f32]| masses.iter().map(|m| f64::from(*m)).sum::<f64>();
    assert!((total(&skirt.sewn.masses) / total(&skirt.open.masses) - 1.0).abs() < 1e-6);
    // A merge adds up at most a few members in f32, with an error of about 1e-7 of what it adds.
    for (kind, what) in ["centre of mass", "momentum"].into_iter().enumerate() {
        let [before, after] = [mean(&open[kind], &skirt.open.masses), mean(&sewn[kind], &skirt.sewn.masses)];
        assert!(open[kind].iter().any(|v| v.length() > 0.05), "there is a {what} to keep");
        assert!((after - before).length() < 1e-6, "{what}: {before} became {after}");
        for (particle, value) in sewn[kind].iter().enumerate() {
            let members = skirt.merge.members.row(particle);
            let values: Vec<Vec3> = members.iter().map(|i| open[kind][*i as usize]).collect();
            let masses: Vec<f32> = members.iter().map(|i| skirt.open.masses[*i as usize]).collect();
            let error = (value.as_dvec3() - mean(&values, &masses)).length();
            assert!(error < 1e-6 * (1.0 + f64::from(value.length())), "{what}: particle {particle} is off by {error}");
        }
    }
    // The saboteur: were only the first member of each taken, it would be found.
    let lost = |particle: usize| open[0][skirt.merge.members.row(particle)[0] as usize];
    assert!((0..sewn[0].len()).any(|particle| (sewn[0][particle] - lost(particle)).length() > 1e-4));
}

#[test]
fn the_sewn_simulation_goes_on_from_the_open_one() {
    let skirt = skirt();
    let device = &gpu().device;
    let mut open = Cloth::new(device, &skirt.open, &skirt.sewing, Default::default()).expect("it fits the device");
    let status = advance(&mut open).expect("it stays finite");
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut sewn =
        open.sewn(device, &mut encoder, &skirt.sewn, &skirt.merge, &skirt.draping).expect("it fits the device");
    gpu().queue.submit([encoder.finish()]);
    let after = finish_frame(&mut sewn).expect("it stays finite");
    assert_eq!(after.step, status.step);
    assert_eq!(after.seam_gap_max, 0.0, "no seam is open");
    assert!(after.kinetic_energy > 0.0 && after.kinetic_energy < 1.001 * status.kinetic_energy, "a merge takes energy");
    let later = advance(&mut sewn).expect("it stays finite");
    assert_eq!(later.step, status.step + u64::from(skirt.draping.steps_per_frame));
    assert!(gpu().vec3s(&sewn.frame().normals).iter().all(|n| (n.length() - 1.0).abs() < 1e-5), "normals are units");
}

#[test]
fn the_buffers_of_a_frame_are_what_a_renderer_binds() {
    let skirt = skirt();
    let cloth = Cloth::new(&gpu().device, &skirt.open, &skirt.sewing, Default::default()).expect("it fits the device");
    let frame = cloth.frame();
    let vertex = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    assert!(frame.positions.usage().contains(vertex) && frame.normals.usage().contains(vertex));
    assert!(frame.indices.usage().contains(wgpu::BufferUsages::INDEX));
    assert_eq!(frame.particle_count, skirt.open.particle_count());
    assert_eq!(frame.positions.size(), 16 * u64::from(frame.particle_count));
    assert_eq!(frame.normals.size(), 16 * u64::from(frame.particle_count));
    assert_eq!(frame.indices.size(), 4 * u64::from(frame.index_count));
    assert_eq!(frame.index_count as usize, 3 * skirt.open.triangles().len());
    let indices = gpu().words(&frame.indices);
    assert!(indices.iter().all(|index| *index < frame.particle_count));
    assert_eq!(indices, skirt.open.triangles().concat());
    let start: Vec<Vec3> = gpu().vec3s(&frame.positions);
    assert_eq!(start, skirt.open.positions, "before the first frame the cloth stands where it was placed");
}

/// A cloth is a surface for the maps of the next one, from the same buffers.
#[test]
fn a_cloth_can_be_drawn_into_the_maps_of_the_next_one() {
    let skirt = skirt();
    let mut cloth =
        Cloth::new(&gpu().device, &skirt.open, &skirt.sewing, Default::default()).expect("it fits the device");
    advance(&mut cloth).expect("it stays finite");
    let sphere = Mesh::sphere(Vec3::new(0.0, 0.9, 0.0), 0.5, 8);
    let seen = DrawnMaps::draw(gpu(), MapKind::Layers, &[(&sphere, 0.0)], 0.02).expect("the device answers");
    let map_box = seen.maps.space().map_box;
    let counts = |maps: &toile_reference::maps::BodyMaps| {
        let toile_reference::maps::BodyMaps::Layers(layers) = maps else { panic!("the maps are layered") };
        let ends: u32 = layers.columns.iter().map(|column| column.end_count).sum();
        let sheets: u32 = layers.columns.iter().map(|column| column.sheet_count).sum();
        [ends, sheets]
    };
    let [ends, sheets] = counts(&seen.read);
    assert!(ends > 1000 && sheets == 0, "a sphere is closed");
    let surface = cloth.frame().surface(&gpu().device);
    gpu().run(|encoder| seen.maps.record_over(&gpu().device, encoder, &[(&surface, 0.002)]));
    let over = read_maps(gpu(), &seen.maps, map_box).expect("the device answers");
    let [still, cloth] = counts(&over);
    assert_eq!(still, ends, "the sphere is seen as before");
    assert!(cloth > 1000, "{cloth} layers of cloth");
}

/// Nothing waits and nothing is mapped in the frame loop: frames may be recorded before any is submitted, more of them than
/// status reports can be under way, and the device is only polled.
#[test]
fn status_arrives_without_waiting_or_mapping_in_the_loop() {
    const FRAMES: usize = 12;
    let skirt = skirt();
    let device = &gpu().device;
    let mut cloth = Cloth::new(device, &skirt.open, &skirt.sewing, Colliders::default()).expect("it fits");
    assert_eq!(cloth.status().expect("it stays finite"), None, "before the first frame");
    let recorded: Vec<wgpu::CommandBuffer> = (0..FRAMES)
        .map(|_| {
            let mut encoder = device.create_command_encoder(&Default::default());
            cloth.record(device, &mut encoder);
            assert_eq!(cloth.status().expect("it stays finite"), None, "nothing was submitted");
            encoder.finish()
        })
        .collect();
    let at_once = recorded.len();
    gpu().queue.submit(recorded);
    let steps = u64::from(skirt.sewing.steps_per_frame);
    // Eight reports can be under way; the frames behind them go unreported but not undone.
    let newest = arrived("the status of frame 8", || {
        cloth.status().expect("it stays finite").filter(|status| status.step == 8 * steps)
    });
    assert_eq!(at_once as u64 * steps, cloth.step());
    assert!(newest.kinetic_energy > 0.0);
    // The slots are free again.
    let status = advance(&mut cloth).expect("it stays finite");
    assert_eq!(status.step, (FRAMES as u64 + 1) * steps);
}

/// Recorded in one go or frame by frame: the same bits, also where a moving sphere is uploaded for each frame.
#[test]
fn frames_recorded_together_are_frames_recorded_one_by_one() {
    let mut ball = toile_lab::fixtures::scene("moving-ball", &[("n", "17"), ("sheet.0.corner", "[-0.5, 0.256, 0.5]")]);
    let toile_scene::Cloth::Sheet(sheet) = ball.cloths.remove(0) else { panic!("it has a sheet") };
    let toile_scene::Body::Shape(sphere) = ball.bodies.remove(0) else { panic!("it has a sphere") };
    let model = Model::from_sheet(&sheet, &ball.settings);
    let step = StepSettings::new(&ball.settings, &model);
    let positions = |at_once: bool| {
        let colliders = Colliders::new(None, vec![sphere.clone()]);
        let mut cloth = Cloth::new(&gpu().device, &model, &step, colliders).expect("it fits the device");
        if at_once {
            gpu().run(|encoder| (0..6).for_each(|_| cloth.record(&gpu().device, encoder)));
        } else {
            (0..6).for_each(|_| gpu().run(|encoder| cloth.record(&gpu().device, encoder)));
        }
        gpu().words(&cloth.frame().positions)
    };
    assert_eq!(positions(true), positions(false));
}
