//! Where the maps of the bodies stand, at any time.

use crate::Error;
use glam::{DVec3, Vec3};
use toile_gpu::MapSpace;
use toile_model::MapBox;
use toile_scene::{MapKind, Mesh, Motion, MovingMesh};

/// Bounds of a body are looked up in a table of so many per second [1/s].
const BOUNDS_RATE: f64 = 60.0;
/// What the table adds on every side [m]: a body goes no farther between two of its times, and inner garments hang out of it.
const BOUNDS_MARGIN: f32 = 0.03;
/// So many parts of a jump are looked at for the size of the maps.
const PARTS: u32 = 8;
/// Maps of a body that the host skins are this much larger than its longest extent [1]: it may stand any way, and stretch its arms.
const HOSTED_ROOM: f32 = 1.3;
/// So much larger its area may become as it is bent [1].
const HOSTED_AREA: f64 = 1.2;
/// What is added around a body for the garments that lie under another one [m].
const GARMENT_MARGIN: f32 = 0.25;

/// Where the maps of moving surfaces stand: as large as they ever need, around where they are.
#[derive(Clone, Debug)]
pub(crate) struct Boxes {
    bounds: Vec<[Vec3; 2]>,
    /// Length of a round [s], for a motion that repeats.
    round: Option<f64>,
    margin: f32,
    texel: f32,
    size: [u32; 3],
    jumps: Option<Jumps>,
    /// The cube around a body that the host skins: the maps stand around it alone.
    hosted: Option<Cube>,
    /// Largest area of all bodies together [m²].
    area: f64,
}

/// A cube around a body, from where it was seen last.
#[derive(Clone, Copy, Debug)]
struct Cube {
    /// The middle of the body as it was seen last.
    centre: Vec3,
    /// When that was [s], and how fast it went [m/s]; `None` since it was set elsewhere.
    seen: Option<(f64, Vec3)>,
    /// Half of its edge [m].
    reach: f32,
    /// How far the body may stand off the middle of the cube and be inside of it [m].
    room: f32,
}

impl Cube {
    fn around(mesh: &Mesh, margin: f32) -> Self {
        let [low, high] = mesh.bounds().unwrap_or_default();
        let half = 0.5 * (high - low).max_element();
        let room = (HOSTED_ROOM - 1.0) * half;
        Self { centre: low.midpoint(high), seen: None, reach: half + room + margin, room }
    }

    /// The body was seen here at a time [s].
    fn see(&mut self, middle: Vec3, time: f64) {
        let velocity = match self.seen {
            Some((before, _)) if before < time => (middle - self.centre) / (time - before) as f32,
            _ => Vec3::ZERO,
        };
        (self.centre, self.seen) = (middle, Some((time, velocity)));
    }

    /// Where it stands at a time [s]: the answers of the device come late, so it goes on as the body went. Within the room alone: a
    /// body that stops is then inside all the same.
    fn corners(&self, time: f64) -> [Vec3; 2] {
        let ahead = self.seen.map_or(Vec3::ZERO, |(seen, velocity)| velocity * (time - seen).max(0.0) as f32);
        let centre = self.centre + ahead.clamp_length_max(self.room);
        [centre - self.reach, centre + self.reach]
    }
}

/// Where a body jumps: the box around both ends would be as large as the jump is far.
#[derive(Clone, Debug)]
struct Jumps {
    body: MovingMesh,
    still: Vec<[Vec3; 2]>,
    /// Times of the table after which it jumps.
    indices: Vec<usize>,
}

/// What the maps of an outfit must hold, and where they stand.
#[derive(Clone, Debug)]
pub(crate) struct MapPlan {
    /// How they see bodies.
    pub(crate) kind: MapKind,
    /// Where they stand while anything in them moves.
    pub(crate) boxes: Option<Boxes>,
    /// Where they stand when nothing does.
    pub(crate) still_box: Option<MapBox>,
    /// Largest area of all that they show together [m²].
    pub(crate) area: f64,
}

