//! The settings of each program, from cheap to exact.

use toile::scene::{Rule, Settings, Threshold, VelocityModification};
use toile_lab::peers::{NvClothSettings, Trial};

/// A program with its settings.
pub enum Program {
    /// Toile.
    Toile(Box<Settings>),
    /// NvCloth's scheme, with iterations in a frame.
    NvCloth(NvClothSettings, u32),
    /// Taichi's example.
    Taichi(TaichiSettings),
}

/// What a user of Taichi's example sets.
#[derive(Clone, Copy)]
pub struct TaichiSettings {
    /// Acceleration [m/s²] of a particle by a spring, per elongation of 1.
    pub stiffness: f64,
    /// Steps in a frame.
    pub substeps: u32,
}

impl Program {
    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Toile(_) => "toile",
            Self::NvCloth(NvClothSettings { tethers: true, .. }, _) => "NvCloth's scheme, ours, tethers",
            Self::NvCloth(..) => "NvCloth's scheme, ours",
            Self::Taichi(_) => "Taichi",
        }
    }
}

/// All of them for a sheet, with the words for each setting.
pub fn programs(trial: &Trial) -> Vec<(Program, String)> {
    let toile = [(0.05, 1), (0.05, 2), (0.02, 2), (0.01, 2)];
    let toile = toile.into_iter().map(|(threshold, sweeps)| {
        let mut settings = trial.scene.settings.clone();
        settings.fabric.threshold = Threshold::even(threshold);
        settings.velocity_modification = VelocityModification::new(Rule::Hierarchical);
        settings.velocity_modification.sweeps = Some(sweeps);
        let words = format!("threshold {:.0} %, sweeps {sweeps}", 1e2 * threshold);
        (Program::Toile(Box::new(settings)), words)
    });
    let nvcloth = |tethers: bool| {
        NVCLOTH_ITERATIONS.into_iter().map(move |iterations| {
            let settings = NvClothSettings { tethers, stiffness: NVCLOTH_STIFFNESS };
            (Program::NvCloth(settings, iterations), format!("{iterations} iterations"))
        })
    };
    // Tethers need something to lead to.
    let tethered = trial.is_held().then(|| nvcloth(true)).into_iter().flatten();
    let taichi = TAICHI_STIFFNESS.into_iter().map(|stiffness| {
        let stiffness = stiffness * (f64::from(trial.n) / 64.0).powi(2);
        let substeps = taichi_substeps(trial, stiffness);
        (
            Program::Taichi(TaichiSettings { stiffness, substeps }),
            format!("stiffness {stiffness:.2e}, substeps {substeps}"),
        )
    });
    toile.chain(nvcloth(false)).chain(tethered).chain(taichi).collect()
}

/// Its default of 300 a second is 5 in a frame. At 500 the fall of an iteration is lost in the rounding of f32 positions: it hangs in the air.
const NVCLOTH_ITERATIONS: [u32; 5] = [5, 15, 40, 100, 200];
/// Sides of cells are stiff, as in its samples; diagonals and what spans two cells give way, as in toile's sheet.
const NVCLOTH_STIFFNESS: [f64; 3] = [1.0, 0.8, 0.5];
/// At 64 × 64 particles [m/s²]; at other sizes in proportion to the particles, whose masses are all one. The example has 3e4 at 128 × 128.
const TAICHI_STIFFNESS: [f64; 4] = [3e4, 2e5, 6e5, 2e6];

/// As few as stay bounded: twelve springs and twelve dashpots pull a particle, and what they may do in a step was found by trial.
fn taichi_substeps(trial: &Trial, stiffness: f64) -> u32 {
    let springs = 0.6 * (trial.spacing() / stiffness).sqrt();
    let dashpots = 1.2 / (24.0 * 1e4 * trial.spacing());
    (trial.frame_seconds() / springs.min(dashpots)).ceil() as u32
}
