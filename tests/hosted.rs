//! A body that the host skins: it gives the maps of the same body from a file, and cloth on it goes the same way.

use glam::{DQuat, DVec3, Vec3, vec3};
use toile::gpu::{HostAttribute, HostMotion, HostVertices, MapSpace, MovingBody};
use toile::{Error, Simulation};
use toile_lab::DrawnMaps;
use toile_lab::fixtures::{fixture, scene};
use toile_lab::kernels::{first_difference, vec3_words};
use toile_model::MapBox;
use toile_reference::maps::LayerMaps;
use toile_scene::{Body, MapKind, Mesh, MovingMesh, RigidKey, Scene};
use toile_workspace::own_gpu as gpu;

const STORAGE: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE;
const FRAME: f64 = 1.0 / 60.0;
/// Words of a vertex of the host: something else, position, normal, velocity, the position before.
const STRIDE: usize = 14;

/// The vertices of a host that keeps all of them in one buffer, among other things, with normals of some length.
fn interleaved(mesh: &Mesh, velocities: &[Vec3], last: &[Vec3], by_velocity: bool) -> HostVertices {
    let mut words = vec![7.0_f32; 65];
    for (vertex, place) in mesh.positions.iter().enumerate() {
        let parts = [*place, 3.0 * mesh.normals[vertex], velocities[vertex], last[vertex]];
        words.extend([0.5, -0.5]);
        words.extend(parts.into_iter().flat_map(|part| part.to_array()));
    }
    let buffer = gpu().upload(bytemuck::cast_slice(&words), STORAGE);
    let attribute = |part: usize| HostAttribute::new(&buffer, 4 * (65 + 2 + 3 * part) as u64, 4 * STRIDE as u64);
    let motion = match by_velocity {
        true => HostMotion::Velocities(attribute(2)),
        false => HostMotion::LastPositions(attribute(3)),
    };
    let mut vertices = HostVertices::new(attribute(0), attribute(1));
    vertices.motion = Some(motion);
    vertices
}

fn walking() -> MovingMesh {
    let mut options = toile::files::BodyOptions::default();
    options.clip = Some("walk_loop".to_owned());
    let path = fixture("bodies/walking_woman.glb");
    toile::files::read_moving_body(&path, &options).unwrap_or_else(|error| panic!("{error}")).body
}

/// A sphere of the radius of the scene `ball` that goes along x [m/s] and turns.
fn rolling_ball(speed: f64) -> MovingMesh {
    let key = |time: f64| RigidKey {
        time,
        translation: DVec3::new(speed * time, 0.1 * time, 0.0),
        rotation: DQuat::from_rotation_z(-2.0 * time),
    };
    MovingMesh::rigid(Mesh::sphere(Vec3::ZERO, 0.25, 32), (0..=8).map(|k| key(0.25 * f64::from(k))).collect())
}

/// What each column meets: depths, normals and velocities.
fn columns(maps: &LayerMaps) -> Vec<Vec<(f32, Vec3, Vec3)>> {
    let velocities = maps.velocities.as_ref().expect("a moving body");
    let column = |column: &toile_reference::maps::Column| {
        let range = column.first as usize..(column.first + column.end_count + column.sheet_count) as usize;
        range.map(|k| (maps.depths[k], maps.normals[k], velocities[k])).collect()
    };
    maps.columns.iter().map(column).collect()
}

fn drawn(body: &MovingBody, space: &MapSpace) -> Vec<Vec<(f32, Vec3, Vec3)>> {
    let maps = DrawnMaps::draw_surfaces(gpu(), &[(body.surface(), 0.0)], space).expect("the device answers");
    columns(maps.layers())
}

/// The host skins by itself: here by the passes of a body from a file, whose buffers it gives.
#[test]
fn the_maps_of_the_hosts_buffers_are_those_of_the_file() {
    let device = &gpu().device;
    let woman = walking();
    let mut file = MovingBody::new(device, &woman, 0.02).expect("it fits the device");
    let mut hosted = MovingBody::new(device, &MovingMesh::hosted(woman.mesh.clone()), 0.02).expect("it fits");
    let skinned = file.surface().clone();
    let whole = |buffer| HostAttribute::new(buffer, 0, 16);
    let vertices = HostVertices::new(whole(&skinned.positions), whole(&skinned.normals));
    for time in [0.3, 0.3 + FRAME] {
        hosted.give(device, &vertices, time, FRAME).expect("it fits the device");
        gpu().run(|encoder| {
            file.record_pose(device, encoder, time);
            hosted.record_pose(device, encoder, time);
        });
    }
    let [low, high] = woman.at(0.3 + FRAME).bounds().expect("she has vertices");
    let map_box = MapBox::around([low, high], 0.02);
    let mut space = MapSpace::new(MapKind::Layers, map_box, woman.mesh.area());
    space.moving = true;
    let [file, hosted] = [drawn(&file, &space), drawn(&hosted, &space)];
    let (mut layers, mut moving) = (0, 0);
    for (one, other) in file.iter().zip(&hosted) {
        assert_eq!(one.len(), other.len());
        for (one, other) in one.iter().zip(other) {
            // Normals are made unit ones once more.
            assert!(one.0 == other.0 && one.1.distance(other.1) < 1e-6 && one.2 == other.2, "{one:?} {other:?}");
            layers += 1;
            moving += usize::from(one.2.length() > 0.5);
        }
    }
    assert!(layers > 4000 && moving > 1000, "{layers} layers, {moving} of them move");
}

