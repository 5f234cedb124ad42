//! The air on the device: drag, lift, pressure, and what they do to a sheet.

use glam::{DVec2, DVec3, dvec3};
use toile_gpu::Solver;
use toile_lab::Random;
use toile_lab::fixtures::{scene, sheet_settings};
use toile_lab::with;
use toile_model::{Arrays, Link, Model, NO_CORNER, StepSettings};
use toile_scene::{AIR_DENSITY, Pin, Rule, Settings, Sheet, Wind};
use toile_workspace::gpu;

/// A sheet of 0.5 m × 0.5 m and 0.2 kg/m² with its outside along `right × down`.
fn sheet(right: DVec3, down: DVec3, pins: Vec<Pin>) -> Sheet {
    let [columns, rows] = [11, 11];
    let mut sheet = Sheet::new("sheet", [columns, rows], DVec2::splat(0.5));
    sheet.right = right;
    sheet.down = down;
    sheet.pins = pins;
    sheet
}

fn settings(wind: Wind, gravity: DVec3, damping: f64) -> Settings {
    let mut settings = sheet_settings();
    settings.wind = Some(wind);
    settings.gravity = gravity;
    settings.fabric.damping = damping;
    settings.velocity_modification.rule = Rule::None;
    settings
}

struct Run {
    model: Model,
    settings: StepSettings,
    solver: Solver,
}

impl Run {
    fn new(sheet: &Sheet, settings: &Settings, change: impl FnOnce(&mut Arrays)) -> Self {
        let model = Model::from_sheet(sheet, settings).changed(change).expect("arrays that fit together");
        let settings = StepSettings::new(settings, &model);
        let solver = Solver::new(&gpu().device, &model, &settings, None, Vec::new()).expect("it fits the device");
        Self { model, settings, solver }
    }

    fn step(&mut self, count: u32) {
        gpu().run(|encoder| self.solver.record_steps(&gpu().device, encoder, 0..count, count));
    }

    fn frame(&mut self) {
        self.step(self.settings.steps_per_frame);
    }

    fn positions(&self) -> Vec<DVec3> {
        gpu().vec3s(self.solver.positions()).iter().map(|p| p.as_dvec3()).collect()
    }

    fn velocities(&self) -> Vec<DVec3> {
        gpu().vec3s(self.solver.velocities()).iter().map(|v| v.as_dvec3()).collect()
    }
}

/// From v' = c·(w − v)² with c = ½·ρ·drag/σ: v = w − w/(1 + c·w·t).
#[test]
fn a_free_sheet_takes_on_the_wind_and_never_outruns_it() {
    // The last needs the guard against overshooting: without, its first step would reach several times the wind.
    for speed in [3.0, 25.0, 400.0] {
        let wind = Wind::new(dvec3(0.0, 0.0, -speed));
        let settings = settings(wind, DVec3::ZERO, 0.0);
        let mut run = Run::new(&sheet(DVec3::X, DVec3::Y, Vec::new()), &settings, |_| ());
        let rate = 0.5 * AIR_DENSITY * wind.drag / settings.fabric.areal_density * speed;
        let mut last = 0.0;
        for frame in 1..=20 {
            run.frame();
            let time = f64::from(run.settings.dt * (frame * run.settings.steps_per_frame) as f32);
            let expected = speed - speed / (1.0 + rate * time);
            for v in run.velocities() {
                let along = -v.z;
                assert!(along > last - 1e-4 * speed && along <= speed, "{speed} m/s: {along} after {last}");
                assert!((v.x.abs() + v.y.abs()) < 1e-3 * speed, "{v}");
                // The guard slows it while the step is long against 1/rate.
                let coarse = rate * f64::from(run.settings.dt);
                assert!((along - expected).abs() < (0.01 + coarse) * speed, "{speed} m/s: {along}, not {expected}");
            }
            last = -run.velocities()[0].z;
        }
        assert!(last > 0.5 * speed, "{last} of {speed} m/s");
    }
}

