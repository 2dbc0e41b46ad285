//! Meshes with faults: inspected, repaired, thinned.

use std::f64::consts::PI;

use drape_collide::{
    Mesh, MeshInspection, RepairNote, RepairSettings, Triangulation, read_mesh, repair,
};

/// Returns a ball of rings and sectors, with the poles as vertices.
fn ball(radius: f64, center: [f64; 3], rings: usize) -> Triangulation {
    let sectors = 2 * rings;
    let mut vertices = vec![[0.0, radius, 0.0]];
    for ring in 1..rings {
        let polar = PI * ring as f64 / rings as f64;
        vertices.extend((0..sectors).map(|sector| {
            let around = 2.0 * PI * sector as f64 / sectors as f64;
            let level = radius * polar.sin();
            [level * around.sin(), radius * polar.cos(), level * around.cos()]
        }));
    }
    vertices.push([0.0, -radius, 0.0]);
    let last = vertices.len() as u32 - 1;
    let at = |ring: usize, sector: usize| 1 + ((ring - 1) * sectors + sector % sectors) as u32;
    let mut triangles = Vec::new();
    for sector in 0..sectors {
        triangles.push([0, at(1, sector), at(1, sector + 1)]);
        triangles.push([last, at(rings - 1, sector + 1), at(rings - 1, sector)]);
        for ring in 1..rings - 1 {
            let [a, b] = [sector, sector + 1].map(|sector| at(ring, sector));
            let [c, d] = [sector, sector + 1].map(|sector| at(ring + 1, sector));
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    for vertex in &mut vertices {
        *vertex = std::array::from_fn(|axis| vertex[axis] + center[axis]);
    }
    Triangulation { vertices, triangles }
}

fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

#[test]
fn a_ball_has_its_size_area_and_volume() {
    let inspection = MeshInspection::new(&ball(0.2, [1.0, 0.0, 0.0], 60));
    assert!(inspection.is_closed() && inspection.parts == 1);
    assert_eq!(inspection.intersections.count, 0);
    assert_eq!(inspection.flat_triangles.count, 0);
    let off = (inspection.volume / volume(0.2) - 1.0).abs();
    assert!(off < 2e-3, "volume off by {off}");
    let off = (inspection.area / (4.0 * PI * 0.04) - 1.0).abs();
    assert!(off < 2e-3, "area off by {off}");
    let off = (inspection.size()[1] - 0.4).abs();
    assert!(off < 1e-12, "size off by {off}");
}

#[test]
fn holes_wrong_sides_twins_and_slivers_are_found_and_repaired() {
    let whole = ball(0.2, [0.0; 3], 40);
    let mut broken = whole.clone();
    // A hole of six edges around a vertex, ten triangles turned, one twice, one without area, one
    // that names a vertex twice.
    let center = 800;
    broken.triangles.retain(|triangle| !triangle.contains(&center));
    broken.triangles[100..110].iter_mut().for_each(|triangle| triangle.swap(0, 1));
    broken.triangles.push(broken.triangles[300]);
    broken.triangles.push([5, 5, 6]);
    let last = whole.vertices.len() as u32 - 1;
    broken.vertices.push([0.0, 0.05, 0.0]);
    broken.triangles.push([0, last, last + 1]);
    assert!(Mesh::new(&broken.vertices, &broken.triangles).is_err());
    let found = MeshInspection::new(&broken);
    assert!(!found.is_closed());
    assert!(found.opposed_edges.count >= 12, "{:?}", found.opposed_edges);
    assert!(found.branching_edges.count >= 3, "{:?}", found.branching_edges);
    assert_eq!(found.flat_triangles.count, 1);

    let settings = RepairSettings { thinning_distance: 0.0, ..RepairSettings::for_spacing(0.02) };
    let repaired = repair(&broken, &settings);
    let mesh = &repaired.mesh;
    let inspection = MeshInspection::new(mesh);
    assert!(inspection.is_closed(), "{inspection:?}");
    assert_eq!(inspection.intersections.count, 0);
    Mesh::new(&mesh.vertices, &mesh.triangles).expect("a body");
    let lost = 1.0 - inspection.volume / MeshInspection::new(&whole).volume;
    assert!((0.0..1e-3).contains(&lost), "volume lost: {lost}");
    let notes = &repaired.notes;
    assert!(notes.contains(&RepairNote::Dropped { triangles: 3 }), "{notes:?}");
    assert!(notes.contains(&RepairNote::Turned { triangles: 10 }), "{notes:?}");
    let closed = |note: &RepairNote| matches!(note, RepairNote::Closed { edges: 6, .. });
    assert!(notes.iter().any(closed), "{notes:?}");
}

#[test]
fn a_neck_stays_open_and_is_told() {
    let mut bust = ball(0.2, [0.0; 3], 40);
    bust.triangles.retain(|t| t.iter().all(|v| bust.vertices[*v as usize][1] < 0.15));
    let repaired = repair(&bust, &RepairSettings::for_spacing(0.01));
    let left = repaired.notes.iter().find_map(|note| match note {
        RepairNote::Left { length, place, .. } => Some((*length, place[1])),
        _ => None,
    });
    let (length, height) = left.expect("a hole that is left");
    assert!((0.7..1.0).contains(&length), "{length}");
    assert!((0.13..0.15).contains(&height), "{height}");
    assert_eq!(MeshInspection::new(&repaired.mesh).holes.len(), 1);
}

#[test]
fn a_surface_that_is_inside_out_is_turned() {
    let mut inside_out = ball(0.1, [0.3, 0.0, 0.0], 20);
    inside_out.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    assert!(MeshInspection::new(&inside_out).volume < 0.0);
    let mesh = repair(&inside_out, &RepairSettings::for_spacing(0.01)).mesh;
    assert!(MeshInspection::new(&mesh).volume > 0.0);
}

#[test]
fn corners_of_their_own_are_merged() {
    let ball = ball(0.1, [0.0; 3], 20);
    let corners = ball.triangles.iter().flatten().map(|vertex| ball.vertices[*vertex as usize]);
    let corners: Vec<[f64; 3]> = corners.collect();
    let noise = |k: usize| 1e-9 * (k as f64).sin();
    let soup = Triangulation {
        vertices: corners.iter().enumerate().map(|(k, c)| c.map(|x| x + noise(k))).collect(),
        triangles: (0..ball.triangles.len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect(),
    };
    assert_eq!(MeshInspection::new(&soup).parts, ball.triangles.len());
    let settings = RepairSettings { thinning_distance: 0.0, ..RepairSettings::for_spacing(0.01) };
    let mesh = repair(&soup, &settings).mesh;
    assert_eq!(
        (mesh.vertices.len(), mesh.triangles.len()),
        (ball.vertices.len(), ball.triangles.len())
    );
    // Corners at the very same positions, as in an STL file, are a closed body.
    let same = Triangulation { vertices: corners, triangles: soup.triangles };
    let inspection = MeshInspection::new(&same);
    assert!(inspection.is_closed() && inspection.parts == 1, "{inspection:?}");
    assert_eq!(inspection.vertices, ball.vertices.len());
    assert!(Mesh::new(&same.vertices, &same.triangles).is_ok());
}

/// Returns several meshes as one.
fn together(meshes: &[Triangulation]) -> Triangulation {
    let mut all = Triangulation { vertices: Vec::new(), triangles: Vec::new() };
    for mesh in meshes {
        let first = all.vertices.len() as u32;
        all.vertices.extend(&mesh.vertices);
        all.triangles.extend(mesh.triangles.iter().map(|t| t.map(|vertex| first + vertex)));
    }
    all
}

#[test]
fn a_part_that_is_there_twice_is_no_closed_body_until_it_is_there_once() {
    let one = ball(0.1, [0.0; 3], 20);
    let mut turned = one.clone();
    turned.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    let beside = ball(0.05, [0.3, 0.0, 0.0], 12);
    for twice in [vec![one.clone(), one.clone(), beside.clone()], vec![beside, turned, one]] {
        let twice = together(&twice);
        let inspection = MeshInspection::new(&twice);
        assert!(!inspection.is_closed() && inspection.branching_edges.count > 0);
        assert!(Mesh::new(&twice.vertices, &twice.triangles).is_err());
        let mesh = repair(&twice, &RepairSettings::for_spacing(0.001)).mesh;
        Mesh::new(&mesh.vertices, &mesh.triangles).expect("a body");
        assert_eq!(MeshInspection::new(&mesh).parts, 2);
    }
}

#[test]
fn sheets_that_nearly_touch_stay_apart_in_bodies_that_are_right_and_in_torn_ones() {
    // Two balls whose poles, and all around them, are less apart than vertices are that are merged.
    let low = ball(0.1, [0.0; 3], 20);
    let gap = 4e-7;
    let mut high = low.clone();
    for vertex in &mut high.vertices {
        vertex[1] = 0.2 + gap - vertex[1];
    }
    high.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    let mut whole = together(&[low.clone(), high]);
    // They are flat where they touch, so that whole edges nearly touch.
    for vertex in &mut whole.vertices {
        let [_, y, _] = vertex;
        let (is_low, top) = (*y <= 0.1, low.vertices[1][1]);
        *y = if is_low { y.min(top) } else { y.max(0.2 + gap - top) - 0.2 + 2.0 * top };
    }
    assert!(Mesh::new(&whole.vertices, &whole.triangles).is_ok());
    let settings = RepairSettings { thinning_distance: 0.0, ..RepairSettings::for_spacing(0.02) };
    let repaired = repair(&whole, &settings);
    assert!(repaired.notes.is_empty(), "{:?}", repaired.notes);
    assert_eq!(repaired.mesh.vertices.len(), whole.vertices.len());
    // The same with corners of their own.
    let corners = whole.triangles.iter().flatten().map(|vertex| whole.vertices[*vertex as usize]);
    let corners = corners.enumerate().map(|(k, c)| c.map(|x| x + 1e-9 * (k as f64).sin()));
    let torn = Triangulation {
        vertices: corners.collect(),
        triangles: (0..whole.triangles.len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect(),
    };
    let mesh = repair(&torn, &settings).mesh;
    Mesh::new(&mesh.vertices, &mesh.triangles).expect("a body");
    assert_eq!(mesh.vertices.len(), whole.vertices.len());
}

#[test]
fn no_repair_leaves_a_worse_body() {
    // Faults of all kinds at places that a simple generator of numbers chooses.
    let mut seed: u64 = 7;
    let mut next = move |below: usize| {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as usize % below
    };
    for round in 0..12 {
        let mut mesh = together(&[
            ball(0.1, [0.0; 3], 10),
            ball(0.1, [0.19 + 1e-7 * round as f64, 0.0, 0.0], 10),
        ]);
        for _ in 0..next(6) {
            let [a, b] = [next(mesh.vertices.len()), next(mesh.vertices.len())];
            mesh.vertices[a] = mesh.vertices[b].map(|x| x + 5e-7);
        }
        for _ in 0..next(8) {
            mesh.triangles.remove(next(mesh.triangles.len()));
            mesh.triangles.push(mesh.triangles[next(mesh.triangles.len())]);
        }
        let before = MeshInspection::new(&mesh);
        let repaired = repair(&mesh, &RepairSettings::for_spacing(0.02));
        let after = MeshInspection::new(&repaired.mesh);
        assert!(!after.is_worse_than(&before), "round {round}: {:?}", repaired.notes);
    }
}

#[test]
fn two_balls_in_each_other_intersect_around_their_common_circle() {
    let mut both = ball(0.1, [0.0; 3], 24);
    let other = ball(0.1, [0.12, 0.0, 0.0], 25);
    let count = both.vertices.len() as u32;
    both.vertices.extend(other.vertices);
    both.triangles.extend(other.triangles.iter().map(|t| t.map(|vertex| vertex + count)));
    let inspection = MeshInspection::new(&both);
    assert_eq!(inspection.parts, 2);
    assert!(inspection.intersections.count > 50, "{}", inspection.intersections.count);
    for [x, y, z] in inspection.intersections.first {
        let radius = y.hypot(z);
        assert!((x - 0.06).abs() < 0.01 && (radius - 0.08).abs() < 0.01, "at {x}, {radius}");
    }
}

#[test]
fn a_fine_ball_is_thinned_within_the_distance() {
    let fine = ball(0.15, [0.0; 3], 200);
    assert_eq!(fine.triangles.len(), 159_200);
    let settings = RepairSettings::for_spacing(0.01);
    let Repaired { from, to, distance, mesh } = Repaired::of(&fine, &settings);
    assert_eq!(from, fine.triangles.len());
    assert!(to < from / 8, "{to} triangles of {from}");
    assert!(distance <= settings.thinning_distance, "moved by {distance} m");
    let inspection = MeshInspection::new(&mesh);
    assert!(inspection.is_closed() && inspection.intersections.count == 0);
    assert!(inspection.edge_lengths.max <= settings.edge_length, "{:?}", inspection.edge_lengths);
    let off = (inspection.volume / MeshInspection::new(&fine).volume - 1.0).abs();
    assert!(off < 5e-3, "volume off by {off}");
}

/// Result of a thinning.
struct Repaired {
    from: usize,
    to: usize,
    distance: f64,
    mesh: Triangulation,
}

impl Repaired {
    fn of(mesh: &Triangulation, settings: &RepairSettings) -> Repaired {
        let repaired = repair(mesh, settings);
        let thinned = repaired.notes.iter().find_map(|note| match note {
            RepairNote::Thinned { from, to, distance } => Some((*from, *to, *distance)),
            _ => None,
        });
        let (from, to, distance) = thinned.expect("a mesh that was thinned");
        Repaired { from, to, distance, mesh: repaired.mesh }
    }
}

#[test]
fn hostile_meshes_are_inspected_and_repaired_without_a_panic() {
    let nothing = Triangulation { vertices: Vec::new(), triangles: Vec::new() };
    let dangling = Triangulation { vertices: vec![[0.0; 3]; 3], triangles: vec![[0, 1, 7]] };
    let point =
        Triangulation { vertices: vec![[1.0; 3]; 4], triangles: vec![[0, 1, 2], [1, 2, 3]] };
    let far = Triangulation {
        vertices: vec![[0.0; 3], [1e30, 0.0, 0.0], [0.0, f64::NAN, 0.0]],
        triangles: vec![[0, 1, 2]],
    };
    for mesh in [nothing, dangling, point, far] {
        let _ = MeshInspection::new(&mesh);
        let _ = repair(&mesh, &RepairSettings::for_spacing(0.01));
    }
}

#[test]
fn the_shipped_body_needs_no_repair() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/bodies/body.obj");
    let Ok(body) = read_mesh(path) else { return };
    let inspection = MeshInspection::new(&body);
    assert!(inspection.is_closed(), "{:?}", inspection.holes);
    assert_eq!(inspection.intersections.count, 0, "{:?}", inspection.intersections.first);
    let [_, height, _] = inspection.size();
    assert!((1.5..2.0).contains(&height), "{height}");
}
