//! What the passes of a step move through memory, on paper.

use crate::{Pass, Plan};
use toile_kernels::{Binding, Domain, Interface, Per, Resource, TABLE, buffer_row};
use toile_model::{CLUSTER_PAIRS, Level, Model, StepSettings};
use toile_scene::Shape;

/// Corners of a cluster or of a quad.
const CORNERS: u64 = 4;
/// Ends of a limit or of a seam pair.
const ENDS: u64 = 2;

impl Plan {
    /// Bytes that a step moves between memory and processors. Each pass reads every item of a buffer that it reaches once, and writes it once
    /// where it writes any: what neighbours share lies in a cache, and nothing stays there until the next pass. Textures are not counted.
    pub fn traffic(&self, model: &Model, settings: &StepSettings, shapes: &[Shape]) -> u64 {
        let sizes = self.buffer_sizes(model, settings, shapes);
        let kernels = self.kernels();
        let interfaces: Vec<Interface> = kernels.iter().map(|kernel| Interface::of(*kernel)).collect();
        let moved = |pass: &Pass| -> u64 {
            let place = kernels.iter().position(|kernel| *kernel == pass.kernel).expect("the plan has it");
            let bindings = interfaces[place].bindings.iter();
            bindings.map(|binding| moved(pass, binding, sizes.get(&binding.name).copied().unwrap_or(0), model)).sum()
        };
        self.step.iter().map(moved).sum()
    }
}

/// Bytes that a pass moves of a buffer of a size [byte].
fn moved(pass: &Pass, binding: &Binding, size: u64, model: &Model) -> u64 {
    let Resource::Storage { written, stride } = binding.resource else { return 0 };
    let row = TABLE.iter().find(|row| row.kernel == pass.kernel).expect("every kernel has a row");
    let bytes = match reached(pass, row.domain, &binding.name, model) {
        Reached::Items(count) => size.min(count * u64::from(stride)),
        Reached::Part { items, of } => (size as f64 * items as f64 / of.max(1) as f64) as u64,
        Reached::All => size,
    };
    if written { 2 * bytes } else { bytes }
}

/// What a pass reaches of a buffer.
enum Reached {
    All,
    /// So many of its items.
    Items(u64),
    /// As large a part as its own items are of all there are for its kernel.
    Part {
        items: u64,
        of: u64,
    },
}

fn reached(pass: &Pass, domain: Domain, name: &str, model: &Model) -> Reached {
    let items = u64::from(pass.items.end - pass.items.start);
    let is_corner = matches!(buffer_row(name).per, Per::Particle | Per::Node);
    let small = || model.levels.iter().filter(|level| level.is_small());
    let clusters = |level: &Level| level.colours.iter().map(|colour| u64::from(colour.end - colour.start)).sum::<u64>();
    match domain {
        Domain::LevelCluster | Domain::GuardedCluster if is_corner => Reached::Items(CORNERS * items),
        Domain::LevelNode if is_corner => Reached::Items(items),
        Domain::LimitColour | Domain::SeamColour if is_corner => Reached::Items(ENDS * items),
        Domain::LevelNode => Reached::Part { items, of: (model.positions.len() + model.coarse_particles.len()) as u64 },
        Domain::GuardedCluster if name == "guard_lengths" => Reached::Items(CLUSTER_PAIRS.len() as u64 * items),
        // What else is listed has an entry for each.
        Domain::LevelCluster | Domain::GuardedCluster | Domain::LimitColour | Domain::SeamColour => {
            Reached::Items(items)
        }
        // Only small levels have a kernel of one workgroup in a sweep; what others see is small anyway.
        Domain::Workgroup if is_corner => {
            Reached::Items(small().map(|level| u64::from(level.nodes.end - level.nodes.start)).sum())
        }
        Domain::Workgroup => Reached::Part { items: small().map(clusters).sum(), of: model.clusters.len() as u64 },
        _ => Reached::All,
    }
}
