//! Cloth that is hard by itself: what it is made of, how it starts, where it is.

use super::case::{Case, Course, Outcome, course};
use glam::{DQuat, DVec2, DVec3};
use toile::Colliders;
use toile::model::{Arrays, Model, StepSettings};
use toile::scene::{Curve, Edge, Garment, Panel, Placement, Settings, Sheet, Threshold};
use toile_lab::scenes::{fabric, hanging_sheet};
use toile_lab::{Lab, LabError, Random, Run};

const N: u32 = 12;
const FRAMES: u32 = 15;

pub(super) const STIFFNESS: Case = Case {
    name: "stiffness 1000 : 1",
    must: "finite; elongation below 10 %",
    run: |lab| {
        let outcome = sheet(
            lab,
            |_, settings| settings.fabric.structural_stiffness = 1000.0 * settings.fabric.shear_stiffness,
            |_| (),
        )?;
        Ok(outcome.held_if(|course| course.elongation_max < 0.1))
    },
};

pub(super) const MASSES: Case = Case {
    name: "masses 1000 : 1, in turns",
    must: "finite; elongation below 10 %",
    run: |lab| {
        let heavy = |model: &mut Arrays| {
            for i in (0..model.masses.len()).step_by(2) {
                model.masses[i] *= 1000.0;
                model.inverse_masses[i] /= 1000.0;
            }
            model.weigh_coarse_particles();
        };
        Ok(sheet(lab, |_, _| (), heavy)?.held_if(|course| course.elongation_max < 0.1))
    },
};

pub(super) const NEEDLE: Case = Case {
    name: "a needle-thin panel: 1 m long, 2 mm wide, meshed at 2 cm",
    must: "an error that names the panel, or finite",
    run: needle,
};

pub(super) const CRUMPLED: Case = Case {
    name: "a free sheet crumpled to a tenth",
    must: "finite; unfolds without getting faster than its springs' energy allows",
    run: crumpled,
};

pub(super) const COINCIDENT: Case = Case {
    name: "a whole row of coincident particles, and two neighbours in one place",
    must: "finite; elongation below 10 % at the end",
    run: |lab| {
        let coincide = |model: &mut Arrays| {
            let n = N as usize;
            let place = model.positions[5 * n];
            model.positions[5 * n..6 * n].fill(place);
            model.positions[8 * n + 4] = model.positions[8 * n + 5];
        };
        // The row starts a metre long in one place: what it must not do is to stay broken.
        Ok(sheet(lab, |_, _| (), coincide)?.held_if(|course| course.elongation_end < 0.1))
    },
};

pub(super) const WEIGHTLESS: Case = Case {
    name: "no gravity",
    must: "nothing moves faster than 0.1 mm/s",
    run: |lab| {
        let outcome = sheet(lab, |_, settings| settings.gravity = DVec3::ZERO, |_| ())?;
        Ok(outcome.held_if(|course| course.speed_max < 1e-4))
    },
};

pub(super) const HEAVY: Case = Case {
    name: "a thousand times gravity",
    must: "finite, or an error; elongation below 100 % if finite",
    run: |lab| {
        let outcome = sheet(lab, |_, settings| settings.gravity *= 1000.0, |_| ())?;
        let held = !outcome.0.finite || outcome.0.elongation_end < 1.0;
        Ok(Outcome { happened: outcome.0.words(), held })
    },
};

pub(super) const NO_THRESHOLD: Case = Case {
    name: "threshold 0",
    must: "finite; elongation below 2 %",
    run: |lab| {
        let outcome = sheet(lab, |_, settings| settings.fabric.threshold = Threshold::even(0.0), |_| ())?;
        Ok(outcome.held_if(|course| course.elongation_max < 0.02))
    },
};

pub(super) const FAR_AWAY: Case = Case {
    name: "50 km from the origin",
    must: "finite; elongation below 10 %, although f32 resolves 4 mm there",
    run: |lab| {
        let outcome = sheet(lab, |sheet, _| sheet.corner = DVec3::new(5e4, 0.0, 0.0), |_| ())?;
        Ok(outcome.held_if(|course| course.elongation_max < 0.1))
    },
};

/// The course of a changed sheet, not judged yet.
struct Judged(Course);

