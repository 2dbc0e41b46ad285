//! Faults that are planted in a surface: the exact test finds each, and the step filter leads to
//! none.

use drape_collide::{
    ContactDistances, PinchPolicy, SeamIntersections, Surface, SurfaceContact, SurfaceParts,
    SurfaceSettings, SurfaceStart, SurfaceTrial,
};

type Point = [f64; 3];

const DISTANCES: ContactDistances =
    ContactDistances { activation_distance: 4e-4, min_separation: 1e-4 };

/// Triangles of cloth, each a panel, with the seam pairs of their corners.
fn cloth(triangles: &[[Point; 3]], seam_pairs: &[[u32; 2]]) -> SurfaceParts {
    let count = 3 * triangles.len();
    SurfaceParts {
        // At rest each lies flat and alone.
        rest_positions: (0..count).flat_map(|k| rest_corner(k % 3)).collect(),
        triangles: (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        areas: vec![1e-3; count],
        groups: (0..count as u32).map(|k| k / 3).collect(),
        distances: vec![DISTANCES; triangles.len()],
        free_vertices: count,
        seam_pairs: seam_pairs.to_vec(),
        ties: Vec::new(),
    }
}

fn rest_corner(corner: usize) -> Point {
    [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]][corner]
}

fn contact(parts: SurfaceParts, bodies: Vec<f64>) -> SurfaceContact {
    let groups = parts.distances.len();
    let settings = SurfaceSettings {
        stiffness: 1e8,
        sticking_displacement: 1e-6,
        friction_coefficients: vec![0.0; groups * groups],
        pinch: PinchPolicy::Error,
    };
    SurfaceContact::new(Surface::new(parts).unwrap(), settings, bodies).unwrap()
}

fn flat(triangles: &[[Point; 3]]) -> Vec<f64> {
    triangles.iter().flatten().flatten().copied().collect()
}

/// Number of intersections of triangles of cloth.
fn intersections(triangles: &[[Point; 3]]) -> usize {
    contact(cloth(triangles, &[]), Vec::new()).intersections(&flat(triangles)).unwrap().len()
}

const LOWER: [Point; 3] = [[0.0, 0.1, 0.0], [0.0, 0.1, 0.1], [0.1, 0.1, 0.0]];

fn over(height: f64) -> [Point; 3] {
    [[0.03, height, 0.03], [0.05, 0.2, 0.03], [0.03, 0.2, 0.05]]
}

#[test]
fn a_vertex_is_found_a_millimetre_a_micrometre_and_a_rounding_beyond() {
    for height in [0.099, 0.1 - 1e-6, 0.1_f64.next_down(), 0.1] {
        assert!(intersections(&[LOWER, over(height)]) > 0, "{height}");
    }
    for height in [0.1_f64.next_up(), 0.1 + 1e-6, 0.101] {
        assert_eq!(intersections(&[LOWER, over(height)]), 0, "{height}");
    }
}

#[test]
fn triangles_on_each_other_in_one_plane_are_found() {
    let beside = |x: f64| [[x, 0.1, 0.0], [x, 0.1, 0.1], [x + 0.1, 0.1, 0.0]];
    for x in [0.0, 0.05, 0.1] {
        assert!(intersections(&[LOWER, beside(x)]) > 0, "{x}");
    }
    assert_eq!(intersections(&[LOWER, beside(0.1_f64.next_up())]), 0);
}

#[test]
fn a_flat_fold_is_nearer_than_the_minimum_separation() {
    let mut parts = cloth(&[LOWER], &[]);
    parts.rest_positions.extend([0.1, 0.1, 0.0]);
    parts.triangles.push([2, 1, 3]);
    parts.areas.push(1e-3);
    parts.groups.push(0);
    parts.free_vertices = 4;
    let mut contact = contact(parts, Vec::new());
    let mut nearest = |apex: Point| {
        let positions = [flat(&[LOWER]), apex.to_vec()].concat();
        contact.detect(&positions).unwrap().summary().min_ratio
    };
    assert!(nearest([0.02, 0.1, 0.02]) < 1e-9);
    assert!(nearest([0.02, 0.1 + 1e-6, 0.02]) < 1.0);
    assert!(nearest([0.02, 0.11, 0.02]) > 1.0);
}

