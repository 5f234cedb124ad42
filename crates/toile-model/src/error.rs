//! What cannot be turned into a model.

/// What cannot be turned into a model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A number that no scene has.
    #[error("{0}")]
    Range(#[from] toile_scene::OutOfRange),
    /// Arrays that are no model.
    #[error("the arrays of a model do not fit together: {what}")]
    Arrays {
        /// The first thing that does not fit, with its array, its index and what was expected.
        what: String,
    },
    /// The spacing is no length.
    #[error("the spacing is {spacing} m: give a positive, finite distance of neighbouring particles")]
    Spacing {
        /// The spacing that was asked for [m].
        spacing: f64,
    },
    /// More particles than the solvers' buffers are meant for.
    #[error(
        "garment {garment}: a spacing of {spacing} m needs about {count} particles, more than {limit}: choose a larger spacing"
    )]
    TooManyParticles {
        /// Name of the garment.
        garment: String,
        /// The spacing that was asked for [m].
        spacing: f64,
        /// Estimated particle count.
        count: u64,
        /// Largest particle count.
        limit: u64,
    },
    /// The outline of a panel encloses nothing.
    #[error("panel {panel}: its outline encloses no area: check the order and the positions of its edges")]
    NoArea {
        /// Name of the panel.
        panel: String,
    },
    /// The outline of a panel crosses or touches itself.
    #[error(
        "panel {panel}: edges {} and {} of its outline cross or touch where particles {spacing} m apart follow them: \
         correct the outline, or choose a spacing smaller than the narrowest place of the panel",
        edges[0], edges[1]
    )]
    Crossing {
        /// Name of the panel.
        panel: String,
        /// Indices of the two edges; the same index twice when one edge crosses itself.
        edges: [usize; 2],
        /// Finest spacing that was tried on these edges [m].
        spacing: f64,
    },
    /// No valid mesh was found.
    #[error("panel {panel}: no valid mesh was found at a spacing of {spacing} m: choose a smaller spacing")]
    Mesh {
        /// Name of the panel.
        panel: String,
        /// The spacing that was asked for [m].
        spacing: f64,
    },
    /// A frame would have more steps than a run could end with.
    #[error(
        "{cloth}: a frame would take {steps} steps, and at most {most} are done: use softer springs, heavier or coarser cloth, a larger safety \
         factor, or the rule \"hierarchical\", which needs few"
    )]
    Steps {
        /// Name of the garment or sheet.
        cloth: String,
        /// Steps of a frame.
        steps: u32,
        /// Most steps of a frame.
        most: u32,
    },
    /// The step is of the hierarchical rule, and the model of another.
    #[error(
        "the rule \"hierarchical\" holds levels of limits, and this model was made for another rule: make model and step from the same settings"
    )]
    Rule,
    /// A polish under a rule that knows none.
    #[error(
        "a polish measures what the coming move would do: use the rule \"hierarchical\" or \"predictive\" with it, or none"
    )]
    Polish,
}
