//! VTK: files of ParaView and PyVista, one for each frame (`.vtp`), and the list of them with their
//! times (`.pvd`).
//!
//! Arrays are in the XML, coded by base 64, so that any reader of XML can read them.

use std::io::{self, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use drape_frames::{Frame, Recording, SurfacePart};
use drape_input::xml_text;

use crate::error::Error;
use crate::field::Field;
use crate::mesh;
use crate::normal;

/// Surface of a frame that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Surface {
    /// All panels.
    Cloth,
    /// All bodies.
    Bodies,
}

/// Cloth or bodies of a frame, with fields.
#[derive(Debug, Clone, Copy)]
pub struct PolyData<'a> {
    /// The run.
    pub recording: &'a Recording,
    /// The frame.
    pub frame: &'a Frame,
    /// Surface of the frame that is written.
    pub surface: Surface,
    /// Fields of the cloth, a number for each vertex.
    pub fields: &'a [(Field, Vec<f64>)],
}

/// Writes the cloth or the bodies of `data` to `to` as PolyData of VTK: positions in m with every
/// bit, y up.
///
/// Points have normals. Points of the cloth also have pattern coordinates in m (`uv`) and fields,
/// whose units are in their names. Triangles have the number of their panel or body (`part`). The
/// field data `names` has the names of the parts, `TimeValue` the time in s, and `units` and `up`
/// words.
///
/// # Errors
/// `to` fails.
pub fn write_vtp(data: &PolyData, mut to: impl Write) -> io::Result<()> {
    let PolyData { recording, frame, surface, fields } = *data;
    let (manifest, topology) = (recording.manifest(), recording.topology());
    let (parts, positions, triangles) = match surface {
        Surface::Cloth => (&manifest.panels, &frame.cloth, &topology.cloth),
        Surface::Bodies => (&manifest.bodies, &frame.bodies, &topology.bodies),
    };
    writeln!(to, "<?xml version=\"1.0\"?>")?;
    writeln!(
        to,
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<FieldData>"
    )?;
    // Data of the whole surface.
    numbers("TimeValue", &[[frame.time]], &mut to)?;
    words("units", ["m"], &mut to)?;
    words("up", ["y"], &mut to)?;
    words("names", parts.iter().map(|part| &*part.name), &mut to)?;
    let (points, polys) = (positions.len(), triangles.len());
    writeln!(
        to,
        "</FieldData>\n<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{polys}\">"
    )?;
    // Data of points.
    match surface {
        Surface::Cloth => {
            writeln!(to, "<PointData Normals=\"Normals\" TCoords=\"uv\">")?;
            let normals = normal::cloth_normals(frame, triangles, &manifest.seam_pairs);
            numbers("Normals", &normals, &mut to)?;
            numbers("uv", &mesh::pattern(recording), &mut to)?;
            for (field, values) in fields {
                let rows: Vec<[f64; 1]> = values.iter().map(|value| [*value]).collect();
                numbers(&format!("{} ({})", field.key(), field.unit()), &rows, &mut to)?;
            }
        }
        Surface::Bodies => writeln!(to, "<PointData>")?,
    }
    // Data of triangles, then points and triangles.
    writeln!(to, "</PointData>\n<CellData Scalars=\"part\">")?;
    numbers("part", &triangle_owners(parts), &mut to)?;
    writeln!(to, "</CellData>\n<Points>")?;
    numbers("Points", positions, &mut to)?;
    writeln!(to, "</Points>\n<Polys>")?;
    let corners: Vec<[i64; 1]> =
        triangles.iter().flatten().map(|corner| [i64::from(*corner)]).collect();
    let ends: Vec<[i64; 1]> = (1..=polys as i64).map(|triangle| [3 * triangle]).collect();
    numbers("connectivity", &corners, &mut to)?;
    numbers("offsets", &ends, &mut to)?;
    writeln!(to, "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>")
}

/// File of a collection, with its time.
#[derive(Debug, Clone, PartialEq)]
pub struct CollectionFile {
    /// Time, in s.
    pub time: f64,
    /// Path of the file from the folder of the collection, with slashes.
    pub file: String,
    /// Surface that the file has.
    pub surface: Surface,
}

/// Writes the collection of `files`, the files of a clip, to `to`. ParaView opens the collection as
/// one object that moves.
///
/// # Errors
/// `to` fails.
pub fn write_pvd(files: &[CollectionFile], mut to: impl Write) -> Result<(), Error> {
    writeln!(to, "<?xml version=\"1.0\"?>")?;
    writeln!(
        to,
        "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>"
    )?;
    for CollectionFile { time, file, surface } in files {
        let (part, name) = match surface {
            Surface::Cloth => (0, "cloth"),
            Surface::Bodies => (1, "bodies"),
        };
        let file = xml_text(file);
        writeln!(
            to,
            "<DataSet timestep=\"{time}\" group=\"\" part=\"{part}\" name=\"{name}\" file=\"{file}\"/>"
        )?;
    }
    writeln!(to, "</Collection>\n</VTKFile>")?;
    Ok(())
}

/// Number that VTK has a type for.
trait Number: Copy {
    /// Name of the type in VTK.
    const NAME: &'static str;

    /// Adds the number to `bytes`.
    fn put(self, bytes: &mut Vec<u8>);
}

impl Number for f64 {
    const NAME: &'static str = "Float64";

    fn put(self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}

impl Number for f32 {
    const NAME: &'static str = "Float32";

    fn put(self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}

impl Number for i64 {
    const NAME: &'static str = "Int64";

    fn put(self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}

impl Number for i32 {
    const NAME: &'static str = "Int32";