#[test]
fn vertices_of_any_stride_go_ahead_to_the_time_of_the_maps() {
    let device = &gpu().device;
    let mesh = Mesh::sphere(vec3(0.1, 1.0, -0.2), 0.3, 12);
    let velocities: Vec<Vec3> = mesh.positions.iter().map(|p| vec3(p.y, -2.0 * p.x, 1.0)).collect();
    let seconds = 0.02;
    let last: Vec<Vec3> = mesh.positions.iter().zip(&velocities).map(|(p, v)| *p - *v * seconds as f32).collect();
    for by_velocity in [true, false] {
        let vertices = interleaved(&mesh, &velocities, &last, by_velocity);
        for ahead in [0.0, 0.012, -0.03] {
            let mut body = MovingBody::new(device, &MovingMesh::hosted(mesh.clone()), 0.01).expect("it fits");
            body.give(device, &vertices, 5.0, seconds).expect("it fits the device");
            gpu().run(|encoder| {
                body.record_pose(device, encoder, 5.0 + ahead - 0.01);
                body.record_pose(device, encoder, 5.0 + ahead);
                assert!(body.record_bounds(encoder) && !body.record_bounds(encoder), "one question at a time");
            });
            let count = mesh.positions.len();
            let expected: Vec<Vec3> =
                mesh.positions.iter().zip(&velocities).map(|(p, v)| *p + *v * ahead as f32).collect();
            let far = |buffer, expected: &[Vec3]| {
                let pairs = gpu().vec3s(buffer)[..count].to_vec().into_iter().zip(expected);
                pairs.map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
            };
            let surface = body.surface();
            assert!(far(&surface.positions, &expected) < 2e-6, "{by_velocity}, {ahead} s");
            assert!(far(&surface.normals, &mesh.normals) < 1e-6, "{by_velocity}, {ahead} s");
            let moving = surface.velocities.as_ref().expect("a moving body");
            assert!(far(moving, &velocities) < 1e-4, "{by_velocity}, {ahead} s");
            let [low, high] = body.take_bounds().expect("the device was waited for");
            let exact = |pick: fn(Vec3, Vec3) -> Vec3| expected.iter().copied().reduce(pick).expect("vertices");
            assert!(low.distance(exact(Vec3::min)) < 1e-5 && high.distance(exact(Vec3::max)) < 1e-5);
            assert!(body.take_bounds().is_none(), "each answer is taken once");
        }
    }
}

/// A sheet that lies down on a ball, which the host skins or which is given with its motion.
fn sheet_on(body: MovingMesh) -> Scene {
    let corner = "[-0.5, 0.256, 0.5]";
    let mut scene = scene("ball", &[("n", "24"), ("sheet.0.corner", corner)]);
    scene.bodies = vec![Body::Moving(body)];
    scene.settings.texel = 0.01;
    scene
}

/// The host shows a mesh at rest, so far along x [m].
fn show(simulation: &mut Simulation, mesh: &Mesh, x: f32) {
    let mut mesh = mesh.clone();
    mesh.positions.iter_mut().for_each(|p| p.x += x);
    let still = vec![Vec3::ZERO; mesh.positions.len()];
    simulation.set_vertices(interleaved(&mesh, &still, &mesh.positions, true));
}

/// The maps hold the ball, which is so far along x [m].
fn check_maps(simulation: &Simulation, x: f32) {
    let map_box = simulation.map_box().expect("there are maps");
    assert!(map_box.corner().x < x - 0.25 && map_box.far_corner().x > x + 0.25, "{x} m: {map_box:?}");
}

fn advance(simulation: &mut Simulation, seconds: f64) {
    gpu().run(|encoder| {
        simulation.advance(encoder, seconds).expect("it fits and stays finite");
    });
}

