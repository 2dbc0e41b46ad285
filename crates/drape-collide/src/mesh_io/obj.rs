//! Wavefront OBJ files.

use super::triangulation::Triangulation;

/// Returns the vertices and triangles of `bytes`, a Wavefront OBJ text.
pub(crate) fn parse(bytes: &[u8]) -> Result<Triangulation, String> {
    let (text, count) = surface_lines(&String::from_utf8_lossy(bytes));
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..tobj::LoadOptions::default()
    };
    // Materials are ignored: the loader gets an empty list.
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| {
        Ok((Vec::new(), Default::default()))
    })
    .map_err(|error| error.to_string())?;
    let mut vertices = vec![[0.0; 3]; count];
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for model in &models {
        let (positions, _) = model.mesh.positions.as_chunks::<3>();
        let (colours, _) = model.mesh.vertex_color.as_chunks::<3>();
        let (faces, remainder) = model.mesh.indices.as_chunks::<3>();
        if !remainder.is_empty() {
            return Err("a face has fewer than three corners".to_string());
        }
        let numbers: Vec<u32> = colours.iter().map(|colour| colour[0] as u32).collect();
        for (&number, position) in numbers.iter().zip(positions) {
            *vertices.get_mut(number as usize).ok_or("a vertex has no number")? = *position;
        }
        for face in faces {
            let corners = face.map(|index| numbers.get(index as usize).copied());
            let [Some(a), Some(b), Some(c)] = corners else {
                return Err("a face names a vertex that does not exist".to_string());
            };
            triangles.push([a, b, c]);
        }
    }
    Ok(Triangulation { vertices, triangles })
}

/// Returns the lines of vertices and faces of the OBJ `text`, and the number of vertices. Faces
/// lose their normals and texture coordinates.
///
/// The parser would split the surface by groups and materials, and fail on careless files for
/// reasons that do not matter here. It also renumbers vertices in the order in which faces use
/// them. The numbers in the file are therefore passed on as colours of the vertices.
fn surface_lines(text: &str) -> (String, usize) {
    let mut kept = String::with_capacity(text.len());
    let mut count = 0;
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            // A colour may follow the coordinates in the file.
            Some("v") => {
                let coordinates: Vec<&str> = words.take(3).collect();
                kept.extend(["v"].iter().chain(&coordinates).flat_map(|w| [*w, " "]));
                if coordinates.len() == 3 {
                    kept.push_str(&format!("{count} 0 0"));
                }
                count += 1;
            }
            Some("f") => {
                let corners = words.map(|word| word.split('/').next().unwrap_or(""));
                kept.extend(["f"].into_iter().chain(corners).flat_map(|w| [w, " "]));
            }
            _ => continue,
        }
        kept.push('\n');
    }
    (kept, count)
}
