//! Files of frames: arrays of positions, triangles and material coordinates.

use std::path::Path;

use crate::array::{self, HashedRows};
use crate::error::Error;
use crate::frame::Frame;
use crate::frame_hash::FileHashes;
use crate::manifest::{Manifest, SurfacePart};
use crate::source::index::IndexEntry;
use crate::topology::{Topology, check_corners};

/// Returns the name of the file of frame `number`.
pub(crate) fn name(number: usize) -> String {
    format!("frame-{number:05}.npy")
}

/// Reads the topology of a run from `folder`.
pub(crate) fn topology(folder: &Path, manifest: &Manifest) -> Result<Topology, Error> {
    let (cloth, bodies) = (manifest.cloth_counts(), manifest.body_counts());
    let file = folder.join("material.npy");
    let material = array::coordinates(&file, "material coordinates", cloth.vertices)?.rows;
    let bodies = if manifest.bodies.is_empty() {
        Vec::new()
    } else {
        let file = folder.join("body-triangles.npy");
        triangles(&file, bodies.triangles, &manifest.bodies)?
    };
    let file = folder.join("triangles.npy");
    let cloth = triangles(&file, cloth.triangles, &manifest.panels)?;
    Ok(Topology { material, cloth, bodies })
}

/// Reads the `count` triangles of `parts` from `file`.
fn triangles(file: &Path, count: usize, parts: &[SurfacePart]) -> Result<Vec<[u32; 3]>, Error> {
    let triangles = array::corners(file, count)?;
    check_corners(file, &triangles, parts)?;
    Ok(triangles)
}

/// Reads the frame that `entry` lists from `folder`.
///
/// # Errors
/// A file is missing, is not what a run writes, or has changed since it was written.
pub(crate) fn read(folder: &Path, manifest: &Manifest, entry: &IndexEntry) -> Result<Frame, Error> {
    let IndexEntry { number, time, growth, bodies, touched, .. } = *entry;
    let file = folder.join(name(number));
    let count = manifest.cloth_counts().vertices;
    let HashedRows { rows: cloth, hash } = array::coordinates(&file, "vertices", count)?;
    let mut hashes = FileHashes { cloth: Some(hash), ..FileHashes::default() };

    // A frame in which nothing touches has no file of pressures.
    let pressures = match touched {
        None => None,
        Some(0) => Some(vec![0.0; count]),
        Some(_) => {
            let path = folder.join(format!("pressure-{number:05}.npy"));
            let HashedRows { rows, hash } = array::pressures(&path, count)?;
            hashes.pressures = Some(hash);
            Some(rows)
        }
    };

    let vertices = manifest.body_counts().vertices;
    let bodies_frame = bodies;
    let bodies = match bodies_frame {
        Some(number) => {
            let path = folder.join(format!("bodies-{number:05}.npy"));
            let HashedRows { rows, hash } = array::coordinates(&path, "vertices", vertices)?;
            hashes.bodies = Some(hash);
            rows
        }
        None if vertices == 0 => Vec::new(),
        None => {
            let reason = format!("frame {number} names no frame that has its bodies");
            return Err(Error::malformed(&folder.join("frames.csv"), number + 2, reason));
        }
    };

    if entry.hash.as_ref().is_some_and(|expected| hashes.text() != *expected) {
        let reason = "the frame, its bodies or its pressures are not as the run wrote them";
        return Err(Error::BadArray { path: file, reason: reason.to_owned() });
    }
    let growth_fraction = growth;
    let file = Some(file);
    Ok(Frame { number, time, growth_fraction, cloth, bodies, bodies_frame, pressures, file })
}
