use crate::triangulate::Triangulation;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Property, PropertyAccess, PropertyAccessResult};
use std::io::Cursor;

/// What is used of an element: a vertex has a place, a face has corners.
#[derive(Debug, Default)]
struct Element {
    place: [Option<f64>; 3],
    corners: Option<Vec<u32>>,
    /// Whether its corners are none, such as negative ones.
    wrong: bool,
}

impl PropertyAccess for Element {
    fn new() -> Element {
        Element::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let axis = ["x", "y", "z"].iter().position(|axis| *axis == name);
        match (axis, name) {
            (Some(axis), _) => {
                self.place[axis] = match property {
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
                self.wrong = self.corners.is_none();
            }
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

/// The vertices and triangles of a PLY file.
pub(crate) fn parse(bytes: &[u8]) -> Result<Triangulation, String> {
    let parser = Parser::<Element>::new();
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = parser.read_header(&mut reader).map_err(said)?;
    // Each element takes a byte at least, so what the header says cannot make the parser reserve or loop for ever.
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
    let mut payload = parser.read_payload(&mut reader, &header).map_err(said)?;
    let mut element = |name: &str| {
        payload.shift_remove(name).ok_or_else(|| format!("it has no element \"{name}\""))
    };
    let place = |(number, vertex): (usize, Element)| match vertex.place {
        [Some(x), Some(y), Some(z)] => Ok([x, y, z]),
        _ => Err(format!("vertex {number} has no x, y and z")),
    };
    let vertices: Result<Vec<[f64; 3]>, String> =
        element("vertex")?.into_iter().enumerate().map(place).collect();
    let mut triangles = Vec::new();
    for (number, face) in element("face")?.into_iter().enumerate() {
        let corners = face.corners.filter(|_| !face.wrong);
        let corners = corners.ok_or_else(|| format!("face {number} has no vertex_indices"))?;
        if corners.len() < 3 {
            return Err(format!("face {number} has {} corners", corners.len()));
        }
        triangles.extend((2..corners.len()).map(|k| [corners[0], corners[k - 1], corners[k]]));
    }
    Ok(Triangulation { vertices: vertices?, triangles })
}

/// What the parser says, in one line.
fn said(error: ParseError) -> String {
    error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}
