//! Cloth between two plates that close on it: who is pinched, what is kept then, and when that
//! ends.

use drape_collide::{
    ContactDistances, PinchPolicy, PinchedVertices, Surface, SurfaceContact, SurfaceParts,
    SurfaceSettings,
};

use crate::sheets::{ALL, Between, KEPT, REACH, SIDE, SPACING, WIDE, level};

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
fn cloth_is_thinned_between_corners_as_well_as_between_faces() {
    // Corners of the plates are inside the cells about the middle of the sheet.
    let mut between = Between::new(PinchPolicy::Thin, 0.2 * SPACING, [-4e-4, 4e-4]);
    assert_eq!(between.step([1e-4, -3e-4], [0.0, -1e-4]), thinned(7));
}

#[test]
fn only_cloth_that_may_be_thinned_keeps_less_than_its_distance() {
    let fraction =
        |policy| Between::new(policy, WIDE, [-4e-4, 4e-4]).contact.state().thinned_fraction();
    assert_eq!(fraction(PinchPolicy::Thin), PinchPolicy::THINNED_FRACTION);
    assert_eq!(fraction(PinchPolicy::Error), 1.0);
    assert_eq!(fraction(PinchPolicy::Release), 1.0);
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
        between.contact.energy(&level(height)).unwrap().add_forces(&mut forces).unwrap();
        forces.iter().skip(1).step_by(3).sum::<f64>()
    };
    assert!(forces(&mut between, 5e-5) > 0.0, "the lower one repels it, the upper one is nearer");
    // The upper one is round the sheet, and released as long as it is.
    assert_eq!(between.step([0.0, -2.5e-4], [5e-5, 5e-5]), released(ALL));
    assert_eq!(between.step([0.0, -2.5e-4], [5e-5, 5e-5]), released(ALL));
    // It goes up again, above the sheet but near it, and has contact once it is out of reach.
    assert_eq!(between.step([0.0, 6e-4], [5e-5, 5e-5]), released(ALL));
    assert_eq!(between.step([0.0, 7e-4], [5e-5, 5e-5]), released(ALL));
    assert_eq!(between.step([0.0, 0.0], [5e-5, 5e-5]), released(0));
}

#[test]
fn cloth_that_a_released_plate_cuts_is_exempt_from_the_test_for_intersections() {
    // The plates are narrower than the sheet, whose outer triangles they cut, far from their faces.
    let half = 1.2 * SPACING;
    let mut between = Between::new(PinchPolicy::Release, half, [-4e-4, 4e-4]);
    let pinched = between.step([0.0, -4e-4], [0.0, 0.0]);
    assert!((10..=ALL).contains(&pinched.released) && pinched.thinned == 0, "{pinched:?}");
    let pinched = between.step([0.0, -8e-4], [0.0, 0.0]);
    let all = between.contact.inspect(&level(0.0)).unwrap().intersections_with_released().unwrap();
    assert!(!all.is_empty() && pinched.released >= 10, "{pinched:?}");
    assert!(between.contact.intersections(&level(0.0)).unwrap().is_empty());
    // Nine vertices are in the plate; those of triangles that it cuts stay released too.
    let again = between.step([0.0, 0.0], [0.0, 0.0]);
    assert_eq!((pinched, again), (released(23), released(23)), "all but two corners");
}

#[test]
fn a_step_that_is_taken_back_takes_its_pinches_back() {
    let mut between = Between::new(PinchPolicy::Thin, WIDE, [-3e-4, 3e-4]);
    let memory = between.contact.state().memory();
    assert_eq!(between.step([0.0, -2e-4], [0.0, -1e-4]), thinned(ALL));
    let bodies = between.contact.state().body_positions().to_vec();
    between.contact.restore(&memory).unwrap();
    assert_eq!(between.contact.state().pinched_vertices(), thinned(0));
    assert_ne!(between.contact.state().body_positions(), &bodies[..]);
    assert!((between.ratio(0.0) - 1.5).abs() < 1e-9, "distances and bodies are as before");
}

#[test]
fn a_contact_goes_on_from_what_was_saved_and_refuses_what_is_of_another() {
    let mut between = Between::new(PinchPolicy::Thin, WIDE, [-3e-4, 3e-4]);
    between.step([0.0, -2e-4], [0.0, -1e-4]);
    let saved = between.contact.state().saved();
    let mut other = Between::new(PinchPolicy::Thin, WIDE, [-3e-4, 3e-4]);
    other.contact.resume(&level(-1e-4), &saved).unwrap();
    assert_eq!(other.contact.state().pinched_vertices(), thinned(ALL));
    assert_eq!(other.contact.state().body_positions(), between.contact.state().body_positions());
    assert_eq!(other.ratio(-1e-4), between.ratio(-1e-4));
    assert_eq!(other.contact.state().saved(), saved);
    assert!(other.contact.resume(&level(0.0)[3..], &saved).is_err(), "a vertex is missing");
    let mut lost = level(-1e-4);
    lost[4] = f64::NAN;
    assert!(other.contact.resume(&lost, &saved).is_err(), "a place is not finite");
    assert!(between.contact.detect(&lost).is_err(), "near by pairs are known");
    assert!(between.contact.pairs().failure().is_some());
    let mut narrow = Between::new(PinchPolicy::Thin, WIDE, [-3e-4, 3e-4]);
    narrow.contact = {
        let bodies = between.contact.state().body_positions();
        let surface = Surface::new(SurfaceParts {
            rest_positions: [&level(0.0)[..], &bodies[..9]].concat(),
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
    assert!(narrow.contact.resume(&level(-1e-4), &saved).is_err(), "it has fewer bodies");
}
