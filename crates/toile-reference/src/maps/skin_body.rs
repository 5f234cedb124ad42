//! A mesh bent by its joints.

use glam::{Vec3, Vec4};
use toile_scene::Skin;

/// Positions [m] and unit normals, each of shape [vertex_count], of vertices that follow joints: `positions` and `normals` are
/// those of the bind pose, morphs included; `joints` holds the first three rows of each joint's matrix. Normals go by the
/// cofactors of the blended matrix; one that vanishes becomes +y.
pub fn skin_body(positions: &[Vec3], normals: &[Vec3], skin: &Skin, joints: &[[Vec4; 3]]) -> [Vec<Vec3>; 2] {
    let mut posed = [Vec::with_capacity(positions.len()), Vec::with_capacity(positions.len())];
    for (vertex, (&position, &normal)) in positions.iter().zip(normals).enumerate() {
        let range = skin.influence_offsets[vertex] as usize..skin.influence_offsets[vertex + 1] as usize;
        let mut rows = [Vec4::ZERO; 3];
        for influence in &skin.influences[range] {
            for (row, of_joint) in rows.iter_mut().zip(joints[influence.joint as usize]) {
                *row += of_joint * influence.weight;
            }
        }
        let [x, y, z] = rows.map(Vec4::truncate);
        posed[0].push(Vec3::from_array(rows.map(|row| row.truncate().dot(position) + row.w)));
        let turned = Vec3::new(y.cross(z).dot(normal), z.cross(x).dot(normal), x.cross(y).dot(normal));
        let length = turned.length();
        posed[1].push(if length > 0.0 { turned / length } else { Vec3::Y });
    }
    posed
}
