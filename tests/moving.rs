//! Bodies that move: their skin, the velocities in their maps, cloth on them, and cloth that they would pass through.

use glam::{DQuat, DVec3, Vec3, vec3};
use toile::Simulation;
use toile_gpu::{MapSpace, MovingBody};
use toile_lab::fixtures::{fixture, free_particle, scene, sheet_model};
use toile_lab::kernels::{first_difference, vec3_words};
use toile_lab::{DrawnMaps, read_maps};
use toile_model::{MapBox, Model, SideBox, StepSettings};
use toile_reference::maps::{BodyMaps, LayerMaps, SideMaps, Surface, skin_body, vertex_velocities};
use toile_reference::{Colliders, Reference};
use toile_scene::{Body, Cloth, MapKind, Mesh, Motion, MovingMesh, RigidKey, Rule, Scene, VelocityModification};
use toile_workspace::gpu;

fn walking(clip: &str) -> MovingMesh {
    let mut options = toile::files::BodyOptions::default();
    options.clip = Some(clip.to_owned());
    let path = fixture("bodies/walking_woman.glb");
    toile::files::read_moving_body(&path, &options).unwrap_or_else(|error| panic!("{error}")).body
}

fn sheet(n: &str) -> (Model, Scene) {
    let ball = scene("ball", &[("n", n), ("sheet.0.corner", "[-0.5, 0.256, 0.5]")]);
    (sheet_model(&ball), ball)
}

/// A sphere of the scene's size that goes along x at 1 m/s and turns.
fn rolling_ball() -> MovingMesh {
    let key = |time: f64| RigidKey {
        time,
        translation: DVec3::new(time, 0.1 * time, 0.0),
        rotation: DQuat::from_rotation_z(-2.0 * time),
    };
    MovingMesh::rigid(Mesh::sphere(Vec3::ZERO, 0.25, 48), vec![key(0.0), key(0.5), key(1.0)])
}

/// Where the maps of a body stand at a time [s].
fn box_at(body: &MovingMesh, time: f64, texel: f32) -> MapBox {
    let [low, high] = body.at(time).bounds().expect("a body has vertices");
    let [low, high] = [low - 0.03, high + 0.03];
    MapBox::moving([low, high], texel, MapBox::size_for(high - low, texel))
}

/// A scene of sheets that goes on a body.
fn simulation(scene: &Scene, body: &MovingMesh, texel: f64) -> Simulation {
    let mut scene = scene.clone();
    scene.bodies = vec![Body::Moving(body.clone())];
    scene.settings.texel = texel;
    Simulation::new(&gpu().device, &scene).expect("its body is finite")
}

/// Goes on by a frame of 1/60 s.
fn frame(simulation: &mut Simulation) {
    gpu().run(|encoder| {
        simulation.advance(encoder, 1.0 / 60.0).expect("it fits and stays finite");
    });
}

/// Velocities of all that maps show [m/s].
fn velocities(maps: &BodyMaps) -> Vec<Vec3> {
    match maps {
        BodyMaps::Sides(sides) => sides.velocities.as_ref().expect("a moving body").concat(),
        BodyMaps::Layers(layers) => layers.velocities.clone().expect("a moving body"),
    }
}

fn layers_of(maps: BodyMaps) -> LayerMaps {
    match maps {
        BodyMaps::Layers(layers) => layers,
        BodyMaps::Sides(_) => panic!("maps are layered where nothing else is asked for"),
    }
}

/// What the cloths see, from the inside out.
fn seen_maps(simulation: &Simulation) -> Vec<BodyMaps> {
    let map_box = simulation.map_box().expect("there are maps");
    let maps = simulation.cloths().map(|worn| worn.cloth.maps().expect("a cloth on a body has maps"));
    maps.map(|maps| read_maps(gpu(), maps, map_box).expect("the device answers")).collect()
}

