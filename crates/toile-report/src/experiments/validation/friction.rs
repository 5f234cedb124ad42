//! Coulomb's friction angle on a tilted plate: cloth sticks below atan(μ) and slides above, through the maps.

use super::laws::settings;
use crate::page::{Block, Cell, Table};
use glam::{DQuat, DVec2, DVec3, Vec3};
use toile::Colliders;
use toile::scene::{Friction, Mesh, Rule, Sheet};
use toile_lab::{DrawnMaps, Lab, LabError, Run};

/// μ of the cloth on the plate: atan(0.5) is 26.6°.
pub const FRICTION: f64 = 0.5;

/// How long it slides [s].
const SECONDS: f64 = 0.6;

/// What a sheet on the plate does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slide {
    /// How far it slides downhill [m], the mean of its particles.
    pub way: f64,
    /// How far any of them leaves the plate [m].
    pub off: f64,
}

/// Lays a sheet of 24 cm and 9 × 9 particles on a plate that is tilted by `degrees`, for 0.6 s.
///
/// # Errors
/// [`LabError`] when the device is lost.
pub fn slide(lab: &Lab, degrees: f64, friction: Friction) -> Result<Slide, LabError> {
    let mut settings = settings(Rule::Hierarchical);
    settings.fabric.friction = FRICTION;
    settings.friction = friction;
    let thickness = settings.fabric.thickness;
    let (mesh, tilt) = plate(degrees);
    let [right, uphill, normal] = [DVec3::X, tilt * DVec3::NEG_Z, tilt * DVec3::Y];
    let mut sheet = Sheet::new("sheet", [9, 9], DVec2::splat(0.24));
    sheet.corner = normal * thickness - right * 0.12;
    sheet.right = right;
    sheet.down = uphill;
    let layers = DrawnMaps::draw(&lab.gpu(), settings.maps, &[(&mesh, thickness as f32)], settings.texel as f32)?;
    let colliders = Colliders::new(Some(layers.maps), Vec::new());
    let mut run = Run::sheet(lab, &sheet, &settings, colliders)?;
    for _ in 0..(SECONDS * settings.frame_rate).round() as u32 {
        run.frame(lab)?;
    }
    let end = run.positions(lab)?;
    let ways = || end.iter().zip(&run.model.positions).map(|(position, start)| *position - start.as_dvec3());
    Ok(Slide {
        way: ways().map(|way| -way.dot(uphill)).sum::<f64>() / end.len() as f64,
        off: ways().map(|way| way.dot(normal).abs()).fold(0.0, f64::max),
    })
}

/// Way [m] of a point that slides with Coulomb friction.
pub fn coulomb_way(degrees: f64) -> f64 {
    let angle = degrees.to_radians();
    (0.5 * 9.81 * (angle.sin() - FRICTION * angle.cos()) * SECONDS * SECONDS).max(0.0)
}

/// A plate whose upper side falls towards the front camera by `degrees`.
fn plate(degrees: f64) -> (Mesh, DQuat) {
    let tilt = DQuat::from_rotation_x(degrees.to_radians());
    let mut mesh = Mesh::cuboid(Vec3::new(-0.5, -0.3, -1.0), Vec3::new(0.5, 0.0, 1.0));
    for vector in mesh.positions.iter_mut().chain(&mut mesh.normals) {
        *vector = (tilt * vector.as_dvec3()).as_vec3();
    }
    (mesh, tilt)
}

/// The table.
pub(super) fn blocks(lab: &mut Lab) -> Result<Vec<Block>, LabError> {
    let caption = format!(
        "A sheet of 24 cm, 9 × 9 particles, lies on a tilted plate for 0.6 s; the plate is seen through maps with texels of 5 mm. μ = {FRICTION}, so the \
         friction angle is 26.6°. Below it cloth must stick, above it must slide as a point does. Last column: the papers' law (W eq. 15 \
         and 16, 80 % of the velocity kept, 50 % of the force removed), which has no friction angle. {}",
        lab.place()
    );
    let columns = &[
        ["tilt", "°"],
        ["way", "mm"],
        ["way of a point", "mm"],
        ["farthest off the plate", "mm"],
        ["papers' law, way", "mm"],
    ];
    let mut table = Table::new(caption, columns);
    for degrees in lab.pick(vec![25.0, 29.0], vec![10.0, 15.0, 20.0, 25.0, 26.0, 27.0, 29.0, 35.0, 40.0, 45.0]) {
        lab.say(0.55, &format!("friction on {degrees}°"))?;
        let coulomb = slide(lab, degrees, Friction::Coulomb)?;
        let papers = slide(lab, degrees, Friction::Papers { velocity_kept: 0.8, force_removed: 0.5 })?;
        let way = coulomb_way(degrees);
        let row = [coulomb.way, way, coulomb.off, papers.way].map(|metres| Cell::number(1e3 * metres));
        table.push([Cell::number(degrees)].into_iter().chain(row).collect());
    }
    Ok(vec![Block::Table(table)])
}
