//! Topology and manifest: the data that all frames share, stored once.

use drape_collide::ContactDistances;
use drape_frames::{Manifest, SurfacePart, Topology};

use crate::measure::garment_parts::GarmentParts;
use crate::world::World;

/// Returns the triangles and material coordinates of `world`.
pub(crate) fn topology(world: &World) -> Topology {
    let mut bodies = Vec::new();
    let mut first = 0;
    for outline in world.contact.triangulations() {
        let triangles = outline.triangles.iter();
        bodies.extend(triangles.map(|corners| corners.map(|corner| corner + first)));
        first += outline.vertices.len() as u32;
    }
    let cloth = &world.cloth;
    Topology { material: cloth.coordinates().to_vec(), cloth: cloth.triangles().to_vec(), bodies }
}

/// Returns the panels and bodies of `world` and `parts`, with the distances that contact keeps.
pub(crate) fn manifest(world: &World, parts: &GarmentParts) -> Manifest {
    let cloth = &world.cloth;
    let surfaces = world.contact.surfaces();
    let distances = surfaces.map(|surfaces| surfaces.contact.surface().group_distances());

    // The groups of the surface are the panels and then the bodies.
    let panels = parts.panels.iter().enumerate().map(|(group, panel)| {
        // The triangles of a cloth are in the order of its panels.
        let [start, end] = [panel.particles.start, panel.particles.end].map(|first| {
            cloth.triangles().partition_point(|triangle| (triangle[0] as usize) < first)
        });
        let part = SurfacePart {
            name: panel.name.clone(),
            vertices: panel.particles.len(),
            triangles: end - start,
            fabric: panel.fabric.clone(),
            fabric_colour: panel.colour,
            weft: panel.weft,
            ..SurfacePart::default()
        };
        with_distances(part, distances.and_then(|distances| distances.get(group)))
    });
    let panels: Vec<SurfacePart> = panels.collect();

    let bodies = world.contact.bodies().iter().zip(world.contact.triangulations()).enumerate();
    let bodies = bodies.map(|(number, (body, outline))| {
        let part = SurfacePart {
            name: body.name.clone(),
            vertices: outline.vertices.len(),
            triangles: outline.triangles.len(),
            ..SurfacePart::default()
        };
        let group = panels.len() + number;
        with_distances(part, distances.and_then(|distances| distances.get(group)))
    });

    Manifest {
        surface_contact: surfaces.is_some(),
        bodies: bodies.collect(),
        panels,
        pinch_fraction: surfaces
            .map_or(1.0, |surfaces| surfaces.contact.state().thinned_fraction()),
        seam_pairs: parts.seams.pairs.clone(),
        ties: parts.seams.tied_triples(),
        ..Manifest::default()
    }
}

/// Returns `part` with half of the `distances` of its group, if it has any.
fn with_distances(part: SurfacePart, distances: Option<&ContactDistances>) -> SurfacePart {
    let Some(distances) = distances else { return part };
    SurfacePart {
        half_activation_distance: distances.activation_distance,
        half_min_separation: distances.min_separation,
        ..part
    }
}