/// Positions of the sheet after so many calls at a rate [1/s], with the ball skinned by the host.
fn hosted_run(rate: f64, calls: u32, by_velocity: bool) -> Vec<Vec3> {
    let ball = rolling_ball(1.0);
    let mut simulation = Simulation::new(&gpu().device, &sheet_on(MovingMesh::hosted(ball.mesh.clone())));
    let simulation = simulation.as_mut().expect("its body is finite");
    for call in 1..=calls {
        let time = f64::from(call) / rate;
        let [last, now] = [ball.at(time - 1.0 / rate), ball.at(time)];
        let pairs = now.positions.iter().zip(&last.positions);
        let velocities: Vec<Vec3> = pairs.map(|(now, last)| (*now - *last) * rate as f32).collect();
        simulation.set_vertices(interleaved(&now, &velocities, &last.positions, by_velocity));
        advance(simulation, 1.0 / rate);
        simulation.stage().expect("the body is within its maps");
    }
    gpu().vec3s(&simulation.cloths().next().expect("a sheet").cloth.frame().positions)
}

#[test]
fn cloth_goes_the_same_way_on_a_body_that_the_host_skins() {
    // Up to a tenth of a second: later folds grow from what the last bits of normals say.
    for (rate, calls, frames, most) in
        [(60.0, 6, 6, 2e-6), (30.0, 3, 6, 3e-3), (144.0, 12, 5, 3e-3), (48.0, 4, 5, 3e-3)]
    {
        let mut given = Simulation::new(&gpu().device, &sheet_on(rolling_ball(1.0))).expect("its body is finite");
        (0..frames).for_each(|_| advance(&mut given, FRAME));
        let given = gpu().vec3s(&given.cloths().next().expect("a sheet").cloth.frame().positions);
        for by_velocity in [true, false] {
            let hosted = hosted_run(rate, calls, by_velocity);
            let far = hosted.iter().zip(&given).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            assert!(far < most, "{rate} Hz, by velocity {by_velocity}: {far} m");
        }
    }
}

#[test]
fn the_maps_follow_a_body_that_the_host_skins() {
    let ball = rolling_ball(0.0).mesh;
    let mut simulation = Simulation::new(&gpu().device, &sheet_on(MovingMesh::hosted(ball.clone())));
    let simulation = simulation.as_mut().expect("its body is finite");
    let show = |simulation: &mut Simulation, x: f32| {
        show(simulation, &ball, x);
        advance(simulation, FRAME);
    };
    // 1.5 m/s, well beyond what the maps hold at first.
    for frame in 0..60 {
        show(simulation, 0.025 * frame as f32);
        simulation.stage().expect("the body is within its maps");
    }
    check_maps(simulation, 1.475);
    // A jump that is told is none to the maps; one that is not is an error, until they have followed.
    gpu().run(|encoder| simulation.teleport(encoder, DVec3::X * 40.0));
    for _ in 0..3 {
        show(simulation, 41.475);
        simulation.stage().expect("the jump was told");
    }
    (0..2).for_each(|_| show(simulation, 61.475));
    let error = simulation.stage().expect_err("nobody told it");
    assert!(matches!(error, Error::Outside { outside } if (19.0..20.3).contains(&outside)), "{error}");
    for _ in 0..3 {
        show(simulation, 61.475);
        simulation.stage().expect("the maps have followed");
    }
}

/// A host that has four frames under way sees all answers of the device late.
#[test]
fn the_maps_follow_where_answers_come_late() {
    let ball = rolling_ball(0.0).mesh;
    let scene = sheet_on(MovingMesh::hosted(ball.clone()));
    let mut simulation = Simulation::new(&gpu().device, &scene).expect("its body is finite");
    // It sets off within half a second, and then goes 1.2 m/s: 0.14 m in seven frames, where there is room for 0.1 m.
    let x = |frame: u32| if frame < 30 { frame.pow(2) as f32 / 3000.0 } else { 0.3 + 0.02 * (frame - 30) as f32 };
    for batch in 0..20 {
        let frames = (4 * batch..4 * batch + 4).map(|frame| {
            show(&mut simulation, &ball, x(frame));
            let mut encoder = gpu().device.create_command_encoder(&Default::default());
            simulation.advance(&mut encoder, FRAME).expect("it fits and stays finite");
            simulation.stage().expect("the body is within its maps");
            encoder.finish()
        });
        let frames: Vec<_> = frames.collect();
        gpu().queue.submit(frames);
        gpu().device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    }
    check_maps(&simulation, x(79));
}

