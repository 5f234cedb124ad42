//! PLY, ASCII and binary: the elements `vertex`, `face` and `tristrips`.

use crate::body::ply_header::{Element, Header, Property};
use crate::body::ply_values::Values;
use crate::body::soup::Soup;
use crate::error::{Found, Place};
use crate::source;
use crate::unread::{Unread, shortened};
use glam::DVec3;

const POSITION_AND_NORMAL: [&str; 6] = ["x", "y", "z", "nx", "ny", "nz"];

/// Names of the list of corners.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Elements and properties that say nothing about the surface, each with its reason; `*` is any element.
const NEEDLESS: [(&str, &[&str], &str); 7] = [
    ("*", &["red", "green", "blue", "alpha", "r", "g", "b", "a"], "colours"),
    (
        "*",
        &[
            "diffuse_red",
            "diffuse_green",
            "diffuse_blue",
            "ambient_red",
            "ambient_green",
            "ambient_blue",
            "specular_red",
            "specular_green",
            "specular_blue",
            "ambient_coeff",
            "diffuse_coeff",
            "specular_coeff",
            "specular_power",
            "material_index",
            "material_indices",
        ],
        "colours",
    ),
    (
        "*",
        &["s", "t", "u", "v", "texture_u", "texture_v", "texture_s", "texture_t", "texcoord", "texnumber", "tx", "ty"],
        "texture coordinates",
    ),
    (
        "*",
        &["quality", "confidence", "intensity", "value", "flags", "radius", "scalar"],
        "what a scanner notes at a point",
    ),
    ("face", &["nx", "ny", "nz"], "normals of flat faces, which their corners give"),
    ("edge", &[], "lines have no surface"),
    ("material", &[], "colours"),
];

/// So many properties that are not read are told by name.
const MOST_NAMES: usize = 8;

/// Reads a PLY file. Positions stay in the file's unit. What is not read is noted.
pub(crate) fn read(bytes: &[u8], unread: &mut Unread) -> Result<Soup, Found> {
    let bytes = &*source::utf8(bytes);
    let header = Header::read(bytes)?;
    let mut values = Values::after(&header, bytes);
    let mut soup = Soup::default();
    for element in &header.elements {
        values.check_declared(element)?;
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut values, &mut soup)?,
            "face" => read_faces(element, &mut values, &mut soup)?,
            "tristrips" => read_strips(element, &mut values, &mut soup)?,
            _ => pass_over(element, &mut values)?,
        }
        note(element, unread);
    }
    values.pass_spaces();
    if values.left() > 0 {
        unread.note("what follows the last element", || values.place());
    }
    soup.check_indices(0)?;
    Ok(soup)
}

/// Notes what of an element is not read.
fn note(element: &Element, unread: &mut Unread) {
    let name = element.name.as_str();
    let read: &[&str] = match name {
        "vertex" => &POSITION_AND_NORMAL,
        "face" | "tristrips" => &CORNERS,
        _ => {
            if !NEEDLESS.iter().any(|(known, properties, _)| *known == name && properties.is_empty()) {
                unread.note(&format!("the element \"{}\"", shortened(name)), || Place::File);
            }
            return;
        }
    };
    let is_unread = |property: &&str| {
        let is_needless =
            |(of, properties, _): &(&str, &[&str], &str)| (*of == "*" || *of == name) && properties.contains(property);
        !read.contains(property) && !NEEDLESS.iter().any(is_needless)
    };
    let names = element.properties.iter().map(|property| property.name.as_str());
    let names: Vec<String> = names.filter(is_unread).map(|name| format!("\"{}\"", shortened(name))).collect();
    // Vertex groups, which have no end, are written as properties.
    let (told, others) = names.split_at(names.len().min(MOST_NAMES));
    if !told.is_empty() {
        let others = if others.is_empty() { String::new() } else { format!(" and {} more", others.len()) };
        let properties = if names.len() == 1 { "property" } else { "properties" };
        unread.note(&format!("the {properties} {}{others} of {name}", told.join(", ")), || Place::File);
    }
}

