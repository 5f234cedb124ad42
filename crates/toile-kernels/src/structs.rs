//! The structs that Rust and WGSL share. encase lays them out; a test compares each with naga's layout of the WGSL.

use encase::ShaderType;
use glam::{Vec3, Vec4};

/// The numbers of one step, the same for every particle. `wgsl/shared/step_params.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct StepParams {
    /// Gravity [m/s²].
    pub gravity: Vec3,
    /// Time step [s].
    pub dt: f32,
    /// Viscous damping rate [1/s].
    pub damping: f32,
    /// Largest speed on the way out of a body [m/s].
    pub push_speed: f32,
    /// Largest change of normal speed that friction counts [m/s].
    pub pressing_speed: f32,
    /// A point nearer than this is in contact [m].
    pub contact_margin: f32,
    /// C_refl of W eq. 15 [1].
    pub reflection: f32,
    /// 0 Coulomb, 1 the papers'.
    pub friction_law: u32,
    /// Coulomb's coefficient [1].
    pub friction: f32,
    /// C_fric of W eq. 15 [1].
    pub velocity_kept: f32,
    /// C_fric of W eq. 16 [1].
    pub force_removed: f32,
    /// Speed of a held edge towards its height, per metre from it [1/s].
    pub hold_rate: f32,
    /// Largest speed of a held edge towards its height [m/s].
    pub hold_speed: f32,
    /// Number of particles.
    pub particle_count: u32,
    /// Number of quads.
    pub quad_count: u32,
    /// 1: the whole way of a point is tested against the bodies.
    pub swept: u32,
    /// Velocity of the air [m/s].
    pub wind: Vec3,
    /// Drag coefficient of a plate across the wind [1].
    pub drag: f32,
    /// Lift coefficient [1].
    pub lift: f32,
    /// Distance kept from the bodies [m].
    pub thickness: f32,
    /// How much the guard shortens a spring at once [m].
    pub guard_way: f32,
    /// Part of the threshold that the limits hold [1].
    pub aim: f32,
    /// Number of structural and shear springs, whose limits are the first.
    pub limit_count: u32,
}

/// The part of an array that one dispatch works on. `wgsl/shared/span.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Span {
    /// First item.
    pub first: u32,
    /// Number of items.
    pub count: u32,
    /// Part of an excess that a pass of the guard removes [1]; no other kernel reads it.
    pub share: f32,
}

/// Rest length and stiffness of a link. `wgsl/step/spring_forces.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct LinkSpring {
    /// Rest length [m].
    pub rest_length: f32,
    /// Stiffness [N/m].
    pub stiffness: f32,
}

/// A unilateral maximum length. `wgsl/shared/limit.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Limit {
    /// One particle.
    pub first: u32,
    /// The other.
    pub second: u32,
    /// Rest length [m].
    pub rest_length: f32,
    /// Maximum length [m].
    pub max_length: f32,
}

/// A line of cloth and the limits along it. `wgsl/shared/strand.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Strand {
    /// First of its particles.
    pub first: u32,
    /// Number of its particles.
    pub count: u32,
    /// First of its maximum lengths.
    pub lengths: u32,
    /// Number of levels: limits over 2, 4, 8… edges.
    pub level_count: u32,
}

/// A maximum distance of a particle from a pin. `wgsl/shared/attachment.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Attachment {
    /// The pinned particle.
    pub pin: u32,
    /// Maximum distance [m].
    pub max_length: f32,
}

/// Two particles that a seam pulls together. `wgsl/shared/seam_pair.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct SeamPair {
    /// One particle.
    pub first: u32,
    /// The other.
    pub second: u32,
    /// Closing speed [m/s].
    pub closing_speed: f32,
}

/// The edges of one label, held at their mean height. `wgsl/step/hold_edges.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Hold {
    /// Where its particles begin among the held particles.
    pub first: u32,
    /// Number of its particles.
    pub count: u32,
    /// Their mean height [m].
    pub height: f32,
}

/// Mean of the corners of a quad. `wgsl/shared/midpoint.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Midpoint {
    /// Position [m].
    pub position: Vec3,
    /// Velocity [m/s].
    pub velocity: Vec3,
}

