//! Cloth between two plates that close on it: who is pinched, what is kept then, and when that ends.

use drape_collide::{
    Body, ContactDistances, PinchPolicy, PinchedVertices, Pose, Shape, Surface, SurfaceContact,
    SurfaceParts, SurfaceSettings,
};

/// Vertices along a side of the sheet, and their distance, in m.
const SIDE: usize = 5;
const SPACING: f64 = 0.01;

/// Distance that a sheet keeps from a plate, and that at which a plate begins to repel it, in m.
const KEPT: f64 = 2e-4;
const REACH: f64 = 6e-4;

/// Thickness of a plate, in m.
const THICKNESS: f64 = 1e-3;

/// Level sheet between two plates, its vertices and the plates' at some heights.
struct Between {
    contact: SurfaceContact,
    /// Heights of the upper face of the lower plate, and of the lower face of the upper one, in m.
    faces: [f64; 2],
    /// Half of the sides of the plates, in m.
    half: f64,
}

impl Between {
    /// Sheet between plates of some half sides, in m, whose faces are at some heights, in m.
    fn new(pinch: PinchPolicy, half: f64, faces: [f64; 2]) -> Self {
        let plates = plates(half, faces);
        let free = SIDE * SIDE;
        let row = SIDE as u32;
        let cells = (0..row * (row - 1)).filter(|k| k % row < row - 1);
        let mut triangles: Vec<[u32; 3]> =
            cells.flat_map(|a| [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]).collect();
        let mut groups = vec![0; free];
        for (group, (corners, own)) in plates.iter().enumerate() {
            let first = groups.len() as u32;
            triangles.extend(own.iter().map(|t| t.map(|corner| corner + first)));
            groups.resize(groups.len() + corners.len() / 3, group as u32 + 1);
        }
        let bodies = [&plates[0].0[..], &plates[1].0].concat();
        let own = ContactDistances { activation_distance: 0.5 * REACH, min_separation: 0.5 * KEPT };
        let surface = Surface::new(SurfaceParts {
            rest_positions: [sheet(0.0), bodies.clone()].concat(),
            triangles,
            areas: vec![SPACING * SPACING; groups.len()],
            groups,
            distances: vec![own; 3],
            free_vertices: free,
            seam_pairs: Vec::new(),
            ties: Vec::new(),
        });
        let settings = SurfaceSettings { pinch, ..SurfaceSettings::new(1e8, vec![0.0; 9]) };
        let contact = SurfaceContact::new(surface.unwrap(), settings, bodies).unwrap();
        Self { contact, faces, half }
    }

    /// Makes a step in which the faces move by some ways, in m, and the sheet from a height to
    /// another one, in m; returns who is pinched since.
    fn step(&mut self, ways: [f64; 2], [from, to]: [f64; 2]) -> PinchedVertices {
        self.faces = [0, 1].map(|k| self.faces[k] + ways[k]);
        let [lower, upper] = plates(self.half, self.faces);
        self.contact.begin(&sheet(from), &[lower.0, upper.0].concat());
        self.contact.commit(&sheet(to));
        self.contact.pinched_vertices()
    }

    /// Smallest distance of the sheet at a height, in m, over what is kept.
    fn ratio(&mut self, height: f64) -> f64 {
        self.contact.summary_at(&sheet(height)).unwrap().min_ratio
    }
}

/// Vertices and triangles of two plates with some half sides, in m, whose faces are at some heights, in m.
fn plates(half: f64, faces: [f64; 2]) -> [(Vec<f64>, Vec<[u32; 3]>); 2] {
    let half_extents = [half, 0.5 * THICKNESS, half];
    let middles = [faces[0] - 0.5 * THICKNESS, faces[1] + 0.5 * THICKNESS];
    middles.map(|y| {
        let shape = Shape::Box { half_extents, edge_radius: 0.0 };
        let plate = Body::new("plate", shape, Pose::new([0.0, y, 0.0])).triangulate().unwrap();
        (plate.vertices.as_flattened().to_vec(), plate.triangles)
    })
}

