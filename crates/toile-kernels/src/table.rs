//! The kernel table. The order of its rows is the algorithm.

use crate::import::resolve;

/// In which part of a run a kernel works.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// Whenever the maps are drawn anew: a body takes its next pose. Planned for a body, not for a cloth.
    Pose,
    /// Whenever the maps are drawn anew, once the bodies have their poses. Planned for maps, not for a cloth.
    Maps,
    /// Once per step.
    Step,
    /// Once per sweep: consecutive rows of this stage are repeated together as often as the settings say, so that limits, bodies and
    /// seams take turns.
    Sweep,
    /// In the first sweep of a step alone, among the rows of [`Stage::Sweep`] around it.
    FirstSweep,
    /// Once after the sweeps of a step, and after each further sweep of a polish.
    AfterSweeps,
    /// Before each further sweep of a polish and after the last: it repeats the rows of [`Stage::Sweep`] and [`Stage::AfterSweeps`]
    /// before it.
    Polish,
    /// Once per frame, after its steps.
    Frame,
    /// Once, when the open model becomes the sewn one.
    Handover,
    /// Between steps, when a body or the host sets something elsewhere.
    Between,
    /// Only when a run is measured.
    Measure,
}

/// What one invocation works on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Domain {
    /// A particle.
    Particle,
    /// A quad.
    Quad,
    /// A particle or a quad midpoint.
    Point,
    /// A hold; one workgroup each.
    Hold,
    /// A particle that the host holds or lets go.
    Pin,
    /// A limit.
    Limit,
    /// A limit; one dispatch per colour.
    LimitColour,
    /// A cluster of the cloth itself; one dispatch per colour and pass of the guard.
    GuardedCluster,
    /// A node of a level; one dispatch per level.
    LevelNode,
    /// A cluster of a level; one dispatch per colour and pass.
    LevelCluster,
    /// A seam pair.
    SeamPair,
    /// A seam pair; one dispatch per colour and pass.
    SeamColour,
    /// A vertex of a body.
    Vertex,
    /// A part of a triangle, once for each axis.
    TrianglePart,
    /// A column of the layered maps.
    Column,
    /// One workgroup in all.
    Workgroup,
}

/// What a scene must have for a kernel to be in its plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Need {
    /// Nothing.
    Nothing,
    /// A number of the step, by its name in [`StepParams`](crate::structs::StepParams), that is other than zero.
    Number(&'static str),
    /// Air around the cloth.
    Wind,
    /// Any body.
    Body,
    /// Mesh bodies at rest, in the papers' maps.
    StillSides,
    /// Mesh bodies that move, in the papers' maps.
    MovingSides,
    /// Mesh bodies at rest, in layered maps.
    StillLayers,
    /// Mesh bodies that move, in layered maps.
    MovingLayers,
    /// A body whose vertices follow joints.
    Joints,
    /// A body with morph targets.
    Morphs,
    /// A body that the host skins.
    Hosted,
    /// Analytic shapes.
    Shapes,
    /// Held edges.
    Holds,
    /// Open seams.
    Seams,
    /// Limits.
    Limits,
    /// Limits under the rule Zero.
    RuleZero,
    /// Limits under the rule Average.
    RuleAverage,
    /// Limits under the rule Directional.
    RuleDirectional,
    /// Limits under the rules Predictive and Hierarchical.
    Pulls,
    /// Limits under the rule Predictive.
    RulePredictive,
    /// Limits under the rule Position.
    RulePosition,
    /// Levels, under the rule Hierarchical.
    Levels,
    /// The same, and some of them small.
    SmallLevels,
    /// Limits of a cloth without open seams, under the rule Hierarchical.
    Guard,
    /// The same, and any body.
    GuardOnBody,
    /// Pins under the rule Hierarchical.
    Attachments,
    /// Limits under a predictive rule, with a polish.
    Polish,
}

/// One row of the kernel table.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Row {
    /// The kernel.
    pub kernel: Kernel,
    /// When it works.
    pub stage: Stage,
    /// What one invocation works on.
    pub domain: Domain,
    /// What the scene must have.
    pub need: Need,
    /// What its pipeline has otherwise than its WGSL says where a driver runs on the CPU.
    pub cpu_constants: &'static [(&'static str, f64)],
}

