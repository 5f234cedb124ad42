//! Whether a body has the size of a person in the declared unit.

use crate::body::disjoint::Disjoint;
use crate::body::soup::Soup;
use crate::error::{Fault, Found, rounded};
use crate::plausible::{HEIGHTS, WIDTH_MAX};
use glam::DVec3;
use std::collections::HashMap;
use toile_scene::Mesh;

/// So many triangles has each part of a body that tells the unit. Lashes and buttons are small in any.
const LEAST_TRIANGLES: usize = 100;

/// Refuses a unit that no cleaning could mend: cleaning a large file takes seconds, and then the body would be refused.
///
/// Only what is certain is refused. Floors are wide, and one that hangs together with the body is low; so all parts must be
/// too large along each axis.
pub(crate) fn check_unit(soup: &Soup, metres_per_unit: f64) -> Result<(), Found> {
    let parts = parts(soup, metres_per_unit);
    let [low, high] = parts.iter().fold(NOTHING, |whole, part| joined(whole, part.bounds));
    let longest = (high - low).max_element();
    let is_small = longest > 0.0 && longest < HEIGHTS[0];
    let mut large = parts.iter().filter(|part| part.triangle_count >= LEAST_TRIANGLES).peekable();
    let is_large =
        large.peek().is_some() && large.all(|part| (part.bounds[1] - part.bounds[0]).min_element() > HEIGHTS[1]);
    if is_small || is_large {
        let most = parts.iter().max_by_key(|part| part.triangle_count);
        let [low, high] = most.map_or([low, high], |part| part.bounds);
        return Err(wrong_unit(high - low, metres_per_unit));
    }
    Ok(())
}

const NOTHING: [DVec3; 2] = [DVec3::INFINITY, DVec3::NEG_INFINITY];

fn joined(a: [DVec3; 2], b: [DVec3; 2]) -> [DVec3; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// What hangs together by the vertices of a file.
struct Part {
    triangle_count: usize,
    bounds: [DVec3; 2],
}

fn parts(soup: &Soup, metres_per_unit: f64) -> Vec<Part> {
    let mut sets = Disjoint::of(soup.positions.len());
    for [a, b, c] in &soup.triangles {
        sets.join(*a, *b);
        sets.join(*a, *c);
    }
    let mut numbers = HashMap::new();
    let mut parts: Vec<Part> = Vec::new();
    let mut last = (u32::MAX, 0);
    for triangle in &soup.triangles {
        let root = sets.smallest(triangle[0]);
        // Triangles of a part mostly follow each other.
        if last.0 != root {
            last = (root, *numbers.entry(root).or_insert(parts.len()));
        }
        if last.1 == parts.len() {
            parts.push(Part { triangle_count: 0, bounds: NOTHING });
        }
        let part = &mut parts[last.1];
        part.triangle_count += 1;
        for corner in triangle {
            let position = soup.positions[*corner as usize] * metres_per_unit;
            part.bounds = joined(part.bounds, [position; 2]);
        }
    }
    parts
}

/// Refuses a body that is no person's size. It need not stand: then its longest side is its height.
pub(crate) fn check(mesh: &Mesh, metres_per_unit: f64) -> Result<(), Found> {
    let [low, high] = mesh.bounds().expect("a clean mesh has vertices");
    let size = high.as_dvec3() - low.as_dvec3();
    let height = size.y;
    if plausible(height) {
        let width = size.x.max(size.z);
        if width > WIDTH_MAX {
            return Err(Fault::BodyWidth { width: rounded(width) }.into());
        }
        return Ok(());
    }
    if plausible(height.max(size.max_element())) {
        return Ok(());
    }
    Err(wrong_unit(size, metres_per_unit))
}

fn wrong_unit(size: DVec3, metres_per_unit: f64) -> Found {
    let height = size.max_element();
    let typical = 1.7;
    let unit = [("mm", 0.001), ("cm", 0.01), ("dm", 0.1), ("m", 1.0), ("in", 0.0254)]
        .map(|(unit, metres)| (unit, height / metres_per_unit * metres))
        .into_iter()
        .filter(|(_, height)| plausible(*height))
        .min_by(|a, b| (a.1 / typical).ln().abs().total_cmp(&(b.1 / typical).ln().abs()));
    let advice = match unit {
        Some((unit, height)) => {
            format!("give {unit} as its unit if it should be {} m", rounded(height))
        }
        None => "no unit from mm to m makes it a body's size".into(),
    };
    Fault::BodyUnits { height: rounded(height), advice }.into()
}

fn plausible(height: f64) -> bool {
    (HEIGHTS[0]..=HEIGHTS[1]).contains(&height)
}

#[cfg(test)]
mod tests {
    use super::check_unit;
    use crate::body::soup::Soup;
    use glam::{DVec3, dvec3};

    /// A box as a lattice of triangles on four of its sides, from its lower corner.
    fn add_box(soup: &mut Soup, corner: DVec3, size: DVec3) {
        let (around, up) = (12, 10);
        let first = soup.positions.len() as u32;
        for row in 0..=up {
            for column in 0..around {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(column) / f64::from(around)).sin_cos();
                let part = dvec3(0.5 + 0.5 * sin, f64::from(row) / f64::from(up), 0.5 + 0.5 * cos);
                soup.positions.push(corner + size * part);
            }
        }
        for row in 0..up {
            for column in 0..around {
                let at = |row: u32, column: u32| first + row * around + column % around;
                let [a, b] = [at(row, column), at(row, column + 1)];
                let [c, d] = [at(row + 1, column), at(row + 1, column + 1)];
                soup.triangles.extend([[a, b, c], [c, b, d]]);
            }
        }
    }

    const PERSON: DVec3 = dvec3(0.5, 1.7, 0.3);

    fn told(parts: &[(DVec3, DVec3)], metres_per_unit: f64) -> Option<String> {
        let mut soup = Soup::default();
        parts.iter().for_each(|(corner, size)| add_box(&mut soup, *corner, *size));
        check_unit(&soup, metres_per_unit).err().map(|found| found.fault.to_string())
    }

    #[test]
    fn a_unit_that_no_cleaning_mends_is_refused_before_any() {
        let person = [(DVec3::ZERO, PERSON)];
        for (in_metres, unit) in [(1e-3, "mm"), (1e-2, "cm"), (0.0254, "in")] {
            let scaled = person.map(|(corner, size)| (corner, size / in_metres));
            let told = self::told(&scaled, 1.0).expect("a wrong unit");
            assert!(told.ends_with(&format!("give {unit} as its unit if it should be 1.70 m")), "{told}");
            assert_eq!(self::told(&scaled, in_metres), None);
        }
        let told = self::told(&person, 1e-3).expect("a wrong unit");
        assert!(told.starts_with("the body is 0.00170 m tall"), "{told}");
    }

    #[test]
    fn what_cleaning_may_mend_is_not_refused() {
        let floor = (dvec3(-20.0, -0.1, -20.0), dvec3(40.0, 0.1, 40.0));
        let hall = (dvec3(-20.0, 0.0, -20.0), dvec3(40.0, 9.0, 40.0));
        let speck = (dvec3(0.0, 90.0, 0.0), dvec3(0.01, 0.01, 0.01));
        for beside in [floor, hall, speck] {
            assert_eq!(told(&[(DVec3::ZERO, PERSON), beside], 1.0), None);
        }
        assert_eq!(told(&[(DVec3::ZERO, dvec3(12.0, 1.7, 12.0))], 1.0), None);
        assert_eq!(told(&[(DVec3::ZERO, DVec3::ZERO)], 1.0), None);
        assert_eq!(told(&[], 1.0), None);
    }
}
