//! What WGSL leaves to the driver: the answer of a kernel does not hang on it.

use crate::kernels::{Case, alone, seeds};
use std::env;
use std::sync::LazyLock;

use toile_lab::kernels::{Compiled, Difference, first_difference};
use toile_workspace::{Compute, gpu};

/// Part of the name of the adapter that the tests are meant to run on.
const WANTED: &str = "TOILE_TEST_ADAPTER";

/// What drivers make of the smaller and the larger of a number and NaN, and of zeros of two signs.
const READINGS: [(&str, &str); 3] = [
    (
        "the second of what cannot be compared",
        "fn read_min(a: f32, b: f32) -> f32 { if a < b { return a; } return b; }
        fn read_max(a: f32, b: f32) -> f32 { if a > b { return a; } return b; }",
    ),
    (
        "the first of what cannot be compared",
        "fn read_min(a: f32, b: f32) -> f32 { if b < a { return b; } return a; }
        fn read_max(a: f32, b: f32) -> f32 { if b > a { return b; } return a; }",
    ),
    (
        "NaN of what cannot be compared",
        "fn read_min(a: f32, b: f32) -> f32 { if a < b { return a; } if b <= a { return b; } return a + b; }
        fn read_max(a: f32, b: f32) -> f32 { if a > b { return a; } if b >= a { return b; } return a + b; }",
    ),
];

const CLAMP: &str = "fn read_clamp(x: f32, low: f32, high: f32) -> f32 { return read_min(read_max(x, low), high); }";

/// Whether the driver takes numbers below the smallest normal one for nothing, as WGSL allows. The kernels alone agree in all bits
/// there; whole runs differ where cloth lies in a plane but for its rounding errors.
pub static FLUSHES: LazyLock<bool> = LazyLock::new(|| {
    let source = "@group(0) @binding(0) var<storage, read_write> factors: array<f32>;
        @group(0) @binding(1) var<storage, read_write> product: array<f32>;
        @compute @workgroup_size(1) fn multiply() { product[0] = factors[0] * factors[1]; }";
    let factors: Vec<u8> = [1e-30f32, 1e-10].iter().flat_map(|factor| factor.to_le_bytes()).collect();
    let product = Compute::new(gpu(), "multiply", source).run(gpu(), 1, &[factors], 4);
    product == [0]
});

/// What such a driver may be apart from the reference, in metres, and per second: the square of a length below 1e-19 m is nothing,
/// so a direction can be lost.
const FLUSHED: f32 = 1e-15;

/// Where two arrays of floats differ first; by more than what the driver takes for nothing, where it does.
pub fn first_beyond(device: &[u32], reference: &[u32]) -> Option<Difference> {
    if !*FLUSHES {
        return first_difference(device, reference);
    }
    assert_eq!(device.len(), reference.len(), "the arrays that are compared have one length");
    let near = |(device, reference): (&u32, &u32)| {
        let apart = (f32::from_bits(*device) - f32::from_bits(*reference)).abs();
        if apart <= FLUSHED { *reference } else { *device }
    };
    let device: Vec<u32> = device.iter().zip(reference).map(near).collect();
    first_difference(&device, reference)
}

/// The WGSL with functions in the place of what the driver brings; `None` where it asks for none of it.
fn with_reading(source: &str, reading: &str) -> Option<String> {
    let mut text = String::new();
    let mut any = false;
    for line in source.lines() {
        let mut line = line.to_owned();
        // Whole numbers have one smaller and one larger.
        if !line.contains("2u)") {
            for name in ["min(", "max(", "clamp("] {
                let places: Vec<usize> = line
                    .match_indices(name)
                    .map(|(place, _)| place)
                    .filter(|place| !line[..*place].ends_with(|c: char| c.is_alphanumeric() || c == '_'))
                    .collect();
                any |= !places.is_empty();
                places.iter().rev().for_each(|place| line.insert_str(*place, "read_"));
            }
        }
        text.push_str(&line);
        text.push('\n');
    }
    any.then(|| format!("{text}{reading}\n{CLAMP}\n"))
}

#[test]
fn no_answer_hangs_on_what_a_driver_takes_for_the_larger_of_a_number_and_nan() {
    let mut faults = Vec::new();
    let mut kernels = 0;
    for row in alone() {
        let name = row.kernel.name();
        let source = row.kernel.source();
        let mut cases = None;
        for (words, reading) in READINGS {
            let Some(source) = with_reading(&source, reading) else { continue };
            let compiled = Compiled::new(gpu(), row.kernel, &source).expect("the functions compile");
            let cases = cases.get_or_insert_with(|| Case::variants(seeds(), row.kernel));
            let found = cases.iter().find_map(|case| case.difference(gpu(), &compiled));
            faults.extend(found.map(|difference| format!("{name}, {words}: {difference}")));
        }
        kernels += u32::from(cases.is_some());
    }
    assert!(kernels >= 8, "only {kernels} kernels ask for a smaller or larger of two");
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
#[ignore = "`cargo xtask test` says on which adapter it runs the tests of parity once more"]
fn the_tests_run_on_the_adapter_that_is_asked_for() {
    let wanted = env::var(WANTED).unwrap_or_else(|_| panic!("{WANTED} names the adapter"));
    assert!(!wanted.is_empty() && gpu().adapter.contains(&wanted), "the tests run on {}, not {wanted}", gpu().adapter);
}
