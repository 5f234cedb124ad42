//! What the kernels read, as bytes on the device: each type of the model has its encoding here, once.

use crate::step_params::{Counts, step_params};
use encase::{ShaderType, StorageBuffer, UniformBuffer, internal::WriteInto};
use glam::{Vec3, Vec4};
use toile_kernels::structs;
use toile_model::{
    Arrays, Attachment, Cluster, Hold, Leader, Limit, Link, MapBox, PinTarget, SeamPair, ShapeStep, SideBox,
    StepSettings,
};
use toile_scene::{Displacement, Influence, Polish};

/// Bytes of the buffer of a name that a model and the settings of its step decide; `None` for the others. `after_maps` when shapes are
/// sampled after maps.
pub fn constant(name: &str, model: &Arrays, settings: &StepSettings, after_maps: bool) -> Option<Vec<u8>> {
    Some(match name {
        "step" => uniform(&step_params(Counts::of(model), settings, after_maps)),
        "polish" => {
            let Polish { target, sweeps } = settings.polish?;
            uniform(&structs::Polish { target_elongation: target as f32, sweeps })
        }
        "positions" => with_w(&model.positions, &model.inverse_masses),
        "velocities" => with_w(&vec![Vec3::ZERO; model.masses.len()], &model.masses),
        "link_offsets" => words(&model.links.offsets),
        "link_others" => words(&model.links.values.iter().map(|link| link.other).collect::<Vec<_>>()),
        "link_springs" => encoded(&model.links.values),
        "limits" => encoded(&model.limits),
        "nodes" => nodes(model),
        "clusters" => encoded(&model.clusters),
        "guard_lengths" => bytemuck::cast_slice(&model.guard_lengths).to_vec(),
        "small_turns" => small_turns(model, settings),
        "leaders" => encoded(&model.leaders.values),
        "attachment_offsets" => words(&model.attachments.offsets),
        "attachments" => encoded(&model.attachments.values),
        "seam_pairs" => encoded(&model.seam_pairs),
        "holds" => encoded(&model.holds),
        "held_particles" => words(&model.held_particles),
        "quads" => bytemuck::cast_slice(&model.quads).to_vec(),
        "particle_quad_offsets" => words(&model.particle_quads.offsets),
        "particle_quads" => words(&model.particle_quads.values),
        _ => return None,
    })
}

/// Something that the kernels read, and the struct that they have for it.
pub trait Encode {
    /// The struct.
    type Struct: ShaderType + WriteInto;

    /// The same as the struct.
    fn encode(&self) -> Self::Struct;
}

fn nodes(model: &Arrays) -> Vec<u8> {
    array((0..model.leaders.row_count()).map(|node| structs::Node {
        site: model.site(node as u32),
        inverse_mass: match node.checked_sub(model.positions.len()) {
            Some(coarse) => model.coarse_particles[coarse].inverse_mass,
            None => model.inverse_masses[node],
        },
        first_leader: model.leaders.offsets[node],
        end_leader: model.leaders.offsets[node + 1],
    }))
}

/// The turns of the small levels, from the coarsest on: the nodes of a level begin, then its colours are held.
fn small_turns(model: &Arrays, settings: &StepSettings) -> Vec<u8> {
    let mut turns = Vec::new();
    let none = structs::SmallTurn { first_node: 0, end_node: 0, first_cluster: 0, end_cluster: 0, relaxation: 0.0 };
    for level in model.levels.iter().rev().filter(|level| level.is_small()) {
        let relaxation = StepSettings::relaxation(level);
        turns.push(structs::SmallTurn { first_node: level.nodes.start, end_node: level.nodes.end, ..none });
        turns.extend((0..settings.level_passes(level)).flat_map(|_| &level.colours).map(|colour| structs::SmallTurn {
            first_cluster: colour.start,
            end_cluster: colour.end,
            relaxation,
            ..none
        }));
    }
    array(turns.into_iter())
}

/// Structs as a storage buffer holds them.
pub fn array<T>(items: impl Iterator<Item = T>) -> Vec<u8>
where
    Vec<T>: ShaderType + WriteInto,
{
    let mut buffer = StorageBuffer::new(Vec::new());
    buffer.write(&items.collect::<Vec<_>>()).expect("a vector grows to what is written");
    buffer.into_inner()
}

