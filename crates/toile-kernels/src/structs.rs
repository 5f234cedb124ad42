//! The structs that Rust and WGSL share: each is written once, here. encase lays out the Rust, a compiler of WGSL the text that kernels
//! import as `#import struct/Name`; a test compares both.

use encase::ShaderType;
use glam::{Vec3, Vec4};

/// What a word of the list below is in Rust.
macro_rules! rust_type {
    (f32) => {
        f32
    };
    (u32) => {
        u32
    };
    (vec3) => {
        Vec3
    };
    (vec4) => {
        Vec4
    };
    (atomic_u32) => {
        u32
    };
}

/// What it is in WGSL.
macro_rules! wgsl_type {
    (f32) => {
        "f32"
    };
    (u32) => {
        "u32"
    };
    (vec3) => {
        "vec3<f32>"
    };
    (vec4) => {
        "vec4<f32>"
    };
    (atomic_u32) => {
        "atomic<u32>"
    };
}

macro_rules! shared_structs {
    ($($(#[doc = $doc:literal])+ $name:ident { $($(#[doc = $field_doc:literal])+ $field:ident: $kind:ident,)+ })+) => {
        $(
            $(#[doc = $doc])+
            #[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
            pub struct $name {
                $($(#[doc = $field_doc])+ pub $field: rust_type!($kind),)+
            }

            impl $name {
                /// Whether the field of a name is other than zero.
                ///
                /// # Panics
                /// When there is none of that name.
                pub fn has(&self, name: &str) -> bool {
                    let zero = Self::default();
                    match name {
                        $(stringify!($field) => self.$field != zero.$field,)+
                        _ => panic!("{} has no field {name}", stringify!($name)),
                    }
                }
            }
        )+

        /// Name for the import and WGSL of each.
        pub(crate) const WGSL: &[(&str, &str)] = &[$((
            concat!("struct/", stringify!($name)),
            concat!(
                $("//", $doc, "\n",)+
                "struct ", stringify!($name), " {\n",
                $($("    //", $field_doc, "\n",)+ "    ", stringify!($field), ": ", wgsl_type!($kind), ",\n",)+
                "}\n",
            ),
        )),+];
    };
}

shared_structs! {
    /// The numbers of one step, the same for every particle.
    StepParams {
        /// Gravity [m/s²].
        gravity: vec3,
        /// Time step [s].
        dt: f32,
        /// Viscous damping rate [1/s].
        damping: f32,
        /// Largest speed on the way out of a body [m/s].
        push_speed: f32,
        /// Largest change of normal speed that friction counts [m/s].
        pressing_speed: f32,
        /// A point nearer than this is in contact [m].
        contact_margin: f32,
        /// C_refl of W eq. 15 [1].
        reflection: f32,
        /// 0 Coulomb, 1 the papers'.
        friction_law: u32,
        /// Coulomb's coefficient [1].
        friction: f32,
        /// C_fric of W eq. 15 [1].
        velocity_kept: f32,
        /// C_fric of W eq. 16 [1].
        force_removed: f32,
        /// Speed of a held edge towards its height, per metre from it [1/s].
        hold_rate: f32,
        /// Largest speed of a held edge towards its height [m/s].
        hold_speed: f32,
        /// Number of particles.
        particle_count: u32,
        /// Number of quads.
        quad_count: u32,
        /// 1: the whole way of a point is tested against the bodies.
        swept: u32,
        /// Velocity of the air [m/s].
        wind: vec3,
        /// Drag coefficient of a plate across the wind [1].
        drag: f32,
        /// Lift coefficient [1].
        lift: f32,
        /// How much more the air presses on the inside of the cloth than on its outside [Pa].
        pressure: f32,
        /// Distance kept from the bodies [m].
        thickness: f32,
        /// How much the guard shortens a spring at once [m].
        guard_way: f32,
        /// Part of the threshold that the limits hold [1].
        aim: f32,
        /// Number of structural and shear springs, whose limits are the first.
        limit_count: u32,
        /// 1: the probes already hold what the points see in the maps when the shapes are sampled.
        after_maps: u32,
    }

    /// The part of an array that one dispatch works on.
    Span {
        /// First item.
        first: u32,
        /// Number of items.
        count: u32,
        /// Part of an excess that a pass of the guard removes [1]; no other kernel reads it.
        share: f32,
    }

    /// Rest length and stiffness of a link.
    LinkSpring {
        /// Rest length [m].
        rest_length: f32,
        /// Stiffness [N/m].
        stiffness: f32,
    }

    /// A unilateral maximum length.
    Limit {
        /// One particle.
        first: u32,
        /// The other.
        second: u32,
        /// Rest length [m].
        rest_length: f32,
        /// Maximum length [m].
        max_length: f32,
    }

    /// A particle, or a coarse particle.
    Node {
        /// The particle of the cloth where it is.
        site: u32,
        /// Of a coarse particle the inverse of the mass that it carries [1/kg].
        inverse_mass: f32,
        /// Its leaders.
        first_leader: u32,
        /// After them.
        end_leader: u32,
    }

    /// Up to four nodes, and the maximum length between each two [m].
    Cluster {
        /// A node.
        a: u32,
        /// A node.
        b: u32,
        /// A node, or none.
        c: u32,
        /// A node, or none.
        d: u32,
        /// Between a and b.
        ab: f32,
        /// Between c and d.
        cd: f32,
        /// Between a and c.
        ac: f32,
        /// Between b and d.
        bd: f32,
        /// Between a and d.
        ad: f32,
        /// Between b and c.
        bc: f32,
    }

    /// What the workgroup of the small levels does between two barriers: nodes begin, or a colour of clusters is held.
    SmallTurn {
        /// Nodes that begin.
        first_node: u32,
        /// After them.
        end_node: u32,
        /// Clusters that are held.
        first_cluster: u32,
        /// After them.
        end_cluster: u32,
        /// How much more than its excess a limit takes [1].
        relaxation: f32,
    }

    /// A node that leads another.
    Leader {
        /// The node.
        node: u32,
        /// Part that it has in what the other is moved by [1].
        part: f32,
    }

    /// A maximum distance of a particle from a pin.
    Attachment {
        /// The pinned particle.
        pin: u32,
        /// Maximum distance [m].
        max_length: f32,
    }

    /// Two particles that a seam pulls together.
    SeamPair {
        /// One particle.
        first: u32,
        /// The other.
        second: u32,
        /// Closing speed [m/s].
        closing_speed: f32,
    }

    /// The edges of one label, held at their mean height.
    Hold {
        /// Where its particles begin among the held particles.
        first: u32,
        /// Number of its particles.
        count: u32,
        /// Their mean height [m].
        height: f32,
    }

    /// Mean of the corners of a quad.
    Midpoint {
        /// Position [m].
        position: vec3,
        /// Velocity [m/s].
        velocity: vec3,
    }

    /// What a point sees of the bodies.
    Probe {
        /// Unit normal out of the body.
        normal: vec3,
        /// Distance to the surface, negative inside [m].
        distance: f32,
        /// Velocity of the surface [m/s].
        velocity: vec3,
        /// 1 near enough to matter, 0 not.
        hit: f32,
    }

    /// What a particle touched.
    Contact {
        /// Unit normal out of the body.
        normal: vec3,
        /// 1 in contact, 0 not.
        touching: f32,
        /// Velocity of the body at the contact [m/s].
        velocity: vec3,
        /// Fills the last word.
        padding: f32,
    }

    /// Where the two map cameras stand.
    SideBox {
        /// Left edge [m].
        origin_x: f32,
        /// Top edge [m].
        origin_y: f32,
        /// Edge length of a texel [m].
        texel: f32,
        /// Plane of the front camera [m].
        z_front: f32,
        /// Plane of the back camera [m].
        z_back: f32,
        /// Texels along x.
        columns: u32,
        /// Texels along y.
        rows: u32,
    }

    /// Which camera draws, and how far the surface is offset.
    Side {
        /// 0 front, 1 back.
        side: u32,
        /// Offset along the normals [m].
        thickness: f32,
    }

    /// Where the layered maps stand.
    LayerBox {
        /// Smallest corner from the origin of the world; whole numbers [texel].
        low: vec3,
        /// Edge length of a texel [m].
        texel: f32,
        /// Texels along x.
        size_x: u32,
        /// Texels along y.
        size_y: u32,
        /// Texels along z.
        size_z: u32,
        /// 1 / texel [1/m].
        texels_per_metre: f32,
        /// Columns of all three maps.
        column_count: u32,
    }

    /// A surface that is drawn into the layered maps.
    Drawn {
        /// Parts of its triangles.
        part_count: u32,
        /// How many triangles were drawn before.
        first_triangle: u32,
        /// 1: it is open by what it is, as a garment.
        is_open: u32,
    }

    /// Where a column meets a triangle.
    Crossing {
        /// Along the axis [m].
        depth: f32,
        /// Which triangle of all that are drawn.
        triangle: u32,
        /// Whether it begins a body, and whether it belongs to an open surface: bits.
        kind: u32,
        /// The next of the column: one more than its place, 0 at the end.
        next: u32,
    }

    /// What the layered maps hold, and what did not fit.
    LayerCounts {
        /// Crossings.
        crossing_count: atomic_u32,
        /// Layers.
        layer_count: atomic_u32,
        /// Triangles with a vertex too far away or without a place.
        dropped_triangles: atomic_u32,
        /// Columns with more crossings than can be told apart.
        crowded_columns: atomic_u32,
    }

    /// An analytic shape at the start of a step, going straight on to its end.
    Shape {
        /// Centre [m].
        centre: vec3,
        /// Radius with the thickness of the cloth [m].
        radius: f32,
        /// Velocity [m/s].
        velocity: vec3,
        /// What it is: the number of a `ShapeKind` of the model.
        kind: u32,
        /// Angular velocity [rad/s].
        spin: vec3,
        /// Of a capsule from its centre to an end [m], of a plane its normal, of a box half of its extents without the rounding [m]; zero of a sphere.
        axis: vec3,
        /// First axis of a box.
        right: vec3,
        /// Second axis of a box.
        up: vec3,
    }

    /// How long before the time of the maps a step begins and ends.
    Lag {
        /// From the start of the step [s].
        start: f32,
        /// From its end [s].
        end: f32,
    }

    /// The vertices of a body.
    Vertices {
        /// Number of vertices.
        count: u32,
        /// 1 / time since the last pose, 0 when there was none [1/s].
        rate: f32,
    }

    /// Where the vertices of a body lie in buffers of the host, in words.
    Gather {
        /// Number of vertices.
        count: u32,
        /// First word of the first position.
        first_position: u32,
        /// Words from one position to the next.
        position_stride: u32,
        /// First word of the first normal.
        first_normal: u32,
        /// Words from one normal to the next.
        normal_stride: u32,
        /// First word of the first velocity, or of the first position before.
        first_motion: u32,
        /// Words from one of these to the next.
        motion_stride: u32,
        /// 1: motions are the positions before, not velocities.
        is_last: u32,
        /// How far ahead the vertices go: by velocities in seconds, by positions before in ways from these [s or 1].
        ahead: f32,
    }

    /// What one morph target does to one vertex.
    Displacement {
        /// Displacement of the bind position.
        position: vec3,
        /// Which target.
        morph: u32,
        /// Change of the bind normal.
        normal: vec3,
    }

    /// The share that a joint has in a vertex.
    Influence {
        /// Which joint.
        joint: u32,
        /// Share [1].
        weight: f32,
    }

    /// First three rows of the matrix of a joint, from bind space to the world.
    Joint {
        /// Row of x.
        row_x: vec4,
        /// Row of y.
        row_y: vec4,
        /// Row of z.
        row_z: vec4,
    }

    /// First three rows of the rigid transform that carries a cloth along with a body that jumps.
    Carry {
        /// Row of x.
        row_x: vec4,
        /// Row of y.
        row_y: vec4,
        /// Row of z.
        row_z: vec4,
    }

    /// A particle that the host holds or lets go.
    PinTarget {
        /// Where it is wanted [m].
        position: vec3,
        /// The particle.
        particle: u32,
        /// One by the time that it has for its way [1/s].
        rate: f32,
        /// 1: it is held; 0: it is free from now on.
        is_held: u32,
    }

    /// Further sweeps in the steps that need them.
    Polish {
        /// Elongation that needs no further sweep [1].
        target_elongation: f32,
        /// At most so many further sweeps in a step.
        sweeps: u32,
    }

    /// What a polish knows: the first two words are those of the present step, the others count from the start.
    PolishState {
        /// Bits of the largest elongation above the target [1]; 0: none.
        elongation_max: atomic_u32,
        /// Further sweeps of the present step.
        granted: u32,
        /// Further sweeps so far.
        further_sweeps: u32,
        /// Steps so far that ended above the target.
        missed_steps: u32,
    }

    /// What a frame reports. Cleared to zero before the status kernels run. Positive floats keep their order as bits, so that integer atomics
    /// find the largest, whatever the order of the invocations.
    Status {
        /// Particles that are not finite.
        non_finite_count: atomic_u32,
        /// 0xffffffff minus the index of the first of them, so that the largest is the first; 0: none.
        first_non_finite: atomic_u32,
        /// Bits of the largest speed [m/s].
        speed_max: atomic_u32,
        /// Bits of the largest elongation [1].
        elongation_max: atomic_u32,
        /// Limits that are exceeded.
        over_long_count: atomic_u32,
        /// 0xffffffff minus the index of the limit that is exceeded the most; 0: none.
        longest_limit: atomic_u32,
        /// Bits of the largest seam gap [m].
        seam_gap_max: atomic_u32,
        /// Kinetic energy [J].
        kinetic_energy: f32,
    }
}
