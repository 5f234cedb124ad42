//! A model as one number, by which a saved state knows its own.

use crate::Arrays;

/// FNV-1a over some bytes, 64 bits: the same number with every compiler and on every machine.
pub fn digest_of(bytes: &[u8]) -> u64 {
    let (start, prime) = (0xcbf2_9ce4_8422_2325_u64, 0x0000_0100_0000_01b3);
    bytes.iter().fold(start, |digest, byte| (digest ^ u64::from(*byte)).wrapping_mul(prime))
}

impl Arrays {
    /// The model as one number: another one has another number, but for one chance in 10^19. Names do not count.
    pub fn digest(&self) -> u64 {
        let mut words: Vec<u32> = Vec::new();
        let mut floats = |values: &mut dyn Iterator<Item = f32>| words.extend(values.map(f32::to_bits));
        floats(&mut self.positions.iter().flat_map(|p| p.to_array()));
        floats(&mut self.masses.iter().copied());
        floats(&mut self.inverse_masses.iter().copied());
        floats(&mut self.links.values.iter().flat_map(|link| [link.rest_length, link.stiffness]));
        floats(&mut self.limits.iter().flat_map(|limit| [limit.rest_length, limit.max_length]));
        floats(&mut self.clusters.iter().flat_map(|cluster| cluster.max_lengths));
        floats(&mut self.leaders.values.iter().map(|leader| leader.part));
        floats(&mut self.attachments.values.iter().map(|attachment| attachment.max_length));
        words.extend(self.links.offsets.iter().chain(self.links.values.iter().map(|link| &link.other)));
        words.extend(self.limits.iter().flat_map(|limit| limit.ends));
        words.extend(self.clusters.iter().flat_map(|cluster| cluster.nodes));
        words.extend(self.leaders.values.iter().map(|leader| leader.node));
        words.extend(self.attachments.values.iter().map(|attachment| attachment.pin));
        words.extend(self.seam_pairs.iter().flat_map(|pair| pair.ends));
        words.extend(self.quads.iter().flatten());
        digest_of(bytemuck::cast_slice(&words))
    }
}

#[cfg(test)]
mod tests {
    use super::digest_of;
    use crate::Arrays;
    use glam::Vec3;

    #[test]
    fn the_digest_is_fnv_1a() {
        // Vectors of the specification.
        assert_eq!(digest_of(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(digest_of(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(digest_of(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn another_model_has_another_digest() {
        let model = Arrays { positions: vec![Vec3::X, Vec3::Y], masses: vec![1.0, 2.0], ..Arrays::default() };
        assert_eq!(model.digest(), model.clone().digest());
        let moved = Arrays { positions: vec![Vec3::X, Vec3::Z], ..model.clone() };
        let turned = Arrays { quads: vec![[0, 1, 0, 1]], ..model.clone() };
        assert_ne!(model.digest(), moved.digest());
        assert_ne!(model.digest(), turned.digest());
    }
}