/// What a point sees of the bodies. `wgsl/shared/probe.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Probe {
    /// Unit normal out of the body.
    pub normal: Vec3,
    /// Distance to the surface, negative inside [m].
    pub distance: f32,
    /// Velocity of the surface [m/s].
    pub velocity: Vec3,
    /// 1 near enough to matter, 0 not.
    pub hit: f32,
}

/// What a particle touched. `wgsl/shared/contact.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Contact {
    /// Unit normal out of the body.
    pub normal: Vec3,
    /// 1 in contact, 0 not.
    pub touching: f32,
    /// Velocity of the body at the contact [m/s].
    pub velocity: Vec3,
    /// Fills the last word.
    pub padding: f32,
}

/// Where the two map cameras stand. `wgsl/shared/map_box.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct MapBox {
    /// Left edge [m].
    pub origin_x: f32,
    /// Top edge [m].
    pub origin_y: f32,
    /// Edge length of a texel [m].
    pub texel: f32,
    /// Plane of the front camera [m].
    pub z_front: f32,
    /// Plane of the back camera [m].
    pub z_back: f32,
    /// Texels along x.
    pub columns: u32,
    /// Texels along y.
    pub rows: u32,
}

/// Which camera draws, and how far the surface is offset. `wgsl/maps/render_maps.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Side {
    /// 0 front, 1 back.
    pub side: u32,
    /// Offset along the normals [m].
    pub thickness: f32,
}

/// The analytic sphere during one step. `wgsl/step/sample_sphere.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Ball {
    /// Centre [m].
    pub centre: Vec3,
    /// Radius with the thickness of the cloth [m].
    pub radius: f32,
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// 1 when the probes already hold what the points see in the maps.
    pub after_maps: u32,
    /// Angular velocity [rad/s].
    pub spin: Vec3,
}

/// How long before the time of the maps a step begins and ends. `wgsl/step/sample_moving_maps.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Lag {
    /// From the start of the step [s].
    pub start: f32,
    /// From its end [s].
    pub end: f32,
}

/// The vertices of a body. `wgsl/shared/vertices.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Vertices {
    /// Number of vertices.
    pub count: u32,
    /// 1 / time since the last pose, 0 when there was none [1/s].
    pub rate: f32,
}

/// What one morph target does to one vertex. `wgsl/maps/morph_body.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Displacement {
    /// Displacement of the bind position.
    pub position: Vec3,
    /// Which target.
    pub morph: u32,
    /// Change of the bind normal.
    pub normal: Vec3,
}

/// The share that a joint has in a vertex. `wgsl/maps/skin_body.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Influence {
    /// Which joint.
    pub joint: u32,
    /// Share [1].
    pub weight: f32,
}

/// First three rows of the matrix of a joint, from bind space to the world. `wgsl/maps/skin_body.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Joint {
    /// Row of x.
    pub row_x: Vec4,
    /// Row of y.
    pub row_y: Vec4,
    /// Row of z.
    pub row_z: Vec4,
}

/// Further sweeps in the steps that need them. `wgsl/shared/polish.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Polish {
    /// Elongation that needs no further sweep [1].
    pub target_elongation: f32,
    /// At most so many further sweeps in a step.
    pub sweeps: u32,
}

/// What a polish knows. `wgsl/shared/polish.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct PolishState {
    /// Bits of the largest elongation above the target [1]; 0: none.
    pub elongation_max: u32,
    /// Further sweeps of the present step.
    pub granted: u32,
    /// Further sweeps so far.
    pub further_sweeps: u32,
    /// Steps so far that ended above the target.
    pub missed_steps: u32,
}

/// What a frame reports. `wgsl/shared/status.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct Status {
    /// Particles that are not finite.
    pub non_finite_count: u32,
    /// `u32::MAX` minus the index of the first of them; 0: none.
    pub first_non_finite: u32,
    /// Bits of the largest speed [m/s].
    pub speed_max: u32,
    /// Bits of the largest elongation [1].
    pub elongation_max: u32,
    /// Limits that are exceeded.
    pub over_long_count: u32,
    /// `u32::MAX` minus the index of the limit that is exceeded the most; 0: none.
    pub longest_limit: u32,
    /// Bits of the largest seam gap [m].
    pub seam_gap_max: u32,
    /// Kinetic energy [J].
    pub kinetic_energy: f32,
}
