//! A whole run: every cloth of a scene one after another, then the files and the metrics.

use crate::adapter;
use crate::args::{Backend, Running};
use crate::bodies::{meshes, moving, shapes};
use crate::engine::Computer;
use crate::fit;
use crate::metrics::{ClothMetrics, Metrics, Surfaces};
use crate::outcome::Outcome;
use crate::output::{self, Shown};
use crate::stdout::print;
use crate::worn::{self, Worn};
use anyhow::{Result, bail};
use toile::model::FitOptions;
use toile::scene::{Cloth, Mesh, Scene};

/// Simulates a scene: garments are dressed one after another, sheets run for a number of frames. Writes the results.
pub fn simulate(
    scene: &Scene,
    frames: u32,
    warnings: &[String],
    options: &FitOptions,
    running: &Running,
) -> Result<Outcome> {
    output::check(&running.out, "metrics.json")?;
    check_bodies(scene, running.place.backend)?;
    if !running.quiet {
        fit::tell_of_files(warnings);
    }
    let fit = fit::look(scene, options)?;
    let scene = &fit.scene;
    if fit.dress_in.is_some() && running.place.backend == Backend::Reference {
        bail!(
            "--backend reference: seams of {} would close around the arms as they hang, and the reference knows bodies at rest alone: \
             a device raises them, or give a body whose arms are level",
            scene.name
        );
    }
    if !running.quiet {
        fit::tell(&fit);
    }
    let computer = match running.place.backend {
        Backend::Gpu => Computer::Gpu(adapter::open(&running.place)?),
        Backend::Reference => Computer::Reference,
    };
    let all = worn::run(&fit, frames, &computer, running)?;
    let end = end(&all);
    let mut surfaces = Surfaces::new(&scene.bodies, end);
    let mut measured = Vec::new();
    for worn in &all {
        measured.push(ClothMetrics::new(worn, &surfaces, scene.settings.texel as f32));
        if measured.len() < all.len() {
            surfaces.add_garment(&worn.mesh);
        }
    }
    let metrics = Metrics::new(&scene.name, computer.name(), fit::sentences(&fit), measured);
    let shapes: Vec<(&str, Mesh)> = shapes(scene).iter().map(|shape| (shape.name(), shape.mesh(end))).collect();
    let moved: Vec<Mesh> = moving(scene).map(|body| body.at(end)).collect();
    let mut bodies: Vec<Shown<'_>> = meshes(scene).chain(&moved).map(|mesh| Shown { name: "body", mesh }).collect();
    bodies.extend(shapes.iter().map(|(name, mesh)| Shown { name, mesh }));
    let thickness = |worn: &worn::Worn| f64::from(worn.settings.thickness);
    let cloths: Vec<(Shown<'_>, f64)> =
        all.iter().map(|worn| (Shown { name: &worn.name, mesh: &worn.mesh }, thickness(worn))).collect();
    let hides = running.hides_progress();
    output::write_whole(&running.out, |folder| output::write(folder, &bodies, &cloths, &metrics, hides))?;
    if running.json {
        print(&serde_json::to_string_pretty(&metrics)?)?;
    } else if !running.quiet {
        for cloth in &metrics.cloths {
            print(&cloth.line())?;
        }
        print(&format!("wrote {}", running.out.display()))?;
    }
    Ok(Outcome::of(all.iter().filter_map(|worn| worn.verdict.as_ref())))
}

/// An error when a scene has bodies that a run does not know.
fn check_bodies(scene: &Scene, backend: Backend) -> Result<()> {
    if moving(scene).next().is_none() {
        return Ok(());
    }
    if !scene.cloths.iter().any(|cloth| matches!(cloth, Cloth::Sheet(_))) {
        bail!(
            "scene {} has garments on a mesh that moves: toile walk goes along with one, toile run dresses",
            scene.name
        );
    }
    if backend == Backend::Reference {
        bail!("scene {} has a mesh that moves: --backend reference knows meshes at rest, a device runs it", scene.name);
    }
    Ok(())
}

/// Simulated time at the end of the last cloth [s].
fn end(all: &[Worn]) -> f64 {
    all.last().map_or(0.0, |worn| worn.status.step as f64 * f64::from(worn.settings.dt))
}
