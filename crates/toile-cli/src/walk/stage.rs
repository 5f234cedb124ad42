//! Where a walk takes place: every picture of it has the same scale, and what moves in them is the body.

use glam::Vec3;
use toile::scene::MovingMesh;

/// Poses that are looked at.
const POSE_COUNT: u32 = 48;
/// Room for garments and hands around the body, as part of its size to the sides [1].
const ROOM: f32 = 0.06;

/// A box that goes along with a body on a straight line.
pub struct Stage {
    start: Vec3,
    velocity: Vec3,
    low: Vec3,
    high: Vec3,
}

impl Stage {
    /// The smallest box that holds the body for some seconds, and room for its garments.
    pub fn new(body: &MovingMesh, seconds: f64) -> Self {
        let times: Vec<f64> = (0..=POSE_COUNT).map(|k| seconds * f64::from(k) / f64::from(POSE_COUNT)).collect();
        let bounds: Vec<[Vec3; 2]> = times.iter().filter_map(|time| body.at(*time).bounds()).collect();
        let middle = |[low, high]: &[Vec3; 2]| low.midpoint(*high) * Vec3::new(1.0, 0.0, 1.0);
        let [start, end] = [bounds.first(), bounds.last()].map(|bounds| bounds.map_or(Vec3::ZERO, middle));
        // A body that walks on the spot swings about one place.
        let goes = start.distance(end) > 0.5;
        let velocity = if goes { (end - start) / seconds as f32 } else { Vec3::ZERO };
        let mut stage = Self { start, velocity, low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };
        for (time, [low, high]) in times.iter().zip(&bounds) {
            let place = stage.place(*time);
            stage.low = stage.low.min(*low - place);
            stage.high = stage.high.max(*high - place);
        }
        let room = (stage.high - stage.low) * Vec3::new(ROOM, 0.0, ROOM);
        stage.low -= room;
        stage.high += room;
        stage
    }

    /// Smallest and largest corner of the box at a time [s].
    pub fn at(&self, time: f64) -> [Vec3; 2] {
        let place = self.place(time);
        [self.low + place, self.high + place]
    }

    fn place(&self, time: f64) -> Vec3 {
        self.start + self.velocity * time as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3, vec3};
    use toile::scene::{Mesh, RigidKey};

    fn walking_on(way: f64) -> MovingMesh {
        let mesh = Mesh {
            positions: vec![vec3(-0.2, 0.0, 0.0), vec3(0.2, 0.0, 0.0), vec3(0.0, 1.8, 0.1)],
            normals: vec![Vec3::Z; 3],
            triangles: vec![[0, 1, 2]],
        };
        let key = |time: f64, x: f64| RigidKey { time, translation: DVec3::X * x, rotation: DQuat::IDENTITY };
        MovingMesh::rigid(mesh, vec![key(0.0, 0.0), key(1.0, 0.6 * way), key(2.0, way)])
    }

    #[test]
    fn it_has_one_size_and_goes_along_evenly() {
        let stage = Stage::new(&walking_on(4.0), 2.0);
        let [start, end] = [stage.at(0.0), stage.at(2.0)];
        assert!((end[0] - start[0]).distance(vec3(4.0, 0.0, 0.0)) < 1e-5);
        assert!((end[1] - end[0]).distance(start[1] - start[0]) < 1e-5);
        for time in [0.0, 0.5, 1.0, 2.0] {
            let [low, high] = walking_on(4.0).at(time).bounds().expect("it has vertices");
            assert!(stage.at(time)[0].cmple(low).all() && stage.at(time)[1].cmpge(high).all(), "at {time} s");
        }
    }

    #[test]
    fn on_the_spot_it_stands() {
        let stage = Stage::new(&walking_on(0.3), 2.0);
        assert_eq!(stage.at(0.0), stage.at(2.0));
    }
}
