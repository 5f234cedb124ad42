//! The six directions along the axes of a file.

use glam::{DMat3, DVec3};
use std::fmt;
use std::str::FromStr;

/// A direction along an axis of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis {
    /// 0 is x, 1 is y, 2 is z.
    index: usize,
    is_negative: bool,
}

impl Axis {
    /// Along +x.
    pub const X: Self = Self { index: 0, is_negative: false };
    /// Along +y, which is up.
    pub const Y: Self = Self { index: 1, is_negative: false };
    /// Along +z, where a body faces.
    pub const Z: Self = Self { index: 2, is_negative: false };

    /// All six, the axes first.
    pub const ALL: [Self; 6] = [Self::X, Self::Y, Self::Z, Self::X.opposite(), Self::Y.opposite(), Self::Z.opposite()];

    /// The other way.
    pub const fn opposite(self) -> Self {
        Self { index: self.index, is_negative: !self.is_negative }
    }

    /// Its unit vector.
    pub fn direction(self) -> DVec3 {
        let direction = DVec3::AXES[self.index];
        if self.is_negative { -direction } else { direction }
    }

    /// Whether both lie along one axis.
    pub fn is_parallel_to(self, other: Self) -> bool {
        self.index == other.index
    }

    /// The rotation by which a body that has this direction up stands, exactly: quarter turns have no rounding.
    pub(crate) fn upright(self) -> DMat3 {
        match (self.index, self.is_negative) {
            (0, false) => quarter_turns(Self::Z, 1),
            (0, true) => quarter_turns(Self::Z, 3),
            (1, false) => DMat3::IDENTITY,
            (1, true) => quarter_turns(Self::Z, 2),
            (_, false) => quarter_turns(Self::X, 3),
            (_, true) => quarter_turns(Self::X, 1),
        }
    }

    /// The turn of [`Axis::upright`] in words: by how much [°], and about which axis.
    pub(crate) fn way_upright(self) -> (i32, &'static str) {
        match (self.index, self.is_negative) {
            (0, false) => (90, "z"),
            (0, true) => (-90, "z"),
            (1, false) => (0, "z"),
            (1, true) => (180, "z"),
            (_, false) => (-90, "x"),
            (_, true) => (90, "x"),
        }
    }

    /// The direction that is nearest to a vector.
    pub(crate) fn nearest(vector: DVec3) -> Self {
        let along = |axis: &Self| axis.direction().dot(vector);
        Self::ALL.into_iter().max_by(|a, b| along(a).total_cmp(&along(b))).unwrap_or(Self::Z)
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", if self.is_negative { "-" } else { "+" }, ["x", "y", "z"][self.index])
    }
}

impl FromStr for Axis {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = |axis: &Self| [axis.to_string(), axis.to_string().replace('+', "")].iter().any(|name| name == text);
        Self::ALL.into_iter().find(known).ok_or_else(|| "it must be x, y, z, -x, -y or -z".to_owned())
    }
}

/// Counter-clockwise quarter turns about a positive axis, exactly.
pub(crate) fn quarter_turns(about: Axis, count: i64) -> DMat3 {
    let [next, last] = [1, 2].map(|step| DVec3::AXES[(about.index + step) % 3]);
    let mut columns = [DVec3::ZERO; 3];
    columns[about.index] = DVec3::AXES[about.index];
    let [to_next, to_last] = match count.rem_euclid(4) {
        0 => [next, last],
        1 => [last, -next],
        2 => [-next, -last],
        _ => [-last, next],
    };
    columns[(about.index + 1) % 3] = to_next;
    columns[(about.index + 2) % 3] = to_last;
    DMat3::from_cols(columns[0], columns[1], columns[2])
}
