//! Every kernel alone: the device and the reference on the same seeded input, bit for bit.

use crate::branches;
use std::sync::OnceLock;
use toile_kernels::{Kernel, Row, Stage, TABLE};
use toile_lab::kernels::{Compiled, Input, Inputs, Seeds, VARIANTS, Variant, answer, first_difference};
use toile_workspace::{Gpu, gpu};

/// One item, and around the border of a workgroup, and more than a few of them.
const SIZES: [u32; 5] = [1, 63, 64, 65, 1757];

/// Buffers that hold whole numbers.
const COUNTS: [&str; 3] = ["polish_state", "status", "sweep_dispatches"];

/// What all inputs of the device of this test process are drawn from.
pub fn seeds() -> &'static Seeds {
    static SEEDS: OnceLock<Seeds> = OnceLock::new();
    SEEDS.get_or_init(|| Seeds::new(gpu(), 0).expect("the device answers"))
}

/// Seeded input for a kernel.
pub fn input(kernel: Kernel, items: u32, variant: Variant) -> Input {
    seeds().input(kernel, items, variant)
}

/// Input of a kernel, and what the reference makes of it.
pub struct Case {
    kernel: Kernel,
    input: Input,
    expected: Input,
}

impl Case {
    pub fn new(kernel: Kernel, input: Input) -> Self {
        let mut expected = input.clone();
        answer(kernel, &mut expected);
        Self { kernel, input, expected }
    }

    /// Seeded input of a few workgroups under every variant of the settings, and of two items.
    pub fn variants(seeds: &Seeds, kernel: Kernel) -> Vec<Self> {
        let many = VARIANTS.map(|variant| (1757, variant));
        let all = many.into_iter().chain([(2, Variant::Papers)]);
        all.map(|(items, variant)| Self::new(kernel, seeds.input(kernel, items, variant))).collect()
    }

    /// Where the device, that of the seeds, differs from the reference in what the kernel writes.
    pub fn difference(&self, gpu: &Gpu, compiled: &Compiled) -> Option<String> {
        let name = self.kernel.name();
        let written = compiled.run(gpu, self.input.invocations, &self.input).expect("the device answers");
        assert!(!written.is_empty(), "{name} writes nothing");
        written.iter().find_map(|(buffer, device)| {
            let reference: Vec<u32> = bytemuck::pod_collect_to_vec(&self.expected.bytes(buffer));
            // NaN agree whatever their bits, so most of what is compared must be numbers.
            let numbers = reference.iter().filter(|bits| !f32::from_bits(**bits).is_nan()).count();
            assert!(4 * numbers >= 3 * reference.len(), "{name}: {numbers} numbers of {}", reference.len());
            if COUNTS.contains(&buffer.as_str()) {
                // An index or a count may have the bits of a NaN, which would agree with any other.
                let fault = device.iter().zip(&reference).position(|(device, reference)| device != reference)?;
                return Some(format!("{buffer}: word {fault}: {:#x}, not {:#x}", device[fault], reference[fault]));
            }
            first_difference(device, &reference).map(|difference| format!("{buffer}: {difference}"))
        })
    }
}

/// The kernels that have an answer of their own: those that draw maps leave columns in no order, so that the maps are compared as a whole
/// (`tests/maps`).
pub fn alone() -> impl Iterator<Item = &'static Row> {
    TABLE.iter().filter(|row| row.stage != Stage::Maps)
}

/// All kernels agree bit for bit: on lavapipe `+ − × ÷`, `sqrt`, `dot`, `length` round as Rust does and nothing is fused.
#[test]
fn every_kernel_alone_gives_the_bits_of_its_reference() {
    let mut faults = Vec::new();
    for row in alone() {
        let kernel = row.kernel;
        let compiled = Compiled::new(gpu(), kernel, &kernel.source()).expect("the kernel compiles");
        for items in SIZES {
            for variant in VARIANTS {
                if let Some(difference) = Case::new(kernel, input(kernel, items, variant)).difference(gpu(), &compiled)
                {
                    faults.push(format!("{} of {items} {variant:?}: {difference}", kernel.name()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn the_input_leads_into_every_branch_of_every_kernel() {
    for row in alone() {
        let mut seen = branches::Seen::default();
        for variant in VARIANTS {
            let before = input(row.kernel, 1757, variant);
            let mut after = before.clone();
            answer(row.kernel, &mut after);
            branches::count(row.kernel, &before, &after, &mut seen);
        }
        for (branch, count) in seen {
            assert!(count > 0, "{}: no item {branch}", row.kernel.name());
        }
    }
}
