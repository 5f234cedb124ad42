//! The files of a run: written to a folder of another name first, so that no half-written result is ever seen.

use crate::metrics::Metrics;
use crate::picture::{self, Drawn, Material, View};
use crate::worn::Worn;
use anyhow::{Context, Result};
use glam::Vec3;
use std::fs;
use std::path::Path;
use toile::files::{NamedMesh, write_atomically, write_glb, write_obj};
use toile::scene::Mesh;

/// Height of the pictures [px].
const PICTURE_HEIGHT: u32 = 1000;
/// Colour of the body in the GLB, linear RGB.
const BODY_COLOUR: [f32; 3] = [0.55, 0.36, 0.27];

/// Writes the dressed body, the cloth, three pictures and the metrics.
pub fn write(folder: &Path, bodies: &[(String, Mesh)], worn: &[Worn], metrics: &Metrics) -> Result<()> {
    let parent = match folder.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    fs::create_dir_all(parent).with_context(|| format!("cannot create {}", parent.display()))?;
    let unfinished = tempfile::Builder::new()
        .prefix(".toile-unfinished-")
        .tempdir_in(parent)
        .with_context(|| format!("cannot write beside {}", folder.display()))?;
    write_files(unfinished.path(), bodies, worn, metrics)?;
    fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))?;
    for entry in fs::read_dir(unfinished.path())? {
        let entry = entry?;
        let target = folder.join(entry.file_name());
        fs::rename(entry.path(), &target).with_context(|| format!("cannot write {}", target.display()))?;
    }
    Ok(())
}

fn write_files(folder: &Path, bodies: &[(String, Mesh)], worn: &[Worn], metrics: &Metrics) -> Result<()> {
    let colour = |index: usize| Material::cloth(index).outside;
    let mut meshes: Vec<NamedMesh<'_>> =
        bodies.iter().map(|(name, mesh)| NamedMesh { name, mesh, colour: BODY_COLOUR }).collect();
    for (index, cloth) in worn.iter().enumerate() {
        meshes.push(NamedMesh { name: &cloth.name, mesh: &cloth.mesh, colour: colour(index) });
    }
    write_glb(&folder.join("dressed.glb"), &meshes)?;
    write_obj(&folder.join("garment.obj"), &joined(worn))?;
    let mut drawn: Vec<Drawn<'_>> = bodies.iter().map(|(_, mesh)| Drawn { mesh, material: Material::SKIN }).collect();
    for (index, cloth) in worn.iter().enumerate() {
        drawn.push(Drawn { mesh: &cloth.mesh, material: Material::cloth(index) });
    }
    for (name, view) in [("front.png", View::Front), ("back.png", View::Back), ("side.png", View::Side)] {
        picture::save_png(&folder.join(name), &picture::render(&drawn, view, PICTURE_HEIGHT)?)?;
    }
    write_atomically(&folder.join("metrics.json"), serde_json::to_string_pretty(metrics)?.as_bytes())?;
    Ok(())
}

/// All cloths as one mesh.
fn joined(worn: &[Worn]) -> Mesh {
    let mut whole = Mesh::default();
    for cloth in worn {
        let first = whole.positions.len() as u32;
        whole.positions.extend::<&[Vec3]>(&cloth.mesh.positions);
        whole.normals.extend::<&[Vec3]>(&cloth.mesh.normals);
        whole.triangles.extend(cloth.mesh.triangles.iter().map(|t| t.map(|i| i + first)));
    }
    whole
}