impl MapPlan {
    /// Maps that hold it all; `None` where there is nothing to see.
    pub(crate) fn space(&self) -> Option<MapSpace> {
        let map_box = self.boxes.as_ref().map(|boxes| boxes.at(0.0, DVec3::ZERO)).or(self.still_box)?;
        let mut space = MapSpace::new(self.kind, map_box, self.area);
        space.moving = self.boxes.is_some();
        Some(space)
    }
}

impl Boxes {
    /// The boxes around bodies that move, and around boxes that stand still. `texel` is the edge length of a texel [m] and `thickness`
    /// that of the cloth on the bodies [m]; `layered` when garments show in the maps too.
    ///
    /// # Errors
    /// [`Error::Body`] when a position of a body is not finite at some time.
    pub(crate) fn new(
        moving: &[MovingMesh],
        still: &[[Vec3; 2]],
        texel: f32,
        thickness: f32,
        layered: bool,
    ) -> Result<Self, Error> {
        let duration = moving.iter().map(MovingMesh::duration).fold(0.0, f64::max);
        let count = (duration * BOUNDS_RATE).ceil() as u32 + 1;
        let mut area = 0.0_f64;
        let bounds_at = |index| {
            let time = f64::from(index) / BOUNDS_RATE;
            let mut boxes = still.to_vec();
            let mut area_now = 0.0;
            for body in moving {
                let posed = body.at(time);
                // Bounds alone do not tell: they pass over what is no number.
                if !posed.positions.iter().all(|position| position.is_finite()) {
                    return Err(Error::Body { time });
                }
                boxes.push(posed.bounds().unwrap_or_default());
                area_now += posed.area();
            }
            area = area.max(area_now);
            Ok(boxes.into_iter().reduce(around_both).unwrap_or_default())
        };
        let bounds = (0..count).map(bounds_at).collect::<Result<_, _>>()?;
        let margin = thickness + BOUNDS_MARGIN + if layered { GARMENT_MARGIN } else { 0.0 };
        let round = match moving {
            [only] if only.is_closed() => Some(only.duration()),
            _ => None,
        };
        let jumps = match moving {
            [only] => Jumps::of(only, still, count as usize),
            _ => None,
        };
        let hosted = moving.iter().find(|body| matches!(body.motion, Motion::Hosted));
        let hosted = hosted.map(|body| Cube::around(&body.mesh, margin));
        if hosted.is_some() {
            area *= HOSTED_AREA;
        }
        let mut boxes = Self { bounds, round, margin, texel, size: [0; 3], jumps, hosted, area };
        let size_at = |time| {
            let [low, high] = boxes.around(time);
            high - low
        };
        let times = (0..count).map(f64::from);
        // On its way from one key to the next a body that jumps may turn.
        let on_the_way = boxes.jumps.iter().flat_map(|jumps| &jumps.indices);
        let on_the_way =
            on_the_way.flat_map(|index| (1..PARTS).map(|k| *index as f64 + f64::from(k) / f64::from(PARTS)));
        let sizes = times.chain(on_the_way).map(|index| size_at(index / BOUNDS_RATE));
        let largest = sizes.fold(Vec3::ZERO, Vec3::max);
        boxes.size = MapBox::size_for(largest, texel);
        Ok(boxes)
    }

    /// Largest area of the bodies that move [m²].
    pub(crate) fn area(&self) -> f64 {
        self.area
    }

    /// The box at a time [s], with the bodies so far from where their motion has them [m].
    pub(crate) fn at(&self, time: f64, place: DVec3) -> MapBox {
        let time = self.round.map_or(time, |round| time.rem_euclid(round)).max(0.0);
        // What the host skins is seen where it is.
        let place = if self.hosted.is_some() { DVec3::ZERO } else { place };
        let bounds = self.around(time).map(|corner| corner + place.as_vec3());
        MapBox::moving(bounds, self.texel, self.size)
    }

    /// Follows a body that the host skins, which was seen within these bounds [m] at a time [s].
    pub(crate) fn follow(&mut self, [low, high]: [Vec3; 2], time: f64) {
        if let Some(cube) = &mut self.hosted {
            cube.see(low.midpoint(high), time);
        }
    }

