//! Where a walk takes place: every picture of it has the same scale, and what moves in them is the body.

use glam::Vec3;
use toile::scene::MovingMesh;

/// Poses that are looked at.
const POSE_COUNT: u32 = 48;
/// Room for garments and hands around the body, as part of its size to the sides [1].
const ROOM: f32 = 0.06;

/// How far the middle of a body may be off the straight line from its start to its end before the box leaves that line [m].
const OFF_LINE: f32 = 0.4;
/// Over so many poses on each side the way of a box off the line is smoothed: steps and swinging arms are no way.
const SMOOTHED: usize = 8;

/// A box that goes along with a body: on a straight line, or where the body turns a corner, on its way.
pub struct Stage {
    seconds: f64,
    /// Middle of the box at even times.
    path: Vec<Vec3>,
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
        let line = |index: usize| if goes { start.lerp(end, index as f32 / POSE_COUNT as f32) } else { start };
        let mut path: Vec<Vec3> = (0..times.len()).map(line).collect();
        let middles: Vec<Vec3> = bounds.iter().map(middle).collect();
        let is_off = middles.iter().zip(&path).any(|(middle, place)| middle.distance(*place) > OFF_LINE);
        if middles.len() == path.len() && is_off {
            let mean = |index: usize| {
                let reach = SMOOTHED.min(index).min(path.len() - 1 - index);
                let around = &middles[index - reach..=index + reach];
                around.iter().sum::<Vec3>() / around.len() as f32
            };
            path = (0..path.len()).map(mean).collect();
        }
        let mut stage = Self { seconds, path, low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };
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
        let last = self.path.len() - 1;
        let at = (time / self.seconds * last as f64).clamp(0.0, last as f64);
        let index = (at as usize).min(last - 1);
        self.path[index].lerp(self.path[index + 1], (at - index as f64) as f32)
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
    fn it_turns_the_corner_with_the_body() {
        let mesh = walking_on(0.0).mesh;
        let key = |time: f64, x: f64, z: f64| RigidKey {
            time,
            translation: DVec3::new(x, 0.0, z),
            rotation: DQuat::IDENTITY,
        };
        let corner = MovingMesh::rigid(mesh, vec![key(0.0, 0.0, 0.0), key(1.0, 2.0, 0.0), key(2.0, 2.0, 2.0)]);
        let stage = Stage::new(&corner, 2.0);
        let middle = |time| stage.at(time)[0].midpoint(stage.at(time)[1]);
        let way = middle(1.0) - middle(0.0);
        assert!(way.x > 1.5 && way.z < 0.4, "{way}");
        assert!((stage.at(1.0)[1] - stage.at(1.0)[0]).distance(stage.at(0.0)[1] - stage.at(0.0)[0]) < 1e-5);
    }

    #[test]
    fn on_the_spot_it_stands() {
        let stage = Stage::new(&walking_on(0.3), 2.0);
        assert_eq!(stage.at(0.0), stage.at(2.0));
    }
}
