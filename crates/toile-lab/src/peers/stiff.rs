//! How stiff cloth moves: what the motion of every program is held against.

use super::Trial;
use crate::Network;
use glam::DVec3;
use toile::model::{Model, StepSettings};
use toile::scene::{Cloth, Rule, Threshold, VelocityModification};

/// Stiffness of a limit [N/m]: half of the hanging sheet's weight stretches one spring by a fortieth of a per cent of the sheet.
const STIFFNESS: f64 = 4000.0;
/// Elongation that limits allow [1].
const THRESHOLD: f64 = 1e-3;

/// Mean position [m] after some seconds of a sheet whose springs resist lengthening by 4000 N/m and bend as softly as the scene's, in f64 and
/// steps of fourth order. After half a second, 33 × 33 particles are within 3 mm of 49 × 49 in both scenes.
pub fn stiff_middle(name: &str, n: u32, seconds: f64) -> DVec3 {
    let mut trial = Trial::new(name, n);
    let settings = &mut trial.scene.settings;
    settings.velocity_modification = VelocityModification::new(Rule::Predictive);
    settings.fabric.threshold = Threshold::even(THRESHOLD);
    let [Cloth::Sheet(sheet)] = trial.scene.cloths.as_slice() else { panic!("a trial has one sheet") };
    let model = Model::from_sheet(sheet, settings);
    let mut network = Network::new(&model, &StepSettings::new(settings, &model)).with_limits(&model, STIFFNESS);
    let step = 0.5 * network.stable_step();
    let count = (seconds / step).ceil();
    for _ in 0..count as u64 {
        network.advance(seconds / count, step);
        if let Some(sphere) = trial.sphere {
            keep_out(&mut network, sphere.radius, sphere.friction);
        }
    }
    network.positions.iter().sum::<DVec3>() / network.positions.len() as f64
}

/// Sets what is inside of a sphere on its surface; takes its inward velocity, and of its sliding what Coulomb's law allows.
fn keep_out(network: &mut Network, radius: f64, friction: f64) {
    for (position, velocity) in network.positions.iter_mut().zip(&mut network.velocities) {
        let normal = position.normalize_or_zero();
        let inward = -velocity.dot(normal);
        if position.length() < radius && inward > 0.0 {
            let sliding = *velocity + normal * inward;
            *velocity = sliding * (1.0 - friction * inward / sliding.length().max(f64::MIN_POSITIVE)).max(0.0);
            *position = normal * radius;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::stiff_middle;
    use glam::DVec3;

    #[test]
    fn it_swings_down_and_comes_to_lie_on_the_ball() {
        // A sheet that nothing holds falls by half of g·t².
        let fallen = stiff_middle("ball", 5, 0.1);
        assert!(fallen.distance(DVec3::new(0.0, 0.45 - 0.5 * 9.81 * 0.01, 0.0)) < 1e-3, "{fallen}");
        // The sphere stops it: it would be at −3.9 m.
        let lying = stiff_middle("ball", 9, 0.4);
        assert!((-0.2..0.25).contains(&lying.y), "{lying}");
        // Two held corners keep the middle within the length of the cloth.
        let hanging = stiff_middle("hang", 9, 0.5);
        assert!((hanging.x - 0.5).abs() < 1e-3 && (-0.6..-0.4).contains(&hanging.y), "{hanging}");
    }
}
