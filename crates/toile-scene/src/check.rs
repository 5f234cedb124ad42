//! What a scene must be like, whoever made it: a file, a program or a slider.

use crate::{Cloth, Fabric, Form, Friction, OutOfRange, Polish, Scene, Settings, Shape, ShapeMotion, Sheet};
use crate::{VelocityModification, Wind};
use glam::DVec3;
use std::ops::RangeInclusive;

/// Largest component of a vector: positions [m], velocities [m/s] and gravity [m/s²] beyond it are slips.
pub(crate) const COMPONENTS: RangeInclusive<f64> = -1e6..=1e6;
/// Lengths of a sheet, a sphere's radius [m] and periods [s].
const SIZES: RangeInclusive<f64> = 1e-3..=1e3;
/// Length of what is of unit length.
pub(crate) const UNIT: RangeInclusive<f64> = 0.999..=1.001;
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
            match cloth {
                Cloth::Sheet(sheet) => check_sheet(sheet)?,
                Cloth::Garment(garment) => garment.check()?,
            }
            cloth.fabric().map_or(Ok(()), |fabric| fabric.check(&format!("{}.fabric.", cloth.name())))?;
        }
        self.bodies.iter().enumerate().try_for_each(|(at, body)| body.check(&format!("body {at}")))
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
        check_vector("gravity", self.gravity, &COMPONENTS, "m/s²")?;
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
        check_vector("wind.velocity", self.velocity, &Self::VELOCITIES, "m/s")?;
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
        check_vector(&of("centre"), self.centre, &COMPONENTS, "m")?;
        match self.form {
            Form::Sphere { radius } => OutOfRange::check(of("radius"), radius, &SIZES, "m")?,
            Form::Capsule { half_axis, radius } => {
                OutOfRange::check(of("radius"), radius, &SIZES, "m")?;
                OutOfRange::check(of("length"), 2.0 * half_axis.length(), &SIZES, "m")?;
            }
            Form::Plane { normal } => OutOfRange::check(of("normal"), normal.length(), &UNIT, "")?,
            Form::Box { half_size, rotation, radius } => {
                check_vector(&of("size"), 2.0 * half_size, &SIZES, "m")?;
                OutOfRange::check(of("rotation"), rotation.length(), &UNIT, "")?;
                OutOfRange::check(of("radius"), radius, &(0.0..=half_size.min_element()), "m")?;
            }
        }
        match &self.motion {
            ShapeMotion::Still => Ok(()),
            ShapeMotion::Keys(keys) => keys.check(self.name()),
            ShapeMotion::Swing { amplitude, period } => {
                check_vector(&of("swing.amplitude"), *amplitude, &COMPONENTS, "m")?;
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
    check_vector(&of("corner"), sheet.corner, &COMPONENTS, "m")?;
    for (name, direction) in [("right", sheet.right), ("down", sheet.down)] {
        OutOfRange::check(of(name), direction.length(), &UNIT, "")?;
    }
    for length in sheet.size.to_array() {
        OutOfRange::check(of("size"), length, &SIZES, "m")?;
    }
    for pin in &sheet.pins {
        OutOfRange::check(of("column of a pin"), f64::from(pin.column), &(0.0..=f64::from(sheet.columns - 1)), "")?;
        OutOfRange::check(of("row of a pin"), f64::from(pin.row), &(0.0..=f64::from(sheet.rows - 1)), "")?;
    }
    Ok(())
}

/// An error where a component of a vector is out of a range, or no number.
pub(crate) fn check_vector(
    name: &str,
    vector: DVec3,
    range: &RangeInclusive<f64>,
    unit: &'static str,
) -> Result<(), OutOfRange> {
    let mut components = ["x", "y", "z"].into_iter().zip(vector.to_array());
    components.try_for_each(|(axis, value)| OutOfRange::check(format!("{name}.{axis}"), value, range, unit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Body, Curve, Edge, EdgeRef, Garment, Mesh, MeshSequence, Motion, MovingMesh, Panel, Pin, Placement, RigidKey,
    };
    use crate::{RigidMotion, Rule, Seam};
    use glam::{DQuat, DVec2, Vec3};

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

    fn cuboid() -> Mesh {
        Mesh::cuboid(Vec3::ZERO, Vec3::ONE)
    }

    /// A triangle of which two edges are sewn together.
    fn garment(change: impl Fn(&mut Garment)) -> Garment {
        let edge = |start| Edge { start, curve: Curve::Straight, label: None };
        let placement = Placement { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };
        let edges = [DVec2::ZERO, DVec2::X, DVec2::Y].map(edge).to_vec();
        let seam = Seam { sides: [0, 1].map(|edge| EdgeRef { panel: 0, edge }), right_wrong: false };
        let panels = vec![Panel { name: "front".to_owned(), edges, placement }];
        let mut garment = Garment { name: "band".to_owned(), panels, seams: vec![seam], fabric: None };
        assert_eq!(garment.check(), Ok(()));
        change(&mut garment);
        garment
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
            said(&|scene| scene.bodies[0] = Body::Shape(Shape::cuboid(DVec3::ZERO, DVec3::new(1.0, 0.2, 1.0), 0.11))),
            said(&|scene| scene.bodies[0] = Body::Shape(Shape::cuboid(DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0), 0.0))),
            said(&|scene| sheet(scene, &|sheet| sheet.down = DVec3::ZERO)),
            said(&|scene| scene.settings.wind = Some(Wind::new(DVec3::Y * 101.0))),
            said(&|scene| scene.bodies[1] = Body::Mesh(Mesh::cuboid(Vec3::ZERO, Vec3::X * f32::NAN))),
            said(&|scene| scene.bodies[1] = Body::Mesh(Mesh { normals: vec![Vec3::Y], ..cuboid() })),
            said(&|scene| scene.bodies[1] = Body::Mesh(Mesh { triangles: vec![[0, 1, 24]], ..cuboid() })),
            said(&|scene| {
                let sequence = MeshSequence { frame_rate: 30.0, frames: vec![[vec![Vec3::ZERO], vec![Vec3::Y]]] };
                scene.bodies[1] = Body::Moving(MovingMesh { mesh: cuboid(), motion: Motion::Sequence(sequence) });
            }),
            said(&|scene| {
                let key = |time| RigidKey { time, translation: DVec3::ZERO, rotation: DQuat::IDENTITY };
                let motion = ShapeMotion::Keys(RigidMotion { keys: vec![key(1.0), key(0.5)] });
                scene.bodies[1] = Body::Shape(Shape { motion, ..Shape::sphere(DVec3::ZERO, 1.0) });
            }),
            said(&|scene| scene.cloths[0] = Cloth::Garment(garment(|garment| garment.seams[0].sides[1].edge = 3))),
            said(&|scene| scene.cloths[0] = Cloth::Garment(garment(|garment| garment.seams[0].sides[0].panel = 1))),
            said(&|scene| {
                let bent = |garment: &mut Garment| garment.panels[0].edges[1].start.y = f64::INFINITY;
                scene.cloths[0] = Cloth::Garment(garment(bent));
            }),
            said(&|scene| {
                let far =
                    |garment: &mut Garment| garment.panels[0].placement.rotation = DQuat::from_xyzw(0., 0., 0., 0.);
                scene.cloths[0] = Cloth::Garment(garment(far));
            }),
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
                "box.radius is 0.11 and must be 0 to 0.1 m",
                "box.size.y is 0 and must be 0.001 to 1000 m",
                "sheet flag: down is 0 and must be 0.999 to 1.001",
                "wind.velocity.y is 101 and must be -100 to 100 m/s",
                "body 1: vertex 0.x is NaN and must be -1000000 to 1000000 m",
                "body 1: normals is 1 and must be 24 to 24",
                "body 1: vertex of triangle 0 is 24 and must be 0 to 23",
                "body 1: vertices of frame 0 is 1 and must be 24 to 24",
                "sphere: time of key 1 is 0.5 and must be 1 to 1000000 s",
                "band: edge of seam 0 is 3 and must be 0 to 2",
                "band: panel of seam 0 is 1 and must be 0 to 0",
                "band: panel front: start of edge 1.y is inf and must be -1000000 to 1000000 m",
                "band: panel front: rotation is 0 and must be 0.999 to 1.001",
            ]
        );
    }
}
