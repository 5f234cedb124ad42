//! The number that each term is there for.

use crate::experiments::terms::term::Term;
use crate::experiments::terms::trial::Outcome;
use glam::DVec3;
use toile::model::NO_CORNER;
use toile_lab::scenes::BALL_RADIUS;

impl Term {
    /// The number that it is there for, with its unit.
    pub fn purpose(self) -> &'static str {
        match self {
            Self::Wind => "mean way down the wind [mm]",
            Self::BendSprings => "mean angle between neighbouring cells [degrees]",
            Self::Levels => "largest elongation in the run [%]",
            Self::QuadMidpoints => "deepest midpoint below the thickness [mm]",
            Self::Friction | Self::FrictionLaw => "mean slip within 0.15 m of the sphere's top [mm]",
            Self::VelocityMap => "mean of the cloth behind the sphere's centre [mm]",
        }
    }

    /// That number, of what came out; infinite when the run diverged.
    pub fn measure(self, outcome: &Outcome) -> f64 {
        if outcome.positions.iter().any(|position| !position.is_finite()) {
            return f64::INFINITY;
        }
        let ways = outcome.positions.iter().zip(&outcome.start).map(|(end, start)| *end - *start);
        match self {
            Self::Wind => -1e3 * mean(ways.map(|way| way.z)),
            Self::BendSprings => mean_angle(outcome),
            Self::Levels => 1e2 * outcome.elongation_max,
            Self::QuadMidpoints => 1e3 * deepest_midpoint(outcome),
            Self::Friction | Self::FrictionLaw => {
                let near = |(_, start): &(DVec3, &DVec3)| start.x.hypot(start.z) < 0.15;
                1e3 * mean(ways.zip(&outcome.start).filter(near).map(|(way, _)| way.x.hypot(way.z)))
            }
            Self::VelocityMap => 1e3 * mean(outcome.positions.iter().map(|position| outcome.centre.x - position.x)),
        }
    }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count.max(1))
}

/// Mean angle between the normals of neighbouring quads along the rows [degrees].
fn mean_angle(outcome: &Outcome) -> f64 {
    let normal = |quad: &[u32; 4]| {
        let [a, b, c, d] = quad.map(|corner| outcome.positions[corner as usize]);
        (c - a).cross(d - b)
    };
    let neighbours = outcome.quads.windows(2).filter(|pair| pair[0].iter().any(|corner| pair[1].contains(corner)));
    mean(neighbours.map(|pair| normal(&pair[0]).angle_between(normal(&pair[1])).to_degrees()))
}

/// How deep the deepest midpoint of a quad lies below the surface that is the thickness above the sphere [m]; 0 for none.
fn deepest_midpoint(outcome: &Outcome) -> f64 {
    let radius = BALL_RADIUS + outcome.thickness;
    let quads = outcome.quads.iter().filter(|quad| quad[3] != NO_CORNER);
    let middle = |quad: &[u32; 4]| quad.iter().map(|corner| outcome.positions[*corner as usize]).sum::<DVec3>() / 4.0;
    quads.map(|quad| radius - middle(quad).length()).fold(0.0, f64::max)
}
