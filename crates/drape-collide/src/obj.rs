use crate::error::{CollideError, check};
use crate::mesh::Mesh;
use std::path::Path;

impl Mesh {
    /// Reads a Wavefront OBJ file and multiplies its coordinates by a scale, in m per unit of the
    /// file.
    ///
    /// All groups and objects of the file are taken together as one surface; polygons become fans
    /// of triangles. Normals, texture coordinates and materials are ignored.
    pub fn load(path: impl AsRef<Path>, scale: f64) -> Result<Mesh, CollideError> {
        let path = path.as_ref();
        check("the scale of the mesh", scale, "positive", scale > 0.0)?;
        let bytes = std::fs::read(path).map_err(|error| CollideError::Unreadable {
            path: path.to_path_buf(),
            reason: error.to_string(),
        })?;
        let malformed =
            |reason: String| CollideError::Malformed { path: path.to_path_buf(), reason };
        let text = surface_lines(&String::from_utf8_lossy(&bytes));
        let options = tobj::LoadOptions {
            triangulate: true,
            ignore_points: true,
            ignore_lines: true,
            ..tobj::LoadOptions::default()
        };
        let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| {
            Ok((Vec::new(), Default::default()))
        })
        .map_err(|error| malformed(error.to_string()))?;
        let mut vertices: Vec<[f64; 3]> = Vec::new();
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        for model in &models {
            let first = vertices.len() as u32;
            let (places, _) = model.mesh.positions.as_chunks::<3>();
            let (faces, rest) = model.mesh.indices.as_chunks::<3>();
            if !rest.is_empty() {
                return Err(malformed("a face has fewer than three corners".to_string()));
            }
            vertices.extend(places.iter().map(|p| p.map(|value| value * scale)));
            triangles.extend(faces.iter().map(|f| f.map(|index| index + first)));
        }
        Mesh::new(&vertices, &triangles)
    }
}

/// The vertices and faces of an OBJ text, the faces without normals and texture coordinates.
///
/// The parser would split the surface by groups and materials, and trip over files that are
/// careless about what is not used here.
fn surface_lines(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            // A colour may follow the coordinates.
            Some("v") => kept.extend(["v"].into_iter().chain(words.take(3)).flat_map(|w| [w, " "])),
            Some("f") => {
                let corners = words.map(|word| word.split('/').next().unwrap_or(""));
                kept.extend(["f"].into_iter().chain(corners).flat_map(|w| [w, " "]));
            }
            _ => continue,
        }
        kept.push('\n');
    }
    kept
}
