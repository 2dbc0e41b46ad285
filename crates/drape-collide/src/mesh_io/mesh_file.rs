//! Mesh files, by the extension of their names.

use std::io::Read;
use std::path::Path;

use super::triangulation::Triangulation;
#[cfg(feature = "mesh-files")]
use super::{obj, ply, stl};
use crate::error::Error;

/// Largest size of the file of a mesh or of its motion, in bytes. A tenth of it holds a million
/// triangles. All of it holds twenty thousand vertices for a thousand frames.
pub const MESH_BYTES_MAX: u64 = 1 << 28;

/// Reads the Wavefront OBJ, STL (text or binary) or PLY (text or binary) file at `path`. The
/// extension of the file's name decides the format.
///
/// All groups and objects of an OBJ file are one surface. Polygons become fans of triangles.
/// Normals, texture coordinates, colours and materials are ignored. The triangles of an STL file
/// share no vertices. Coordinates keep the unit of the file, vertices their order.
///
/// # Errors
/// The file is of none of these formats, is cut off, is no regular file, or is longer than 256 MiB.
/// Or the crate was built without its feature `mesh-files`.
pub fn read_mesh(path: impl AsRef<Path>) -> Result<Triangulation, Error> {
    read_mesh_within(path, MESH_BYTES_MAX)
}

/// Reads the mesh file at `path`, of at most `limit` bytes, as [`read_mesh`] does.
///
/// # Errors
/// As for [`read_mesh`], with `limit` in place of 256 MiB.
pub fn read_mesh_within(path: impl AsRef<Path>, limit: u64) -> Result<Triangulation, Error> {
    let path = path.as_ref();
    let parser = parser(path)?;
    parse(path, &read_bytes(path, limit)?, parser)
}

/// Returns the triangles of `bytes`, the content of a file with the name `path`, as [`read_mesh`]
/// does for the file.
///
/// # Errors
/// As for [`read_mesh`].
pub fn parse_mesh(path: impl AsRef<Path>, bytes: &[u8]) -> Result<Triangulation, Error> {
    let path = path.as_ref();
    parse(path, bytes, parser(path)?)
}

/// Parser of the content of a mesh file.
type Parser = fn(&[u8]) -> Result<Triangulation, String>;

/// Returns the parser for the file at `path`, by the extension of its name.
#[cfg(feature = "mesh-files")]
fn parser(path: &Path) -> Result<Parser, Error> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extension.as_str() {
        "obj" => Ok(obj::parse),
        "stl" => Ok(stl::parse),
        "ply" => Ok(ply::parse),
        _ => Err(Error::UnknownMeshFormat { path: path.to_path_buf() }),
    }
}

/// Returns no parser: the crate was built without its feature `mesh-files`.
#[cfg(not(feature = "mesh-files"))]
fn parser(path: &Path) -> Result<Parser, Error> {
    Err(Error::WithoutMeshFiles { path: path.to_path_buf() })
}

fn parse(path: &Path, bytes: &[u8], parser: Parser) -> Result<Triangulation, Error> {
    parser(bytes).map_err(|reason| Error::MalformedFile { path: path.to_path_buf(), reason })
}

/// Returns the content of the regular file at `path`, of at most `limit` bytes.
pub(crate) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, Error> {
    // The kind of file is checked first: opening a pipe would wait for its writer.
    let metadata = std::fs::metadata(path).map_err(|error| unreadable(path, error))?;
    if !metadata.is_file() {
        return Err(unreadable(path, "it is no regular file"));
    }
    if metadata.len() > limit {
        let (path, bytes) = (path.to_path_buf(), metadata.len());
        let times = bytes.div_ceil(MESH_BYTES_MAX);
        return Err(Error::FileTooLong { path, bytes, limit, times });
    }

    let mut bytes = Vec::new();
    let file = std::fs::File::open(path).map_err(|error| unreadable(path, error))?;
    file.take(limit).read_to_end(&mut bytes).map_err(|error| unreadable(path, error))?;
    Ok(bytes)
}

/// Returns the error of a file at `path` that cannot be read, with the `reason`.
fn unreadable(path: &Path, reason: impl ToString) -> Error {
    Error::UnreadableFile { path: path.to_path_buf(), reason: reason.to_string() }
}
