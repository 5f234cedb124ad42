//! A mesh that bends with joints.

use crate::Mesh;
use glam::{DMat4, DVec3, Vec3, Vec4};

/// How the vertices of a mesh hang on joints. A rigid body is a skin with one joint.
///
/// A vertex stands at Σ weight·(joint matrix)·(bind position), after the morph targets have moved its bind position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// Bind positions, in the unit of the file, shape [vertex_count].
    pub positions: Vec<Vec3>,
    /// Bind normals, shape [vertex_count]; of unit length where no morph target turns them.
    pub normals: Vec<Vec3>,
    /// Where the influences of each vertex begin, shape [vertex_count + 1].
    pub influence_offsets: Vec<u32>,
    /// Influences of all vertices, one vertex after the other; the weights of a vertex sum to 1.
    pub influences: Vec<Influence>,
    /// Morph targets; `None` without any.
    pub morphs: Option<Morphs>,
}

/// The share that a joint has in a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Influence {
    /// Index into [`Pose::joints`].
    pub joint: u32,
    /// Share [1], 0 to 1.
    pub weight: f32,
}

/// Displacements of bind positions and normals that a pose mixes in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Morphs {
    /// Where the displacements of each vertex begin, shape [vertex_count + 1].
    pub offsets: Vec<u32>,
    /// Displacements of all vertices, one vertex after the other.
    pub displacements: Vec<Displacement>,
}

/// What one morph target does to one vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Displacement {
    /// Index into [`Pose::morph_weights`].
    pub target: u32,
    /// Displacement of the bind position, in the unit of the file.
    pub position: Vec3,
    /// Change of the bind normal.
    pub normal: Vec3,
}

/// Where the joints stand at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// From bind space to the world [m]: the first three rows of each joint's matrix, shape [joint_count].
    pub joints: Vec<[Vec4; 3]>,
    /// Weight of each morph target, shape [target_count].
    pub morph_weights: Vec<f32>,
}

impl Skin {
    /// The skin of a rigid mesh: every vertex hangs on joint 0, and bind space is where the mesh stands.
    pub fn rigid(mesh: &Mesh) -> Self {
        let count = mesh.positions.len();
        Self {
            positions: mesh.positions.clone(),
            normals: mesh.normals.clone(),
            influence_offsets: (0..=count as u32).collect(),
            influences: vec![Influence { joint: 0, weight: 1.0 }; count],
            morphs: None,
        }
    }

    /// Influences of a vertex.
    pub fn influences_of(&self, vertex: usize) -> &[Influence] {
        let [start, end] = [self.influence_offsets[vertex], self.influence_offsets[vertex + 1]];
        &self.influences[start as usize..end as usize]
    }

    /// Displacements of a vertex by morph targets.
    pub fn displacements_of(&self, vertex: usize) -> &[Displacement] {
        self.morphs.as_ref().map_or(&[], |morphs| {
            &morphs.displacements[morphs.offsets[vertex] as usize..morphs.offsets[vertex + 1] as usize]
        })
    }

    /// From bind space to the world for a vertex: the mean of its joints' matrices by weight.
    pub fn blended(&self, vertex: usize, joints: &[DMat4]) -> DMat4 {
        let shares = self.influences_of(vertex).iter();
        shares.fold(DMat4::ZERO, |sum, share| sum + joints[share.joint as usize] * f64::from(share.weight))
    }

    /// Bind position and bind normal of a vertex after the morph targets.
    pub fn morphed(&self, vertex: usize, morph_weights: &[f64]) -> [DVec3; 2] {
        let start = [self.positions[vertex], self.normals[vertex]].map(|v| v.as_dvec3());
        self.displacements_of(vertex).iter().fold(start, |[position, normal], displacement| {
            let weight = morph_weights[displacement.target as usize];
            [position + displacement.position.as_dvec3() * weight, normal + displacement.normal.as_dvec3() * weight]
        })
    }