    /// Stands around a body that the host skins, whose middle is here now [m].
    pub(crate) fn stand_around(&mut self, middle: Vec3) {
        if let Some(cube) = &mut self.hosted {
            (cube.centre, cube.seen) = (middle, None);
        }
    }

    /// Goes a way with a body that the host skins [m].
    pub(crate) fn go_along(&mut self, way: DVec3) {
        if let Some(cube) = &mut self.hosted {
            cube.centre += way.as_vec3();
        }
    }

    /// The middle of a body that the host skins, as it was seen last.
    pub(crate) fn middle(&self) -> Option<Vec3> {
        self.hosted.map(|cube| cube.centre)
    }

    /// The box around the bodies from one time of the table to the next; where a body jumps between them, around where it stands.
    fn around(&self, time: f64) -> [Vec3; 2] {
        if let Some(cube) = &self.hosted {
            return cube.corners(time);
        }
        // A time of the table stays one whatever the rounding: boxes of the same pose are then the same.
        let index = (time * BOUNDS_RATE + 1e-4) as usize;
        let last = self.bounds.len() - 1;
        let [low, high] = match &self.jumps {
            Some(jumps) if jumps.indices.contains(&index) => jumps.around(time),
            _ => around_both(self.bounds[index.min(last)], self.bounds[(index + 1).min(last)]),
        };
        [low - self.margin, high + self.margin]
    }
}

impl Jumps {
    /// The jumps of a body among boxes that stand still; `None` without any.
    fn of(body: &MovingMesh, still: &[[Vec3; 2]], count: usize) -> Option<Self> {
        let lead = body.lead()?;
        let jumps = |index: &usize| {
            let [from, to] = [*index, index + 1].map(|index| index as f64 / BOUNDS_RATE);
            lead.jump(from, to).is_some()
        };
        let indices: Vec<usize> = (0..count).filter(jumps).collect();
        (!indices.is_empty()).then(|| Self { body: body.clone(), still: still.to_vec(), indices })
    }

    /// The box around everything at a time [s].
    fn around(&self, time: f64) -> [Vec3; 2] {
        let stands = self.body.at(time).bounds();
        self.still.iter().copied().chain(stands).reduce(around_both).unwrap_or_default()
    }
}

