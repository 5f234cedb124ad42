//! A whole run: every cloth of a scene one after another, then the files and the metrics.

use crate::adapter;
use crate::args::{Backend, Running};
use crate::commands::print;
use crate::engine::{Computer, Layer};
use crate::metrics::{ClothMetrics, Metrics, Surfaces};
use crate::output::{self, Shown};
use crate::worn::{self, Surroundings, Worn};
use anyhow::{Result, bail};
use toile::files::SceneFile;
use toile::model::Model;
use toile::scene::{Body, Cloth, Scene, Shape};

/// Simulates a scene: garments are dressed one after another, sheets run for a number of frames. Writes the results.
pub fn simulate(file: &SceneFile, running: &Running) -> Result<()> {
    let scene = &file.scene;
    output::check(&running.out)?;
    check_bodies(scene)?;
    let shapes = shapes(scene);
    if !running.quiet {
        for warning in &file.warnings {
            eprintln!("warning: {warning}");
        }
    }
    let computer = match running.place.backend {
        Backend::Gpu => Computer::Gpu(adapter::open(&running.place)?),
        Backend::Reference => Computer::Reference,
    };
    let thickness = scene.settings.fabric.thickness as f32;
    let texel = scene.settings.texel as f32;
    let mut layers: Vec<Layer> = meshes(scene).map(|mesh| Layer { mesh: mesh.clone(), thickness }).collect();
    let mut surfaces = Surfaces::new(&scene.bodies, scene.settings.fabric.thickness);
    let mut all: Vec<Worn> = Vec::new();
    let mut measured = Vec::new();
    for cloth in &scene.cloths {
        let shapes = shapes.clone();
        let around = Surroundings { computer: &computer, layers: &layers, shapes, texel, quiet: running.quiet };
        let worn = match cloth {
            Cloth::Garment(garment) => worn::dress(garment, &scene.settings, &around)?,
            Cloth::Sheet(sheet) => {
                let model = Model::from_sheet(sheet, &scene.settings);
                worn::run(&sheet.name, model, file.frames, &scene.settings, &around)?
            }
        };
        measured.push(ClothMetrics::new(&worn, &surfaces, texel));
        if all.len() + 1 < scene.cloths.len() {
            surfaces.add_garment(&worn.mesh);
            layers.push(Layer { mesh: worn.mesh.clone(), thickness });
        }
        all.push(worn);
    }
    let metrics = Metrics::new(&scene.name, computer.name(), measured);
    let shape_meshes: Vec<_> = shapes.iter().map(|shape| (shape.name(), shape.mesh(end(&all)))).collect();
    let mut bodies: Vec<Shown<'_>> = meshes(scene).map(|mesh| Shown { name: "body", mesh }).collect();
    bodies.extend(shape_meshes.iter().map(|(name, mesh)| Shown { name, mesh }));
    let cloths: Vec<Shown<'_>> = all.iter().map(|worn| Shown { name: &worn.name, mesh: &worn.mesh }).collect();
    let thickness = scene.settings.fabric.thickness;
    output::write_whole(&running.out, |folder| output::write(folder, &bodies, &cloths, thickness, &metrics))?;
    if running.json {
        print(&serde_json::to_string_pretty(&metrics)?)?;
    } else if !running.quiet {
        for cloth in &metrics.cloths {
            print(&cloth.line())?;
        }
        print(&format!("wrote {}", running.out.display()))?;
    }
    Ok(())
}

/// An error when a scene has bodies that a run does not know.
pub fn check_bodies(scene: &Scene) -> Result<()> {
    if scene.bodies.iter().any(|body| matches!(body, Body::Moving(_))) {
        bail!(
            "scene {} has a mesh that moves: toile walk goes along with one, toile run knows meshes at rest",
            scene.name
        );
    }
    Ok(())
}

/// The mesh bodies of a scene.
fn meshes(scene: &Scene) -> impl Iterator<Item = &toile::scene::Mesh> {
    scene.bodies.iter().filter_map(|body| match body {
        Body::Mesh(mesh) => Some(mesh),
        Body::Moving(_) | Body::Shape(_) => None,
    })
}

/// The shapes of a scene.
pub fn shapes(scene: &Scene) -> Vec<Shape> {
    let shape = |body: &Body| match body {
        Body::Shape(shape) => Some(shape.clone()),
        Body::Mesh(_) | Body::Moving(_) => None,
    };
    scene.bodies.iter().filter_map(shape).collect()
}

/// Simulated time at the end of the last cloth [s].
fn end(all: &[Worn]) -> f64 {
    all.last().map_or(0.0, |worn| worn.status.step as f64 * f64::from(worn.settings.dt))
}
