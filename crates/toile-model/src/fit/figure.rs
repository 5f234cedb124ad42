//! A standing person, recognised by cuts through a mesh, and the landmarks that garments follow.

use super::section::{Ring, Skin};
use glam::{DVec2, DVec3};

/// Cuts from the soles to the crown.
const CUT_COUNT: usize = 64;
/// Rings below this part of the squared height [1] are fingers, eyes or specks.
const SPECK: f64 = 4e-4;
/// Areas of a leg below the knee or above it, by the squared height [1].
const LEG_AREAS: [f64; 2] = [1e-3, 2.5e-2];
/// Areas of a trunk at its waist, by the squared height [1].
const TRUNK_AREAS: [f64; 2] = [8e-3, 0.12];
/// Areas of a head, by the squared height [1]; that of a child is large.
const HEAD_AREAS: [f64; 2] = [1e-3, 4e-2];
/// Two legs are alike: the area of one is at most so many times that of the other [1].
const LEGS_RATIO: f64 = 2.5;
/// How much wider than deep a trunk is at least [1] where it tells left from right.
const TRUNK_RATIO: f64 = 1.12;
/// Heights at which soles are cut, by the height [1].
const SOLES: [f64; 3] = [0.015, 0.02, 0.025];
/// Areas of the cut through a foot, by the squared height [1].
const FOOT_AREAS: [f64; 2] = [1e-3, 1.5e-2];
/// A foot lies at most so far from its shin, by the height [1].
const FOOT_LENGTH: f64 = 0.1;
/// How far the middle of the soles lies before that of the shins at least, by the height [1], where it tells the facing.
const FOOT_REACH: f64 = 0.012;
/// What stands farther from the middle than this many half widths of the trunk is an arm [1].
const ARM_DISTANCE: f64 = 1.12;
/// Length of the upper arm that tells its direction, by the height [1].
const UPPER_ARM: f64 = 0.11;

/// A standing person with y up, and the landmarks that garments follow.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    /// Heights of soles and crown [m].
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Where the trunk stands, x and z [m].
    pub(crate) middle: DVec2,
    /// Half the width of the trunk without arms [m].
    pub(crate) half_width: f64,
    /// How far the legs reach to the side of the middle at each cut below the crotch, from the soles on [m].
    legs_reach: Vec<f64>,
    /// Height of the narrowest place of the neck [m].
    pub(crate) neck: f64,
    /// Height of the narrowest place of the trunk [m].
    pub(crate) waist: f64,
    /// Height where the legs part [m].
    pub(crate) crotch: f64,
    /// Where it faces, a unit vector with the axes x and z; `None` where feet and trunk do not tell.
    pub(crate) facing: Option<DVec2>,
}

/// An arm, from the shoulder on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Arm {
    /// A place in its middle where it leaves the trunk [m].
    pub(crate) start: DVec3,
    /// Unit vector along the upper arm, away from the trunk.
    pub(crate) direction: DVec3,
}

