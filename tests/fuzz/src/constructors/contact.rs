//! Contact of surfaces, distances and impacts of meshes, and bodies.

use drape::collide::section::SectionPlane;
use drape::collide::{
    Body, ContactDistances, Mesh, MeshInspection, NearestSurface, ParticleContact,
    ParticleSettings, PlainMesh, Pose, ProximityMesh, RepairSettings, Shape, Surface,
    SurfaceContact, SurfaceParts, SurfaceSettings, SurfaceStart, SurfaceTrial, Triangulation,
    earliest_impact, earliest_self_impact, mesh_distance, repair,
};

use crate::shapes::Source;

fn parts(source: &mut Source<'_>) -> Option<SurfaceParts> {
    let distances = ContactDistances {
        activation_distance: source.mostly_positive(8),
        min_separation: source.mostly_positive(8) * 1e-3,
    };
    let [free, bodies] = [0; 2].map(|_| source.odd_points(7));
    let [free_faces, body_faces] =
        [free.len(), bodies.len()].map(|count| source.triangles(3, count));
    let free = PlainMesh { positions: &free, triangles: &free_faces };
    let bodies = PlainMesh { positions: &bodies, triangles: &body_faces };
    let mut parts = SurfaceParts::from_meshes(&[free], &[bodies], distances).ok()?;
    let count = parts.areas.len();
    match source.below(10) {
        0 => parts.rest_positions.truncate(source.below(4) as usize),
        1 => parts.groups = (0..count).map(|_| source.number(2)).collect(),
        2 => parts.distances.truncate(source.below(2) as usize),
        3 => parts.free_vertices = source.number(count) as usize,
        4 => parts.areas = source.odd_list(count),
        5 => parts.seam_pairs = vec![[source.number(count), source.number(count)]],
        6 => parts.ties = vec![[0; 3].map(|_| source.number(count))],
        _ => {}
    }
    Some(parts)
}

pub fn surfaces(source: &mut Source<'_>) {
    let Some(parts) = parts(source) else { return };
    let (rest, free) = (parts.rest_positions.clone(), 3 * parts.free_vertices);
    let Ok(surface) = Surface::new(parts) else { return };
    let vertex = source.number(surface.vertex_count());
    let _ = surface.group(vertex);
    let _ = surface.pair_distances(vertex, source.number(surface.vertex_count()));

    let groups = surface.group_distances().len();
    let mut settings =
        SurfaceSettings::new(source.mostly_positive(6), vec![0.3; source.length(groups * groups)]);
    if source.below(6) == 0 {
        settings.sticking_displacement = source.odd();
        settings.friction_coefficients = source.odd_list(groups * groups);
    }
    let bodies = if source.below(6) == 0 { source.odd_list(6) } else { rest[free..].to_vec() };
    let Ok(mut contact) = SurfaceContact::new(surface, settings, bodies.clone()) else { return };
    let start = if source.below(4) == 0 { source.odd_list(free) } else { rest[..free].to_vec() };
    let _ = contact.detect(&start);
    let _ = contact.step().map(|_| ());
    let Ok(mut step) = contact.begin(SurfaceStart::new(&start, &bodies)) else { return };
    let (trial, mut forces) = (source.odd_list(free), source.odd_list(free));
    if let Ok(mut energy) = step.energy(&trial) {
        let _ = energy.potential();
        let _ = energy.add_forces(&mut forces);
        let _ = energy.add_stiffness(&mut |_, _| {});
    }
    let mut displacements = source.odd_list(free);
    let held: Vec<usize> = (0..source.below(3)).map(|_| source.number(free / 3) as usize).collect();
    let _ = step.limit(SurfaceTrial {
        start: &start,
        displacements: &mut displacements,
        held: &held,
        obstacle_time: source.odd(),
        obstacle_advance: &mut source.odd(),
    });
    step.set_obstacle_time(source.odd());
    let _ = step.intersections(&trial);
    if source.below(2) == 0 {
        let _ = step.commit(&trial);
    } else {
        step.reject();
    }
}

fn body(source: &mut Source<'_>, mesh: &Triangulation) -> Option<Body> {
    let length = source.mostly_positive(5);
    let edge_radius = if source.below(2) == 0 { 0.0 } else { source.odd() };
    let shape = match source.below(5) {
        0 => Shape::Sphere { radius: length },
        1 => Shape::Box { half_extents: [length; 3], edge_radius },
        2 => Shape::Cylinder { radius: length, half_height: source.odd(), edge_radius },
        3 => Shape::Plane,
        _ => Shape::Mesh(Mesh::new(&mesh.vertices, &mesh.triangles).ok()?),
    };
    let mut pose = Pose::new([0; 3].map(|_| source.odd()));
    if source.below(3) == 0 {
        pose.rotation = [0; 4].map(|_| source.odd());
    }
    Some(Body::new("body", shape, pose).with_friction(source.mostly_positive(4)))
}

pub fn bodies(source: &mut Source<'_>) {
    let vertices = source.odd_points(9);
    let triangles = source.triangles(9, vertices.len());
    let mesh = Triangulation { vertices, triangles };
    let _ = MeshInspection::new(&mesh);
    let _ = repair(&mesh, &RepairSettings::for_spacing(source.mostly_positive(4)));
    let plane = SectionPlane::horizontal(source.odd());
    let _ = plane.lines(&mesh);
    let _ = plane.pieces(&mesh);
    let _ = SectionPlane::through(&mesh.vertices);
    if let Ok(surface) = NearestSurface::new(&mesh.vertices, &mesh.triangles) {
        let _ = surface.distance([0; 3].map(|_| source.odd()), source.odd());
    }

    let other = source.odd_points(6);
    let other_triangles = source.triangles(4, other.len());
    if let Ok(first) = ProximityMesh::new(&mesh.vertices, &mesh.triangles)
        && let Ok(mut second) = ProximityMesh::new(&other, &other_triangles)
    {
        let _ = mesh_distance(&first, &second);
        let end = source.odd_points(9);
        let tolerance = source.mostly_positive(3);
        if let Ok(motion) = first.moving_to(&end) {
            let _ = earliest_impact(&motion, &second.at_rest(), tolerance);
            let _ = earliest_self_impact(&motion, tolerance);
        }
        let _ = second.move_to(&end);
    }

    let bodies: Vec<Body> = (0..source.below(3)).filter_map(|_| body(source, &mesh)).collect();
    for body in &bodies {
        let _ = body.signed_distance([0; 3].map(|_| source.odd()));
        let _ = body.triangulate();
    }
    let count = bodies.len();
    let settings = ParticleSettings {
        activation_distance: source.mostly_positive(6),
        stiffness: source.mostly_positive(6),
        ..ParticleSettings::default()
    };
    let areas = source.odd_list(3).into_iter().map(f64::abs).collect();
    let Ok(mut contact) = ParticleContact::new(bodies, settings, areas) else { return };
    let (start, mut forces) = (source.odd_list(9), source.odd_list(9));
    let _ = contact.begin(&start, source.mostly_positive(4));
    let _ = contact.add_forces(&start, &mut forces);
    let _ = contact.summary(&start);
    let _ = contact.move_body(source.number(count) as usize, Pose::new([source.odd(); 3]));
}
