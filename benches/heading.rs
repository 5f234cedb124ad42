//! Whether a walk depends on where the body faces: the built-in woman walks at headings of 0°, 45°, 90° and 180°, and turns all the while; the worst
//! frame of each, against the exact skinned mesh. The rows are to be the same within a tenth.
//!
//! `cargo bench --bench heading -- --garment skirt --spacing 0.02 --seconds 4`.

use std::str::FromStr;
use toile::model::{Fit, FitOptions};
use toile::scene::{Body, Cloth, MovingMesh, Scene};
use toile_lab::fixtures::{garment, settings, woman};
use toile_lab::motion::Made;
use toile_lab::{Gpu, Worst, turned};
use toile_workspace::gpu;

/// Headings [degrees].
const HEADINGS: [f64; 4] = [0.0, 45.0, 90.0, 180.0];

fn main() {
    let gpu = gpu();
    println!("{}", gpu.adapter);
    let name: String = option("--garment").unwrap_or_else(|| "skirt".to_owned());
    let (spacing, seconds) = (option("--spacing").unwrap_or(0.02), option("--seconds").unwrap_or(4.0));
    println!(
        "{:<12} {:>16} {:>16} {:>14} {:>10} {:>10} {:>10}",
        name, "elongation p99 %", "elongation max %", "particles mm", "edges mm", "faces mm", "crossed"
    );
    let fit = fitted(&name, spacing, woman("walk_loop"));
    for heading in HEADINGS {
        row(&format!("{heading:.0}°"), gpu, &turned(&fit, heading.to_radians()), seconds);
    }
    row("turning", gpu, &fitted(&name, spacing, Made::Turning.of(&woman("walk_loop"))), seconds);
}

fn row(name: &str, gpu: &Gpu, fit: &Fit, seconds: f64) {
    let worst = Worst::of(gpu, fit, seconds).unwrap_or_else(|error| panic!("{name}: {error}"));
    println!(
        "{name:<12} {:>16.2} {:>16.2} {:>14.2} {:>10.2} {:>10.2} {:>10}",
        1e2 * worst.elongation_p99,
        1e2 * worst.elongation_max,
        1e3 * worst.particles,
        1e3 * worst.edges,
        1e3 * worst.faces,
        worst.crossed_count
    );
}

fn fitted(name: &str, spacing: f64, body: MovingMesh) -> Fit {
    let mut settings = settings(spacing);
    settings.frame_rate = 30.0;
    let mut scene = Scene::new("heading", settings);
    scene.cloths = vec![Cloth::Garment(garment(name))];
    scene.bodies = vec![Body::Moving(body)];
    Fit::new(&scene, &FitOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// The word after a flag.
fn option<T: FromStr>(flag: &str) -> Option<T> {
    let mut words = std::env::args().skip_while(|word| word != flag);
    words.next()?;
    words.next()?.parse().ok()
}