#[test]
fn a_sheet_edge_on_to_the_wind_feels_none() {
    // A sheet in the plane of the wind, and the saboteur that leans out of it.
    for (right, feels) in [(DVec3::Y, false), (dvec3(0.0, 0.8, 0.6), true)] {
        let windy = settings(Wind::new(dvec3(0.0, 7.0, 0.0)), DVec3::ZERO, 0.0);
        let mut calm = windy.clone();
        calm.wind = None;
        // Springs whose rest length is rounded move by themselves, the same in both.
        let [windy, calm] = [windy, calm].map(|settings| {
            let mut run = Run::new(&sheet(right, DVec3::X, Vec::new()), &settings, |_| ());
            run.frame();
            run.velocities()
        });
        assert_eq!(windy != calm, feels, "{right}");
    }
}

/// The force on a flat plate [N] as textbooks tell it: drag and lift by angle, in f64.
fn plate(corners: &[DVec3], wind: &Wind) -> DVec3 {
    let area = match corners {
        [a, b, c] => 0.5 * (*b - *a).cross(*c - *a),
        [a, b, c, d] => 0.5 * (*c - *a).cross(*d - *b),
        _ => panic!("a quad or a triangle"),
    };
    let u = wind.velocity;
    let angle = u.angle_between(area).min(u.angle_between(-area));
    let pressure = 0.5 * AIR_DENSITY * u.length_squared() * area.length() * angle.cos();
    // Across the wind, on the side to which the leeward normal leans.
    let leeward = area * area.dot(u).signum();
    let crosswise = (leeward - u * (leeward.dot(u) / u.length_squared())).normalize_or_zero();
    u.normalize() * (pressure * wind.drag) + crosswise * (pressure * angle.sin() * wind.lift)
}

/// Sum of the forces on all quads [N].
fn load(model: &Model, wind: &Wind) -> DVec3 {
    let corners = |quad: &[u32; 4]| -> Vec<DVec3> {
        quad.iter().filter(|i| **i != NO_CORNER).map(|i| model.positions[*i as usize].as_dvec3()).collect()
    };
    model.quads.iter().map(|quad| plate(&corners(quad), wind)).sum()
}

#[test]
fn the_momentum_gained_is_the_sum_of_drag_and_lift_of_all_quads() {
    let mut wind = Wind::new(dvec3(0.4, 0.9, -0.7));
    wind.drag = 1.1;
    wind.lift = 0.6;
    let mut settings = settings(wind, DVec3::ZERO, 0.0);
    settings.safety = 0.05;
    let crumple = |model: &mut Arrays| {
        let random = &mut Random::new(3);
        for position in &mut model.positions {
            *position += random.vector(0.02);
        }
    };
    let mut run = Run::new(&sheet(DVec3::X, DVec3::NEG_Z, Vec::new()), &settings, crumple);
    let force = load(&run.model, &wind);
    let dt = f64::from(run.settings.dt);
    run.step(1);
    let gained: DVec3 = run.velocities().iter().zip(&run.model.masses).map(|(v, m)| *v * f64::from(*m)).sum();
    // The guard takes dt·rate of it: 1.2 kg/m³ · 1.2 m/s · 1.7 / (2 · 0.2 kg/m²) · dt, less where quads stand askew, more where
    // they are stretched.
    let guarded = 0.5 * AIR_DENSITY * wind.velocity.length() * 1.7 / settings.fabric.areal_density * dt;
    assert!(guarded < 0.01);
    let error = (gained - force * dt).length() / (force * dt).length();
    assert!(error < 2.0 * guarded, "gained {gained}, forces give {}", force * dt);
    let without_lift = load(&run.model, &with(wind, |wind| wind.lift = 0.0));
    assert!((force - without_lift).length() > 0.1 * force.length(), "the test sees the lift");
}

/// A flag under uniform loads hangs straight along their sum. With θ from the plumb line, the wind carries
/// q·cos θ·drag along itself and q·cos θ·sin θ·lift upward, per area; q = ½·ρ·w².
#[test]
fn a_flag_in_light_wind_hangs_along_gravity_and_wind_together() {
    let speed = 0.65;
    let wind = Wind::new(dvec3(0.0, 0.0, speed));
    let settings = settings(wind, dvec3(0.0, -9.81, 0.0), 4.0);
    let pins = (0..11).map(|column| Pin { column, row: 0 }).collect();
    let mut run = Run::new(&sheet(DVec3::X, DVec3::NEG_Y, pins), &settings, |_| ());
    for _ in 0..240 {
        run.frame();
    }
    assert!(run.velocities().iter().all(|v| v.length() < 2e-3), "it hangs still");
    let weight = settings.fabric.areal_density * 9.81;
    let pressure = 0.5 * AIR_DENSITY * speed * speed;
    let mut tilt = (pressure * wind.drag / weight).atan();
    for _ in 0..20 {
        let [sine, cosine] = [tilt.sin(), tilt.cos()];
        tilt = (pressure * cosine * wind.drag / (weight - pressure * cosine * sine * wind.lift)).atan();
    }
    let end = run.positions();
    for column in 0..11 {
        let span = end[110 + column] - end[column];
        let found = span.z.atan2(-span.y);
        assert!((found - tilt).abs() < 0.02 * tilt, "column {column}: {found} rad, not {tilt}");
    }
}