    /// Positions [m] and unit normals of all vertices, for joint matrices from bind space to the world [m] and weights of the
    /// morph targets [1]; computed in f64. A normal that the joints flatten becomes +y, so that none is ever zero.
    pub fn posed(&self, joints: &[DMat4], morph_weights: &[f64]) -> [Vec<Vec3>; 2] {
        let vertex = |vertex: usize| {
            let matrix = self.blended(vertex, joints);
            let [position, normal] = self.morphed(vertex, morph_weights);
            let normal = turned_normal(matrix, normal).normalize_or(DVec3::Y);
            (matrix.transform_point3(position).as_vec3(), normal.as_vec3())
        };
        let (positions, normals) = (0..self.positions.len()).map(vertex).unzip();
        [positions, normals]
    }
}

/// A unit normal under a linear map that need not keep angles; zero where the map flattens it. The cofactors stand for the
/// inverse transpose, which a flattened limb would not have.
pub fn turned_normal(matrix: DMat4, normal: DVec3) -> DVec3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
    let turned = y.cross(z) * normal.x + z.cross(x) * normal.y + x.cross(y) * normal.z;
    turned.normalize_or_zero()
}

/// The unit normal that [`turned_normal`] turns into this one; +y where the map flattens every normal.
pub fn normal_before(matrix: DMat4, turned: DVec3) -> DVec3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
    let back = |[x, y, z]: [DVec3; 3]| DVec3::new(x.dot(turned), y.dot(turned), z.dot(turned)).try_normalize();
    let mirrored = x.dot(y.cross(z)) < 0.0;
    let sign = if mirrored { -1.0 } else { 1.0 };
    let exact =
        back([x, y, z].map(|axis| axis * sign)).filter(|normal| turned_normal(matrix, *normal).dot(turned) > 0.0);
    // A flat map has no inverse; its cofactors still tell which side is which.
    exact.or_else(|| back([y.cross(z), z.cross(x), x.cross(y)])).unwrap_or(DVec3::Y)
}

#[cfg(test)]
mod tests {
    use super::{Displacement, Influence, Morphs, Skin, normal_before, turned_normal};
    use glam::{DMat4, DQuat, DVec3, Vec3, dvec3, vec3};

    #[test]
    fn a_normal_stays_perpendicular_and_comes_back() {
        let rotation = DQuat::from_axis_angle(dvec3(0.6, 0.0, 0.8), 1.3);
        let normal = dvec3(2.0, 3.0, 6.0) / 7.0;
        let along = normal.any_orthonormal_vector();
        for scale in [dvec3(1.0, 3.0, 0.2), dvec3(-2.0, 1.0, 1.0)] {
            let matrix = DMat4::from_scale_rotation_translation(scale, rotation, DVec3::ONE);
            let turned = turned_normal(matrix, normal);
            assert!(turned.dot(matrix.transform_vector3(along)).abs() < 1e-12);
            assert!(normal_before(matrix, turned).distance(normal) < 1e-12, "{scale}");
        }
        // Flattened along x, only the x part of a normal is left.
        let flat = DMat4::from_scale_rotation_translation(dvec3(0.0, 1.0, 1.0), rotation, DVec3::ZERO);
        let turned = turned_normal(flat, normal);
        let before = normal_before(flat, turned);
        assert!(before.is_normalized() && turned_normal(flat, before).distance(turned) < 1e-12);
        assert_eq!(normal_before(DMat4::ZERO, DVec3::Z), DVec3::Y);
    }

    /// One vertex half way between two joints, with two morph targets.
    fn skin() -> Skin {
        let displace = |target, position| Displacement { target, position, normal: Vec3::ZERO };
        Skin {
            positions: vec![Vec3::X],
            normals: vec![Vec3::Y],
            influence_offsets: vec![0, 2],
            influences: vec![Influence { joint: 0, weight: 0.5 }, Influence { joint: 2, weight: 0.5 }],
            morphs: Some(Morphs {
                offsets: vec![0, 2],
                displacements: vec![displace(1, vec3(0.0, 0.0, 0.5)), displace(0, vec3(0.0, 0.25, -0.25))],
            }),
        }
    }

    #[test]
    fn a_vertex_is_the_mean_of_its_joints_after_its_morphs() {
        let joints = [DMat4::IDENTITY, DMat4::ZERO, DMat4::from_translation(dvec3(0.0, 4.0, 0.0))];
        let [positions, normals] = skin().posed(&joints, &[2.0, 1.0]);
        assert_eq!(positions, [vec3(1.0, 2.5, 0.0)]);
        assert_eq!(normals, [Vec3::Y]);
    }
}