/// Moves vertices by what the step filter leaves of displacements.
fn advance(contact: &mut SurfaceContact, positions: &mut [f64], displacements: &mut [f64]) {
    let mut obstacle_advance = 1.0;
    contact
        .step()
        .unwrap()
        .limit(SurfaceTrial {
            start: positions,
            displacements,
            held: &[],
            obstacle_time: 0.0,
            obstacle_advance: &mut obstacle_advance,
        })
        .unwrap();
    positions.iter_mut().zip(displacements).for_each(|(x, step)| *x += *step);
}

/// Steps that would end beyond a sheet, or on it, are shortened again and again: none reaches it.
#[test]
fn the_step_filter_leads_to_no_planted_fault() {
    let start = flat(&[LOWER, over(0.105)]);
    let mut contact = contact(cloth(&[LOWER, over(0.105)], &[]), Vec::new());
    for end in [0.099, 0.1 - 1e-6, 0.1_f64.next_down(), 0.1, 0.1 + 1e-6] {
        contact.begin(SurfaceStart::new(&start, &[])).unwrap();
        let mut positions = start.clone();
        for _ in 0..100 {
            let mut displacements = vec![0.0; positions.len()];
            displacements[10] = end - positions[10];
            advance(&mut contact, &mut positions, &mut displacements);
        }
        let kept = positions[10] - 0.1;
        let least = 2.0 * DISTANCES.min_separation;
        assert!(kept >= least && kept < 1.01 * least, "{end}: {kept}");
        assert_eq!(contact.intersections(&positions).unwrap(), []);
    }
}

#[test]
fn a_sheet_inside_a_ball_is_inside() {
    let mut parts = cloth(&[LOWER], &[]);
    // An octahedron of 0.3 m about (0, 0.1, 0).
    let axis = |k: usize, sign: f64| {
        [0, 1, 2].map(|j| if j == k { 0.3 * sign } else { 0.0 } + if j == 1 { 0.1 } else { 0.0 })
    };
    let body: Vec<f64> =
        (0..6).flat_map(|k| axis(k / 2, if k % 2 == 0 { 1.0 } else { -1.0 })).collect();
    for [x, y, z] in [[0, 2, 4], [0, 5, 2], [0, 4, 3], [0, 3, 5], [1, 4, 2], [1, 2, 5]]
        .into_iter()
        .chain([[1, 3, 4], [1, 5, 3]])
    {
        parts.triangles.push([x, y, z].map(|corner: u32| corner + 3));
    }
    parts.rest_positions.extend(&body);
    parts.areas.extend([0.0; 6]);
    parts.groups.extend([1; 6]);
    parts.distances.push(DISTANCES);
    let contact = contact(parts, body);
    let at = |x: f64| flat(&[LOWER.map(|[a, y, z]| [a + x, y, z])]);
    assert!(
        (0..3).all(|vertex| contact.inspect(&at(0.0)).unwrap().is_inside_body(vertex).unwrap())
    );
    assert!(
        (0..3).all(|vertex| !contact.inspect(&at(1.0)).unwrap().is_inside_body(vertex).unwrap())
    );
    // No surface of the two meets.
    assert_eq!(contact.inspect(&at(0.0)).unwrap().intersections_with_released().unwrap(), []);
    assert!(!contact.inspect(&at(0.25)).unwrap().intersections_with_released().unwrap().is_empty());
}

/// Two triangles that are sewn together at two corners, with their edges so far apart along y and
/// z, the second turned to one side.
fn sewn(gap: [f64; 2], apex: Point) -> [[Point; 3]; 2] {
    let [y, z] = gap;
    let first = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.05, -0.1, 0.0]];
    [first, [[0.0, y, z], [0.1, y, z], apex]]
}

