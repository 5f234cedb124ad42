//! `toile plan`: what a scene gets, without an adapter.

use crate::args::PlanOf;
use crate::bodies::{meshes, shapes};
use crate::commands::outfit;
use crate::fit;
use crate::pattern::{self, Pattern};
use crate::stdout::print;
use anyhow::Result;
use glam::Vec3;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;
use toile::files::{read_scene, write_atomically};
use toile::gpu::{Kernel, KernelRuns, MapSpace, Maps, Pass, Plan, kernel_runs};
use toile::model::{MapBox, Merge, Model, StepSettings};
use toile::scene::{Body, Cloth, Mesh, Scene, Shape};

/// Prints passes, dispatches and bytes of every cloth of a scene; draws the limits of all of them when a picture is wanted.
pub fn run(arguments: &PlanOf) -> Result<()> {
    let (scene, warnings) = match &arguments.scene {
        Some(path) => {
            let file = read_scene(path, &arguments.set)?;
            (file.scene, file.warnings)
        }
        None => outfit::read(&arguments.outfit)?,
    };
    fit::tell_of_files(&warnings);
    let patterns = patterns(&scene)?;
    let plans = plans(&scene, &patterns)?;
    if let Some(path) = &arguments.picture {
        write_atomically(path, pattern::draw(&patterns).as_bytes())?;
    }
    if arguments.json {
        return print(&serde_json::to_string_pretty(&plans)?);
    }
    plans.iter().try_for_each(|plan| print(&plan.to_string()))?;
    arguments.picture.iter().try_for_each(|path| print(&format!("wrote {}", path.display())))
}

/// The cloths of a scene in the order of dressing.
fn patterns(scene: &Scene) -> Result<Vec<Pattern>> {
    let pattern = |cloth: &Cloth| match cloth {
        Cloth::Sheet(sheet) => {
            let open = Model::from_sheet(sheet, &scene.settings);
            let merge = Merge::identity(open.particle_count());
            Ok(Pattern { name: sheet.name.clone(), open, sewn: None, merge })
        }
        Cloth::Garment(garment) => {
            let open = Model::from_garment(garment, &scene.settings)?;
            let (sewn, merge) = open.sewn();
            Ok(Pattern { name: garment.name.clone(), open, sewn: Some(sewn), merge })
        }
    };
    scene.cloths.iter().map(pattern).collect()
}

/// What one model of a cloth gets.
#[derive(Serialize)]
struct ClothPlan {
    name: String,
    /// "open" and "sewn" for a garment, "sheet" for a sheet.
    state: &'static str,
    particle_count: u32,
    spring_count: u32,
    quad_count: u32,
    colour_count: u32,
    steps_per_frame: u32,
    step: Vec<KernelPlan>,
    frame: Vec<KernelPlan>,
    buffers: BTreeMap<String, u64>,
    bytes: u64,
    bytes_per_particle: f64,
    /// What a step moves through memory.
    traffic_per_particle: f64,
    /// Shared by both models of a garment, and not counted in `bytes`.
    map_bytes: u64,
}

/// All dispatches of a kernel.
#[derive(Serialize)]
struct KernelPlan {
    kernel: &'static str,
    /// How often its turn comes.
    runs: usize,
    dispatches: usize,
    items: u64,
}

/// The plans of all cloths; a garment has one for sewing and one for draping.
fn plans(scene: &Scene, patterns: &[Pattern]) -> Result<Vec<ClothPlan>> {
    let shapes = shapes(scene);
    let mut bounds = bounds(scene);
    let mut plans = Vec::new();
    let mut area = 0.0;
    for (Pattern { name, open, sewn, .. }, fabric) in patterns.iter().zip(scene.fabrics()) {
        let settings = scene.settings.of_fabric(Some(fabric));
        let step = |model| StepSettings::of_cloth(name, &settings, model);
        // As a garment is dressed: sewn, then draped.
        let models = match sewn {
            None => vec![("sheet", open, step(open)?)],
            Some(sewn) => vec![("open", open, step(open)?.sewing()), ("sewn", sewn, step(sewn)?.draping())],
        };
        // Sheets run with all else; a garment is dressed on bodies that stand still.
        let moves =
            sewn.is_none() && (patterns.len() > 1 || scene.bodies.iter().any(|body| matches!(body, Body::Moving(_))));
        let maps = if bounds.is_none() { Maps::None } else { Maps::of(scene.settings.maps, moves) };
        let map_bytes = bounds.map_or(0, |bounds| {
            let map_box = MapBox::around(bounds, scene.settings.texel as f32);
            let bodies: f64 = meshes(scene).map(Mesh::area).sum();
            let mut space = MapSpace::new(scene.settings.maps, map_box, area + bodies);
            space.moving = moves;
            space.bytes()
        });
        for (state, model, step) in &models {
            plans.push(ClothPlan::new(name, state, model, step, maps, &shapes, map_bytes));
        }
        area += sewn.as_ref().unwrap_or(open).area_max(settings.fabric.areal_density);
        // A later cloth lies over this one. Where it will hang is not known; near the body it changes little.
        bounds = bounds.or_else(|| around(models.iter().flat_map(|(_, model, _)| &model.positions)));
    }
    Ok(plans)
}

