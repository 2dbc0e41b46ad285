use crate::error::{CollideError, check};
use crate::mesh::Mesh;
use crate::{obj, ply, stl};
use std::io::Read;
use std::path::Path;

/// Longest mesh file, in bytes: a million triangles take a tenth of it.
const BYTES_MAX: u64 = 1 << 28;

/// The vertices and triangles of a mesh file, as they are in it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshFile {
    /// Three coordinates each, in units of the file, in the order of the file.
    pub vertices: Vec<[f64; 3]>,
    /// Three vertex numbers each.
    pub triangles: Vec<[u32; 3]>,
}

impl MeshFile {
    /// Reads a Wavefront OBJ, STL (text or binary) or PLY (text or binary) file, by the end of its name.
    ///
    /// All groups and objects of an OBJ file are taken together as one surface; polygons become fans of triangles.
    /// Normals, texture coordinates, colours and materials are ignored. The corners of an STL file are a vertex each.
    ///
    /// # Errors
    /// A file that is none of these, that is cut off, or that is no regular file or longer than 256 MiB.
    pub fn read(path: impl AsRef<Path>) -> Result<MeshFile, CollideError> {
        let path = path.as_ref();
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let parse: fn(&[u8]) -> Result<MeshFile, String> = match extension.as_str() {
            "obj" => obj::parse,
            "stl" => stl::parse,
            "ply" => ply::parse,
            _ => return Err(CollideError::UnknownMeshFormat { path: path.to_path_buf() }),
        };
        let bytes = read_bytes(path, BYTES_MAX)?;
        parse(&bytes).map_err(|reason| CollideError::Malformed { path: path.to_path_buf(), reason })
    }

    /// The same with coordinates multiplied by a scale, in m per unit of the file.
    #[must_use]
    pub fn scaled(mut self, scale: f64) -> MeshFile {
        self.vertices.iter_mut().flatten().for_each(|value| *value *= scale);
        self
    }
}

impl Mesh {
    /// Reads a [`MeshFile`] and multiplies its coordinates by a scale, in m per unit of the file.
    ///
    /// # Errors
    /// A file that is none, or a surface that [`Mesh::new`] refuses.
    pub fn load(path: impl AsRef<Path>, scale: f64) -> Result<Mesh, CollideError> {
        check("the scale of the mesh", scale, "positive", scale > 0.0)?;
        let MeshFile { vertices, triangles } = MeshFile::read(path)?.scaled(scale);
        Mesh::new(&vertices, &triangles)
    }
}

/// The content of a regular file of at most so many bytes.
pub(crate) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, CollideError> {
    let unreadable = |reason: String| CollideError::Unreadable { path: path.to_path_buf(), reason };
    let fail = |error: std::io::Error| unreadable(error.to_string());
    // Asked before it is opened: opening a pipe would wait for its writer.
    let metadata = std::fs::metadata(path).map_err(fail)?;
    if !metadata.is_file() {
        return Err(unreadable("it is no regular file".to_string()));
    }
    if metadata.len() > limit {
        let (path, bytes) = (path.to_path_buf(), metadata.len());
        return Err(CollideError::LongFile { path, bytes, limit });
    }
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(fail)?;
    file.take(limit).read_to_end(&mut bytes).map_err(fail)?;
    Ok(bytes)
}
