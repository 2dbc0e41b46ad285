//! Wavefront OBJ: one frame, an object for each panel and each body.

use std::io::{self, Write};

use drape_frames::{Frame, Part, Recording};

/// Writes a frame as Wavefront OBJ: in metres, y up, an object for each panel and each body.
///
/// Texture coordinates are the coordinates of the panel's own frame, in m. Every number has as many
/// digits as tell it from its neighbours.
///
/// # Errors
/// Those of the writer.
pub fn write_obj(recording: &Recording, frame: &Frame, mut to: impl Write) -> io::Result<()> {
    let (manifest, topology) = (recording.manifest(), recording.topology());
    match frame.time {
        Some(time) => writeln!(to, "# metres, y up; t = {time} s")?,
        None => writeln!(to, "# metres, y up")?,
    }
    for [x, y, z] in frame.cloth.iter().chain(&frame.bodies) {
        writeln!(to, "v {x:?} {y:?} {z:?}")?;
    }
    let mut material = topology.material.iter();
    for panel in &manifest.panels {
        for &point in material.by_ref().take(panel.vertices) {
            let [x, y] = panel.pattern_point(point);
            writeln!(to, "vt {x:?} {y:?}")?;
        }
    }
    let mut triangles = topology.cloth.iter();
    for panel in &manifest.panels {
        object(panel, &mut to)?;
        for triangle in triangles.by_ref().take(panel.triangles) {
            let [a, b, c] = triangle.map(|corner| corner + 1);
            writeln!(to, "f {a}/{a} {b}/{b} {c}/{c}")?;
        }
    }
    let first = frame.cloth.len() as u32 + 1;
    let mut triangles = topology.bodies.iter();
    for body in &manifest.bodies {
        object(body, &mut to)?;
        for triangle in triangles.by_ref().take(body.triangles) {
            let [a, b, c] = triangle.map(|corner| corner + first);
            writeln!(to, "f {a} {b} {c}")?;
        }
    }
    Ok(())
}

fn object(part: &Part, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "o {}", part.name.replace(char::is_control, " "))
}