/// A body that has gone 1.5 m away, and 40 m by a teleport, is found where it was: by a reset, and by another simulation that goes on from its state.
#[test]
fn a_reset_and_a_saved_state_find_the_body_where_it_was() {
    let ball = rolling_ball(0.0).mesh;
    let scene = sheet_on(MovingMesh::hosted(ball.clone()));
    let mut simulation = Simulation::new(&gpu().device, &scene).expect("its body is finite");
    let show = |simulation: &mut Simulation, x: f32| {
        show(simulation, &ball, x);
        advance(simulation, FRAME);
        simulation.stage().expect("the body is within its maps");
        check_maps(simulation, x);
    };
    (0..60).for_each(|frame| show(&mut simulation, 0.025 * frame as f32));
    let mut checkpoint = None;
    gpu().run(|encoder| checkpoint = Some(simulation.checkpoint(encoder)));
    let checkpoint = checkpoint.expect("it was made");
    let state = simulation.save(&gpu().queue).expect("the device answers");
    (58..90).rev().for_each(|frame| show(&mut simulation, 0.025 * (frame - 30) as f32));
    gpu().run(|encoder| simulation.teleport(encoder, DVec3::X * 40.0));
    (0..2).for_each(|_| show(&mut simulation, 40.7));
    gpu().run(|encoder| simulation.reset(encoder, &checkpoint).expect("it goes back"));
    (0..3).for_each(|_| show(&mut simulation, 1.475));
    let mut other = Simulation::new(&gpu().device, &scene).expect("its body is finite");
    other.restore(&gpu().queue, &state).expect("it is of the same scene");
    (0..3).for_each(|_| show(&mut other, 1.475));
}

/// A body that the host skins with a buffer that is wrong in one way.
fn give(change: impl Fn(&mut HostVertices)) {
    let device = &gpu().device;
    let mesh = Mesh::sphere(Vec3::ZERO, 0.3, 8);
    let still = vec![Vec3::ZERO; mesh.positions.len()];
    let mut vertices = interleaved(&mesh, &still, &mesh.positions, true);
    change(&mut vertices);
    let mut body = MovingBody::new(device, &MovingMesh::hosted(mesh), 0.01).expect("it fits");
    body.give(device, &vertices, 0.0, FRAME).expect("it fits");
}

#[test]
#[should_panic(expected = "multiples of 4")]
fn an_uneven_offset_is_refused() {
    give(|vertices| vertices.normals.offset += 2);
}

#[test]
#[should_panic(expected = "the stride at least 12")]
fn a_stride_too_small_is_refused() {
    give(|vertices| vertices.positions.stride = 8);
}

#[test]
#[should_panic(expected = "their buffer has")]
fn a_buffer_too_short_is_refused() {
    give(|vertices| vertices.positions.offset += 4 * 60);
}

#[test]
#[should_panic(expected = "usage STORAGE")]
fn a_buffer_of_another_usage_is_refused() {
    give(|vertices| vertices.positions.buffer = gpu().upload(&[0; 1 << 16], wgpu::BufferUsages::VERTEX));
}

#[test]
#[should_panic(expected = "the scene has none")]
fn a_scene_without_such_a_body_takes_no_vertices() {
    let ball = rolling_ball(1.0);
    let still = vec![Vec3::ZERO; ball.mesh.positions.len()];
    let vertices = interleaved(&ball.mesh, &still, &still, true);
    let mut simulation = Simulation::new(&gpu().device, &sheet_on(ball)).expect("its body is finite");
    simulation.set_vertices(vertices);
}

#[test]
#[should_panic(expected = "a simulation of its own")]
fn two_such_bodies_are_refused() {
    let ball = MovingMesh::hosted(rolling_ball(1.0).mesh);
    let mut scene = sheet_on(ball.clone());
    scene.bodies.push(Body::Moving(ball));
    let _ = Simulation::new(&gpu().device, &scene);
}

#[test]
fn the_pass_has_the_bits_of_its_reference_in_a_window_of_a_large_buffer() {
    let device = &gpu().device;
    let mesh = Mesh::sphere(Vec3::ZERO, 0.3, 16);
    let count = mesh.positions.len();
    // Beyond where a device begins to bind, so that the window has a word before the first position.
    let first = 1000 * 64 + 3;
    let mut words = vec![f32::NAN; first];
    words.extend(mesh.positions.iter().flat_map(|p| p.to_array()));
    let buffer = gpu().upload(bytemuck::cast_slice(&words), STORAGE);
    let attribute = HostAttribute::new(&buffer, 4 * first as u64, 12);
    let vertices = HostVertices::new(attribute.clone(), attribute);
    let mut body = MovingBody::new(device, &MovingMesh::hosted(mesh.clone()), 0.01).expect("it fits");
    body.give(device, &vertices, 0.0, FRAME).expect("it fits");
    gpu().run(|encoder| body.record_pose(device, encoder, 0.0));
    let positions = &gpu().vec3s(&body.surface().positions)[..count];
    let fault = first_difference(&vec3_words(positions), &vec3_words(&mesh.positions));
    assert!(fault.is_none(), "{}", fault.expect("there is one"));
}
