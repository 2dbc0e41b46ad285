//! Files of format 2: arrays of positions, triangles and material coordinates.

use std::path::Path;

use crate::array;
use crate::error::Error;
use crate::frame::Frame;
use crate::index::Entry;
use crate::manifest::{Manifest, SurfacePart};
use crate::topology::{Topology, check_corners};

/// Returns the name of the file of a frame.
pub(crate) fn name(number: usize) -> String {
    format!("frame-{number:05}.npy")
}

/// Reads the topology of a folder.
pub(crate) fn topology(folder: &Path, manifest: &Manifest) -> Result<Topology, Error> {
    let (cloth, bodies) = (manifest.cloth_counts(), manifest.body_counts());
    let file = folder.join("material.npy");
    let material = array::coordinates(&file, "material coordinates", cloth.vertices)?;
    let triangles = |name: &str, count: usize, parts: &[SurfacePart]| {
        let file = folder.join(name);
        let triangles = array::corners(&file, count)?;
        check_corners(&file, &triangles, parts)?;
        Ok(triangles)
    };
    let of_bodies = match manifest.bodies.is_empty() {
        true => Vec::new(),
        false => triangles("body-triangles.npy", bodies.triangles, &manifest.bodies)?,
    };
    let cloth = triangles("triangles.npy", cloth.triangles, &manifest.panels)?;
    Ok(Topology { material, cloth, bodies: of_bodies })
}

/// Reads a frame.
pub(crate) fn read(folder: &Path, manifest: &Manifest, entry: Entry) -> Result<Frame, Error> {
    let Entry { number, time, growth, bodies, touched } = entry;
    let file = folder.join(name(number));
    let count = manifest.cloth_counts().vertices;
    let cloth = array::coordinates(&file, "vertices", count)?;
    let pressures = match touched {
        None => None,
        Some(0) => Some(vec![0.0; count]),
        Some(_) => {
            Some(array::pressures(&folder.join(format!("pressure-{number:05}.npy")), count)?)
        }
    };
    let vertices = manifest.body_counts().vertices;
    let bodies_file = bodies.map(|number| folder.join(format!("bodies-{number:05}.npy")));
    let bodies = match &bodies_file {
        Some(path) => array::coordinates(path, "vertices", vertices)?,
        None if vertices == 0 => Vec::new(),
        None => {
            let reason = format!("frame {number} names no frame that has its bodies");
            return Err(Error::Malformed {
                path: folder.join("frames.csv"),
                line: number + 2,
                reason,
            });
        }
    };
    Ok(Frame { number, file, time: Some(time), growth, cloth, bodies_file, bodies, pressures })
}
