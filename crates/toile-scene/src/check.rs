//! What a scene must be like, whoever made it: a file, a program or a slider.

use crate::{Body, Cloth, Fabric, Form, Friction, OutOfRange, Polish, Scene, Settings, Shape, ShapeMotion, Sheet};
use crate::{VelocityModification, Wind};
use glam::DVec3;
use std::ops::RangeInclusive;

/// Largest component of a vector: positions [m], velocities [m/s] and gravity [m/s²] beyond it are slips.
const COMPONENTS: RangeInclusive<f64> = -1e6..=1e6;
/// Lengths of a sheet, a sphere's radius [m] and periods [s].
const SIZES: RangeInclusive<f64> = 1e-3..=1e3;
/// What is a part of a whole.
const PARTS: RangeInclusive<f64> = 0.0..=1.0;

impl Scene {
    /// An error where a number of the scene is one that no scene has.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number, by the name that scene files give it.
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.settings.check()?;
        for cloth in &self.cloths {
            if let Cloth::Sheet(sheet) = cloth {
                check_sheet(sheet)?;
            }
            cloth.fabric().map_or(Ok(()), |fabric| fabric.check(&format!("{}.fabric.", cloth.name())))?;
        }
        let mut shapes = self.bodies.iter().filter_map(|body| match body {
            Body::Shape(shape) => Some(shape),
            Body::Mesh(_) | Body::Moving(_) => None,
        });
        shapes.try_for_each(Shape::check)
    }
}

impl Settings {
    /// An error where a number is one that no settings have.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number, by the name that scene files give it.
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.fabric.check("fabric.")?;
        Self::NUMBERS.iter().try_for_each(|number| number.check("", self))?;
        check_vector("gravity", self.gravity, "m/s²")?;
        self.wind.iter().try_for_each(Wind::check)?;
        if let Friction::Papers { velocity_kept, force_removed } = self.friction {
            OutOfRange::check("friction.papers.velocity_kept", velocity_kept, &PARTS, "")?;
            OutOfRange::check("friction.papers.force_removed", force_removed, &PARTS, "")?;
        }
        let VelocityModification { sweeps, polish, .. } = self.velocity_modification;
        let whole = |range: RangeInclusive<u32>| f64::from(*range.start())..=f64::from(*range.end());
        if let Some(sweeps) = sweeps {
            OutOfRange::check("sweeps", f64::from(sweeps), &whole(VelocityModification::SWEEPS), "")?;
        }
        if let Some(Polish { target, sweeps }) = polish {
            OutOfRange::check("polish.target", target, &Polish::TARGETS, "")?;
            OutOfRange::check("polish.sweeps", f64::from(sweeps), &whole(Polish::SWEEPS), "")?;
        }
        Ok(())
    }
}

impl Fabric {
    /// An error where a number is one that no fabric has. `prefix` stands before its name.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number.
    pub fn check(&self, prefix: &str) -> Result<(), OutOfRange> {
        Self::NUMBERS.iter().try_for_each(|number| number.check(prefix, self))
    }
}

impl Wind {
    /// An error where a number is one that no air has.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number.
    pub fn check(&self) -> Result<(), OutOfRange> {
        check_vector("wind.velocity", self.velocity, "m/s")?;
        Self::NUMBERS.iter().try_for_each(|number| number.check("wind.", self))
    }
}

impl Shape {
    /// An error where a number is one that no shape has.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let of = |part: &str| format!("{}.{part}", self.name());
        check_vector(&of("centre"), self.centre, "m")?;
        match self.form {
            Form::Sphere { radius } => OutOfRange::check(of("radius"), radius, &SIZES, "m")?,
            Form::Capsule { half_axis, radius } => {
                OutOfRange::check(of("radius"), radius, &SIZES, "m")?;
                OutOfRange::check(of("length"), 2.0 * half_axis.length(), &SIZES, "m")?;
            }
            Form::Plane { normal } => OutOfRange::check(of("normal"), normal.length(), &(0.999..=1.001), "")?,
        }
        match &self.motion {
            ShapeMotion::Still | ShapeMotion::Keys(_) => Ok(()),
            ShapeMotion::Swing { amplitude, period } => {
                check_vector(&of("swing.amplitude"), *amplitude, "m")?;
                OutOfRange::check(of("swing.period"), *period, &SIZES, "s")
            }
        }
    }
}

fn check_sheet(sheet: &Sheet) -> Result<(), OutOfRange> {
    let most = f64::from(Settings::PARTICLE_COUNT_MAX);
    let of = |part: &str| format!("sheet {}: {part}", sheet.name);
    for (name, count) in [("columns", sheet.columns), ("rows", sheet.rows)] {
        OutOfRange::check(of(name), f64::from(count), &(2.0..=0.5 * most), "")?;
    }
    OutOfRange::check(of("particles"), f64::from(sheet.columns) * f64::from(sheet.rows), &(4.0..=most), "")?;
    check_vector(&of("corner"), sheet.corner, "m")?;
    for length in sheet.size.to_array() {
        OutOfRange::check(of("size"), length, &SIZES, "m")?;
    }
    for pin in &sheet.pins {
        OutOfRange::check(of("column of a pin"), f64::from(pin.column), &(0.0..=f64::from(sheet.columns - 1)), "")?;
        OutOfRange::check(of("row of a pin"), f64::from(pin.row), &(0.0..=f64::from(sheet.rows - 1)), "")?;
    }
    Ok(())
}

