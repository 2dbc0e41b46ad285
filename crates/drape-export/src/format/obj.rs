//! Wavefront OBJ: one frame, an object for each panel and each body; or the cloth as one object,
//! which point caches move.

use std::io::{self, Write};

use drape_frames::{Frame, Recording};

use crate::mesh;
use crate::name;

/// Writes `frame` to `to` as Wavefront OBJ: in metres, y up, an object for each panel and each
/// body.
///
/// Texture coordinates are the coordinates in the panel's frame, in m. Every number has the fewest
/// digits that distinguish it from its neighbours. A repeated name gets a number.
///
/// # Errors
/// `to` fails.
pub fn write_obj(recording: &Recording, frame: &Frame, mut to: impl Write) -> io::Result<()> {
    let (manifest, topology) = (recording.manifest(), recording.topology());
    head(frame, &mut to)?;
    vertices(frame.cloth.iter().chain(&frame.bodies), &mut to)?;
    pattern(recording, &mut to)?;

    let names = name::unique(manifest.panels.iter().chain(&manifest.bodies));
    let (panel_names, body_names) = names.split_at(manifest.panels.len());
    let mut triangles = topology.cloth.iter();
    for (panel, name) in manifest.panels.iter().zip(panel_names) {
        writeln!(to, "o {}", word(name))?;
        for corners in triangles.by_ref().take(panel.triangles) {
            face_with_pattern(corners, &mut to)?;
        }
    }

    let first = frame.cloth.len() as u32 + 1;
    let mut triangles = topology.bodies.iter();
    for (body, name) in manifest.bodies.iter().zip(body_names) {
        writeln!(to, "o {}", word(name))?;
        for triangle in triangles.by_ref().take(body.triangles) {
            let [a, b, c] = triangle.map(|corner| corner + first);
            writeln!(to, "f {a} {b} {c}")?;
        }
    }
    Ok(())
}

/// Writes the cloth of `frame` to `to` as Wavefront OBJ: one object with a group and a material for
/// each panel. The vertices are in the order of the run, so that [`write_pc2`](crate::write_pc2)
/// and [`write_mdd`](crate::write_mdd) write caches that move the object.
///
/// # Errors
/// `to` fails.
pub fn write_rest_obj(recording: &Recording, frame: &Frame, mut to: impl Write) -> io::Result<()> {
    let (manifest, topology) = (recording.manifest(), recording.topology());
    head(frame, &mut to)?;
    writeln!(to, "o cloth")?;
    vertices(&frame.cloth, &mut to)?;
    pattern(recording, &mut to)?;
    writeln!(to, "s 1")?;
    let mut triangles = topology.cloth.iter();
    for (panel, name) in manifest.panels.iter().zip(name::unique(&manifest.panels)) {
        let name = word(&name);
        writeln!(to, "g {name}\nusemtl {name}")?;
        for corners in triangles.by_ref().take(panel.triangles) {
            face_with_pattern(corners, &mut to)?;
        }
    }
    Ok(())
}

/// Writes the unit and the time of `frame` as a comment.
fn head(frame: &Frame, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "# metres, y up; t = {} s", frame.time)
}

/// Writes `positions` as vertices.
fn vertices<'a>(
    positions: impl IntoIterator<Item = &'a [f64; 3]>,
    to: &mut impl Write,
) -> io::Result<()> {
    for [x, y, z] in positions {
        writeln!(to, "v {x:?} {y:?} {z:?}")?;
    }
    Ok(())
}

/// Writes the pattern coordinates of `recording` as texture coordinates.
fn pattern(recording: &Recording, to: &mut impl Write) -> io::Result<()> {
    for [x, y] in mesh::pattern(recording) {
        writeln!(to, "vt {x:?} {y:?}")?;
    }
    Ok(())
}

/// Writes a triangle by its `corners`, which have texture coordinates with the same numbers.
fn face_with_pattern(corners: &[u32; 3], to: &mut impl Write) -> io::Result<()> {
    let [a, b, c] = corners.map(|corner| corner + 1);
    writeln!(to, "f {a}/{a} {b}/{b} {c}/{c}")
}

/// Returns `name` as a name that ends with its line. A backslash at its end would join the next
/// line.
fn word(name: &str) -> String {
    name.replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    fn written(write: fn(&Recording, &Frame, &mut Vec<u8>) -> io::Result<()>) -> String {
        let folder = example::folder(&[0.3]);
        let recording = Recording::open(folder.path()).unwrap();
        let mut text = Vec::new();
        write(&recording, &recording.frame(0).unwrap(), &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    fn lines<'a>(text: &'a str, key: &str) -> Vec<&'a str> {
        text.lines().filter_map(|line| line.strip_prefix(key)?.strip_prefix(' ')).collect()
    }

    #[test]
    fn every_part_is_an_object_of_its_name() {
        let text = written(|recording, frame, to| write_obj(recording, frame, to));
        assert!(text.starts_with("# metres, y up; t = 0.3 s\n"));
        assert_eq!(lines(&text, "o"), ["front", &example::HOSTILE.replace('\\', "/"), "box"]);
        assert_eq!((lines(&text, "v").len(), lines(&text, "vt").len()), (15, 7));
        let faces = lines(&text, "f");
        assert_eq!((faces[2], faces[3]), ("5/5 7/7 6/6", "8 10 11"));
    }

    #[test]
    fn the_object_of_a_cache_has_the_vertices_of_the_run_and_a_material_for_each_panel() {
        let text = written(|recording, frame, to| write_rest_obj(recording, frame, to));
        assert_eq!(lines(&text, "o"), ["cloth"]);
        assert_eq!(lines(&text, "usemtl"), lines(&text, "g"));
        assert_eq!(lines(&text, "g"), ["front", &example::HOSTILE.replace('\\', "/")]);
        let positions: Vec<String> =
            example::cloth(0.3).iter().map(|[x, y, z]| format!("{x:?} {y:?} {z:?}")).collect();
        assert_eq!(lines(&text, "v"), positions);
        // Pattern coordinates of the second panel, whose weft is along its height.
        assert_eq!(lines(&text, "vt")[4..], ["0.0 0.0", "0.0 0.5", "-0.25 0.0"]);
    }
}