/// The box that the maps are drawn around [m]; `None` without a mesh body.
fn bounds(scene: &Scene) -> Option<[Vec3; 2]> {
    let thickness = scene.fabrics().map(|fabric| fabric.thickness as f32).fold(0.0, f32::max);
    let corners: Vec<Vec3> = scene
        .bodies
        .iter()
        .filter_map(|body| match body {
            Body::Mesh(mesh) => mesh.bounds(),
            Body::Moving(body) => body.mesh.bounds(),
            Body::Shape(_) => None,
        })
        .flat_map(|[low, high]| [low - thickness, high + thickness])
        .collect();
    around(&corners)
}

fn around<'a>(points: impl IntoIterator<Item = &'a Vec3>) -> Option<[Vec3; 2]> {
    points.into_iter().map(|p| [*p, *p]).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

impl ClothPlan {
    fn new(
        name: &str,
        state: &'static str,
        model: &Model,
        settings: &StepSettings,
        maps: Maps,
        shapes: &[Shape],
        map_bytes: u64,
    ) -> Self {
        let plan = Plan::new(model, settings, maps, !shapes.is_empty());
        let mut buffers = plan.buffer_sizes(model, settings, shapes);
        buffers.insert("indices".to_owned(), 12 * model.triangles().len() as u64);
        let bytes = buffers.values().sum();
        let per_particle = |bytes: u64| bytes as f64 / f64::from(model.particle_count().max(1));
        Self {
            name: name.to_owned(),
            state,
            particle_count: model.particle_count(),
            spring_count: model.spring_count(),
            quad_count: model.quad_count(),
            colour_count: model.colour_count(),
            steps_per_frame: settings.steps_per_frame,
            step: kernels(&plan.step),
            frame: kernels(&plan.frame),
            bytes_per_particle: per_particle(bytes),
            traffic_per_particle: per_particle(plan.traffic(model, settings, shapes)),
            buffers,
            bytes,
            map_bytes,
        }
    }
}

fn kernels(passes: &[Pass]) -> Vec<KernelPlan> {
    let plan = |KernelRuns { kernel, runs, dispatches, items, .. }| KernelPlan {
        kernel: Kernel::name(kernel),
        runs,
        dispatches,
        items,
    };
    kernel_runs(passes).into_iter().map(plan).collect()
}

impl fmt::Display for ClothPlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}, {}", self.name, self.state)?;
        writeln!(
            f,
            "  {} particles, {} quads, {} springs, limits in {} colours, {} steps per frame",
            self.particle_count, self.quad_count, self.spring_count, self.colour_count, self.steps_per_frame
        )?;
        for (title, kernels) in [("step", &self.step), ("frame", &self.frame)] {
            let dispatches: usize = kernels.iter().map(|kernel| kernel.dispatches).sum();
            writeln!(f, "  {title}: {dispatches} dispatches")?;
            for KernelPlan { kernel, runs, dispatches, items } in kernels {
                writeln!(f, "    {kernel:<22} {runs:>2} runs, {dispatches:>4} dispatches, {items} items")?;
            }
        }
        writeln!(f, "  a step moves {:.1} bytes per particle", self.traffic_per_particle)?;
        writeln!(f, "  buffers: {} bytes, {:.1} per particle", self.bytes, self.bytes_per_particle)?;
        for (name, bytes) in &self.buffers {
            writeln!(f, "    {name:<22} {bytes:>12}")?;
        }
        write!(f, "  maps: {} bytes", self.map_bytes)
    }
}