impl Judged {
    /// What happened, with what must hold besides staying finite.
    fn held_if(self, holds: impl FnOnce(&Course) -> bool) -> Outcome {
        Outcome { happened: self.0.words(), held: self.0.finite && holds(&self.0) }
    }
}

/// The sheet of the table on two held corners, with sheet, settings and model changed.
fn sheet(
    lab: &Lab,
    change: impl FnOnce(&mut Sheet, &mut Settings),
    change_model: impl FnOnce(&mut Arrays),
) -> Result<Judged, LabError> {
    let (mut sheet, mut settings) = hanging_sheet(N);
    change(&mut sheet, &mut settings);
    let model = Model::from_sheet(&sheet, &settings).changed(change_model)?;
    let step = StepSettings::new(&settings, &model);
    Ok(Judged(course(lab, model, step, Colliders::default(), FRAMES)?.1))
}

fn needle(lab: &Lab) -> Result<Outcome, LabError> {
    let corners = [DVec2::ZERO, DVec2::new(0.002, 0.0), DVec2::new(0.001, 1.0)];
    let edges = corners.iter().map(|&start| Edge::new(start, Curve::Straight)).collect();
    let placement = Placement { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };
    let panel = Panel::new("needle", edges, placement);
    let garment = Garment::new("needle", vec![panel], Vec::new());
    let mut settings = Settings::new(fabric());
    settings.spacing = 0.02;
    let model = match Model::from_garment(&garment, &settings) {
        Ok(model) => model,
        Err(error) => {
            let happened = error.to_string();
            let held = happened.contains("needle");
            return Ok(Outcome { happened, held });
        }
    };
    // It hangs by its tip, and is pushed out of its plane.
    let count = model.particle_count();
    let tip = (0..count as usize).max_by(|a, b| model.positions[*a].y.total_cmp(&model.positions[*b].y));
    let model = model.changed(|model| {
        tip.into_iter().for_each(|tip| model.inverse_masses[tip] = 0.0);
        model.weigh_coarse_particles();
        let random = &mut Random::new(lab.seed);
        model.positions.iter_mut().for_each(|position| position.z += random.between(-1e-3, 1e-3));
    })?;
    let step = StepSettings::new(&settings, &model);
    let (_, course) = course(lab, model, step, Colliders::default(), FRAMES)?;
    Ok(Outcome { happened: format!("{count} particles; {}", course.words()), held: course.finite })
}

fn crumpled(lab: &Lab) -> Result<Outcome, LabError> {
    let (mut sheet, mut settings) = hanging_sheet(N);
    sheet.pins.clear();
    settings.gravity = DVec3::ZERO;
    let random = &mut Random::new(lab.seed);
    let model = Model::from_sheet(&sheet, &settings).changed(|model| {
        model.positions.iter_mut().for_each(|position| *position = *position * 0.1 + random.vector(0.03));
    })?;
    let stored = spring_energy(&model);
    let mass: f64 = model.masses.iter().map(|mass| f64::from(*mass)).sum();
    let step = StepSettings::new(&settings, &model);
    let mut run = Run::new(lab, model, step, Colliders::default())?;
    let mut kinetic: f64 = 0.0;
    let mut finite = true;
    for _ in 0..FRAMES {
        match run.frame(lab)? {
            Some(status) => kinetic = kinetic.max(f64::from(status.kinetic_energy)),
            None => finite = false,
        }
    }
    let positions = run.positions(lab)?;
    let [low, high] =
        positions.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(*p), high.max(*p)]);
    let happened = format!(
        "springs stored {stored:.3e} J, {:.2} m/s of the whole; at most {kinetic:.3e} J became motion; {:.2} m wide at the end",
        (2.0 * stored / mass).sqrt(),
        (high - low).max_element()
    );
    Ok(Outcome { happened, held: finite && kinetic < 1.01 * stored })
}

/// Energy of all springs of a model at its start [J].
fn spring_energy(model: &Model) -> f64 {
    (0..model.positions.len())
        .flat_map(|i| model.links.row(i).iter().map(move |link| (i, link)))
        .map(|(i, link)| {
            let length = model.positions[i].distance(model.positions[link.other as usize]);
            // Each spring is a link of both its ends.
            0.25 * f64::from(link.stiffness) * f64::from(length - link.rest_length).powi(2)
        })
        .sum()
}