const TWINS: [[u32; 2]; 2] = [[0, 3], [1, 4]];

#[test]
fn sides_of_a_seam_cross_where_it_is_open_and_not_where_it_is_closed() {
    let crossing = sewn([-0.05, -0.008], [0.05, -0.05, 0.1]);
    let mut contact = contact(cloth(&crossing, &TWINS), Vec::new());
    let positions = flat(&crossing);
    assert_eq!(contact.intersections(&positions).unwrap(), []);
    let gap = 0.05_f64.hypot(0.008);
    let gaps = [gap, gap, f64::INFINITY, gap, gap, f64::INFINITY];
    contact.setup().unwrap().open_seams(&gaps, &positions).unwrap();
    assert!(!contact.intersections(&positions).unwrap().is_empty());
    let apart = flat(&sewn([0.008, 0.0], [0.05, 0.1, 0.0]));
    assert_eq!(contact.intersections(&apart).unwrap(), []);
    contact.setup().unwrap().close_seams();
    assert_eq!(contact.intersections(&positions).unwrap(), []);
}

/// Gap of a closed seam, in m.
const CLOSED: f64 = 1e-4;

#[test]
fn intersections_within_the_gap_of_a_seam_that_counts_as_closed_are_counted_with_their_depth() {
    // The edge of the second goes through the first, at its corners to the front and to the back.
    let across = |gap: f64| {
        let [first, mut second] = sewn([-gap, 0.0], [0.05, 0.1, 0.0]);
        (second[0][2], second[1][2]) = (-0.1 * gap, 0.1 * gap);
        flat(&[first, second])
    };
    let mut contact = contact(cloth(&sewn([8e-3, 0.0], [0.05, 0.1, 0.0]), &TWINS), Vec::new());
    let gaps = |gap: f64| [gap, gap, f64::INFINITY, gap, gap, f64::INFINITY];
    contact
        .setup()
        .unwrap()
        .open_seams(&gaps(8e-3), &flat(&sewn([8e-3, 0.0], [0.05, 0.1, 0.0])))
        .unwrap();
    let none = SeamIntersections::default();
    assert_eq!(
        contact.inspect(&across(5e-5)).unwrap().seam_intersections(CLOSED),
        Ok(none),
        "they are found by the test"
    );
    assert!(!contact.intersections(&across(5e-5)).unwrap().is_empty());
    let closed = gaps(0.0);
    let start = across(5e-5);
    let start = SurfaceStart { seam_gaps: Some(&closed), ..SurfaceStart::new(&start, &[]) };
    contact.begin(start).unwrap().reject();
    assert_eq!(contact.intersections(&across(5e-5)).unwrap(), []);
    // The edge rises by a tenth of the gap on both sides of the face.
    let within = contact.inspect(&across(5e-5)).unwrap().seam_intersections(CLOSED).unwrap();
    assert!(within.exempt > 0 && within.open == 0, "{within:?}");
    assert!((0.09..0.1001).contains(&(within.penetration / 5e-5)), "{within:?}");
    let beyond = contact.inspect(&across(5e-4)).unwrap().seam_intersections(CLOSED).unwrap();
    assert_eq!((beyond.exempt, beyond.open, beyond.penetration), (0, within.exempt, 0.0));
    assert_eq!(
        contact.inspect(&across(0.0)).unwrap().seam_intersections(CLOSED),
        Ok(none),
        "they are one edge"
    );
    contact.setup().unwrap().close_seams();
    assert_eq!(contact.inspect(&across(5e-5)).unwrap().seam_intersections(CLOSED), Ok(none));
    assert!(
        contact.inspect(&[f64::NAN; 18]).unwrap().seam_intersections(CLOSED).is_ok(),
        "no seam is open"
    );
    contact.setup().unwrap().open_seams(&gaps(0.0), &across(0.0)).unwrap();
    assert!(contact.inspect(&[f64::NAN; 18]).unwrap().seam_intersections(CLOSED).is_err());
}

