//! What a program did with a sheet, and how it is judged.

use crate::max_and_p99;
use glam::{DVec3, Vec3};
use serde::Deserialize;
use thiserror::Error;

/// Frames that are not timed: the first ones compile and warm up.
const UNTIMED: usize = 2;

/// What a program did with a square sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Course {
    /// Wall time of each frame [ms].
    pub milliseconds: Vec<f64>,
    /// Positions [m] at the end of each frame, shape [frames][n·n].
    pub positions: Vec<Vec<Vec3>>,
}

/// What is measured of a course.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Wall time of a frame [ms]: the median, without the first two.
    pub milliseconds: f64,
    /// Largest elongation of a side of a cell at the end of any frame [1].
    pub elongation_max_over_run: f64,
    /// Largest one at the end [1].
    pub elongation_max: f64,
    /// The one that 99 of 100 do not exceed at the end [1].
    pub elongation_p99: f64,
    /// Mean position [m] of the particles half-way through, after half of the frames.
    pub middle: DVec3,
}

/// Why the answer of a program is no course.
#[derive(Debug, Error, PartialEq)]
pub enum CourseError {
    /// It has no line that says what it did.
    #[error("its last line is no answer: {0}")]
    Line(String),
    /// It did other frames than asked.
    #[error(
        "it timed {times} frames and wrote {bytes} bytes of positions, where {frames} frames of {n} × {n} particles were asked for"
    )]
    Size {
        /// Frames that it timed.
        times: usize,
        /// Bytes of positions that it wrote.
        bytes: usize,
        /// Frames that it was asked for.
        frames: usize,
        /// Particles on a side.
        n: usize,
    },
}

/// The line that a program ends with.
#[derive(Deserialize)]
struct Told {
    program: String,
    milliseconds: Vec<f64>,
}

impl Course {
    /// The course that a program told of, with its name and version: the last line of its output as JSON with `program` and `milliseconds`,
    /// and its positions as little-endian f32, shape [frames, n·n, 3].
    ///
    /// # Errors
    /// When the line cannot be read, or has not as many frames as asked.
    pub fn told(output: &str, positions: &[u8], n: usize, frames: usize) -> Result<(String, Self), CourseError> {
        let line = output.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or_default();
        let told: Told = serde_json::from_str(line).map_err(|error| CourseError::Line(error.to_string()))?;
        let times = told.milliseconds.len();
        if times != frames || positions.len() != 12 * frames * n * n {
            return Err(CourseError::Size { times, bytes: positions.len(), frames, n });
        }
        let (words, _) = positions.as_chunks::<4>();
        let numbers: Vec<f32> = words.iter().map(|word| f32::from_le_bytes(*word)).collect();
        let (vectors, _) = numbers.as_chunks::<3>();
        let positions =
            vectors.chunks(n * n).map(|frame| frame.iter().map(|v| Vec3::from_array(*v)).collect()).collect();
        Ok((told.program, Self { milliseconds: told.milliseconds, positions }))
    }

    /// What is measured of it, for cells of a spacing [m]; `None` when it diverged: a position that is not finite.
    ///
    /// # Panics
    /// When it has not more than two frames.
    pub fn figures(&self, n: usize, spacing: f64) -> Option<Figures> {
        assert!(self.milliseconds.len() > UNTIMED && self.positions.len() > UNTIMED, "a course has frames");
        if self.positions.iter().flatten().any(|position| !position.is_finite()) {
            return None;
        }
        let elongations = |frame: &Vec<Vec3>| max_and_p99(elongations(frame, n, spacing));
        let [elongation_max, elongation_p99] = elongations(self.positions.last()?)?;
        let largest = self.positions.iter().filter_map(elongations).map(|[max, _]| max);
        let mut times = self.milliseconds[UNTIMED..].to_vec();
        times.sort_by(f64::total_cmp);
        let half_way = &self.positions[self.positions.len() / 2 - 1];
        let sum: DVec3 = half_way.iter().map(|position| position.as_dvec3()).sum();
        Some(Figures {
            milliseconds: times[times.len() / 2],
            elongation_max_over_run: largest.fold(f64::NEG_INFINITY, f64::max),
            elongation_max,
            elongation_p99,
            middle: sum / half_way.len() as f64,
        })
    }
}

