//! Seeded numbers (splitmix64): the same on every machine and in every run.

use glam::Vec3;

/// A seeded sequence of numbers.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next word.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from `low` to below `high`.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * ((self.word() >> 40) as f32 / (1u64 << 24) as f32)
    }

    /// A vector with each component within `reach` of zero.
    pub fn vector(&mut self, reach: f32) -> Vec3 {
        Vec3::new(self.between(-reach, reach), self.between(-reach, reach), self.between(-reach, reach))
    }

    /// A unit vector.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let vector = self.vector(1.0);
            if vector.length() > 0.1 {
                return vector / vector.length();
            }
        }
    }

    /// A whole number below `count`, which is positive.
    pub fn below(&mut self, count: u32) -> u32 {
        (self.word() % u64::from(count)) as u32
    }

    /// Whether something with the chance 1 in `count` happens.
    pub fn one_in(&mut self, count: u32) -> bool {
        self.below(count) == 0
    }

    /// The numbers below `count` in a random order.
    pub fn shuffled(&mut self, count: u32) -> Vec<u32> {
        let mut order: Vec<u32> = (0..count).collect();
        for i in (1..count).rev() {
            order.swap(i as usize, self.below(i + 1) as usize);
        }
        order
    }
}
