//! From sRGB to light and back.

use glam::Vec3;

/// Linear light of an sRGB colour, 0 to 1. IEC 61966-2-1.
pub fn linear(srgb: [f32; 3]) -> Vec3 {
    Vec3::from(srgb.map(|v| if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }))
}

/// Bytes of linear light; what is brighter than white becomes white.
pub fn bytes(light: Vec3) -> [u8; 3] {
    light.to_array().map(|v| {
        let srgb = if v <= 0.0031308 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
        (255.0 * srgb).round() as u8
    })
}