/// Level sheet at a height, in m.
fn sheet(height: f64) -> Vec<f64> {
    let place = |k: usize| SPACING * (k as f64 - 0.5 * (SIDE - 1) as f64);
    (0..SIDE * SIDE).flat_map(|v| [place(v % SIDE), height, place(v / SIDE)]).collect()
}

/// Half side of plates that are wider than the sheet, in m.
const WIDE: f64 = 0.03;

/// All vertices of the sheet.
const ALL: usize = SIDE * SIDE;

fn thinned(thinned: usize) -> PinchedVertices {
    PinchedVertices { thinned, released: 0 }
}

fn released(released: usize) -> PinchedVertices {
    PinchedVertices { thinned: 0, released }
}

#[test]
fn cloth_is_thinned_where_plates_leave_little_room_and_until_they_are_far() {
    let mut between = Between::new(PinchPolicy::Thin, WIDE, [-4e-4, 4e-4]);
    // 0.6 mm are left, of which 0.4 are kept.
    assert_eq!(between.step([0.0, -2e-4], [0.0, -1e-4]), thinned(0));
    assert!((between.ratio(-1e-4) - 1.5).abs() < 1e-9);
    // 0.4 mm are left; the sheet is in their middle.
    assert_eq!(between.step([0.0, -2e-4], [-1e-4, -2e-4]), thinned(ALL));
    let ratio = between.ratio(-2e-4);
    assert!((ratio * PinchPolicy::THINNED_FRACTION - 1.0).abs() < 1e-9, "{ratio}");
    // They part; the sheet is nearer than twice what is kept at first, and then further.
    assert_eq!(between.step([0.0, 2.5e-4], [-2e-4, -7.5e-5]), thinned(ALL));
    assert_eq!(between.step([0.0, 4e-4], [-7.5e-5, 1.25e-4]), thinned(ALL));
    assert_eq!(between.step([0.0, 0.0], [1.25e-4, 1.25e-4]), thinned(0));
    assert!((between.ratio(1.25e-4) - 5.25e-4 / KEPT).abs() < 1e-9);
}

#[test]
fn cloth_is_never_pinched_where_that_is_an_error() {
    let mut between = Between::new(PinchPolicy::Error, WIDE, [-4e-4, 4e-4]);
    assert_eq!(between.step([0.0, -4e-4], [0.0, -2e-4]), thinned(0));
    assert!((between.ratio(-2e-4) - 1.0).abs() < 1e-9);
}

#[test]
fn the_plate_that_approaches_more_passes_through_the_cloth() {
    let mut between = Between::new(PinchPolicy::Release, WIDE, [-4e-4, 4e-4]);
    assert_eq!(between.step([1e-4, -3e-4], [0.0, -1.5e-4]), released(ALL));
    // The lower plate is 0.15 mm below the sheet, and the upper one no longer counts.
    let forces = |between: &mut Between, height: f64| {
        let mut forces = vec![0.0; 3 * ALL];
        between.contact.add_forces(&sheet(height), &mut forces);
        forces.iter().skip(1).step_by(3).sum::<f64>()
    };
    assert!(forces(&mut between, 5e-5) > 0.0, "the lower one repels it, the upper one is nearer");
    // The upper one is round the sheet, and released as long as it is.
    assert_eq!(between.step([0.0, -2.5e-4], [5e-5, 5e-5]), released(ALL));
    assert_eq!(between.step([0.0, -2.5e-4], [5e-5, 5e-5]), released(ALL));
    // It goes up again, and has contact once it is out of reach.
    assert_eq!(between.step([0.0, 1.3e-3], [5e-5, 5e-5]), released(ALL));
    assert_eq!(between.step([0.0, 0.0], [5e-5, 5e-5]), released(0));
}

