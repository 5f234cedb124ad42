//! Every fixture garment on the built-in body, while it is sewn and after the handover: device and reference agree bit for bit.

use crate::life::Life;
use std::sync::OnceLock;
use toile_lab::DrawnMaps;
use toile_lab::fixtures::{body, garment, settings};
use toile_model::{Model, StepSettings};
use toile_scene::{Fabric, MapKind, Settings};
use toile_workspace::gpu;

const SPACING: f64 = 0.03;

/// Frames on each side of the handover.
const FRAMES: u32 = 4;

fn layers(settings: &Settings) -> &'static DrawnMaps {
    static LAYERS: OnceLock<DrawnMaps> = OnceLock::new();
    LAYERS.get_or_init(|| {
        DrawnMaps::draw(gpu(), MapKind::Layers, &[(&body(), settings.fabric.thickness as f32)], settings.texel as f32)
            .expect("the device answers")
    })
}

fn dress(name: &str) {
    let settings = settings(SPACING);
    assert_eq!(settings.fabric, Fabric::preset("cotton").expect("cotton is a preset"));
    let layers = layers(&settings);
    let open = Model::from_garment(&garment(name), &settings).unwrap_or_else(|error| panic!("{error}"));
    let mut life = Life::new(&open, &StepSettings::new(&settings, &open).sewing(), Some(layers), Vec::new());
    let (_, gap) = open.widest_seam(&open.positions).expect("a garment has seams");
    let status = life.agree(&format!("{name} open"), FRAMES);
    assert!(status.seam_gap_max < gap, "{name}: its seams close, from {gap} m to {} m", status.seam_gap_max);
    let (sewn, merge) = open.sewn();
    let mut life = life.sewn(&sewn, &merge, &StepSettings::new(&settings, &sewn).draping(), Some(layers));
    assert_eq!(life.difference(), None, "{name}: the handover");
    let status = life.agree(&format!("{name} sewn"), FRAMES);
    assert_eq!(status.non_finite_count, 0, "{name}: stays finite");
    assert!(life.contacts_max > 0, "{name}: touches the body");
}

#[test]
fn the_dress_agrees() {
    dress("dress");
}

#[test]
fn the_sleeveless_shirt_agrees() {
    dress("shirt_sleeveless");
}

#[test]
fn the_shirt_with_sleeves_agrees() {
    dress("shirt_sleeves");
}

#[test]
fn the_skirt_agrees() {
    dress("skirt");
}

#[test]
fn the_trousers_agree() {
    dress("trousers");
}