fn read_vertices(element: &Element, values: &mut Values, soup: &mut Soup) -> Result<(), Found> {
    const NAMES: [&str; 6] = POSITION_AND_NORMAL;
    let slots: Vec<Option<usize>> =
        element.properties.iter().map(|property| NAMES.iter().position(|name| *name == property.name)).collect();
    if let Some(missing) = NAMES[..3].iter().find(|name| element.scalar(name).is_none()) {
        let message = format!("the element vertex has no number \"{missing}\"");
        return Err(Found::malformed(Place::File, message));
    }
    if !soup.positions.is_empty() {
        return Err(Found::malformed(Place::File, "it has two elements vertex"));
    }
    soup.positions.reserve(element.count);
    soup.normals.reserve(element.count);
    for row in 0..element.count {
        let mut numbers = [0.0; 6];
        for (property, slot) in element.properties.iter().zip(&slots) {
            match (property.list_count, slot) {
                (None, Some(slot)) => numbers[*slot] = values.next(property.scalar)?,
                (None, None) => {
                    values.next(property.scalar)?;
                }
                (Some(count), _) => {
                    for _ in 0..values.list_length(count, property)? {
                        values.next(property.scalar)?;
                    }
                }
            }
        }
        let [x, y, z, nx, ny, nz] = numbers;
        soup.push_vertex(DVec3::new(x, y, z), || Place::Row("vertex".into(), row))?;
        soup.normals[row] = DVec3::new(nx, ny, nz);
    }
    Ok(())
}

fn read_faces(element: &Element, values: &mut Values, soup: &mut Soup) -> Result<(), Found> {
    soup.triangles.reserve(element.count);
    let mut corners: Vec<u32> = Vec::new();
    read_lists(element, values, |row, indices| {
        let place = || Place::Row("face".into(), row);
        corners.clear();
        for index in indices {
            if *index < 0.0 || *index >= f64::from(u32::MAX) || index.fract() != 0.0 || index.is_nan() {
                return Err(Found::malformed(place(), format!("{index} is not a vertex index")));
            }
            corners.push(*index as u32);
        }
        if corners.len() < 3 {
            let message = format!("it has {} corners, it needs 3", corners.len());
            return Err(Found::malformed(place(), message));
        }
        soup.push_polygon(&corners, place);
        Ok(())
    })
}

/// Strips of triangles, each closed by −1.
fn read_strips(element: &Element, values: &mut Values, soup: &mut Soup) -> Result<(), Found> {
    read_lists(element, values, |row, indices| {
        let place = || Place::Row("tristrips".into(), row);
        for strip in indices.split(|index| *index == -1.0) {
            if let Some(wrong) =
                strip.iter().find(|index| !(0.0..f64::from(u32::MAX)).contains(*index) || index.fract() != 0.0)
            {
                return Err(Found::malformed(place(), format!("{wrong} is not a vertex index")));
            }
            for (number, corners) in strip.windows(3).enumerate() {
                let [a, b, c] = [corners[0], corners[1], corners[2]].map(|index| index as u32);
                soup.push_polygon(&if number % 2 == 0 { [a, b, c] } else { [b, a, c] }, place);
            }
        }
        Ok(())
    })
}

/// The list of vertices in each row of an element.
fn read_lists(
    element: &Element,
    values: &mut Values,
    mut take: impl FnMut(usize, &[f64]) -> Result<(), Found>,
) -> Result<(), Found> {
    let is_list = |property: &Property| property.list_count.is_some() && CORNERS.contains(&property.name.as_str());
    if element.count > 0 && !element.properties.iter().any(is_list) {
        let has = element.properties.iter().map(|property| shortened(&property.name)).take(10).collect::<Vec<_>>();
        let message =
            format!("the element {} has no list \"vertex_indices\"; it has: {}", element.name, has.join(", "));
        return Err(Found::malformed(Place::File, message));
    }
    let mut list: Vec<f64> = Vec::new();
    for row in 0..element.count {
        for property in &element.properties {
            let Some(count) = property.list_count else {
                values.next(property.scalar)?;
                continue;
            };
            let length = values.list_length(count, property)?;
            if !is_list(property) {
                for _ in 0..length {
                    values.next(property.scalar)?;
                }
                continue;
            }
            list.clear();
            for _ in 0..length {
                list.push(values.next(property.scalar)?);
            }
            take(row, &list)?;
        }
    }
    Ok(())
}

fn pass_over(element: &Element, values: &mut Values) -> Result<(), Found> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            let length = match property.list_count {
                Some(count) => values.list_length(count, property)?,
                None => 1,
            };
            for _ in 0..length {
                values.next(property.scalar)?;
            }
        }
    }
    Ok(())
}
