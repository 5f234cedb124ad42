//! What changes while a cloth runs: on the device as in the reference, bit for bit where a driver does one operation after the other.

use glam::{DVec3, Vec3, dvec3, vec3};
use std::collections::BTreeMap;
use toile::{Cloth, Colliders};
use toile_lab::fixtures::scene;
use toile_lab::{DrawnMaps, with};
use toile_model::{Model, PinTarget, StepSettings};
use toile_reference::Reference;
use toile_scene::{
    Cloth as Cut, MapKind, Mesh, RigidKey, RigidMotion, Scene, Settings, Shape, ShapeMotion, Sheet, Wind,
};
use toile_workspace::gpu;

/// Where a sphere touches nothing [m].
const BELOW: DVec3 = dvec3(0.5, -1.6, 0.4);

/// A sheet on the device and in the reference.
struct Twin {
    sheet: Sheet,
    settings: Settings,
    model: Model,
    cloth: Cloth,
    reference: Reference,
}

impl Twin {
    /// A sheet that hangs on two corners in a calm, beside a sphere.
    fn hanging() -> Self {
        Self::new("16", 0.0)
    }

    /// The same of so many particles on a side and of a bending rigidity [N·m].
    fn new(n: &str, rigidity: f64) -> Self {
        Self::beside(n, rigidity, None)
    }

    /// The same beside a body, too, in maps.
    fn beside(n: &str, rigidity: f64, body: Option<&DrawnMaps>) -> Self {
        let Scene { mut settings, mut cloths, .. } = scene("hang", &[("n", n)]);
        settings.fabric.bending_rigidity = rigidity;
        settings.wind = Some(with(Wind::new(DVec3::ZERO), |wind| wind.pressure = 0.01));
        let Cut::Sheet(sheet) = cloths.remove(0) else { panic!("it is a sheet") };
        let shapes = vec![Shape::sphere(BELOW, 0.2)];
        let model = Model::from_sheet(&sheet, &settings);
        let step = StepSettings::new(&settings, &model);
        let colliders = Colliders::new(body.map(|body| body.maps.clone()), shapes.clone());
        let cloth = Cloth::new(&gpu().device, &model, &step, colliders).expect("it fits the device");
        let read = body.map(|body| body.read.clone());
        let reference = Reference::new(&model, &step, toile_reference::Colliders::new(read, shapes));
        Self { sheet, settings, model, cloth, reference }
    }

    /// Changes the settings of the scene on both sides.
    fn change(&mut self, change: impl Fn(&mut Settings)) {
        change(&mut self.settings);
        let step = self.cloth.settings().with_numbers_of(&self.settings);
        let model = Model::from_sheet(&self.sheet, &self.settings);
        self.cloth.set_model(&model);
        gpu().run(|encoder| self.cloth.record_settings(&gpu().device, encoder, &step));
        self.reference.set_model(&model);
        self.reference.set_settings(&step);
        self.model = model;
    }

    fn hold(&mut self, pins: &[PinTarget]) {
        gpu().run(|encoder| self.cloth.record_pins(&gpu().device, encoder, pins));
        self.reference.set_pins(pins);
    }

    fn frames(&mut self, count: u32) {
        for _ in 0..count {
            gpu().run(|encoder| self.cloth.record(&gpu().device, encoder));
            self.reference.frame();
        }
    }

    fn positions(&self) -> Vec<Vec3> {
        gpu().vec3s(&self.cloth.frame().positions)
    }

    /// Both sides agree in all bits.
    fn agree(&self, after: &str) {
        let positions = self.positions();
        let first = (0..positions.len()).find(|i| positions[*i] != self.reference.positions()[*i]);
        if let Some(i) = first {
            panic!(
                "{after}: particle {i} is at {} and by the reference at {}",
                positions[i],
                self.reference.positions()[i]
            );
        }
    }

    fn mean(&self) -> Vec3 {
        let positions = self.positions();
        positions.iter().sum::<Vec3>() / positions.len() as f32
    }
}

