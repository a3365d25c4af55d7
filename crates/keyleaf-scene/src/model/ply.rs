//! PLY, text and binary of both byte orders: polygons, normals, colours, texture coordinates.
//!
//! A reader of the project's own, since an error has to name its line or byte, and a vertex must not be a hash map.
//! Elements and properties that are not known are skipped.

use std::path::Path;

use glam::DVec3;

use crate::error::{FilePlace, ImportError};
use crate::note::Note;
use crate::soup::{Soup, check_finite, linear_from_srgb, unit};

use super::ply_values::{Element, Header, Property, Values};

/// Columns of a vertex, in the order of [`VERTEX_NAMES`].
const VERTEX_COLUMNS: usize = 12;
/// The names that programs give to the columns: position, normal, colour, texture coordinate.
const VERTEX_NAMES: [&[&str]; VERTEX_COLUMNS] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx"],
    &["ny"],
    &["nz"],
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
    &["alpha", "a", "diffuse_alpha"],
    &["s", "u", "texture_u"],
    &["t", "v", "texture_v"],
];

/// Attributes of the vertices; empty where the file has none.
#[derive(Default)]
struct VertexAttributes {
    normals: Vec<[f32; 3]>,
    colours: Vec<[f32; 4]>,
    uvs: Vec<[f32; 2]>,
}

/// Reads a PLY file from its bytes.
pub(super) fn read(file: &Path, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Soup, ImportError> {
    let (header, body) = Header::read(file, bytes)?;
    let mut values = Values::new(file, &header, body);
    let mut soup = Soup {
        states_topology: true,
        ..Soup::default()
    };
    let mut attributes = VertexAttributes::default();
    let mut seen_vertices = false;
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" if !seen_vertices => {
                seen_vertices = true;
                read_vertices(file, element, &mut values, &mut soup, &mut attributes)?;
            }
            "face" => {
                if !seen_vertices {
                    let reason = "faces before vertices are not read";
                    return Err(ImportError::unsupported(file, FilePlace::Whole, reason));
                }
                read_faces(file, element, &mut values, &mut soup)?;
            }
            "tristrips" => {
                let reason = "triangle strips are not read; export the model with faces";
                return Err(ImportError::unsupported(file, FilePlace::Whole, reason));
            }
            name => {
                if element.count > 0 {
                    notes.push(Note::remark(file, format!("element '{name}' is not read")));
                }
                skip(element, &mut values)?;
            }
        }
    }
    spread(&mut soup, &attributes);
    Ok(soup)
}

fn skip(element: &Element, values: &mut Values<'_>) -> Result<(), ImportError> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            let count = values.list_length(property)?;
            for _ in 0..count {
                values.number(property.kind)?;
            }
        }
    }
    Ok(())
}

fn read_vertices(
    file: &Path,
    element: &Element,
    values: &mut Values<'_>,
    soup: &mut Soup,
    attributes: &mut VertexAttributes,
) -> Result<(), ImportError> {
    let column = |p: &Property| {
        let of = |names: &&[&str]| p.list.is_none() && names.contains(&p.name.as_str());
        VERTEX_NAMES.iter().position(of)
    };
    let columns: Vec<Option<usize>> = element.properties.iter().map(column).collect();
    let has = |wanted: std::ops::Range<usize>| wanted.clone().all(|c| columns.contains(&Some(c)));
    if !has(0..3) {
        let reason = "the vertices have no properties x, y and z";
        return Err(ImportError::malformed(file, FilePlace::Line(element.line), reason));
    }
    let (with_normals, with_colours, with_uvs) = (has(3..6), has(6..9), has(10..12));
    for vertex in 0..element.count {
        let mut row = [0.0; VERTEX_COLUMNS];
        row[9] = 1.0;
        for (property, column) in element.properties.iter().zip(&columns) {
            for _ in 0..values.list_length(property)? {
                let value = values.number(property.kind)?;
                if let Some(column) = column {
                    let is_colour = (6..10).contains(column);
                    row[*column] = if is_colour {
                        value / property.kind.full_scale()
                    } else {
                        value
                    };
                }
            }
        }
        check_finite(file, || FilePlace::Vertex(vertex), "position", &row[..3])?;
        check_finite(file, || FilePlace::Vertex(vertex), "attribute", &row[3..])?;
        soup.positions.push(DVec3::from_slice(&row));
        if with_normals {
            attributes.normals.push(unit(DVec3::from_slice(&row[3..])));
        }
        if with_colours {
            // Stored as they are seen, that is sRGB.
            let [r, g, b] = [row[6], row[7], row[8]].map(|c| linear_from_srgb(c as f32));
            attributes.colours.push([r, g, b, row[9] as f32]);
        }
        if with_uvs {
            attributes.uvs.push([row[10] as f32, row[11] as f32]);
        }
    }
    Ok(())
}

fn read_faces(file: &Path, element: &Element, values: &mut Values<'_>, soup: &mut Soup) -> Result<(), ImportError> {
    let named = |p: &Property, names: &[&str]| p.list.is_some() && names.contains(&p.name.as_str());
    let is_corners = |p: &Property| named(p, &["vertex_indices", "vertex_index"]);
    let is_uvs = |p: &Property| named(p, &["texcoord"]);
    if !element.properties.iter().any(is_corners) && element.count > 0 {
        let reason = "the faces have no list property vertex_indices";
        return Err(ImportError::malformed(file, FilePlace::Line(element.line), reason));
    }
    let with_uvs = element.properties.iter().any(is_uvs);
    let count = soup.positions.len();
    for face in 0..element.count {
        let line = values.line();
        let place = || line.map_or(FilePlace::Face(face), FilePlace::Line);
        let first = soup.corners.len();
        let mut uvs = Vec::new();
        for property in &element.properties {
            for _ in 0..values.list_length(property)? {
                let value = values.number(property.kind)?;
                if is_corners(property) {
                    // Comparing as floats also refuses NaN.
                    if !(value >= 0.0 && value < count as f64 && value.fract() == 0.0) {
                        return Err(ImportError::IndexOutOfRange {
                            file: file.to_path_buf(),
                            place: place(),
                            what: "vertex",
                            index: value as i64,
                            count,
                        });
                    }
                    soup.corners.push(value as u32);
                } else if is_uvs(property) {
                    uvs.push(value as f32);
                }
            }
        }
        let corners = soup.corners.len() - first;
        if corners < 3 {
            let reason = format!("a face needs at least 3 corners, this one has {corners}");
            return Err(ImportError::malformed(file, place(), reason));
        }
        if with_uvs {
            let finite = uvs.len() == 2 * corners && uvs.iter().all(|c| c.is_finite());
            let uv = |i: usize| if finite { [uvs[2 * i], uvs[2 * i + 1]] } else { [0.0; 2] };
            soup.uvs.extend((0..corners).map(uv));
        }
        soup.ends.push(soup.corners.len() as u32);
        if let Some(line) = line {
            soup.lines.push(line as u32);
        }
    }
    Ok(())
}

/// Copies attributes of vertices to their corners.
fn spread(soup: &mut Soup, attributes: &VertexAttributes) {
    let corners = soup.corners.iter().map(|&v| v as usize);
    if !attributes.normals.is_empty() {
        soup.normals = corners.clone().map(|v| attributes.normals[v]).collect();
    }
    if !attributes.colours.is_empty() {
        soup.colours = corners.clone().map(|v| attributes.colours[v]).collect();
    }
    if !attributes.uvs.is_empty() && soup.uvs.is_empty() {
        soup.uvs = corners.map(|v| attributes.uvs[v]).collect();
    }
}
