//! More items than one dimension of a dispatch holds.

use encase::{ShaderType, UniformBuffer};
use toile_gpu::BodyMaps;
use toile_kernels::{Kernel, structs};
use toile_lab::kernels::{Compiled, Inputs};
use toile_workspace::gpu;

/// A few items into the second row of workgroups.
const ITEMS: u32 = 65_535 * 64 + 100;

/// Particles that all differ, and nowhere to copy them to yet.
struct Many;

impl Inputs for Many {
    fn bytes(&self, name: &str) -> Vec<u8> {
        let vec4s = |value: fn(u32) -> u32| (0..4 * ITEMS).flat_map(|word| value(word).to_le_bytes()).collect();
        match name {
            "step" => {
                let params = structs::StepParams { particle_count: ITEMS, ..Default::default() };
                let mut buffer = UniformBuffer::new(vec![0; structs::StepParams::min_size().get() as usize]);
                buffer.write(&params).expect("it has the size of the struct");
                buffer.into_inner()
            }
            "positions" => vec4s(|word| word),
            "velocities" => vec4s(|word| !word),
            _ => vec![0; 16 * ITEMS as usize],
        }
    }

    fn maps(&self, _: &str) -> Option<&BodyMaps> {
        None
    }
}

#[test]
fn a_dispatch_of_two_rows_reaches_every_particle() {
    let compiled = Compiled::new(gpu(), Kernel::StateCopy, &Kernel::StateCopy.source()).expect("the kernel compiles");
    let copies = compiled.run(gpu(), ITEMS, &Many).expect("the device answers");
    assert!(copies["position_copies"].iter().zip(0u32..).all(|(copy, word)| *copy == word));
    assert!(copies["velocity_copies"].iter().zip(0u32..).all(|(copy, word)| *copy == !word));
}
