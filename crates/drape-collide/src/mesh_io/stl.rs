//! STL files, text and binary.

use std::io::Cursor;

use super::triangulation::Triangulation;

/// Size of the header of a binary file, in bytes.
const HEADER: usize = 84;

/// Size of a triangle of a binary file, in bytes.
const TRIANGLE: usize = 50;

/// Returns the triangles of `bytes`, an STL file. The triangles share no vertices.
pub(crate) fn parse(bytes: &[u8]) -> Result<Triangulation, String> {
    let count = bytes.get(80..HEADER).and_then(|count| count.try_into().ok());
    let count = count.map_or(0, u32::from_le_bytes) as usize;
    let needed = TRIANGLE.saturating_mul(count);
    let is_binary = bytes.len() >= HEADER && bytes.len() - HEADER == needed;
    let is_text = bytes.starts_with(b"solid ") || bytes.starts_with(b"solid\n");

    // The reader decides by the first six bytes whether the file is text or binary.
    let mut content = bytes.to_vec();
    if is_binary {
        // Some programs begin binary files with the word with which texts begin.
        content[..6].fill(b' ');
    } else if is_text {
        if content[5] == b'\n' {
            content.insert(5, b' ');
        }
    } else if bytes.len() < HEADER {
        return Err(format!("its {} bytes are no STL file, or it is cut off", bytes.len()));
    } else {
        return Err(format!(
            "it says that it has {count} triangles, which take {needed} bytes, and has {}",
            bytes.len() - HEADER
        ));
    }

    let mut cursor = Cursor::new(content);
    let reader = stl_io::create_stl_reader(&mut cursor).map_err(|error| error.to_string())?;
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for triangle in reader {
        let triangle = triangle.map_err(|error| error.to_string())?;
        let first = vertices.len() as u32;
        vertices.extend(triangle.vertices.map(|vertex| vertex.0.map(f64::from)));
        triangles.push([first, first + 1, first + 2]);
    }
    Ok(Triangulation { vertices, triangles })
}
