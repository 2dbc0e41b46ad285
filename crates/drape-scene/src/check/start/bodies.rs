//! Bodies as they come: what about a mesh is unusual, and what contact cannot promise on it.
//!
//! Holes, edges with more than two triangles, and triangles without area are refused when the mesh
//! is read. What is said here does not keep a simulation from running.

use drape_input::{Advice, Remedy, counted};

use crate::check::body::mesh_remedy::repaired_file;
use crate::scene::{MeshSource, MovingBody, Scene};

/// Least ratio of the longest horizontal side to the height of a wearer that lies.
const LYING: f64 = 1.5;

/// Returns notes on the bodies of a scene that are meshes.
pub(crate) fn body_notes(scene: &Scene) -> Vec<Advice> {
    let spacings = scene.panels.iter().flat_map(|panel| panel.lattice.spacing());
    let spacing = spacings.fold(f64::INFINITY, f64::min);
    let meshes = scene.bodies.iter().filter_map(|moving| Some((moving, moving.source.as_ref()?)));
    meshes
        .flat_map(|(moving, mesh)| {
            let worn = !scene.garments.is_empty();
            [
                if worn { lying(moving, mesh).map(Advice::from) } else { None },
                fine(moving, mesh, spacing),
                coarse(moving, mesh, spacing).map(Advice::from),
            ]
        })
        .flatten()
        .collect()
}

/// Returns what contact cannot promise on the bodies of a scene, a sentence each.
pub(crate) fn contact_limits(scene: &Scene) -> Vec<Advice> {
    let meshes = scene.bodies.iter().filter_map(|moving| Some((moving, moving.source.as_ref()?)));
    meshes.filter_map(|(moving, mesh)| crossing(moving, mesh)).collect()
}

/// Tells that a body passes through itself.
fn crossing(moving: &MovingBody, mesh: &MeshSource) -> Option<Advice> {
    let found = &mesh.inspection.intersections;
    let [x, y, z] = found.first.first()?;
    let places = counted(found.count, "edge", "edges");
    let note = format!(
        "body \"{}\" passes through its own surface with {places}, first near ({x:.3}, {y:.3}, {z:.3}) m: cloth is kept \
         off the surface, but it may be caught there, or come to lie inside the body; part the surfaces in a modelling \
         program",
        moving.body.name,
    );
    Some(Advice::from(note).with(Remedy::ListCrossings { mesh: mesh.file.clone() }))
}

/// Tells that a wearer lies.
fn lying(moving: &MovingBody, mesh: &MeshSource) -> Option<String> {
    let [x, y, z] = mesh.inspection.size();
    (x.max(z) > LYING * y).then(|| {
        format!(
            "body \"{}\" is {x:.2} × {y:.2} × {z:.2} m: it lies, for y is up; turn = [-90, 0, 0] raises one whose file has \
             z up",
            moving.body.name
        )
    })
}

/// Tells that the triangles of a body are finer than cloth can see.
fn fine(moving: &MovingBody, mesh: &MeshSource, spacing: f64) -> Option<Advice> {
    mesh.inspection.is_too_fine(spacing).then(|| {
        let note = format!(
            "body \"{}\" has {} triangles with edges of {:.2} mm, finer than cloth of {:.0} mm can see: they cost time",
            moving.body.name,
            mesh.inspection.triangles,
            1e3 * mesh.inspection.edge_lengths.median,
            1e3 * spacing,
        );
        Advice::from(note).with(Remedy::ThinMesh {
            mesh: mesh.file.clone(),
            scale: mesh.scale,
            spacing,
            thinned: repaired_file(&mesh.file),
        })
    })
}

/// Tells that the triangles of a body show through the cloth.
fn coarse(moving: &MovingBody, mesh: &MeshSource, spacing: f64) -> Option<String> {
    mesh.inspection.is_too_coarse(spacing).then(|| {
        format!(
            "body \"{}\" has edges of {:.0} mm, and cloth of {:.0} mm shows them: subdivide it in a modelling program",
            moving.body.name,
            1e3 * mesh.inspection.edge_lengths.median,
            1e3 * spacing
        )
    })
}