#[test]
fn cloth_that_a_released_plate_cuts_is_exempt_from_the_test_for_intersections() {
    // The plates are narrower than the sheet, whose outer triangles they cut.
    let half = 1.2 * SPACING;
    let mut between = Between::new(PinchPolicy::Release, half, [-4e-4, 4e-4]);
    let pinched = between.step([0.0, -4e-4], [0.0, 0.0]);
    assert!(pinched.released >= 9 && pinched.thinned == 0, "{pinched:?}");
    let pinched = between.step([0.0, -4e-4], [0.0, 0.0]);
    let all = between.contact.intersections_with_released(&sheet(0.0)).unwrap();
    assert!(!all.is_empty() && pinched.released >= 9, "{pinched:?}");
    assert!(between.contact.intersections(&sheet(0.0)).unwrap().is_empty());
    // Vertices that the plate cuts, or contains, stay released while it stays.
    let again = between.step([0.0, 0.0], [0.0, 0.0]);
    assert!(again.released >= 9 && again.released <= pinched.released, "{again:?}");
}

#[test]
fn a_step_that_is_taken_back_takes_its_pinches_back() {
    let mut between = Between::new(PinchPolicy::Thin, WIDE, [-3e-4, 3e-4]);
    let memory = between.contact.memory();
    assert_eq!(between.step([0.0, -2e-4], [0.0, -1e-4]), thinned(ALL));
    let bodies = between.contact.body_positions().to_vec();
    between.contact.restore(&memory);
    assert_eq!(between.contact.pinched_vertices(), thinned(0));
    assert_ne!(between.contact.body_positions(), &bodies[..]);
    assert!((between.ratio(0.0) - 1.5).abs() < 1e-9, "distances and bodies are as before");
}

#[test]
fn a_contact_goes_on_from_what_was_saved_and_refuses_what_is_of_another() {
    let mut between = Between::new(PinchPolicy::Thin, WIDE, [-3e-4, 3e-4]);
    between.step([0.0, -2e-4], [0.0, -1e-4]);
    let saved = between.contact.saved();
    let mut other = Between::new(PinchPolicy::Thin, WIDE, [-3e-4, 3e-4]);
    other.contact.resume(&sheet(-1e-4), &saved).unwrap();
    assert_eq!(other.contact.pinched_vertices(), thinned(ALL));
    assert_eq!(other.contact.body_positions(), between.contact.body_positions());
    assert_eq!(other.ratio(-1e-4), between.ratio(-1e-4));
    assert_eq!(other.contact.saved(), saved);
    assert!(other.contact.resume(&sheet(0.0)[3..], &saved).is_err(), "a vertex is missing");
    let mut lost = sheet(-1e-4);
    lost[4] = f64::NAN;
    assert!(other.contact.resume(&lost, &saved).is_err(), "a place is not finite");
    assert!(between.contact.summary_at(&lost).is_err(), "near by pairs are known");
    assert!(between.contact.failure().is_some());
    let mut narrow = Between::new(PinchPolicy::Thin, WIDE, [-3e-4, 3e-4]);
    narrow.contact = {
        let bodies = between.contact.body_positions();
        let surface = Surface::new(SurfaceParts {
            rest_positions: [&sheet(0.0)[..], &bodies[..9]].concat(),
            triangles: vec![[0, SIDE as u32, 1], [ALL as u32, ALL as u32 + 1, ALL as u32 + 2]],
            areas: vec![1e-4; ALL + 3],
            groups: (0..ALL + 3).map(|v| u32::from(v >= ALL)).collect(),
            distances: vec![
                ContactDistances { activation_distance: REACH, min_separation: KEPT };
                2
            ],
            free_vertices: ALL,
            seam_pairs: Vec::new(),
            ties: Vec::new(),
        });
        let settings = SurfaceSettings::new(1e8, vec![0.0; 4]);
        SurfaceContact::new(surface.unwrap(), settings, bodies[..9].to_vec()).unwrap()
    };
    assert!(narrow.contact.resume(&sheet(-1e-4), &saved).is_err(), "it has fewer bodies");
}
