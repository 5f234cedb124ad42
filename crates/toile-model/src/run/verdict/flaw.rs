//! What can be wrong with how a garment is worn.

use super::opening::Opening;
use super::place::Place;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What can be wrong with how a garment is worn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "what", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Flaw {
    /// Seams did not close; they are left as they are.
    SeamOpen {
        /// The widest, as "panel.edge to panel.edge".
        seam: String,
        /// How wide it is [m].
        gap: f32,
    },
    /// A part of it slid off, or up, or touches nothing and falls.
    FallenOff {
        /// The panels of the part.
        panels: Vec<String>,
        /// How far its highest particle is below where it was placed [m]; negative above.
        drop: f32,
    },
    /// Nothing goes through one of its openings.
    OpeningEmpty {
        /// The opening.
        opening: Opening,
    },
    /// Particles are on the wrong side of the body, see [`crossed_particles`](crate::crossed_particles).
    Caught {
        /// Number of them.
        particle_count: u32,
        /// How deep that goes [m].
        depth: f32,
        /// Where they are.
        place: Place,
    },
    /// It kept moving.
    NotAtRest {
        /// Particles that move.
        particle_count: u32,
        /// The fastest of them [m/s].
        speed: f32,
        /// Where they are.
        place: Place,
    },
    /// Its fabric is stretched beyond its threshold.
    TooTight {
        /// What is stretched the most: the whole way around, or a spring where no way around is.
        place: Place,
        /// Its length [m].
        length: f32,
        /// Its length at rest [m].
        rest_length: f32,
        /// Elongation that the fabric allows [1].
        threshold: f32,
        /// Largest elongation of a spring [1].
        elongation_max: f32,
    },
}

impl Flaw {
    /// The finding in a word or three.
    pub fn word(&self) -> &'static str {
        match self {
            Self::SeamOpen { .. } => "seam open",
            Self::FallenOff { .. } => "fallen off",
            Self::OpeningEmpty { .. } => "opening empty",
            Self::Caught { .. } => "caught",
            Self::NotAtRest { .. } => "did not come to rest",
            Self::TooTight { .. } => "too tight but at rest",
        }
    }
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SeamOpen { seam, gap } => {
                write!(f, "seam open: {seam} did not close and is {:.1} cm wide; its panels are not merged", 1e2 * gap)
            }
            Self::FallenOff { panels, drop } => {
                let panels = panels.join(", ");
                let way = 1e2 * drop.abs();
                match *drop < 0.0 {
                    false => write!(f, "fallen off: {panels} hangs {way:.0} cm below where it was placed"),
                    true => write!(f, "fallen off: {panels} slid up by {way:.0} cm from where it was placed"),
                }
            }
            Self::OpeningEmpty { opening: Opening { name, girth, centre: [x, y, z], .. } } => write!(
                f,
                "opening empty: nothing goes through the opening {name}, {:.0} cm around, at ({x:.2}, {y:.2}, {z:.2}) m",
                1e2 * girth
            ),
            Self::Caught { particle_count, depth, place } => write!(
                f,
                "caught: {particle_count} particles are on the wrong side of the body, up to {:.1} cm deep, most of them on {place}",
                1e2 * depth
            ),
            Self::NotAtRest { particle_count, speed, place } => write!(
                f,
                "did not come to rest: {particle_count} particles move, the fastest at {speed:.2} m/s, most of them on {place}"
            ),
            Self::TooTight { place, length, rest_length, threshold, elongation_max } => write!(
                f,
                "too tight: {place} is stretched from {:.1} to {:.1} cm, by {:.1} cm ({:.1} %; its fabric allows {:.1} %); single springs \
                 by up to {:.1} %",
                1e2 * rest_length,
                1e2 * length,
                1e2 * (length - rest_length),
                1e2 * (length / rest_length - 1.0),
                1e2 * threshold,
                1e2 * elongation_max
            ),
        }
    }
}