#[test]
fn the_device_skins_the_walking_woman_bit_for_bit() {
    let woman = walking("walk_loop");
    let Motion::Skinned { skin, rig } = &woman.motion else { panic!("the woman has joints") };
    let mut body = MovingBody::new(&gpu().device, &woman, 0.005).expect("it fits the device");
    let mut last: Option<Vec<Vec3>> = None;
    for (index, time) in [0.0, 0.02, 0.04].into_iter().enumerate() {
        gpu().run(|encoder| body.record_pose(&gpu().device, encoder, time));
        let [positions, normals] = skin_body(&skin.positions, &skin.normals, skin, &rig.pose(time).joints);
        let rate = if index == 0 { 0.0 } else { (1.0 / (time - 0.02 * (index as f64 - 1.0))) as f32 };
        let velocities = vertex_velocities(last.as_ref().unwrap_or(&positions), &positions, rate);
        let surface = body.surface();
        let vertex_count = positions.len();
        let device = |buffer| vec3_words(&gpu().vec3s(buffer)[..vertex_count]);
        let same = |buffer, reference: &[Vec3]| first_difference(&device(buffer), &vec3_words(reference));
        assert!(same(&surface.positions, &positions).is_none(), "positions at {time} s");
        assert!(same(&surface.normals, &normals).is_none(), "normals at {time} s");
        let buffer = surface.velocities.as_ref().expect("a moving body has velocities");
        if index == 0 {
            assert!(gpu().vec3s(buffer).iter().all(|velocity| *velocity == Vec3::ZERO), "the first pose stands still");
        } else if let Some(fault) = same(buffer, &velocities) {
            panic!("velocities at {time} s: {fault}");
        }
        // f32 against f64: a few roundings of coordinates up to 2 m.
        let exact = woman.at(time);
        let far = positions.iter().zip(&exact.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        assert!(far < 3e-6, "{far} m at {time} s");
        last = Some(positions);
    }
}

#[test]
fn the_velocity_map_shows_how_a_turning_body_moves() {
    let ball = rolling_ball();
    let map_box = box_at(&ball, 0.2, 0.01);
    let mut body = MovingBody::new(&gpu().device, &ball, 0.01).expect("it fits the device");
    gpu().run(|encoder| {
        body.record_pose(&gpu().device, encoder, 0.199);
        body.record_pose(&gpu().device, encoder, 0.2);
    });
    let mut space = MapSpace::new(MapKind::Sides, map_box, 0.0);
    space.moving = true;
    let maps = DrawnMaps::draw_surfaces(gpu(), &[(body.surface(), 0.0)], &space).expect("the device answers");
    let (maps, map_box) = (maps.sides(), SideBox::of(&map_box));
    let layers = maps.velocities.as_ref().expect("a moving body");
    let mut seen = 0;
    for (side, (depth, velocities)) in maps.depth.iter().zip(layers).enumerate() {
        for (texel, velocity) in velocities.iter().enumerate().filter(|(texel, _)| depth[*texel] < 1.0) {
            let [column, row] = [texel % map_box.columns as usize, texel / map_box.columns as usize];
            let x = map_box.origin_x + (column as f32 + 0.5) * map_box.texel - 0.2;
            let y = map_box.origin_y - (row as f32 + 0.5) * map_box.texel - 0.02;
            // v + ω × r with ω = −2 rad/s around z.
            let expected = vec3(1.0 + 2.0 * y, 0.1 - 2.0 * x, 0.0);
            // Vertices go along chords, and the texel shows the last millisecond: 2 rad/s · 0.5 ms · 0.5 m/s.
            assert!(velocity.distance(expected) < 3e-3, "side {side}, ({x}, {y}): {velocity}, not {expected}");
            seen += 1;
        }
    }
    assert!(seen > 3000, "{seen} texels");
}

#[test]
fn whole_frames_on_a_moving_body_agree() {
    for kind in [MapKind::Layers, MapKind::Sides] {
        whole_frames_agree(kind);
    }
}

fn whole_frames_agree(kind: MapKind) {
    let ball = rolling_ball();
    let (model, mut scene) = sheet("24");
    scene.settings.maps = kind;
    let settings = StepSettings::new(&scene.settings, &model);
    let mut simulation = simulation(&scene, &ball, 0.01);
    let mut reference: Option<Reference> = None;
    let mut contacts = 0;
    for index in 1..=24 {
        frame(&mut simulation);
        let maps = seen_maps(&simulation).remove(0);
        assert!(velocities(&maps).iter().any(|v| v.x > 0.5));
        let reference = reference
            .get_or_insert_with(|| Reference::new(&model, &settings, Colliders::new(Some(maps.clone()), Vec::new())));
        reference.set_maps(maps);
        reference.steps(settings.steps_per_frame);
        let worn = simulation.cloths().next().expect("a sheet");
        let positions = vec3_words(&gpu().vec3s(&worn.cloth.frame().positions));
        let fault = first_difference(&positions, &vec3_words(reference.positions()));
        assert!(fault.is_none(), "frame {index}: {}", fault.expect("there is one"));
        contacts = contacts.max(reference.contacts().iter().filter(|contact| contact.touching).count());
    }
    assert!(contacts > 3, "{contacts} contacts");
    let carried: f32 = reference.expect("it ran").velocities().iter().map(|v| v.x).sum();
    assert!(carried > 0.0, "the ball takes the cloth along");
}

/// The maps of a body between two poses, extrapolated from those of the later one, put the surface where it is.
#[test]
fn a_surface_between_two_poses_is_where_its_velocity_says() {
    for kind in [MapKind::Layers, MapKind::Sides] {
        surface_between_two_poses(kind);
    }
}

fn surface_between_two_poses(kind: MapKind) {
    let ball = rolling_ball();
    let interval = 1.0 / 60.0;
    let map_box = box_at(&ball, 0.3, 0.005);
    let [before, after] = [ball.at(0.3 - interval), ball.at(0.3)];
    let velocities = vertex_velocities(&before.positions, &after.positions, (1.0 / interval) as f32);
    let surface = Surface { mesh: &after, thickness: 0.0, velocities: Some(&velocities), open: false };
    let maps = BodyMaps::draw(kind, &[surface], map_box);
    let mut settings = StepSettings::new(&sheet("4").1.settings, &free_particle());
    settings.swept = true;
    settings.thickness = 0.0;
    let mut worst: [f32; 2] = [0.0; 2];
    for (share, step) in [(0.0, 0), (0.5, 8), (0.95, 15)] {
        let time = 0.3 - interval * (1.0 - share);
        let centre = vec3(time as f32, 0.1 * time as f32, 0.0);
        for turn in 0..64 {
            let (sin, cos) = (turn as f32 * 0.09817).sin_cos();
            let direction = vec3(0.6 * cos, 0.6 * sin, if turn % 2 == 0 { 0.8 } else { -0.8 });
            let point = centre + direction * 0.26;
            let lag = toile_reference::Lag::of(step, 16, interval as f32 / 16.0);
            let lag = toile_reference::Lag { start: (interval * (1.0 - share)) as f32, ..lag };
            let still = toile_reference::Lag::default();
            let probe =
                |lag| toile_reference::step::sample_body_maps(&[point], &[Vec3::ZERO], &maps, lag, &settings)[0];
            worst[0] = worst[0].max((probe(lag).distance - 0.01).abs());
            worst[1] = worst[1].max((probe(still).distance - 0.01).abs());
        }
    }
    // The sphere of 48 rings is flatter than a sphere by 0.5 mm; a texel's plane adds the rest. Without extrapolation the
    // surface would be off by up to 17 mm.
    assert!(worst[0] < 0.002, "{kind:?}: {} m with extrapolation", worst[0]);
    assert!(worst[1] > 0.005, "{kind:?}: {} m without", worst[1]);
}

/// How many particles of a free upright sheet a ball of radius 0.1 m has passed through when it is 0.3 m beyond. Its maps are
/// drawn once per frame of 1/60 s.
fn passed(kind: MapKind, speed: f64, swept: bool) -> usize {
    let mut scene = scene("hang", &[("n", "24")]);
    scene.settings.gravity = DVec3::ZERO;
    // Limits would tear the cloth off the ball at such speeds.
    scene.settings.velocity_modification = VelocityModification::new(Rule::None);
    let Cloth::Sheet(sheet) = &mut scene.cloths[0] else { panic!("the scene has a sheet") };
    sheet.pins.clear();
    sheet.down = -DVec3::Y;
    let middle = sheet.corner + 0.5 * (sheet.right * sheet.size.x + sheet.down * sheet.size.y);
    let model = Model::from_sheet(sheet, &scene.settings);
    let mut settings = StepSettings::new(&scene.settings, &model);
    settings.swept = swept;
    // Cloth that may slide off the ball closes behind it.
    settings.pressing = f32::INFINITY;
    let start = middle - DVec3::Z * 0.5;
    let end = 0.8 / speed;
    let key = |time: f64| RigidKey { time, translation: start + DVec3::Z * speed * time, rotation: DQuat::IDENTITY };
    let ball = MovingMesh::rigid(Mesh::sphere(Vec3::ZERO, 0.1, 24), vec![key(0.0), key(1.0)]);
    let interval = f64::from(settings.dt) * f64::from(settings.steps_per_frame);
    let mut reference: Option<Reference> = None;
    let mut time = 0.0;
    while time < end {
        let [before, after] = [ball.at(time), ball.at(time + interval)];
        time += interval;
        let velocities = vertex_velocities(&before.positions, &after.positions, (1.0 / interval) as f32);
        let surface =
            Surface { mesh: &after, thickness: settings.thickness, velocities: Some(&velocities), open: false };
        let maps = BodyMaps::draw(kind, &[surface], box_at(&ball, time, 0.01));
        let colliders = Colliders::new(Some(maps.clone()), Vec::new());
        let reference = reference.get_or_insert_with(|| Reference::new(&model, &settings, colliders));
        reference.set_maps(maps);
        reference.steps(settings.steps_per_frame);
    }
    let centre = (start + DVec3::Z * speed * time).as_vec3();
    // Those that were in its way: the edges of the sheet close behind the ball.
    let in_the_way = |p: &Vec3| p.truncate().distance(centre.truncate()) < 0.06;
    let pairs = model.positions.iter().zip(reference.expect("it ran").positions().to_vec());
    pairs.filter(|(start, end)| in_the_way(start) && end.z < centre.z).count()
}

#[test]
fn a_fast_body_takes_the_cloth_along() {
    let ways = [(MapKind::Layers, [5.0, 50.0].as_slice()), (MapKind::Sides, &[5.0, 50.0, 150.0, 400.0])];
    for (kind, speeds) in ways {
        for speed in speeds {
            assert_eq!(passed(kind, *speed, true), 0, "{kind:?}: {speed} m/s");
        }
    }
    // Without the test of the whole way, a point that is deeper than the middle of the ball after one step is pushed out behind
    // it: from radius / dt on, which is 96 m/s.
    assert_eq!(passed(MapKind::Sides, 100.0, false), 0);
    assert!(passed(MapKind::Sides, 120.0, false) > 0);
}

/// What a sheet sees in two frames of the first round of the walk and in one of the second, with the maps of the round kept or
/// drawn in each frame.
fn seen(kept: bool) -> Vec<LayerMaps> {
    let mut simulation = simulation(&sheet("12").1, &walking("walk_loop"), 0.02);
    if kept {
        let bytes = simulation.keep_maps().expect("the walk ends as it begins");
        assert_eq!(bytes % 66, 0, "66 maps in 1.1 s");
    }
    let mut seen = Vec::new();
    for index in 1..=67 {
        frame(&mut simulation);
        if [1, 30, 67].contains(&index) {
            seen.push(layers_of(seen_maps(&simulation).remove(0)));
        }
    }
    seen
}

#[test]
fn maps_that_are_kept_are_those_that_are_drawn() {
    for (index, (kept, drawn)) in seen(true).iter().zip(seen(false)).enumerate() {
        let layers = |maps: &LayerMaps, column: usize| {
            let found = maps.columns[column];
            let range = found.first as usize..(found.first + found.end_count + found.sheet_count) as usize;
            let velocities = maps.velocities.as_ref().expect("a moving body");
            range.map(|k| (maps.depths[k], velocities[k])).collect::<Vec<_>>()
        };
        let alike = |column: &usize| {
            let [one, other] = [layers(kept, *column), layers(&drawn, *column)];
            let near = |(a, b): (&(f32, Vec3), &(f32, Vec3))| (a.0 - b.0).abs() < 1e-4 && a.1.distance(b.1) < 0.02;
            one.len() == other.len() && one.iter().zip(&other).all(near)
        };
        let met = (0..drawn.columns.len()).filter(|column| !layers(&drawn, *column).is_empty());
        let count = met.clone().count();
        assert!(count > 2000, "{count} columns meet the woman");
        // The second round is sampled at times that differ in the last bits: at a silhouette a vertex may move over a centre.
        let differing = met.filter(|column| !alike(column)).count();
        assert!(differing * 100 <= count, "frame {index}: {differing} of {count}");
    }
    let open = simulation(&sheet("12").1, &walking("walk_forward_4cycles"), 0.02).keep_maps();
    assert!(open.expect_err("it is not closed").to_string().contains("ends as it begins"));
    let mut slow = sheet("12").1;
    slow.settings.frame_rate = 50.0;
    let uneven = simulation(&slow, &walking("walk_loop"), 0.02).keep_maps();
    assert!(uneven.is_ok(), "1.1 s are 110 maps of 0.01 s");
    slow.settings.frame_rate = 61.0;
    let uneven = simulation(&slow, &walking("walk_loop"), 0.02).keep_maps();
    assert!(uneven.expect_err("not a whole number").to_string().contains("a whole number of maps"));
}

/// The outer one of two sheets sees the body and, where there is no body, the inner sheet and how it moves; the inner one sees
/// the body alone.
#[test]
fn an_outer_garment_sees_the_inner_one_as_it_moves() {
    let ball = rolling_ball();
    // Upright before the ball, so that the front camera looks at it.
    let placed = [("n", "24"), ("sheet.0.corner", "[-0.5, 0.3, 0.3]"), ("sheet.0.down", "[0.0, -1.0, 0.0]")];
    let scene = scene("ball", &placed);
    let thickness = scene.settings.fabric.thickness as f32;
    let mut twice = scene.clone();
    twice.cloths.push(scene.cloths[0].clone());
    twice.settings.maps = MapKind::Sides;
    let mut simulation = simulation(&twice, &ball, 0.01);
    let maps_of = |simulation: &Simulation| -> [SideMaps; 2] {
        let sides = |maps| match maps {
            BodyMaps::Sides(sides) => sides,
            BodyMaps::Layers(_) => panic!("the papers' maps were asked for"),
        };
        seen_maps(simulation).into_iter().map(sides).collect::<Vec<_>>().try_into().expect("two sheets")
    };
    // From the first frame on: the inner sheet, its thickness out of its particles. Its outside looks at the ball.
    frame(&mut simulation);
    let map_box = SideBox::of(&simulation.map_box().expect("there are maps"));
    let [inner, outer] = maps_of(&simulation);
    let sheet = (0..outer.depth[0].len()).filter(|i| inner.depth[0][*i] == 1.0 && outer.depth[0][*i] < 1.0);
    let mut texels = 0;
    for texel in sheet {
        let z = map_box.z_front - outer.depth[0][texel] * (map_box.z_front - map_box.z_back);
        assert!((z - 0.3 + thickness).abs() < 1e-4, "texel {texel}: the sheet is drawn at {z} m");
        assert!(outer.normals[0][texel].distance(Vec3::Z) < 1e-3, "texel {texel}: {}", outer.normals[0][texel]);
        texels += 1;
    }
    assert!(texels > 50, "{texels} texels");

    (1..4).for_each(|_| frame(&mut simulation));
    let [inner, outer] = maps_of(&simulation);
    let seen = |maps: &SideMaps| maps.depth[0].iter().filter(|depth| **depth < 1.0).count();
    assert!(seen(&outer) > seen(&inner) + 50, "{} and {} texels", seen(&outer), seen(&inner));
    let layers = outer.velocities.as_ref().expect("a moving body");
    // Free fall for four frames, seen over the last of them.
    let expected = -9.81 * 3.5 / 60.0;
    let falling = |texel: usize| inner.depth[0][texel] == 1.0 && outer.depth[0][texel] < 1.0;
    let speeds: Vec<f32> = (0..layers[0].len()).filter(|texel| falling(*texel)).map(|i| layers[0][i].y).collect();
    let alike = speeds.iter().filter(|speed| (**speed - expected).abs() < 0.15).count();
    assert!(2 * alike > speeds.len(), "{alike} of {} texels fall at {expected} m/s", speeds.len());
}
