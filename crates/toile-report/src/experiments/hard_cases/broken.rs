//! A number that is none, in one particle.

use super::case::{Case, Outcome};
use toile::Colliders;
use toile_lab::scenes::hanging_sheet;
use toile_lab::{Lab, LabError, Run};

/// The particle that is broken.
const PARTICLE: u32 = 37;

pub(super) const NAN: Case = Case {
    name: "NaN in the position of particle 37",
    must: "the typed error with the step and the particle",
    run: |lab| broken(lab, f32::NAN, false),
};

pub(super) const INFINITY: Case = Case {
    name: "infinity in the velocity of particle 37",
    must: "the typed error with the step and the particle",
    run: |lab| broken(lab, f32::INFINITY, true),
};

/// Breaks a particle after one frame and asks for the status, at once and after another frame.
fn broken(lab: &Lab, value: f32, velocity: bool) -> Result<Outcome, LabError> {
    let (sheet, settings) = hanging_sheet(12);
    let mut run = Run::sheet(lab, &sheet, &settings, Colliders::default())?;
    run.frame(lab)?;
    let buffer = if velocity { run.cloth.velocities() } else { &run.cloth.frame().positions };
    lab.queue.write_buffer(buffer, 16 * u64::from(PARTICLE), &value.to_le_bytes());
    let mut words = Vec::new();
    let mut held = true;
    for at_once in [true, false] {
        let mut encoder = lab.device.create_command_encoder(&Default::default());
        if at_once {
            run.cloth.record_outputs(&mut encoder);
        } else {
            run.cloth.record(&lab.device, &mut encoder);
        }
        lab.queue.submit([encoder.finish()]);
        lab.wait()?;
        match run.cloth.status() {
            Err(toile::Error::Diverged { step, particle, count }) => {
                let when = if at_once { "at once" } else { "a frame later" };
                words.push(format!("{when}: step {step}, first particle {particle}, {count} of them"));
                held &= step == run.cloth.step() && (!at_once || (particle, count) == (PARTICLE, 1));
            }
            Err(error) => return Err(error.into()),
            Ok(_) => {
                words.push("it was not seen".to_owned());
                held = false;
            }
        }
    }
    Ok(Outcome { happened: words.join("; "), held })
}