impl Figure {
    /// The person that a mesh is; `None` where it is none that stands with y up.
    pub(crate) fn of(skin: &Skin) -> Option<Self> {
        let [low, high] = skin.heights();
        let height = high - low;
        if !(height > 0.0 && height.is_finite()) {
            return None;
        }
        let square = height * height;
        let main = |part: f64| -> Vec<Ring> {
            skin.rings(low + part * height).into_iter().filter(|ring| ring.area > SPECK * square).collect()
        };
        let within = |ring: &Ring, areas: [f64; 2]| (areas[0] * square..=areas[1] * square).contains(&ring.area);
        let are_legs = |rings: &[Ring]| match rings {
            [one, other] => within(one, LEG_AREAS) && within(other, LEG_AREAS) && one.area < LEGS_RATIO * other.area,
            _ => false,
        };
        let is_trunk = |rings: &[Ring]| {
            let all: f64 = rings.iter().map(|ring| ring.area).sum();
            rings.first().is_some_and(|ring| within(ring, TRUNK_AREAS) && ring.area > 0.55 * all)
        };
        let is_head = |rings: &[Ring]| matches!(rings, [ring] if within(ring, HEAD_AREAS));
        let count =
            |parts: &[f64], holds: &dyn Fn(&[Ring]) -> bool| parts.iter().filter(|part| holds(&main(**part))).count();
        let is_person = count(&[0.12, 0.16, 0.2, 0.24, 0.28], &are_legs) >= 4
            && count(&[0.55, 0.6, 0.65], &is_trunk) >= 2
            && count(&[0.92, 0.94, 0.96], &is_head) >= 2;
        if !is_person {
            return None;
        }
        let cut = |index: usize| (index as f64 + 0.5) / CUT_COUNT as f64;
        let cuts: Vec<(f64, Vec<Ring>)> = (0..CUT_COUNT).map(|index| (cut(index), main(cut(index)))).collect();
        let between = |from: f64, to: f64| {
            cuts.iter().filter(move |(part, rings)| (from..=to).contains(part) && !rings.is_empty())
        };
        let narrowest = |from: f64, to: f64| {
            let areas = between(from, to).map(|(part, rings)| (*part, rings[0].area));
            areas.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(part, _)| part)
        };
        // Hands hang beside the thighs, and are much thinner.
        let parted = |rings: &[Ring]| matches!(rings, [one, other, ..] if one.area < LEGS_RATIO * other.area);
        let crotch = between(0.2, 0.6).take_while(|(_, rings)| parted(rings)).last().map(|(part, _)| *part)?;
        let waist = narrowest(crotch + 0.08, 0.72)?;
        let neck = narrowest(0.8, 0.92)?;
        let trunk: Vec<&Ring> = between(crotch + 0.03, waist + 0.04).map(|(_, rings)| &rings[0]).collect();
        let middle = trunk.iter().map(|ring| ring.centre).sum::<DVec2>() / trunk.len().max(1) as f64;
        let mut figure = Self {
            low,
            high,
            middle,
            half_width: 0.0,
            legs_reach: Vec::new(),
            neck: low + neck * height,
            waist: low + waist * height,
            crotch: low + crotch * height,
            facing: facing(skin, &trunk, &main(0.1), [low, height]),
        };
        let sides = figure.left();
        let reach = |ring: &Ring| {
            let [a, b] = ring.bounds;
            let corners = [a, b, DVec2::new(a.x, b.y), DVec2::new(b.x, a.y)];
            corners.map(|corner| (corner - middle).dot(sides).abs()).into_iter().fold(0.0, f64::max)
        };
        figure.half_width = trunk.iter().map(|ring| reach(ring)).fold(0.0, f64::max);
        let legs = cuts.iter().take_while(|(part, _)| *part <= crotch);
        figure.legs_reach = legs.map(|(_, rings)| rings.iter().take(2).map(reach).fold(0.0, f64::max)).collect();
        Some(figure)
    }

    /// Height [m].
    pub(crate) fn height(&self) -> f64 {
        self.high - self.low
    }

    /// Towards the person's own left, a unit vector with the axes x and z.
    fn left(&self) -> DVec2 {
        let facing = self.facing.unwrap_or(DVec2::Y);
        DVec2::new(facing.y, -facing.x)
    }

    /// How far a place [m] is to the person's left of the middle [m].
    pub(crate) fn leftward(&self, place: DVec3) -> f64 {
        (DVec2::new(place.x, place.z) - self.middle).dot(self.left())
    }

    /// Away from the middle on the person's left, or on the other side, a unit vector.
    pub(crate) fn out(&self, is_left: bool) -> DVec3 {
        let left = self.left();
        DVec3::new(left.x, 0.0, left.y) * if is_left { 1.0 } else { -1.0 }
    }

    /// The part of the person that a place of it [m] belongs to, in a word.
    pub(crate) fn part_at(&self, place: DVec3) -> &'static str {
        let leftward = self.leftward(place);
        let is_left = leftward > 0.0;
        let rise = (place.y - self.low) / self.height();
        if self.is_arm(place) {
            if is_left { "left arm" } else { "right arm" }
        } else if place.y > self.neck {
            "head"
        } else if place.y < self.crotch || rise < 0.35 {
            if is_left { "left leg" } else { "right leg" }
        } else {
            "trunk"
        }
    }

    /// Whether a place [m] of the person is of an arm: far to the side, and no leg of a person who straddles.
    pub(crate) fn is_arm(&self, place: DVec3) -> bool {
        let rise = (place.y - self.low) / self.height();
        let cut = (rise * CUT_COUNT as f64) as usize;
        let legs = self.legs_reach.get(cut.saturating_sub(1)..).unwrap_or_default();
        let legs = legs.iter().take(3).copied().fold(0.0, f64::max);
        rise > 0.3 && self.leftward(place).abs() > ARM_DISTANCE * self.half_width.max(legs)
    }

    /// The arm of the left, or the other one; `None` where it does not stand off from the trunk.
    pub(crate) fn arm(&self, skin: &Skin, is_left: bool) -> Option<Arm> {
        let side = if is_left { 1.0 } else { -1.0 };
        let arm: Vec<(f64, DVec3)> = skin
            .places
            .iter()
            .filter(|place| self.is_arm(**place))
            .map(|place| (side * self.leftward(*place) - ARM_DISTANCE * self.half_width, *place))
            .filter(|(beyond, _)| *beyond > 0.0)
            .collect();
        let band = 0.025 * self.height();
        let centre = |from: f64| {
            let band = arm.iter().filter(|(beyond, _)| (from..from + band).contains(beyond));
            let (count, sum) = band.fold((0.0, DVec3::ZERO), |(count, sum), (_, place)| (count + 1.0, sum + *place));
            (count > 0.0).then(|| sum / count)
        };
        // Where the arm hangs steeply it does not reach far to the side.
        let reach = arm.iter().map(|(beyond, _)| *beyond).fold(0.0, f64::max);
        let start = centre(0.0)?;
        let direction = (centre((UPPER_ARM * self.height()).min(reach - band).max(band))? - start).try_normalize()?;
        Some(Arm { start, direction })
    }
}

