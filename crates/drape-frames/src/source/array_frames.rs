//! Files of frames: arrays of positions, triangles and material coordinates.

use std::path::Path;

use crate::array;
use crate::error::Error;
use crate::frame::Frame;
use crate::frame_hash::{self, FileHashes};
use crate::manifest::{Manifest, SurfacePart};
use crate::source::index::IndexEntry;
use crate::topology::{Topology, check_corners};

/// Returns the name of the file of frame `number`.
pub(crate) fn name(number: usize) -> String {
    format!("frame-{number:05}.npy")
}

/// Returns the name of the file of bodies that was written with frame `number`.
fn bodies_name(number: usize) -> String {
    format!("bodies-{number:05}.npy")
}

/// Returns the name of the file of pressures of frame `number`.
fn pressure_name(number: usize) -> String {
    format!("pressure-{number:05}.npy")
}

/// Reads the topology of a run from `folder`.
pub(crate) fn topology(folder: &Path, manifest: &Manifest) -> Result<Topology, Error> {
    let (cloth, bodies) = (manifest.cloth_counts(), manifest.body_counts());
    let file = folder.join("material.npy");
    let material = array::coordinates(&file, "material coordinates", cloth.vertices)?;
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
    let cloth = array::coordinates(&file, "vertices", count)?;

    // A frame in which nothing touches has no file of pressures.
    let pressures = match touched {
        None => None,
        Some(0) => Some(vec![0.0; count]),
        Some(_) => Some(array::pressures(&folder.join(pressure_name(number)), count)?),
    };

    let vertices = manifest.body_counts().vertices;
    let bodies_frame = bodies;
    let bodies = match bodies_frame {
        Some(number) => {
            array::coordinates(&folder.join(bodies_name(number)), "vertices", vertices)?
        }
        None if vertices == 0 => Vec::new(),
        None => {
            let reason = format!("frame {number} names no frame that has its bodies");
            return Err(Error::malformed(&folder.join("frames.csv"), number + 2, reason));
        }
    };

    check_hash(folder, entry)?;
    let growth_fraction = growth;
    let file = Some(file);
    Ok(Frame { number, time, growth_fraction, cloth, bodies, bodies_frame, pressures, file })
}

/// Compares the files of the frame that `entry` lists with the hash that `entry` has, if it has
/// one.
///
/// # Errors
/// [`Error::BadArray`] if a file has changed.
fn check_hash(folder: &Path, entry: &IndexEntry) -> Result<(), Error> {
    let Some(expected) = &entry.hash else { return Ok(()) };
    let hash = |name: String| {
        let path = folder.join(name);
        array::content(&path).map(|content| frame_hash::hash(&content))
    };

    let touched = entry.touched.is_some_and(|count| count > 0);
    let hashes = FileHashes {
        cloth: Some(hash(name(entry.number))?),
        bodies: entry.bodies.map(|number| hash(bodies_name(number))).transpose()?,
        pressures: touched.then(|| hash(pressure_name(entry.number))).transpose()?,
    };
    if hashes.text() == *expected {
        return Ok(());
    }
    let reason = "the frame, its bodies or its pressures are not as the run wrote them".to_owned();
    Err(Error::BadArray { path: folder.join(name(entry.number)), reason })
}
