//! PLY files, text and binary.

use std::io::Cursor;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Payload, Property, PropertyAccess, PropertyAccessResult};

use super::triangulation::Triangulation;

/// Element of a file: a vertex with its position, or a face with its corners.
#[derive(Debug, Default)]
struct Element {
    position: [Option<f64>; 3],
    corners: Option<Vec<u32>>,
    /// Whether the corners are no vertex numbers, such as negative ones.
    has_bad_corners: bool,
}

impl PropertyAccess for Element {
    fn new() -> Element {
        Element::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        // Coordinates may be numbers of any type. Corners must be unsigned.
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == name);
        match (axis, name) {
            (Some(axis), _) => {
                self.position[axis] = match property {
                    Property::Float(value) => Some(f64::from(value)),
                    Property::Double(value) => Some(value),
                    Property::Char(value) => Some(f64::from(value)),
                    Property::UChar(value) => Some(f64::from(value)),
                    Property::Short(value) => Some(f64::from(value)),
                    Property::UShort(value) => Some(f64::from(value)),
                    Property::Int(value) => Some(f64::from(value)),
                    Property::UInt(value) => Some(f64::from(value)),
                    _ => None,
                };
            }
            (None, "vertex_indices" | "vertex_index") => {
                self.corners = property.to_u32_list();
                self.has_bad_corners = self.corners.is_none();
            }
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

/// Returns the vertices and triangles of `bytes`, a PLY file.
pub(crate) fn parse(bytes: &[u8]) -> Result<Triangulation, String> {
    let parser = Parser::<Element>::new();
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = parser.read_header(&mut reader).map_err(message)?;
    // Each element takes at least a byte. With larger counts the parser would reserve too much
    // memory or loop without end.
    for element in header.elements.values() {
        let (name, count) = (&element.name, element.count);
        if count > 0 && element.properties.is_empty() {
            return Err(format!("the {count} elements \"{name}\" have no properties"));
        }
        if count > bytes.len() {
            let have = bytes.len();
            return Err(format!("it says that it has {count} of \"{name}\", in {have} bytes"));
        }
    }

    let mut payload = parser.read_payload(&mut reader, &header).map_err(message)?;
    let vertices: Result<Vec<[f64; 3]>, String> = take_elements(&mut payload, "vertex")?
        .into_iter()
        .enumerate()
        .map(|(number, vertex)| match vertex.position {
            [Some(x), Some(y), Some(z)] => Ok([x, y, z]),
            _ => Err(format!("vertex {number} has no x, y and z")),
        })
        .collect();

    // Polygons become fans of triangles.
    let mut triangles = Vec::new();
    for (number, face) in take_elements(&mut payload, "face")?.into_iter().enumerate() {
        let corners = face.corners.filter(|_| !face.has_bad_corners);
        let corners = corners.ok_or_else(|| format!("face {number} has no vertex_indices"))?;
        if corners.len() < 3 {
            return Err(format!("face {number} has {} corners", corners.len()));
        }
        triangles.extend((2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]));
    }
    Ok(Triangulation { vertices: vertices?, triangles })
}

/// Removes the list of elements called `name` from `payload` and returns it.
fn take_elements(payload: &mut Payload<Element>, name: &str) -> Result<Vec<Element>, String> {
    payload.shift_remove(name).ok_or_else(|| format!("it has no element \"{name}\""))
}

/// Returns the message of `error` in one line.
fn message(error: ParseError) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
