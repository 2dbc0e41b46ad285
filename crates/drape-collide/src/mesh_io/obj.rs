//! Wavefront OBJ files.

use super::triangulation::Triangulation;

/// Returns the vertices and triangles of `bytes`, a Wavefront OBJ text.
pub(crate) fn parse(bytes: &[u8]) -> Result<Triangulation, String> {
    let text = String::from_utf8_lossy(bytes);
    check_lines(&text)?;
    let (text, count) = surface_lines(&text);
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
        let (faces, _) = model.mesh.indices.as_chunks::<3>();
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

/// Checks the lines of vertices and faces of the OBJ `text`: a vertex has three numbers, and a face
/// at least three corners, which are vertices of the text.
///
/// # Errors
/// The number of the first line with a fault, and the fault.
fn check_lines(text: &str) -> Result<(), String> {
    let is_vertex = |line: &&str| line.split_whitespace().next() == Some("v");
    let count = text.lines().filter(is_vertex).count() as i64;
    let mut before = 0;
    for (index, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let fault = match words.next() {
            Some("v") => {
                before += 1;
                vertex_fault(words)
            }
            Some("f") => face_fault(words, before, count),
            _ => None,
        };
        if let Some(fault) = fault {
            return Err(format!("line {}: {fault}", index + 1));
        }
    }
    Ok(())
}

/// Returns the fault of a vertex whose coordinates are the words `coordinates`, if there is one.
fn vertex_fault<'a>(coordinates: impl Iterator<Item = &'a str>) -> Option<String> {
    let coordinates: Vec<&str> = coordinates.take(3).collect();
    if coordinates.len() < 3 {
        return Some(format!("a vertex has {} of three coordinates", coordinates.len()));
    }
    let wrong = coordinates.into_iter().find(|word| word.parse::<f64>().is_err())?;
    Some(format!("the coordinate \"{wrong}\" of a vertex is no number"))
}

/// Returns the fault of a face whose corners are the words `corners`, if there is one. The text has
/// `before` vertices before the face, and `count` vertices in all.
fn face_fault<'a>(
    corners: impl Iterator<Item = &'a str>,
    before: i64,
    count: i64,
) -> Option<String> {
    let mut number = 0;
    for corner in corners {
        number += 1;
        let word = corner.split('/').next().unwrap_or("");
        // Negative numbers count back from the last vertex before the face.
        let vertex = match word.parse::<i64>() {
            Ok(vertex) if vertex < 0 => before + 1 + vertex,
            Ok(vertex) => vertex,
            Err(_) => return Some(format!("the corner \"{corner}\" of a face is no number")),
        };
        if !(1..=count).contains(&vertex) {
            return Some(format!(
                "the corner \"{corner}\" of a face is no vertex: the file has {count} vertices, counted from 1"
            ));
        }
    }
    (number < 3).then(|| "a face has fewer than three corners".into())
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mistakes_name_their_line() {
        let vertices = "# a comment\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\n";
        let mistakes = [
            ("f 1 2\n", "line 5: a face has fewer than three corners"),
            ("\nf 1 2 4\n", "line 6: the corner \"4\" of a face is no vertex: the file has 3"),
            ("f 1/1 2/2 -4/3\n", "line 5: the corner \"-4/3\" of a face is no vertex"),
            ("f 1 2 x\n", "line 5: the corner \"x\" of a face is no number"),
            ("v 1 2\n", "line 5: a vertex has 2 of three coordinates"),
            ("v 1 2,5 3\n", "line 5: the coordinate \"2,5\" of a vertex is no number"),
        ];
        for (line, expected) in mistakes {
            let error = parse(format!("{vertices}{line}").as_bytes()).expect_err(line);
            assert!(error.starts_with(expected), "{error} does not say {expected}");
        }
        let whole = parse(format!("{vertices}f -3 2/7/8 3//1\n").as_bytes()).expect("right");
        assert_eq!((whole.vertices.len(), whole.triangles), (3, vec![[0, 1, 2]]));
    }
}