#[test]
fn gravity_wind_damping_and_friction_change_without_new_buffers() {
    let mut twin = Twin::hanging();
    let bytes = twin.cloth.bytes();
    twin.frames(4);
    twin.agree("as it began");
    let before = twin.mean();
    twin.change(|settings| settings.gravity = dvec3(3.0, 6.0, 0.0));
    twin.frames(25);
    twin.agree("gravity turned over");
    assert!((twin.mean() - before).dot(vec3(3.0, 6.0, 0.0)) > 0.1, "it falls to where gravity points now");
    twin.change(|settings| {
        settings.gravity = DVec3::ZERO;
        settings.wind = Some(with(Wind::new(dvec3(0.0, 0.0, 8.0)), |wind| wind.pressure = 5.0));
    });
    let before = twin.mean();
    twin.frames(20);
    twin.agree("a wind blows");
    assert!(twin.mean().z > before.z + 0.05, "it goes with the wind: from {before} to {}", twin.mean());
    let speed = |twin: &Twin| {
        let velocities = gpu().vec3s(twin.cloth.velocities());
        velocities.iter().map(|v| v.length()).sum::<f32>() / velocities.len() as f32
    };
    let fast = speed(&twin);
    twin.change(|settings| {
        settings.wind = None;
        settings.fabric.damping = 200.0;
        settings.fabric.friction = 0.9;
        settings.reflection = 0.1;
    });
    twin.frames(10);
    twin.agree("without air, and damped");
    assert!(speed(&twin) < 0.1 * fast, "honey holds it: {} after {fast} m/s", speed(&twin));
    assert_eq!(twin.cloth.bytes(), bytes);
}

#[test]
fn rigidity_changes_whatever_its_springs_span() {
    let mut twin = Twin::new("65", 2e-3);
    let spans = |twin: &Twin| {
        let model = &twin.model;
        let places = |[a, b]: [u32; 2]| model.flat[a as usize].distance(model.flat[b as usize]);
        let links =
            (0..model.positions.len()).flat_map(|i| model.links.row(i).iter().map(move |link| (i as u32, link)));
        links.filter(|(_, link)| link.stiffness > 0.0).map(|(i, link)| places([i, link.other])).fold(0.0, f32::max)
    };
    // Cells of 16 mm: it carries 7e-4 N·m across two of them.
    for (rigidity, cells) in [(1e-4, 2.0), (2e-3, 4.0), (0.0, 2.0)] {
        twin.change(|settings| settings.fabric.bending_rigidity = rigidity);
        assert!((spans(&twin) * 64.0 - cells).abs() < 0.01, "{} cells at {rigidity} N·m", 64.0 * spans(&twin));
        twin.frames(2);
        twin.agree(&format!("{rigidity} N·m"));
    }
}

#[test]
fn threshold_and_stiffness_change_within_the_step() {
    let mut twin = Twin::hanging();
    twin.frames(30);
    let sag = |twin: &Twin| twin.positions().iter().map(|p| p.y).fold(f32::MAX, f32::min);
    let before = sag(&twin);
    twin.change(|settings| {
        settings.fabric.threshold = toile_scene::Threshold::even(0.15);
        settings.fabric.structural_stiffness = 2.0;
        settings.fabric.shear_stiffness = 1.0;
        settings.fabric.bending_rigidity = 1e-6;
    });
    twin.frames(60);
    twin.agree("softer and looser");
    let elongation = |twin: &Twin| twin.reference.status().elongation_max;
    let loose = elongation(&twin);
    assert!(loose > 0.07 && sag(&twin) < before - 0.02, "it stretches by {loose}");
    twin.change(|settings| settings.fabric.threshold = toile_scene::Threshold::even(0.02));
    twin.frames(60);
    twin.agree("tight again");
    let tight = elongation(&twin);
    assert!(tight < 0.025, "it is stretched by {tight}");
}

/// What is bound anew are maps, too.
#[test]
fn a_fabric_changes_on_a_body() {
    let body = Mesh::sphere(vec3(0.5, -0.35, 0.5), 0.25, 24);
    let body = DrawnMaps::draw(gpu(), MapKind::Layers, &[(&body, 0.0)], 0.02).expect("the device answers");
    let mut twin = Twin::beside("16", 0.0, Some(&body));
    twin.frames(25);
    let touching = |twin: &Twin| twin.reference.contacts().iter().filter(|contact| contact.touching).count();
    assert!(touching(&twin) > 0, "it lies on the body");
    twin.change(|settings| {
        settings.fabric.threshold = toile_scene::Threshold::even(0.15);
        settings.fabric.structural_stiffness = 2.0;
    });
    twin.frames(15);
    twin.agree("softer and looser on a body");
    assert!(touching(&twin) > 0, "it still lies there");
}

