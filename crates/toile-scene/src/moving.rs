//! Meshes that move: skinned, rigid, or given frame by frame.

use crate::{Influence, Mesh, Rig, RigidKey, Skin};
use glam::{DVec3, Vec3};

/// A mesh that moves.
#[derive(Clone, Debug)]
pub struct MovingMesh {
    /// The mesh as it stands at time 0 [m].
    pub mesh: Mesh,
    /// How it moves.
    pub motion: Motion,
}

/// How a mesh moves.
#[derive(Clone, Debug)]
pub enum Motion {
    /// Its vertices follow joints.
    Skinned {
        /// How the vertices hang on the joints.
        skin: Skin,
        /// How the joints move.
        rig: Rig,
    },
    /// Its vertices are given at even times.
    Sequence(MeshSequence),
}

/// Vertices at even times, linear in between; before the first and after the last frame they stand still.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshSequence {
    /// Frames per second [1/s].
    pub frame_rate: f64,
    /// Positions [m] and unit normals of each frame, each of shape [vertex_count]; at least one frame.
    pub frames: Vec<[Vec<Vec3>; 2]>,
}

impl MovingMesh {
    /// A rigid body that goes from key to key.
    ///
    /// # Panics
    /// When there is no key.
    pub fn rigid(mesh: &Mesh, keys: &[RigidKey]) -> Self {
        let vertex_count = mesh.positions.len() as u32;
        let skin = Skin {
            positions: mesh.positions.clone(),
            normals: mesh.normals.clone(),
            influence_offsets: (0..=vertex_count).collect(),
            influences: vec![Influence { joint: 0, weight: 1.0 }; mesh.positions.len()],
            morphs: None,
        };
        let motion = Motion::Skinned { skin, rig: Rig::rigid(keys) };
        let mut body = Self { mesh: mesh.clone(), motion };
        body.mesh = body.at(0.0);
        body
    }

    /// The mesh at a time [s], computed in f64.
    pub fn at(&self, time: f64) -> Mesh {
        let [positions, normals] = match &self.motion {
            Motion::Sequence(sequence) => sequence.at(time),
            Motion::Skinned { skin, rig } => skinned(skin, rig, time),
        };
        Mesh { positions, normals, triangles: self.mesh.triangles.clone() }
    }

    /// End of the motion [s].
    pub fn duration(&self) -> f64 {
        match &self.motion {
            Motion::Skinned { rig, .. } => rig.duration,
            Motion::Sequence(sequence) => (sequence.frames.len() - 1) as f64 / sequence.frame_rate,
        }
    }

    /// Whether the motion ends as it begins, so that it repeats.
    pub fn is_closed(&self) -> bool {
        match &self.motion {
            Motion::Skinned { rig, .. } => rig.is_closed(),
            Motion::Sequence(_) => false,
        }
    }

    /// Smallest and largest corner of the body at each of some times [m]. It places every vertex: for set-up, not for a frame.
    pub fn bounds(&self, times: impl IntoIterator<Item = f64>) -> Vec<[Vec3; 2]> {
        let bounds = |time| {
            let [positions, _] = match &self.motion {
                Motion::Sequence(sequence) => sequence.at(time),
                Motion::Skinned { skin, rig } => skinned(skin, rig, time),
            };
            let start = [Vec3::INFINITY, Vec3::NEG_INFINITY];
            positions.iter().fold(start, |[low, high], p| [low.min(*p), high.max(*p)])
        };
        times.into_iter().map(bounds).collect()
    }
}

impl MeshSequence {
    /// Positions [m] and unit normals at a time [s].
    ///
    /// # Panics
    /// When there is no frame.
    pub fn at(&self, time: f64) -> [Vec<Vec3>; 2] {
        let place = (time * self.frame_rate).clamp(0.0, (self.frames.len() - 1) as f64);
        let first = place.floor() as usize;
        let share = (place - place.floor()) as f32;
        let [a, b] = [&self.frames[first], &self.frames[(first + 1).min(self.frames.len() - 1)]];
        let between = |values: usize| a[values].iter().zip(&b[values]).map(move |(a, b)| a.lerp(*b, share));
        [between(0).collect(), between(1).map(|normal| normal.normalize_or(Vec3::Y)).collect()]
    }
}

fn skinned(skin: &Skin, rig: &Rig, time: f64) -> [Vec<Vec3>; 2] {
    let pose = rig.pose(time);
    let mut posed = [Vec::with_capacity(skin.positions.len()), Vec::with_capacity(skin.positions.len())];
    for vertex in 0..skin.positions.len() {
        let mut position = skin.positions[vertex].as_dvec3();
        let mut normal = skin.normals[vertex].as_dvec3();
        if let Some(morphs) = &skin.morphs {
            let range = morphs.offsets[vertex] as usize..morphs.offsets[vertex + 1] as usize;
            for displacement in &morphs.displacements[range] {
                let weight = f64::from(pose.morph_weights[displacement.target as usize]);
                position += displacement.position.as_dvec3() * weight;
                normal += displacement.normal.as_dvec3() * weight;
            }
        }
        let range = skin.influence_offsets[vertex] as usize..skin.influence_offsets[vertex + 1] as usize;
        let mut rows = [glam::DVec4::ZERO; 3];
        for influence in &skin.influences[range] {
            for (row, of_joint) in rows.iter_mut().zip(pose.joints[influence.joint as usize]) {
                *row += of_joint.as_dvec4() * f64::from(influence.weight);
            }
        }
        let [x, y, z] = rows.map(glam::DVec4::truncate);
        posed[0].push(DVec3::from_array(rows.map(|row| row.truncate().dot(position) + row.w)).as_vec3());
        let turned = DVec3::new(y.cross(z).dot(normal), z.cross(x).dot(normal), x.cross(y).dot(normal));
        posed[1].push(turned.normalize_or(DVec3::Y).as_vec3());
    }
    posed
}
