//! The buffer table: what each buffer that kernels name is for. How long an item is comes from the WGSL.

/// One row of the buffer table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BufferRow {
    /// Name of the global variable in the kernels.
    pub name: &'static str,
    /// How many items it has.
    pub per: Per,
    /// What a run does with it.
    pub role: Role,
}

/// What a buffer has one item for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Per {
    /// All of the cloth.
    Cloth,
    /// A particle.
    Particle,
    /// A quad.
    Quad,
    /// A particle or a quad midpoint.
    Point,
    /// A limit.
    Limit,
    /// A node: a particle or a coarse particle.
    Node,
    /// The particles of a workgroup.
    Workgroup,
    /// A pass that a polish must grant.
    GrantedPass,
    /// As many as a model, or whoever brings the buffer, lists.
    Listed,
}

/// What a run does with a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Changed by the host alone, between steps.
    Numbers,
    /// Never written once it is made: cloths for which it holds the same share it.
    Constant,
    /// Carries over from step to step: all that a saved simulation needs.
    State,
    /// Written before it is read, within a step or a frame.
    Scratch,
    /// Written for the host at the end of a frame.
    Output,
    /// Workgroups of indirect dispatches, written by a kernel.
    Dispatches,
    /// Constant, with an entry for each part of an array that passes work on, at a dynamic offset.
    PerSpan,
    /// Constant, with an entry for each number of steps that are left in an interval of the maps, at a dynamic offset.
    PerStepLeft,
    /// Written by the host, with an entry for each step that it records together, at a dynamic offset.
    PerStep,
    /// Not of a cloth: whoever draws maps, poses a body, hands a cloth over or measures brings it.
    Brought,
}

impl Role {
    /// Whether nothing writes the buffer once it is made: cloths for which it holds the same share it.
    pub fn is_constant(self) -> bool {
        matches!(self, Self::Constant | Self::PerSpan | Self::PerStepLeft)
    }

    /// Whether the buffer has entries, one of which a dispatch sees.
    pub fn has_entries(self) -> bool {
        matches!(self, Self::PerSpan | Self::PerStepLeft | Self::PerStep)
    }
}

macro_rules! buffers {
    ($($name:literal $per:ident $role:ident;)*) => {
        /// Every buffer that a kernel names.
        pub const BUFFERS: &[BufferRow] = &[$(BufferRow { name: $name, per: Per::$per, role: Role::$role },)*];
    };
}

buffers! {
    "step" Cloth Numbers;
    "span" Listed PerSpan;
    "lag" Cloth PerStepLeft;
    "shapes" Listed PerStep;
    "positions" Particle State;
    "velocities" Particle State;
    "contacts" Particle State;
    "pulls" Particle State;
    "polish_state" Cloth State;
    "normals" Particle Output;
    "status" Cloth Output;
    "forces" Particle Scratch;
    "quad_winds" Quad Scratch;
    "midpoints" Quad Scratch;
    "probes" Point Scratch;
    "energy_partials" Workgroup Scratch;
    "polish" Cloth Constant;
    "sweep_workgroups" GrantedPass Constant;
    "sweep_dispatches" GrantedPass Dispatches;
    "link_offsets" Listed Constant;
    "link_others" Listed Constant;
    "link_springs" Listed Constant;
    "limits" Limit Constant;
    "nodes" Node Constant;
    "clusters" Listed Constant;
    "guard_lengths" Listed Constant;
    "small_turns" Listed Constant;
    "leaders" Listed Constant;
    "node_places" Node Scratch;
    "node_shifts" Node Scratch;
    "attachment_offsets" Listed Constant;
    "attachments" Listed Constant;
    "seam_pairs" Listed Constant;
    "holds" Listed Constant;
    "held_particles" Listed Constant;
    "quads" Quad Constant;
    "particle_quad_offsets" Listed Constant;
    "particle_quads" Listed Constant;
    "side_box" Listed Brought;
    "layer_box" Listed Brought;
    "drawn" Listed Brought;
    "triangle_parts" Listed Brought;
    "crossing_lists" Listed Brought;
    "crossings" Listed Brought;
    "layer_counts" Listed Brought;
    "vertices" Listed Brought;
    "bind_positions" Listed Brought;
    "bind_normals" Listed Brought;
    "morph_offsets" Listed Brought;
    "displacements" Listed Brought;
    "morph_weights" Listed Brought;
    "morphed_positions" Listed Brought;
    "morphed_normals" Listed Brought;
    "influence_offsets" Listed Brought;
    "influences" Listed Brought;
    "joints" Listed Brought;
    "body_positions" Listed Brought;
    "body_normals" Listed Brought;
    "gather" Listed Brought;
    "host_positions" Listed Brought;
    "host_normals" Listed Brought;
    "host_motions" Listed Brought;
    "last_positions" Listed Brought;
    "surface_indices" Listed Brought;
    "surface_positions" Listed Brought;
    "surface_normals" Listed Brought;
    "surface_velocities" Listed Brought;
    "open_positions" Listed Brought;
    "open_velocities" Listed Brought;
    "member_offsets" Listed Brought;
    "members" Listed Brought;
    "carry" Cloth Brought;
    "pins" Listed Brought;
    "position_copies" Particle Brought;
    "velocity_copies" Particle Brought;
}

/// The row of a buffer.
///
/// # Panics
/// When it has none: each buffer that a kernel names has a row.
pub fn buffer_row(name: &str) -> &'static BufferRow {
    let row = BUFFERS.iter().find(|row| row.name == name);
    row.unwrap_or_else(|| panic!("the kernels name a buffer {name} that has no row in the buffer table"))
}