/// Where a person faces: across the width of the trunk, where both feet point.
fn facing(skin: &Skin, trunk: &[&Ring], shins: &[Ring], [low, height]: [f64; 2]) -> Option<DVec2> {
    let [xx, xz, zz] = trunk.iter().fold([0.0; 3], |sum, ring| {
        let size = ring.spread[0] + ring.spread[2];
        [0, 1, 2].map(|i| sum[i] + ring.spread[i] / size)
    });
    let (mean, half) = (0.5 * (xx + zz), (0.5 * (xx - zz)).hypot(xz));
    if mean + half < TRUNK_RATIO * TRUNK_RATIO * (mean - half) {
        return None;
    }
    let across = DVec2::from_angle(0.5 * (2.0 * xz).atan2(xx - zz));
    let forward = across.perp();
    let [one, other] = shins else { return None };
    let (mut reach, mut count) = (0.0, 0);
    // Rings, not vertices: a scan may have a floor.
    for sole in SOLES.iter().flat_map(|part| skin.rings(low + part * height)) {
        let is_foot = (FOOT_AREAS[0] * height * height..=FOOT_AREAS[1] * height * height).contains(&sole.area);
        let way = [one, other]
            .map(|shin| sole.centre - shin.centre)
            .into_iter()
            .min_by(|a, b| a.length().total_cmp(&b.length()))?;
        if is_foot && way.length() < FOOT_LENGTH * height {
            reach += way.dot(forward) / height;
            count += 1usize;
        }
    }
    let reach = reach / count.max(1) as f64;
    let points = |sign: f64| count >= SOLES.len() && sign * reach > FOOT_REACH;
    if points(1.0) {
        Some(forward)
    } else if points(-1.0) {
        Some(-forward)
    } else {
        None
    }
}