/// An error where a component of a vector is a slip, or no number.
fn check_vector(name: &str, vector: DVec3, unit: &'static str) -> Result<(), OutOfRange> {
    let named = ["x", "y", "z"].into_iter().zip(vector.to_array());
    named
        .into_iter()
        .try_for_each(|(axis, value)| OutOfRange::check(format!("{name}.{axis}"), value, &COMPONENTS, unit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Pin, Rule};
    use glam::DVec2;

    fn scene() -> Scene {
        let sheet = Sheet {
            name: "flag".to_owned(),
            columns: 4,
            rows: 3,
            size: DVec2::ONE,
            corner: DVec3::ZERO,
            right: DVec3::X,
            down: DVec3::Z,
            pins: vec![Pin { column: 3, row: 2 }],
            fabric: None,
        };
        Scene {
            name: "scene".to_owned(),
            cloths: vec![Cloth::Sheet(sheet)],
            bodies: vec![
                Body::Shape(Shape::sphere(DVec3::ZERO, 0.2)),
                Body::Shape(Shape::plane(DVec3::ZERO, DVec3::Y)),
            ],
            settings: Settings {
                wind: Some(Wind::new(DVec3::X)),
                ..Settings::new(Fabric::preset("silk").expect("known"))
            },
        }
    }

    #[test]
    fn every_preset_may_be_worn() {
        for name in Fabric::PRESETS {
            assert_eq!(Settings::new(Fabric::preset(name).expect("a preset")).check(), Ok(()));
        }
        assert_eq!(scene().check(), Ok(()));
    }

    /// Every number of a table is looked at, and told by its name.
    #[test]
    fn every_number_has_its_range() {
        let refused = |scene: &Scene| scene.check().expect_err("it is out of its range").name;
        for number in Settings::NUMBERS {
            let mut scene = scene();
            *(number.of)(&mut scene.settings) = f64::NAN;
            assert_eq!(refused(&scene), number.name);
        }
        for number in Fabric::NUMBERS {
            let mut scene = scene();
            *(number.of)(&mut scene.settings.fabric) = number.range.end() * 1.1;
            assert_eq!(refused(&scene), format!("fabric.{}", number.name));
        }
        for number in Wind::NUMBERS {
            let mut scene = scene();
            *(number.of)(scene.settings.wind.as_mut().expect("it blows")) = f64::INFINITY;
            assert_eq!(refused(&scene), format!("wind.{}", number.name));
        }
    }

    #[test]
    fn what_no_scene_has_is_told_by_name_value_and_range() {
        let said = |change: &dyn Fn(&mut Scene)| {
            let mut scene = scene();
            change(&mut scene);
            scene.check().expect_err("it is out of its range").to_string()
        };
        let sheet = |scene: &mut Scene, change: &dyn Fn(&mut Sheet)| match &mut scene.cloths[0] {
            Cloth::Sheet(sheet) => change(sheet),
            Cloth::Garment(_) => {}
        };
        let said = [
            said(&|scene| scene.settings.fabric.thickness = 1.0),
            said(&|scene| scene.settings.gravity.y = f64::NAN),
            said(&|scene| scene.settings.velocity_modification.sweeps = Some(0)),
            said(&|scene| {
                scene.settings.velocity_modification = VelocityModification {
                    polish: Some(Polish { target: 0.0, sweeps: 1 }),
                    ..VelocityModification::new(Rule::Hierarchical)
                };
            }),
            said(&|scene| scene.settings.friction = Friction::Papers { velocity_kept: 2.0, force_removed: 0.0 }),
            said(&|scene| sheet(scene, &|sheet| sheet.columns = 1)),
            said(&|scene| sheet(scene, &|sheet| sheet.pins[0].row = 3)),
            said(&|scene| scene.bodies[0] = Body::Shape(Shape::sphere(DVec3::ZERO, -1.0))),
        ];
        assert_eq!(
            said,
            [
                "fabric.thickness is 1 and must be 0 to 0.05 m",
                "gravity.y is NaN and must be -1000000 to 1000000 m/s²",
                "sweeps is 0 and must be 1 to 64",
                "polish.target is 0 and must be 0.001 to 0.5",
                "friction.papers.velocity_kept is 2 and must be 0 to 1",
                "sheet flag: columns is 1 and must be 2 to 2097152",
                "sheet flag: row of a pin is 3 and must be 0 to 2",
                "sphere.radius is -1 and must be 0.001 to 1000 m",
            ]
        );
    }
}
