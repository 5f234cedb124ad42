//! Particles of a cloth that the host holds.

use glam::DVec3;
use std::collections::BTreeMap;
use toile_model::PinTarget;

/// Particles of a cloth that the host holds, and what the device has still to hear of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pins {
    /// Where each is wanted [m].
    targets: BTreeMap<u32, DVec3>,
    freed: Vec<u32>,
    due: Due,
}

/// What the device has still to hear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Due {
    #[default]
    Nothing,
    /// That they go where they are wanted.
    Going,
    /// That they have arrived.
    Arrived,
}

impl Pins {
    /// Particles that are held already, and stand still.
    pub(crate) fn held(particles: impl IntoIterator<Item = (u32, DVec3)>) -> Self {
        Self { targets: particles.into_iter().collect(), ..Self::default() }
    }

    /// Holds these particles and no others.
    pub(crate) fn set(&mut self, targets: &BTreeMap<u32, DVec3>) {
        if *targets == self.targets {
            return;
        }
        let before = std::mem::replace(&mut self.targets, targets.clone());
        self.freed.extend(before.into_keys().filter(|particle| !targets.contains_key(particle)));
        self.freed.retain(|particle| !targets.contains_key(particle));
        self.due = Due::Going;
    }

    /// What the device hears before steps of so many seconds in all: by their end every particle is where it is wanted.
    pub(crate) fn take(&mut self, seconds: f64) -> Vec<PinTarget> {
        let held = |(particle, place): (&u32, &DVec3)| match self.due {
            Due::Going => PinTarget::held(*particle, place.as_vec3(), seconds),
            _ => PinTarget::still(*particle),
        };
        let told = match self.due {
            Due::Nothing => Vec::new(),
            _ => self.targets.iter().map(held).chain(self.freed.drain(..).map(PinTarget::free)).collect(),
        };
        self.due = if self.due == Due::Going { Due::Arrived } else { Due::Nothing };
        told
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_go_arrive_and_are_let_go() {
        let mut pins = Pins::held([(1, DVec3::ZERO), (2, DVec3::ZERO)]);
        assert_eq!(pins.take(0.1), [], "they stand still");
        pins.set(&BTreeMap::from([(2, DVec3::X)]));
        let told = pins.take(0.5);
        assert_eq!(told, [PinTarget::held(2, glam::Vec3::X, 0.5), PinTarget::free(1)]);
        assert_eq!(pins.take(0.5), [PinTarget::still(2)]);
        assert_eq!(pins.take(0.5), []);
        // Who is held again before the device has heard of it was never free.
        pins.set(&BTreeMap::new());
        pins.set(&BTreeMap::from([(2, DVec3::X)]));
        assert_eq!(pins.take(0.5), [PinTarget::held(2, glam::Vec3::X, 0.5)]);
    }
}
