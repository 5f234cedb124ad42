//! Comparison of floats bit for bit.

use glam::Vec3;
use std::fmt;

/// Where two arrays of words differ first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Index of the first word that differs.
    pub index: usize,
    /// What the device has there.
    pub device: u32,
    /// What the reference has there.
    pub reference: u32,
    /// Number of words that differ.
    pub count: usize,
    /// Number of words.
    pub of: usize,
    /// Largest distance of two words in units in the last place.
    pub ulps: u32,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { index, device, reference, count, of, ulps } = self;
        let [d, r] = [device, reference].map(|bits| f32::from_bits(*bits));
        write!(
            f,
            "{count} of {of} words differ by up to {ulps} ULP, first word {index}: device {d:e} ({device:#010x}), reference {r:e} ({reference:#010x})"
        )
    }
}

/// Where two arrays differ first; `None` when all bits agree.
///
/// Two NaN agree whatever their payload and sign, which IEEE 754 leaves open; minus and plus zero do not.
pub fn first_difference(device: &[u32], reference: &[u32]) -> Option<Difference> {
    assert_eq!(device.len(), reference.len(), "the arrays that are compared have one length");
    let mut found: Option<Difference> = None;
    for (index, (&device, &reference)) in device.iter().zip(reference).enumerate() {
        if agree(device, reference) {
            continue;
        }
        let ulps = ulps(device, reference);
        match &mut found {
            None => found = Some(Difference { index, device, reference, count: 1, of: 0, ulps }),
            Some(difference) => {
                difference.count += 1;
                difference.ulps = difference.ulps.max(ulps);
            }
        }
    }
    found.map(|difference| Difference { of: device.len(), ..difference })
}

/// Distance of two words in units in the last place; 0 when they agree. Two NaN agree.
pub fn ulps(device: u32, reference: u32) -> u32 {
    if agree(device, reference) { 0 } else { ordered(device).abs_diff(ordered(reference)) }
}

fn agree(device: u32, reference: u32) -> bool {
    let nan = |bits: u32| f32::from_bits(bits).is_nan();
    device == reference || (nan(device) && nan(reference))
}

/// Maps the bits of floats to integers in the order of their values, so that neighbours differ by one.
fn ordered(bits: u32) -> i32 {
    let bits = bits as i32;
    if bits < 0 { i32::MIN.wrapping_sub(bits) } else { bits }
}

/// The words of vectors, three each.
pub fn vec3_words(vectors: &[Vec3]) -> Vec<u32> {
    bytemuck::cast_slice(vectors).to_vec()
}