/// The box around two boxes, each its smallest and largest corner [m].
pub(crate) fn around_both(a: [Vec3; 2], b: [Vec3; 2]) -> [Vec3; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use toile_scene::{Mesh, RigidKey};

    fn ball(keys: &[(f64, f64)]) -> MovingMesh {
        let key = |&(time, x)| RigidKey { time, translation: DVec3::X * x, rotation: DQuat::IDENTITY };
        MovingMesh::rigid(Mesh::sphere(Vec3::ZERO, 0.25, 8), keys.iter().map(key).collect())
    }

    #[test]
    fn a_body_that_leaves_every_place_is_refused() {
        let lost = ball(&[(0.0, 0.0), (0.5, 0.1), (1.0, 1e39)]);
        let error = Boxes::new(&[lost], &[], 0.01, 0.0, false).expect_err("it leaves");
        assert!(error.to_string().starts_with("the body has no finite position at 0."), "{error}");
    }

    #[test]
    fn a_jump_makes_the_maps_no_larger() {
        let still = Boxes::new(&[ball(&[(0.0, 0.0), (1.0, 0.1)])], &[], 0.01, 0.002, false).expect("all is finite");
        let jump = [(0.0, 0.0), (0.505, 0.05), (0.505, 300.05), (1.0, 300.1)];
        let boxes = Boxes::new(&[ball(&jump)], &[], 0.01, 0.002, false).expect("all is finite");
        assert_eq!(boxes.size, still.size);
        for time in [0.5, 0.504, 0.506, 0.516] {
            let x = 0.1 * time as f32 + if time > 0.505 { 300.0 } else { 0.0 };
            let map_box = boxes.at(time, DVec3::ZERO);
            assert!(map_box.corner().x < x - 0.25 && map_box.far_corner().x > x + 0.25, "{time} s: {map_box:?}");
        }
    }

    #[test]
    fn a_body_that_the_host_skins_has_room_any_way_it_stands() {
        let bar = Mesh::cuboid(Vec3::new(-0.1, 0.0, -0.1), Vec3::new(0.1, 1.6, 0.1));
        let mut boxes = Boxes::new(&[MovingMesh::hosted(bar)], &[], 0.01, 0.002, false).expect("all is finite");
        let holds = |boxes: &Boxes, low: Vec3, high: Vec3| {
            let map_box = boxes.at(7.0, DVec3::X * 5.0);
            map_box.corner().cmplt(low).all() && map_box.far_corner().cmpgt(high).all()
        };
        let lying = [Vec3::new(-0.8, 0.7, -0.1), Vec3::new(0.8, 0.9, 0.1)];
        assert!(holds(&boxes, lying[0], lying[1]));
        let far = Vec3::new(300.0, 1.0, -20.0);
        boxes.follow([far - 0.1, far + 0.1], 7.0);
        assert!(holds(&boxes, far - 0.8, far + 0.8) && !holds(&boxes, lying[0], lying[1]));
        boxes.go_along(DVec3::Y);
        assert_eq!(boxes.middle(), Some(far + Vec3::Y));
    }

    #[test]
    fn answers_that_come_late_are_made_up_for() {
        let bar = Mesh::cuboid(Vec3::new(-0.1, -0.8, -0.1), Vec3::new(0.1, 0.8, 0.1));
        let mut boxes = Boxes::new(&[MovingMesh::hosted(bar)], &[], 0.01, 0.002, false).expect("all is finite");
        let holds = |boxes: &Boxes, time: f64, x: f32| {
            let map_box = boxes.at(time, DVec3::ZERO);
            map_box.corner().x < x - 0.8 && map_box.far_corner().x > x + 0.8
        };
        // Every answer is ten frames old: 2.5 m/s are 0.42 m, where there is room for 0.27 m.
        boxes.follow([Vec3::ZERO; 2], 0.0);
        for frame in 1..30_u32 {
            let time = f64::from(frame) / 60.0;
            boxes.follow([Vec3::X * 2.5 * time as f32; 2], time);
            assert!(holds(&boxes, time + 10.0 / 60.0, 2.5 * (time as f32 + 10.0 / 60.0)), "{frame}");
            // It may stop at once, too.
            assert!(holds(&boxes, time + 1.0, 2.5 * time as f32), "{frame}");
        }
        // What it did before it was set elsewhere says nothing.
        boxes.stand_around(Vec3::ZERO);
        assert!(holds(&boxes, 9.0, 0.24) && holds(&boxes, 9.0, -0.24));
        // Nor does what it will have done at a time gone back to.
        boxes.follow([Vec3::X; 2], 8.0);
        boxes.follow([Vec3::X * 1.1; 2], 7.0);
        assert!(holds(&boxes, 7.5, 1.34) && holds(&boxes, 7.5, 0.86));
    }

    #[test]
    fn the_maps_hold_everything_at_every_time() {
        let bodies = [ball(&[(0.0, 0.0), (1.0, 2.0)]), ball(&[(0.0, -1.0), (0.5, -1.0)])];
        let shelf = [Vec3::new(-0.1, 1.0, 0.0), Vec3::new(0.1, 1.2, 0.1)];
        let boxes = Boxes::new(&bodies, &[shelf], 0.01, 0.002, true).expect("all is finite");
        for time in [0.0, 0.3, 1.0, 7.0] {
            let map_box = boxes.at(time, DVec3::ZERO);
            let [low, high] = [map_box.corner(), map_box.far_corner()];
            let x = 2.0 * time.min(1.0) as f32;
            assert!(low.x < -1.25 && high.x > x + 0.25, "{time} s: {map_box:?}");
            assert!(high.y > 1.2 && low.y < -0.25 && high.z > 0.25, "{time} s: {map_box:?}");
        }
    }
}