#[test]
fn particles_are_held_moved_and_let_go() {
    let mut twin = Twin::hanging();
    let seconds = f64::from(twin.cloth.settings().dt) * f64::from(twin.cloth.settings().steps_per_frame);
    twin.frames(2);
    // The middle of the lower edge is lifted, a corner is carried along.
    let (corner, lower) = (0, 16 * 15 + 8);
    let from = twin.positions();
    let [to_corner, to_lower] = [from[corner] + vec3(0.02, 0.0, 0.03), from[lower] + vec3(0.0, 0.05, 0.0)];
    twin.hold(&[PinTarget::held(corner as u32, to_corner, seconds), PinTarget::held(lower as u32, to_lower, seconds)]);
    twin.frames(1);
    twin.agree("on their way");
    twin.hold(&[PinTarget::still(corner as u32), PinTarget::still(lower as u32)]);
    twin.frames(5);
    twin.agree("held");
    let held = twin.positions();
    assert!(held[corner].distance(to_corner) < 1e-5 && held[lower].distance(to_lower) < 1e-5);
    // Everything is let go, the pin of the sheet too, which long-range attachments know.
    twin.hold(&[PinTarget::free(corner as u32), PinTarget::free(lower as u32), PinTarget::free(15)]);
    twin.frames(20);
    twin.agree("let go");
    let [fallen, before] = [twin.mean(), held.iter().sum::<Vec3>() / held.len() as f32];
    assert!(fallen.y < before.y - 0.3, "it falls freely: from {} to {} m", before.y, fallen.y);
}

#[test]
fn a_shape_goes_where_the_host_has_it() {
    let mut twin = Twin::hanging();
    twin.frames(2);
    let time = twin.cloth.step() as f64 * f64::from(twin.cloth.settings().dt);
    // Into the cloth, in a third of a second, and then away at once.
    let key = |time: f64, y: f64| RigidKey { time, translation: dvec3(0.0, y, 0.0), rotation: Default::default() };
    let motion = ShapeMotion::Keys(RigidMotion { keys: vec![key(time, 0.0), key(time + 0.3, 1.6)] });
    let mut pushing = Shape::sphere(BELOW, 0.2);
    pushing.motion = motion;
    for (shape, touches) in [(pushing, true), (Shape::sphere(5.0 * BELOW, 0.2), false)] {
        twin.cloth.set_shapes(vec![shape.clone()]);
        twin.reference.set_shapes(vec![shape]);
        let touching = |twin: &mut Twin| {
            twin.frames(1);
            twin.reference.contacts().iter().any(|contact| contact.touching)
        };
        assert_eq!((0..18).filter(|_| touching(&mut twin)).count() > 0, touches);
        twin.agree("another sphere");
    }
}

#[test]
fn a_cloth_goes_back_to_a_mark_bit_for_bit() {
    let mut twin = Twin::hanging();
    twin.frames(5);
    let mut mark = None;
    gpu().run(|encoder| mark = Some(twin.cloth.record_mark(&gpu().device, encoder)));
    let mark = mark.expect("it was just made");
    let at_the_mark = twin.positions();
    let mut ends = Vec::new();
    for _ in 0..2 {
        for _ in 0..5 {
            gpu().run(|encoder| twin.cloth.record(&gpu().device, encoder));
        }
        ends.push(twin.positions());
        gpu().run(|encoder| twin.cloth.record_reset(encoder, &mark));
        assert_eq!(twin.positions(), at_the_mark);
        assert_eq!(twin.cloth.status().expect("it is finite"), None, "what was reported is of another time");
    }
    assert_eq!(ends[0], ends[1]);
    assert_ne!(ends[0], at_the_mark);
}

#[test]
#[should_panic(expected = "a cloth without air gets none")]
fn a_wind_that_no_pass_knows_is_refused() {
    let Scene { settings, mut cloths, .. } = scene("hang", &[("n", "4")]);
    let Cut::Sheet(sheet) = cloths.remove(0) else { panic!("it is a sheet") };
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let mut cloth = Cloth::new(&gpu().device, &model, &step, Colliders::default()).expect("it fits the device");
    let windy = step.with_numbers_of(&with(settings, |settings| settings.wind = Some(Wind::new(DVec3::X))));
    gpu().run(|encoder| cloth.record_settings(&gpu().device, encoder, &windy));
}

#[test]
#[should_panic(expected = "particle 256 does not exist")]
fn a_particle_that_does_not_exist_cannot_be_held() {
    let mut twin = Twin::hanging();
    let pins: BTreeMap<u32, Vec3> = BTreeMap::from([(256, Vec3::ZERO)]);
    twin.hold(&pins.iter().map(|(particle, place)| PinTarget::held(*particle, *place, 1.0)).collect::<Vec<_>>());
}