    fn put(self, bytes: &mut Vec<u8>) {
        bytes.extend(self.to_le_bytes());
    }
}

/// Writes the array `name` with `rows`.
fn numbers<T: Number, const N: usize>(
    name: &str,
    rows: &[[T; N]],
    to: &mut impl Write,
) -> io::Result<()> {
    // The format has the number of bytes before the numbers.
    let mut bytes = Vec::with_capacity(8 + size_of_val(rows));
    bytes.extend((size_of_val(rows) as u64).to_le_bytes());
    rows.iter().flatten().for_each(|number| number.put(&mut bytes));
    let (kind, count) = (T::NAME, rows.len());
    write!(
        to,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{N}\" NumberOfTuples=\"{count}\" format=\"binary\">"
    )?;
    base64(&bytes, to)?;
    writeln!(to, "</DataArray>")
}

/// Writes the list `name` of `words`. Each word ends with a zero. A zero inside a word is replaced.
fn words<'a>(
    name: &str,
    words: impl IntoIterator<Item = &'a str>,
    to: &mut impl Write,
) -> io::Result<()> {
    let words: Vec<String> =
        words.into_iter().map(|word| word.replace('\0', "\u{fffd}") + "\0").collect();
    let (count, content) = (words.len(), words.concat());
    let bytes = [&(content.len() as u64).to_le_bytes()[..], content.as_bytes()].concat();
    write!(
        to,
        "<Array type=\"String\" Name=\"{name}\" NumberOfTuples=\"{count}\" format=\"binary\">"
    )?;
    base64(&bytes, to)?;
    writeln!(to, "</Array>")
}

/// Returns for each triangle of `parts` the number of its part.
fn triangle_owners(parts: &[SurfacePart]) -> Vec<[i32; 1]> {
    (0..)
        .zip(parts)
        .flat_map(|(index, part)| std::iter::repeat_n([index], part.triangles))
        .collect()
}

/// Writes `bytes` in base 64.
fn base64(bytes: &[u8], to: &mut impl Write) -> io::Result<()> {
    to.write_all(STANDARD.encode(bytes).as_bytes())
}

#[cfg(test)]
mod tests {
    use roxmltree::{Document, Node};

    use super::*;
    use crate::example;

    /// Returns the bytes of an array of a file, without their length, which is checked.
    fn bytes(document: &Document, name: &str) -> Vec<u8> {
        let is_it = |node: &Node| node.attribute("Name") == Some(name);
        let text = document.descendants().find(is_it).and_then(|node| node.text()).unwrap();
        let mut bytes = STANDARD.decode(text).unwrap();
        let length = u64::from_le_bytes(bytes[..8].try_into().unwrap());
        assert_eq!(length as usize, bytes.len() - 8, "{name}");
        bytes.split_off(8)
    }

    fn floats(document: &Document, name: &str) -> Vec<f64> {
        bytes(document, name).as_chunks().0.iter().map(|eight| f64::from_le_bytes(*eight)).collect()
    }

    fn written(surface: Surface) -> String {
        let folder = example::folder(&[0.3]);
        let recording = Recording::open(folder.path()).unwrap();
        let frame = recording.frame(0).unwrap();
        let fields = [(Field::Shear, vec![0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5])];
        let data = PolyData { recording: &recording, frame: &frame, surface, fields: &fields };
        let mut text = Vec::new();
        write_vtp(&data, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn the_cloth_has_its_points_with_every_bit() {
        let text = written(Surface::Cloth);
        let document = Document::parse(&text).unwrap();
        assert_eq!(floats(&document, "Points"), example::cloth(0.3).concat());
        assert_eq!(floats(&document, "TimeValue"), [0.3]);
        assert_eq!(floats(&document, "shear (°)"), [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5]);
        assert_eq!(floats(&document, "uv")[8..], [0.0, 0.0, 0.0, 0.5, -0.25, 0.0]);
        assert_eq!(
            bytes(&document, "names"),
            format!("front\0{}\0", example::HOSTILE).into_bytes()
        );
        assert_eq!(bytes(&document, "part").len(), 3 * 4);
        let corners: Vec<u8> =
            [0_i64, 2, 1, 1, 2, 3, 4, 6, 5].iter().flat_map(|c| c.to_le_bytes()).collect();
        assert_eq!(bytes(&document, "connectivity"), corners);
        let ends: Vec<u8> = [3_i64, 6, 9].iter().flat_map(|end| end.to_le_bytes()).collect();
        assert_eq!(bytes(&document, "offsets"), ends);
    }

    #[test]
    fn the_bodies_are_a_file_of_their_own() {
        let text = written(Surface::Bodies);
        let document = Document::parse(&text).unwrap();
        assert_eq!(floats(&document, "Points"), example::cube().0.concat());
        assert_eq!(bytes(&document, "names"), b"box\0");
    }

    #[test]
    fn the_list_has_every_file_whatever_its_name() {
        let name = "a \"b\" <&> 'c'\n袖/run-00000.vtp";
        let files = [Surface::Cloth, Surface::Bodies].map(|surface| CollectionFile {
            time: 0.25,
            file: name.to_owned(),
            surface,
        });
        let mut text = Vec::new();
        write_pvd(&files, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let document = Document::parse(&text).unwrap();
        let sets: Vec<Node> =
            document.descendants().filter(|node| node.has_tag_name("DataSet")).collect();
        assert_eq!(
            sets.iter().map(|set| set.attribute("part")).collect::<Vec<_>>(),
            [Some("0"), Some("1")]
        );
        for set in sets {
            assert_eq!(
                (set.attribute("file"), set.attribute("timestep")),
                (Some(name), Some("0.25"))
            );
        }
    }
}
