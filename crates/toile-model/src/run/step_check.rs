//! What the numbers of a step must be, whoever made them.

use crate::{Model, ModelError, StepSettings};
use std::ops::RangeInclusive;
use toile_scene::{Friction, OutOfRange, Rule, Wind};

/// Time steps [s].
const STEPS: RangeInclusive<f64> = 1e-9..=1.0;
/// What is a part of a whole.
const PARTS: RangeInclusive<f64> = 0.0..=1.0;
/// Components of gravity [m/s²], and what else may be large but not endless.
const LARGE: f64 = 1e6;

impl StepSettings {
    /// An error where a number is one that no step has.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number, by the name of its field.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let amount = |name: &str, value: f32, unit| OutOfRange::check(name, f64::from(value), &(0.0..=LARGE), unit);
        OutOfRange::check("dt", f64::from(self.dt), &STEPS, "s")?;
        OutOfRange::check("steps_per_frame", f64::from(self.steps_per_frame), &(1.0..=LARGE), "")?;
        for component in self.gravity.to_array() {
            OutOfRange::check("gravity", f64::from(component), &(-LARGE..=LARGE), "m/s²")?;
        }
        self.wind.as_ref().map_or(Ok(()), Wind::check)?;
        amount("damping", self.damping, "1/s")?;
        amount("thickness", self.thickness, "m")?;
        amount("push_speed", self.push_speed, "m/s")?;
        amount("contact_margin", self.contact_margin, "m")?;
        OutOfRange::check("reflection", f64::from(self.reflection), &PARTS, "")?;
        if let Friction::Papers { velocity_kept, force_removed } = self.law {
            OutOfRange::check("law.velocity_kept", velocity_kept, &PARTS, "")?;
            OutOfRange::check("law.force_removed", force_removed, &PARTS, "")?;
        }
        amount("friction", self.friction, "")?;
        amount("pressing", self.pressing, "m/s²")?;
        amount("hold_rate", self.hold_rate, "1/s")?;
        amount("hold_speed", self.hold_speed, "m/s")
    }

    /// The same, and an error where these are no numbers for this model.
    ///
    /// # Errors
    /// [`ModelError::Range`] as [`StepSettings::check`], [`ModelError::Rule`] when they have the hierarchical rule and the model was made for another,
    /// [`ModelError::Polish`] when their rule knows none.
    pub fn check_with(&self, model: &Model) -> Result<(), ModelError> {
        self.check()?;
        if self.rule == Rule::Hierarchical && model.rule != Rule::Hierarchical {
            return Err(ModelError::Rule);
        }
        if self.polish.is_some() && !matches!(self.rule, Rule::Hierarchical | Rule::Predictive) {
            return Err(ModelError::Polish);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use crate::{Arrays, Model, StepSettings};
    use glam::Vec3;
    use toile_scene::{Fabric, Friction, Settings, Wind};

    #[test]
    fn what_no_step_has_is_told_by_name_value_and_range() {
        let model = Model::new(Arrays::of_particles(vec![Vec3::ZERO], vec![1.0])).expect("a particle is a model");
        let step = StepSettings::new(&Settings::new(Fabric::preset("wool").expect("a preset")), &model);
        assert_eq!(step.check(), Ok(()));
        let said = |change: &dyn Fn(&mut StepSettings)| {
            let mut step = step.clone();
            change(&mut step);
            step.check().expect_err("it is out of its range").to_string()
        };
        let said = [
            said(&|step| step.dt = 0.0),
            said(&|step| step.steps_per_frame = 0),
            said(&|step| step.gravity.z = f32::INFINITY),
            said(&|step| step.wind = Some(Wind::new(glam::DVec3::X * 1e9))),
            said(&|step| step.damping = f32::NAN),
            said(&|step| step.thickness = -0.5),
            said(&|step| step.reflection = 2.0),
            said(&|step| step.law = Friction::Papers { velocity_kept: 0.0, force_removed: -1.0 }),
            said(&|step| step.friction = f32::INFINITY),
        ];
        assert_eq!(
            said,
            [
                "dt is 0 and must be 0.000000001 to 1 s",
                "steps_per_frame is 0 and must be 1 to 1000000",
                "gravity is inf and must be -1000000 to 1000000 m/s²",
                "wind.velocity.x is 1000000000 and must be -100 to 100 m/s",
                "damping is NaN and must be 0 to 1000000 1/s",
                "thickness is -0.5 and must be 0 to 1000000 m",
                "reflection is 2 and must be 0 to 1",
                "law.force_removed is -1 and must be 0 to 1",
                "friction is inf and must be 0 to 1000000",
            ]
        );
    }
}