/// Items as a storage buffer holds them.
pub fn encoded<T: Encode>(items: &[T]) -> Vec<u8>
where
    Vec<T::Struct>: ShaderType + WriteInto,
{
    array(items.iter().map(Encode::encode))
}

/// A struct as a uniform buffer holds it.
pub fn uniform<T: ShaderType + WriteInto>(value: &T) -> Vec<u8> {
    let mut buffer = UniformBuffer::new(Vec::new());
    buffer.write(value).expect("a vector grows to what is written");
    buffer.into_inner()
}

/// Vectors, each with its fourth word.
pub fn with_w(xyz: &[Vec3], w: &[f32]) -> Vec<u8> {
    let packed: Vec<Vec4> = xyz.iter().zip(w).map(|(xyz, w)| xyz.extend(*w)).collect();
    bytemuck::cast_slice(&packed).to_vec()
}

/// Words, one after the other.
pub fn words(values: &[u32]) -> Vec<u8> {
    bytemuck::cast_slice(values).to_vec()
}

/// Floats, one after the other.
pub fn floats(values: &[f32]) -> Vec<u8> {
    bytemuck::cast_slice(values).to_vec()
}

/// How long before the time of the maps a step begins and ends after which `left` more follow.
pub(crate) fn lag(left: u32, settings: &StepSettings) -> Vec<u8> {
    let after = |steps: u32| steps as f32 * settings.dt;
    uniform(&structs::Lag { start: after(left + 1), end: after(left) })
}

macro_rules! encode {
    ($(|$of:ident: $item:ident| $name:ident $fields:tt)*) => {
        $(impl Encode for $item {
            type Struct = structs::$name;

            fn encode(&self) -> structs::$name {
                let $of = self;
                structs::$name $fields
            }
        })*
    };
}

encode! {
    |link: Link| LinkSpring { rest_length: link.rest_length, stiffness: link.stiffness }
    |limit: Limit| Limit {
        first: limit.ends[0],
        second: limit.ends[1],
        rest_length: limit.rest_length,
        max_length: limit.max_length,
    }
    |cluster: Cluster| Cluster {
        a: cluster.nodes[0],
        b: cluster.nodes[1],
        c: cluster.nodes[2],
        d: cluster.nodes[3],
        ab: cluster.max_lengths[0],
        cd: cluster.max_lengths[1],
        ac: cluster.max_lengths[2],
        bd: cluster.max_lengths[3],
        ad: cluster.max_lengths[4],
        bc: cluster.max_lengths[5],
    }
    |leader: Leader| Leader { node: leader.node, part: leader.part }
    |attachment: Attachment| Attachment { pin: attachment.pin, max_length: attachment.max_length }
    |pair: SeamPair| SeamPair { first: pair.ends[0], second: pair.ends[1], closing_speed: pair.closing_speed }
    |hold: Hold| Hold {
        first: hold.particles.start,
        count: hold.particles.end - hold.particles.start,
        height: hold.height,
    }
    |shape: ShapeStep| Shape {
        centre: shape.centre,
        radius: shape.radius,
        velocity: shape.velocity,
        kind: shape.kind as u32,
        spin: shape.spin,
        axis: shape.axis,
        right: shape.turn[0],
        up: shape.turn[1],
    }
    |side_box: SideBox| SideBox {
        origin_x: side_box.origin_x,
        origin_y: side_box.origin_y,
        texel: side_box.texel,
        z_front: side_box.z_front,
        z_back: side_box.z_back,
        columns: side_box.columns,
        rows: side_box.rows,
    }
    |map_box: MapBox| LayerBox {
        low: Vec3::from(map_box.low.map(|first| first as f32)),
        texel: map_box.texel,
        size_x: map_box.size[0],
        size_y: map_box.size[1],
        size_z: map_box.size[2],
        texels_per_metre: 1.0 / map_box.texel,
        column_count: map_box.texel_counts().iter().sum::<u64>() as u32,
    }
    |pin: PinTarget| PinTarget {
        position: pin.position,
        particle: pin.particle,
        rate: pin.rate,
        is_held: u32::from(pin.is_held),
    }
    |influence: Influence| Influence { joint: influence.joint, weight: influence.weight }
    |displacement: Displacement| Displacement {
        position: displacement.position,
        morph: displacement.target,
        normal: displacement.normal,
    }
}
