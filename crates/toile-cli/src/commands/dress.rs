//! `toile dress`.

use crate::adapter;
use crate::args::{Backend, Dress, Running};
use crate::engine::{Computer, Layer};
use crate::metrics::{ClothMetrics, Metrics};
use crate::worn::{self, Surroundings, Worn};
use crate::{commands::outfit, output};
use anyhow::Result;
use toile::model::Model;
use toile::scene::{Body, Cloth, Mesh, Scene};

/// Dresses the outfit that the options name.
pub fn run(arguments: &Dress) -> Result<()> {
    let scene = outfit::read(&arguments.outfit)?;
    simulate(&scene, 0, &arguments.running)
}

/// Simulates a scene: garments are dressed one after another, sheets run for a number of frames. Writes the results.
pub fn simulate(scene: &Scene, frames: u32, running: &Running) -> Result<()> {
    let computer = match running.place.backend {
        Backend::Gpu => Computer::Gpu(adapter::open(&running.place)?),
        Backend::Reference => Computer::Reference,
    };
    let thickness = scene.settings.fabric.thickness as f32;
    let texel = scene.settings.texel as f32;
    let sphere = scene.bodies.iter().find_map(|body| match body {
        Body::Sphere(sphere) => Some(*sphere),
        Body::Mesh(_) => None,
    });
    let bodies: Vec<(String, Mesh)> = scene
        .bodies
        .iter()
        .filter_map(|body| match body {
            Body::Mesh(mesh) => Some(("body".to_owned(), mesh.clone())),
            Body::Sphere(_) => None,
        })
        .collect();
    let mut layers: Vec<Layer> = bodies.iter().map(|(_, mesh)| Layer { mesh: mesh.clone(), thickness }).collect();
    let mut all: Vec<Worn> = Vec::new();
    let mut measured = Vec::new();
    for cloth in &scene.cloths {
        let around = Surroundings { computer: &computer, layers: &layers, sphere, texel, quiet: running.quiet };
        let worn = match cloth {
            Cloth::Garment(garment) => worn::dress(garment, &scene.settings, &around)?,
            Cloth::Sheet(sheet) => {
                let model = Model::from_sheet(sheet, &scene.settings);
                worn::run(&sheet.name, model, frames, &scene.settings, &around)?
            }
        };
        measured.push(ClothMetrics::new(&worn, &layers, texel));
        layers.push(Layer { mesh: worn.mesh.clone(), thickness });
        all.push(worn);
    }
    let metrics = Metrics::new(&scene.name, computer.name(), measured);
    output::write(&running.out, &bodies, &all, &metrics)?;
    if running.json {
        println!("{}", serde_json::to_string_pretty(&metrics)?);
    } else if !running.quiet {
        println!("wrote {}", running.out.display());
    }
    Ok(())
}