/// Elongations of the sides of all cells [1].
fn elongations(positions: &[Vec3], n: usize, spacing: f64) -> Vec<f64> {
    let elongation = |a: usize, b: usize| positions[a].as_dvec3().distance(positions[b].as_dvec3()) / spacing - 1.0;
    let sides = |at: usize| {
        let right = (at % n + 1 < n).then(|| elongation(at, at + 1));
        let down = (at / n + 1 < n).then(|| elongation(at, at + n));
        right.into_iter().chain(down)
    };
    (0..n * n).flat_map(sides).collect()
}

#[cfg(test)]
mod tests {
    use super::{Course, CourseError};
    use glam::{DVec3, Vec3};

    /// A sheet of 3 × 3 particles 0.5 m apart that falls by 1 m a frame; its last frame is drawn out by a tenth along x.
    fn fall() -> Course {
        let frame = |k: usize| {
            let stretch = if k == 5 { 1.1 } else { 1.0 };
            (0..9).map(|at| Vec3::new(stretch * 0.5 * (at % 3) as f32, -(k as f32), 0.5 * (at / 3) as f32)).collect()
        };
        Course { milliseconds: vec![900.0, 800.0, 3.0, 1.0, 2.0, 9.0], positions: (0..6).map(frame).collect() }
    }

    fn bytes(course: &Course) -> Vec<u8> {
        course.positions.iter().flatten().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes).collect()
    }

    #[test]
    fn the_figures_are_those_of_the_frames() {
        let mut course = fall();
        let figures = course.figures(3, 0.5).expect("it is finite");
        assert_eq!(figures.milliseconds, 3.0, "the median without the first two");
        assert!((figures.elongation_max - 0.1).abs() < 1e-6, "{figures:?}");
        assert!((figures.elongation_max_over_run - 0.1).abs() < 1e-6, "{figures:?}");
        assert_eq!(figures.middle, DVec3::new(0.5, -2.0, 0.5), "the third of six frames");
        // Stretched on its way alone.
        course.positions.swap(4, 5);
        let figures = course.figures(3, 0.5).expect("it is finite");
        assert!((figures.elongation_max_over_run - 0.1).abs() < 1e-6 && figures.elongation_max.abs() < 1e-6);
        course.positions[1][4].z = f32::NAN;
        assert_eq!(course.figures(3, 0.5), None, "it diverged");
    }

    #[test]
    fn what_a_program_tells_is_its_course() {
        let course = fall();
        let output = "[Taichi] starts\n{\"program\": \"Taichi 1\", \"milliseconds\": [900, 800, 3, 1, 2, 9]}\n\n";
        let (program, told) = Course::told(output, &bytes(&course), 3, 6).expect("it is readable");
        assert_eq!(program, "Taichi 1");
        assert_eq!(told, course);
    }

    #[test]
    fn an_answer_that_is_none_says_what_is_wrong() {
        let positions = bytes(&fall());
        for output in ["", "Traceback", "{\"program\": \"Taichi 1\"}"] {
            let error = Course::told(output, &positions, 3, 6).expect_err("it is no answer");
            assert!(error.to_string().starts_with("its last line is no answer: "), "{error}");
        }
        let output = "{\"program\": \"Taichi 1\", \"milliseconds\": [1, 2, 3, 4, 5, 6]}";
        assert!(Course::told(output, &positions, 3, 6).is_ok());
        let short = Course::told(output, &positions[4..], 3, 6);
        assert_eq!(short, Err(CourseError::Size { times: 6, bytes: 644, frames: 6, n: 3 }));
        assert!(Course::told(output, &positions, 3, 7).is_err());
    }
}