/// Air that only presses, as a scene says it.
fn pressing(pressure: &str) -> Wind {
    let air = format!("{{ velocity = [0, 0, 0], drag = 0, lift = 0, pressure = {pressure} }}");
    scene("hang", &[("wind", &air)]).settings.wind.expect("the scene has air")
}

/// The rim of a sheet and its area decide what a pressure does to all of it, however it bulges: p times the area that the rim spans.
#[test]
fn the_momentum_gained_under_pressure_is_that_of_the_flat_area() {
    for pressure in ["20", "-5"] {
        let wind = pressing(pressure);
        let bulge = |model: &mut Arrays| {
            for (i, position) in model.positions.iter_mut().enumerate() {
                let [x, y] = [i % 11, i / 11].map(|place| place as f32 / 10.0);
                position.z += 0.3 * (x * (1.0 - x) * y * (1.0 - y)).sqrt();
            }
        };
        let mut run = Run::new(&sheet(DVec3::X, DVec3::Y, Vec::new()), &settings(wind, DVec3::ZERO, 0.0), bulge);
        run.step(1);
        let dt = f64::from(run.settings.dt);
        let gained: DVec3 = run.velocities().iter().zip(&run.model.masses).map(|(v, m)| *v * f64::from(*m)).sum();
        // 0.5 m × 0.5 m, with its outside along +z.
        let expected = DVec3::Z * (wind.pressure * 0.25 * dt);
        let error = (gained - expected).length() / expected.length();
        assert!(error < 1e-4, "{pressure} Pa: gained {gained}, not {expected}");
    }
}

/// A strip that is held at both its ends stands as an arc of radius R, and its springs carry T = p·R·width.
#[test]
fn a_strip_under_pressure_stands_as_an_arc() {
    let (wind, width) = (pressing("10"), 0.05);
    let pins = [0, 1].into_iter().flat_map(|column| [0, 20].map(|row| Pin { column, row })).collect();
    let mut strip = sheet(DVec3::X, DVec3::Y, pins);
    strip.columns = 2;
    strip.rows = 21;
    strip.size = DVec2::new(width, 0.5);
    let mut settings = settings(wind, DVec3::ZERO, 8.0);
    settings.fabric.bend_stiffness = 0.0;
    settings.fabric.shear_stiffness = 0.0;
    let mut run = Run::new(&strip, &settings, |_| ());
    for _ in 0..240 {
        run.frame();
    }
    assert!(run.velocities().iter().all(|v| v.length() < 1e-3), "it stands still");
    let end = run.positions();
    let sag = end[20].z;
    let radius = (0.25 * 0.25 + sag * sag) / (2.0 * sag);
    let centre = dvec3(0.0, 0.25, sag - radius);
    assert!(sag > 0.05, "it stands out by {sag} m");
    for row in 0..21 {
        let found = (end[2 * row] - centre).length();
        assert!((found - radius).abs() < 0.002 * radius, "row {row}: {found} m from the centre, not {radius}");
    }
    for row in 0..20 {
        let mut tension = 0.0;
        for i in [2 * row, 2 * row + 1] {
            let next = |link: &&Link| link.other as usize == i + 2;
            let link = run.model.links.row(i).iter().find(next).expect("a spring along the strip");
            let excess = (end[i + 2] - end[i]).length() - f64::from(link.rest_length);
            tension += f64::from(link.stiffness) * excess;
        }
        let expected = wind.pressure * radius * width;
        assert!((tension - expected).abs() < 0.01 * expected, "row {row}: {tension} N, not {expected}");
    }
}