macro_rules! kernels {
    ($($(#[$doc:meta])* $kernel:ident $folder:literal $name:literal $stage:ident $domain:ident $need:ident $(($number:literal))? $([$($constant:literal = $value:literal),*])?;)*) => {
        /// A WGSL entry point.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Kernel {
            $($(#[$doc])* $kernel,)*
        }

        /// Every compute kernel, in the order in which a step, a frame and a handover run them.
        pub const TABLE: &[Row] = &[
            $(Row {
                kernel: Kernel::$kernel,
                stage: Stage::$stage,
                domain: Domain::$domain,
                need: Need::$need $(($number))?,
                cpu_constants: &[$($(($constant, $value)),*)?],
            },)*
        ];

        impl Kernel {
            /// Name of the entry point, of its WGSL file and of its reference.
            pub fn name(self) -> &'static str {
                match self {
                    $(Kernel::$kernel => $name,)*
                }
            }

            fn text(self) -> &'static str {
                match self {
                    $(Kernel::$kernel => include_str!(concat!("../wgsl/", $folder, "/", $name, ".wgsl")),)*
                }
            }
        }
    };
}

kernels! {
    /// Bind positions as the morph targets of a pose change them.
    MorphBody "maps" "morph_body" Pose Vertex Morphs;
    /// Vertices of a body follow their joints.
    SkinBody "maps" "skin_body" Pose Vertex Joints;
    /// Vertices of a body that the host skins.
    GatherBody "maps" "gather_body" Pose Vertex Hosted;
    /// Velocities of a moving surface. W §4.3.
    VertexVelocities "maps" "vertex_velocities" Pose Vertex Nothing;
    /// Where columns of the layered maps meet a surface at rest. D §8, W §7.
    DrawLayers "maps" "draw_layers" Maps TrianglePart StillLayers;
    /// The same of a moving surface. D §8, W §4.3, §7.
    DrawMovingLayers "maps" "draw_moving_layers" Maps TrianglePart MovingLayers;
    /// What each column of the layered maps meets, from low to high. D §8, W §7.
    SortLayers "maps" "sort_layers" Maps Column Nothing;
    /// Springs, gravity and damping. D eq. 2.
    SpringForces "step" "spring_forces" Step Particle Nothing;
    /// Drag and lift of each quad in the air. W §2.2.
    QuadWind "step" "quad_wind" Step Quad Wind;
    /// Each particle takes its share of the wind on its quads.
    WindForces "step" "wind_forces" Step Particle Wind;
    /// Each particle takes its share of the pressure on its quads.
    PressureForces "step" "pressure_forces" Step Particle Number("pressure");
    /// Reaction of the body to the pressing force. W eq. 16.
    Reaction "step" "reaction" Step Particle Body;
    /// Velocities from forces. W eq. 3.
    Euler "step" "euler" Step Particle Nothing;
    /// Particles begin with half of what limits gave them in the last step.
    WarmStart "step" "warm_start" Step Particle Pulls;
    /// Labelled edges keep their mean height while sewing.
    HoldEdges "step" "hold_edges" Step Hold Holds;
    /// Seams close at their speed, as far as cloth and bodies let them, which answer later in the sweep.
    DrawSeams "step" "draw_seams" Sweep SeamColour Seams;
    /// D §4.3.
    LimitZero "step" "limit_zero" Sweep LimitColour RuleZero;
    /// W eq. 5.
    LimitAverage "step" "limit_average" Sweep LimitColour RuleAverage;
    /// W §3.2, eq. 6.
    LimitDirectional "step" "limit_directional" Sweep LimitColour RuleDirectional;
    /// From pins outward, before the limits between neighbours.
    LimitAttachments "step" "limit_attachments" Sweep Particle Attachments;
    /// The default rule on all small levels, in one workgroup.
    LimitSmallLevels "step" "limit_small_levels" Sweep Workgroup SmallLevels ["LANES" = 8.0];
    /// Nodes of a level begin with what those of the coarser level have found. Rows by level take turns, the coarsest level first.
    LeadLevel "step" "lead_level" Sweep LevelNode Levels;
    /// The default rule between the nodes of a level.
    LimitLevel "step" "limit_level" Sweep LevelCluster Levels;
    /// The particles go where the limits have shifted them.
    ShiftVelocities "step" "shift_velocities" Sweep Particle Levels;
    /// The predictive rule on single springs.
    LimitPredictive "step" "limit_predictive" Sweep LimitColour RulePredictive;
    /// Points of the quads that are tested. D §6.
    QuadMidpoints "step" "quad_midpoints" Sweep Quad Body;
    /// What points see of bodies at rest in the papers' maps. W §4.4.
    SampleSides "step" "sample_sides" FirstSweep Point StillSides;
    /// What points see of moving bodies in the papers' maps. W §4.3, §4.4.
    SampleMovingSides "step" "sample_moving_sides" FirstSweep Point MovingSides;
    /// What points see of bodies at rest in the layered maps. D §8, W §7.
    SampleLayers "step" "sample_layers" FirstSweep Point StillLayers;
    /// What points see of moving bodies in the layered maps. D §8, W §4.3, §7.
    SampleMovingLayers "step" "sample_moving_layers" FirstSweep Point MovingLayers;
    /// What points see of the shapes.
    SampleShapes "step" "sample_shapes" FirstSweep Point Shapes;
    /// Each particle answers its own contact and those of its quads. D §6, W eq. 15.
    Collide "step" "collide" Sweep Particle Body;
    /// Seams close slowly whatever holds them open; last of all, so that one that a tight fit holds open closes all the same.
    CloseSeams "step" "close_seams" Sweep SeamColour Seams;
    /// No contact leaves a spring stretched far beyond its limit.
    LimitGuard "step" "limit_guard" AfterSweeps GuardedCluster Guard;
    /// Cloth gives way into its thickness for it, and no deeper.
    KeepOut "step" "keep_out" AfterSweeps Particle GuardOnBody;
    /// Whether the coming move would stretch a spring beyond the target of a polish.
    MeasureExcess "step" "measure_excess" Polish Limit Polish;
    /// Further sweeps while it would, at most so many.
    GrantSweep "step" "grant_sweep" Polish Workgroup Polish;
    /// Positions move last. W eq. 3.
    MoveParticles "step" "move_particles" Step Particle Nothing;
    /// Provot's rule, after the move. W §3.1.
    LimitPosition "step" "limit_position" Sweep LimitColour RulePosition;
    /// Normals for renderers and later maps.
    ParticleNormals "frame" "particle_normals" Frame Particle Nothing;
    /// Non-finite particles, speed, energy of each workgroup.
    ParticleStatus "frame" "particle_status" Frame Particle Nothing;
    /// Kinetic energy.
    TotalEnergy "frame" "total_energy" Frame Workgroup Nothing;
    /// Elongation.
    LimitStatus "frame" "limit_status" Frame Limit Limits;
    /// Where it is largest.
    LongestLimit "frame" "longest_limit" Frame Limit Limits;
    /// Seam gap.
    SeamStatus "frame" "seam_status" Frame SeamPair Seams;
    /// From the open to the sewn model.
    MergeParticles "frame" "merge_particles" Handover Particle Nothing;
    /// The cloth goes along with a body that jumps.
    CarryParticles "frame" "carry_particles" Between Particle Nothing;
    /// Particles that the host holds, moves and lets go.
    SetPins "frame" "set_pins" Between Pin Nothing;
    /// The unit of cost.
    StateCopy "frame" "state_copy" Measure Particle Nothing;
}

impl Kernel {
    /// Its row in the table.
    pub fn row(self) -> &'static Row {
        // The rows stand in the order of the kernels, which one macro writes.
        &TABLE[self as usize]
    }

    /// The whole WGSL of the kernel, imports resolved.
    pub fn source(self) -> String {
        resolve(self.text())
    }
}

/// The WGSL of the render pass that draws the papers' maps: vertex entry `draw_surface` and fragment entry `write_normal` for bodies at
/// rest, `draw_moving_surface` and `write_normal_and_velocity` for those that move.
pub fn render_sides_source() -> String {
    resolve(include_str!("../wgsl/maps/render_sides.wgsl"))
}
