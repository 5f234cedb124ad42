//! What stands in the way of sewing and cannot be mended.

use super::finding::InBody;

/// What stands in the way of sewing and cannot be mended.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// A number that no scene has.
    #[error("{0}")]
    Range(#[from] toile_scene::OutOfRange),
    /// The body stands with another axis up, and it is not clear which.
    #[error(
        "the body lies: {height:.2} m along y is less than a person of {length:.2} m has, and which way is up is not clear: say which axis is up"
    )]
    Lies {
        /// Its height along y [m].
        height: f64,
        /// Its longest extent [m].
        length: f64,
    },
    /// The host skins the body, so it cannot be turned here.
    #[error(
        "the body that the host skins must stand upright and face +z while it is dressed, and it does not: give its mesh, and pose it, so that it does"
    )]
    Hosted,
    /// A garment is placed above or below the body, and has no label to follow.
    #[error(
        "garment {garment} is placed from {low:.2} to {high:.2} m, where the body, from {body_low:.2} to {body_high:.2} m, is not: move its panels, \
         or label its neckline left_collar and right_collar or its waist lower_interface, which are moved to the neck and waist"
    )]
    Height {
        /// Name of the garment.
        garment: String,
        /// Lowest point of its panels [m].
        low: f64,
        /// Highest point [m].
        high: f64,
        /// Soles of the body [m].
        body_low: f64,
        /// Crown of the body [m].
        body_high: f64,
    },
    /// A panel stands in the body, and no way out of it is free.
    #[error(
        "panel {panel} of garment {garment} stands {place}, and no way out of it is free within {reach_cm:.0} cm: dress the body in another pose, or \
         place the panel elsewhere"
    )]
    InBody {
        /// Name of the garment.
        garment: String,
        /// Name of the panel.
        panel: String,
        /// Where it stands.
        place: InBody,
        /// How far it was moved in search of a clear place [cm].
        reach_cm: f64,
    },
}
