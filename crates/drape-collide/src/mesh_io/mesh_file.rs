//! Mesh files, by the extension of their names.

use std::io::Read;
use std::path::Path;

use super::triangulation::Triangulation;
use super::{obj, ply, stl};
use crate::error::Error;

/// Largest size of a file of a mesh or of its motion, in bytes: a tenth of it holds a million
/// triangles, and all of it twenty thousand vertices for a thousand frames.
pub const MESH_BYTES_MAX: u64 = 1 << 28;

/// Reads a Wavefront OBJ, STL (text or binary) or PLY (text or binary) file, by the extension of
/// its name.
///
/// All groups and objects of an OBJ file are one surface; polygons become fans of triangles.
/// Normals, texture coordinates, colours and materials are ignored. Each corner of an STL triangle
/// is a vertex of its own. Coordinates are in units of the file, vertices in its order.
///
/// # Errors
/// If the file is none of these, is cut off, is no regular file or is longer than 256 MiB.
pub fn read_mesh(path: impl AsRef<Path>) -> Result<Triangulation, Error> {
    read_mesh_within(path, MESH_BYTES_MAX)
}

/// Reads a mesh file of at most `limit` bytes, as [`read_mesh`] does.
///
/// # Errors
/// As for [`read_mesh`], with the limit in place of 256 MiB.
pub fn read_mesh_within(path: impl AsRef<Path>, limit: u64) -> Result<Triangulation, Error> {
    let path = path.as_ref();
    let parser = parser(path)?;
    parse(path, &read_bytes(path, limit)?, parser)
}

/// Returns the triangles of the content of a file, as [`read_mesh`] does of the file.
///
/// # Errors
/// As for [`read_mesh`].
pub fn parse_mesh(path: impl AsRef<Path>, bytes: &[u8]) -> Result<Triangulation, Error> {
    let path = path.as_ref();
    parse(path, bytes, parser(path)?)
}

/// Parser of the content of a mesh file.
type Parser = fn(&[u8]) -> Result<Triangulation, String>;

/// Returns the parser of a file, by the extension of its name.
fn parser(path: &Path) -> Result<Parser, Error> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "obj" => Ok(obj::parse),
        "stl" => Ok(stl::parse),
        "ply" => Ok(ply::parse),
        _ => Err(Error::UnknownMeshFormat { path: path.to_path_buf() }),
    }
}

fn parse(path: &Path, bytes: &[u8], parser: Parser) -> Result<Triangulation, Error> {
    parser(bytes).map_err(|reason| Error::MalformedFile { path: path.to_path_buf(), reason })
}

/// Returns the content of a regular file of at most `limit` bytes.
pub(crate) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, Error> {
    let unreadable = |reason: String| Error::UnreadableFile { path: path.to_path_buf(), reason };
    let fail = |error: std::io::Error| unreadable(error.to_string());
    // Asked before it is opened: opening a pipe would wait for its writer.
    let metadata = std::fs::metadata(path).map_err(fail)?;
    if !metadata.is_file() {
        return Err(unreadable("it is no regular file".to_string()));
    }
    if metadata.len() > limit {
        let (path, bytes) = (path.to_path_buf(), metadata.len());
        let times = bytes.div_ceil(MESH_BYTES_MAX);
        return Err(Error::FileTooLong { path, bytes, limit, times });
    }
    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(fail)?;
    file.take(limit).read_to_end(&mut bytes).map_err(fail)?;
    Ok(bytes)
}
