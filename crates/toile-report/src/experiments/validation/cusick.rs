//! Cusick's drape coefficient: how far the cloth around a disc stands out.

use crate::page::{Block, Cell, Table};
use glam::{DQuat, DVec2, DVec3, Vec3};
use std::f64::consts::PI;
use toile::model::{Model, StepSettings};
use toile::scene::{Curve, Edge, Fabric, Garment, MapKind, Mesh, Panel, Placement, Settings};
use toile_lab::shapes::cylinder;
use toile_lab::{Lab, LabError, Random, settled};
use toile_reference::Colliders;
use toile_reference::maps::{BodyMaps, Surface, render_sides};

/// Radius of the supporting disc and of the sample [m].
const SUPPORT: f64 = 0.09;
const SAMPLE: f64 = 0.15;
/// Thickness of the disc [m]: cloth hangs free below it.
const DISC: f32 = 0.01;

/// Published bands of the drape coefficient [%] of cloth like the presets; none is known for jersey as a whole.
pub const BANDS: [(&str, Option<[f64; 2]>); 5] = [
    ("silk", Some([20.0, 40.0])),
    ("jersey", None),
    ("cotton", Some([60.0, 76.0])),
    ("wool", Some([40.0, 70.0])),
    ("denim", Some([70.0, 90.0])),
];

/// What the drapemeter shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drape {
    /// Drape coefficient [%]; NaN when the run diverged.
    pub coefficient: f64,
    /// Number of particles.
    pub particle_count: u32,
    /// Part of the fabric's bending rigidity that the step carries [1].
    pub carried: f64,
    /// Largest speed of a particle at the end [m/s].
    pub speed: f64,
}

/// Lays a round sample of 30 cm centrally on a disc of 18 cm, clamps it there with another disc, lets the rim fall for `seconds` and
/// takes the area of its shadow, as the coefficient (shadow − support)/(sample − support).
///
/// The disc faces the front camera of the papers' maps, with gravity along −z: they see it well, and layered maps would round its rim by a part of
/// a texel.
///
/// # Errors
/// [`LabError::Toile`] when the sample cannot be meshed.
pub fn drape(seed: u64, fabric: Fabric, spacing: f64, seconds: f64) -> Result<Drape, LabError> {
    let mut settings = Settings::new(fabric);
    settings.spacing = spacing;
    settings.texel = 0.0025;
    settings.gravity = DVec3::new(0.0, 0.0, -9.81);
    // Where it comes to rest is asked, not how.
    settings.fabric.damping = 5.0;
    let thickness = settings.fabric.thickness as f32;
    let random = &mut Random::new(seed);
    let model = Model::from_garment(&sample(), &settings)?.changed(|model| {
        for (position, weight) in model.positions.iter_mut().zip(&mut model.inverse_masses) {
            let clamped = f64::from(position.length()) < SUPPORT - 0.5 * spacing;
            // A flat ring would not know where to fold.
            let offset = if clamped { 0.0 } else { random.between(-5e-5, 5e-5) };
            *weight *= if clamped { 0.0 } else { 1.0 };
            position.z = thickness + offset;
        }
        model.weigh_coarse_particles();
    })?;
    let step = StepSettings::new(&settings, &model);
    let disc = cylinder(SUPPORT as f32, DISC, 64);
    let surface = Surface { mesh: &disc, thickness, velocities: None, open: false };
    let maps = BodyMaps::around(MapKind::Sides, &[surface], settings.texel as f32);
    let colliders = Colliders::new(Some(maps), Vec::new());
    let frames = (seconds * settings.frame_rate).round() as u32;
    let end = settled(&model, &step, colliders, frames);
    let [support, whole] = [SUPPORT, SAMPLE].map(|radius| PI * radius * radius);
    let coefficient = |shadow: f64| 100.0 * (shadow - support) / (whole - support);
    Ok(Drape {
        coefficient: end.as_ref().map_or(f64::NAN, |end| coefficient(shadow(end.positions(), &model))),
        particle_count: model.particle_count(),
        carried: model.bending_carried,
        speed: end.map_or(f64::NAN, |end| f64::from(end.status().speed_max)),
    })
}

/// The table.
pub(super) fn blocks(lab: &mut Lab) -> Result<Vec<Block>, LabError> {
    let seconds = lab.pick(1.5, 2.5);
    let caption = format!(
        "Cusick's drape coefficient of the fabrics shipped: a round sample of 30 cm lies on a disc of 18 cm; the shadow of what hangs over, by that of \
         the flat ring. Default settings (hierarchical limits, two sweeps, 16 steps per frame), after {seconds} s with a damping of 5/s; \
         shadow counted in cells of 1 mm. Bands are those published for such cloth. The bending length is (B/w)^(1/3), with w the weight per area: \
         that of Peirce's cantilever. Reference on the CPU; seed {}.",
        lab.seed
    );
    let columns = &[
        ["fabric", ""],
        ["areal density", "kg/m²"],
        ["bending rigidity B", "µN·m"],
        ["bending length", "mm"],
        ["spacing", "mm"],
        ["particles", ""],
        ["part of B carried", "1"],
        ["drape coefficient", "%"],
        ["published", "%"],
        ["inside", ""],
        ["speed at the end", "m/s"],
    ];
    let mut table = Table::new(caption, columns);
    let spacings = lab.pick(vec![0.0125], vec![0.015, 0.0125, 0.01, 0.0075, 0.005, 0.004]);
    for (name, band) in BANDS {
        for &spacing in &spacings {
            lab.say(0.6, &format!("drape coefficient of {name} at {spacing} m"))?;
            let fabric = Fabric::preset(name).expect("the bands name presets");
            let [rigidity, density] = [fabric.bending_rigidity, fabric.areal_density];
            let drape = drape(lab.seed, fabric, spacing, seconds)?;
            let inside = |[low, high]: [f64; 2]| (low..=high).contains(&drape.coefficient);
            table.push(vec![
                Cell::text(name),
                Cell::number(density),
                Cell::number(1e6 * rigidity),
                Cell::number(1e3 * (rigidity / (9.81 * density)).cbrt()),
                Cell::number(1e3 * spacing),
                Cell::Count(u64::from(drape.particle_count)),
                Cell::number(drape.carried),
                Cell::number(drape.coefficient),
                band.map_or(Cell::Missing, |[low, high]| Cell::text(format!("{low} to {high}"))),
                band.map_or(Cell::Missing, |band| Cell::text(if inside(band) { "yes" } else { "no" })),
                Cell::number(drape.speed),
            ]);
        }
    }
    Ok(vec![Block::Table(table)])
}

/// Area of the cloth's shadow along z [m²].
fn shadow(positions: &[Vec3], model: &Model) -> f64 {
    const CELL: f64 = 1e-3;
    let mesh =
        Mesh { positions: positions.to_vec(), normals: vec![Vec3::Z; positions.len()], triangles: model.triangles() };
    let maps = render_sides(&[Surface { mesh: &mesh, thickness: 0.0, velocities: None, open: false }], CELL as f32);
    maps.depth[0].iter().filter(|depth| **depth < 1.0).count() as f64 * CELL * CELL
}

/// One round panel.
fn sample() -> Garment {
    let corners = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].map(|direction| direction * SAMPLE);
    let arc = Curve::Arc { radius: SAMPLE, large: false, right: true };
    let edges = corners.iter().map(|&start| Edge::new(start, arc)).collect();
    let placement = Placement { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };
    let panel = Panel::new("sample", edges, placement);
    Garment::new("sample", vec![panel], Vec::new())
}