#[test]
fn intersections_of_a_tied_vertex_are_as_deep_as_its_triangle_is_behind_the_edge() {
    // The first corner of the second comes to lie on the upper edge of the first, and is behind it.
    let at = |y: f64, z: f64| {
        let first = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.05, -0.1, 0.0]];
        flat(&[first, [[0.05, y, z], [0.05, 0.1, 0.05], [0.06, 0.1, 0.05]]])
    };
    let mut parts = cloth(&[LOWER, LOWER], &[]);
    parts.ties.push([3, 0, 1]);
    let mut contact = contact(parts, Vec::new());
    let gaps = [f64::INFINITY, f64::INFINITY, f64::INFINITY, 0.0, f64::INFINITY, f64::INFINITY];
    contact.setup().unwrap().open_seams(&gaps, &at(1e-3, 0.0)).unwrap();
    let crossings = contact.inspect(&at(-4e-5, -1e-5)).unwrap().seam_intersections(CLOSED).unwrap();
    // The plane of the second rises along (y, z) behind the edge, and passes it at this distance.
    let [y, z] = [0.1 + 4e-5, 0.05 + 1e-5_f64];
    let depth = (1e-5 * y - 4e-5 * z).abs() / y.hypot(z);
    assert!(
        crossings.exempt > 0 && (crossings.penetration - depth).abs() < 1e-9 * depth,
        "{crossings:?}"
    );
    assert_eq!(crossings.open, 0);
    assert_eq!(
        contact.inspect(&at(-4e-5, 1e-5)).unwrap().seam_intersections(CLOSED).unwrap().exempt,
        0,
        "before it"
    );
}

#[test]
fn sides_of_an_open_seam_keep_a_tenth_of_its_gap_and_end_apart() {
    // The second lies over the first, which its seam is to reach.
    let start = sewn([-0.02, 0.005], [0.05, -0.08, 0.005]);
    let mut contact = contact(cloth(&start, &TWINS), Vec::new());
    let start = flat(&start);
    let gap = 0.02_f64.hypot(0.005);
    let gaps = |gap: f64| [gap, gap, f64::INFINITY, gap, gap, f64::INFINITY];
    contact.setup().unwrap().open_seams(&gaps(gap), &start).unwrap();
    for gap in [gap, 1e-3, 1e-4, 2e-5] {
        let gaps = gaps(gap);
        contact
            .begin(SurfaceStart { seam_gaps: Some(&gaps), ..SurfaceStart::new(&start, &[]) })
            .unwrap();
        let mut positions = start.clone();
        for _ in 0..200 {
            let mut displacements = vec![0.0; positions.len()];
            (3..6).for_each(|vertex| displacements[3 * vertex + 2] = -0.01);
            advance(&mut contact, &mut positions, &mut displacements);
        }
        let kept = positions[3 * 3 + 2];
        let least = (2.0 * DISTANCES.min_separation).min(0.1 * gap);
        assert!(kept >= least && kept < 1.01 * least, "{kept} m of {least} m at {gap} m");
        assert_eq!(contact.intersections(&positions).unwrap(), []);
    }
    contact.step().unwrap().reject();
    // A seam that is taken for closed lets one side through the other.
    contact.setup().unwrap().close_seams();
    contact.begin(SurfaceStart::new(&start, &[])).unwrap();
    let mut positions = start.clone();
    for _ in 0..20 {
        let mut displacements = vec![0.0; positions.len()];
        (3..6).for_each(|vertex| displacements[3 * vertex + 2] = -0.0005);
        advance(&mut contact, &mut positions, &mut displacements);
    }
    contact.step().unwrap().reject();
    contact.setup().unwrap().open_seams(&gaps(gap), &positions).unwrap();
    assert!(!contact.intersections(&positions).unwrap().is_empty());
}
