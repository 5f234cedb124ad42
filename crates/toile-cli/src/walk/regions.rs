//! Which part of a body a vertex belongs to, by the name of its joint.

use glam::DVec3;
use toile::scene::{Mesh, Motion, MovingMesh};

/// Words in the names of joints, and the region that they mean; what has none of them is the torso.
const WORDS: [(&str, &[&str]); 3] = [
    ("arms", &["arm", "hand", "index", "middle", "pinky", "ring", "thumb", "finger", "wrist", "elbow", "clavicle"]),
    ("legs", &["thigh", "calf", "leg", "foot", "ball", "toe", "knee"]),
    ("head", &["head", "neck"]),
];

/// The regions of a body.
pub struct Regions {
    /// Of each vertex.
    of_vertex: Vec<&'static str>,
}

impl Regions {
    /// The regions of a body; all of it is the torso when it has no joints.
    pub fn new(body: &MovingMesh) -> Self {
        let of_vertex = match &body.motion {
            Motion::Sequence(_) | Motion::Hosted => vec!["torso"; body.mesh.positions.len()],
            Motion::Skinned { skin, rig } => {
                let names: Vec<&'static str> = rig.joint_names().map(region).collect();
                let main = |vertex: usize| {
                    let influences = skin.influences_of(vertex);
                    let main = influences.iter().max_by(|a, b| a.weight.total_cmp(&b.weight));
                    main.map_or("torso", |influence| names[influence.joint as usize])
                };
                (0..skin.positions.len()).map(main).collect()
            }
        };
        Self { of_vertex }
    }

    /// The region of the vertex of the body that is nearest to a point [m].
    pub fn nearest(&self, body: &Mesh, point: DVec3) -> &'static str {
        let distance = |vertex: &usize| body.positions[*vertex].as_dvec3().distance_squared(point);
        let nearest = (0..body.positions.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
        nearest.map_or("torso", |vertex| self.of_vertex[vertex])
    }
}

fn region(joint: &str) -> &'static str {
    let name = joint.to_ascii_lowercase();
    let found = WORDS.iter().find(|(_, words)| words.iter().any(|word| name.contains(word)));
    found.map_or("torso", |(region, _)| region)
}

#[cfg(test)]
mod tests {
    use super::region;

    #[test]
    fn joints_are_told_by_their_names() {
        let names = ["upperarm_l", "LeftHandIndex1", "thigh_r", "spine_02", "neck_01", "pelvis", ""];
        assert_eq!(names.map(region), ["arms", "arms", "legs", "torso", "head", "torso", "torso"]);
    }
}
