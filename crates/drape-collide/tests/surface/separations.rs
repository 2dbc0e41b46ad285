//! Minimum separations of surfaces: while they grow, after surfaces are placed, and between the
//! sides of open seams.

use drape_collide::{
    ContactDistances, PinchPolicy, SewnPlacement, Surface, SurfaceContact, SurfaceParts,
    SurfaceSettings, SurfaceStart, SurfaceTrial,
};

use crate::sheets::{Between, KEPT, REACH, WIDE, level, plates};

/// Sheet with room of 0.12 and 0.34 mm to the plates, less than the 0.2 mm that it is to keep.
fn tight() -> Between {
    let mut tight = Between::new(PinchPolicy::Error, WIDE, [-1.2e-4, 3.4e-4]);
    tight.contact.setup().unwrap().shrink_distances(&level(0.0)).unwrap();
    tight
}

/// Result of a step in which distances grow.
struct Growth {
    /// Fraction of the distances that is kept after the step.
    fraction: f64,
    /// Energy that the growth added, in J.
    work: f64,
}

/// Grows the distances by an increment in a step at one place.
fn grow(between: &mut Between, growth_increment: f64, height: f64) -> Growth {
    let contact = &mut between.contact;
    let (positions, bodies) = (level(height), contact.state().body_positions().to_vec());
    let start = SurfaceStart { growth_increment, ..SurfaceStart::new(&positions, &bodies) };
    let step = contact.begin(start).unwrap();
    let work = step.growth_work();
    step.commit(&positions).unwrap();
    Growth { fraction: contact.state().growth_fraction(), work }
}

#[test]
fn distances_shrink_to_the_nearest_pair_and_grow_by_increments_to_the_whole() {
    let mut between = tight();
    let start = 1.2e-4 / REACH;
    assert!((between.contact.state().growth_fraction() - start).abs() < 1e-9);
    assert_eq!(between.contact.energy(&level(0.0)).unwrap().potential(), 0.0, "no pair is active");
    let grown = grow(&mut between, 0.1, 0.0);
    assert!((grown.fraction - start - 0.1).abs() < 1e-9 && grown.work > 0.0);
    // Nine tenths of the distance may become what is kept, and no more.
    let most = 0.9 * 1.2e-4 / KEPT;
    for _ in 0..3 {
        assert!((grow(&mut between, 0.4, 0.0).fraction - most).abs() < 1e-9);
    }
    // In the middle there is room; a tenth too little for the whole grows on, rounding does not.
    let middle = 1.1e-4;
    assert!((grow(&mut between, 0.9 - most, middle).fraction - 0.9).abs() < 1e-9);
    assert_eq!(grow(&mut between, 0.1 - 1e-12, middle).fraction, 1.0);
    let grown = grow(&mut between, 0.1, middle);
    assert_eq!((grown.fraction, grown.work), (1.0, 0.0), "nothing grows any more");
}

#[test]
fn the_work_of_a_growth_is_the_energy_that_it_adds() {
    let mut between = tight();
    grow(&mut between, 0.1, 0.0);
    let before = between.contact.energy(&level(0.0)).unwrap().potential();
    let work = grow(&mut between, 0.1, 0.0).work;
    let added = between.contact.energy(&level(0.0)).unwrap().potential() - before;
    assert!(before > 0.0 && added > 0.0, "{before} J, {added} J");
    assert!((work - added).abs() < 1e-12 * added, "{work} J for {added} J");
}

#[test]
fn what_is_kept_never_falls_while_distances_grow() {
    let mut between = tight();
    let fraction = grow(&mut between, 0.2, 0.0).fraction;
    // Nearer to the plate there is room for less than is kept already.
    assert_eq!(grow(&mut between, 0.2, -4e-5).fraction, fraction);
}

#[test]
fn a_place_is_free_with_its_least_separation_or_intersects_at_known_vertices() {
    let mut between = Between::new(PinchPolicy::Error, WIDE, [-4e-4, 4e-4]);
    let bodies = between.contact.state().body_positions().to_vec();
    let memory = between.contact.state().memory();
    let free = between.contact.setup().unwrap().sewn_placement(&level(1e-4), &bodies).unwrap();
    let SewnPlacement::Free(ratio) = free else { panic!("{free:?}") };
    assert!((ratio - 3e-4 / KEPT).abs() < 1e-9, "{ratio}");
    // One corner of the sheet is in the upper plate.
    let mut corner = level(0.0);
    corner[1] = 5e-4;
    let placement = between.contact.setup().unwrap().sewn_placement(&corner, &bodies).unwrap();
    let SewnPlacement::Intersecting(intersections) = placement else { panic!("{placement:?}") };
    let surface = between.contact.surface();
    for [a, b, c, d, e] in &intersections {
        assert!(surface.edges().contains(&[*a, *b]), "{a} and {b} are no edge");
        assert!(surface.triangles().contains(&[*c, *d, *e]), "{c}, {d} and {e} are no triangle");
        assert!([a, b, c, d, e].contains(&&0), "it is not at the corner");
    }
    assert!(!intersections.is_empty());
    // Where the plates are elsewhere, the same sheet is free; nothing of that stays.
    let [lower, upper] = plates(WIDE, [-4e-4, 9e-4]);
    let apart = [lower.0, upper.0].concat();
    let free = between.contact.setup().unwrap().sewn_placement(&corner, &apart).unwrap();
    assert!(matches!(free, SewnPlacement::Free(ratio) if (ratio - 2.0).abs() < 1e-6), "{free:?}");
    assert!(
        between.contact.state().memory() == memory
            && between.contact.state().body_positions() == bodies
    );
    assert!(
        between.contact.setup().unwrap().sewn_placement(&corner, &bodies[3..]).is_err(),
        "a vertex is missing"
    );
}

#[test]
fn surfaces_are_placed_and_their_distances_shrink_to_what_there_is() {
    let mut between = Between::new(PinchPolicy::Error, WIDE, [-4e-4, 4e-4]);
    let [lower, upper] = plates(WIDE, [-1e-4, 4e-4]);
    let bodies = [lower.0, upper.0].concat();
    between.contact.setup().unwrap().place_bodies(&bodies).unwrap();
    assert_eq!(between.contact.state().body_positions(), bodies);
    assert!((between.ratio(0.0) - 0.5).abs() < 1e-9);
    between.contact.setup().unwrap().shrink_to_separation(&level(0.0)).unwrap();
    assert!((between.contact.state().growth_fraction() - 0.45).abs() < 1e-9, "nine tenths of it");
    assert!((between.ratio(0.0) - 1.0 / 0.9).abs() < 1e-9);
    between.contact.setup().unwrap().shrink_to_separation(&level(0.0)).unwrap();
    assert!((between.contact.state().growth_fraction() - 0.45).abs() < 1e-9, "there is room now");
    assert!(
        between.contact.setup().unwrap().place_bodies(&bodies[3..]).is_err(),
        "a vertex is missing"
    );
}

#[test]
fn settings_out_of_range_are_refused() {
    let contact = |change: &dyn Fn(&mut SurfaceSettings)| {
        let between = Between::new(PinchPolicy::Error, WIDE, [-4e-4, 4e-4]);
        let mut settings = SurfaceSettings::new(1e8, vec![0.0; 9]);
        change(&mut settings);
        let bodies = between.contact.state().body_positions().to_vec();
        SurfaceContact::new(between.contact.surface().clone(), settings, bodies)
    };
    assert!(contact(&|_| ()).is_ok());
    let zero: [&dyn Fn(&mut SurfaceSettings); 5] = [
        &|own| own.stiffness = 0.0,
        &|own| own.sticking_displacement = 0.0,
        &|own| own.stiffness = f64::NAN,
        &|own| own.friction_coefficients[8] = -1e-9,
        &|own| own.friction_coefficients.truncate(8),
    ];
    for (k, change) in zero.into_iter().enumerate() {
        assert!(contact(change).is_err(), "{k}");
    }
}

#[test]
fn steps_are_limited_by_a_plate_where_it_is_since_it_moved() {
    let mut between = Between::new(PinchPolicy::Error, WIDE, [-4e-3, 4e-3]);
    let sink = |between: &mut Between| {
        let bodies = between.contact.state().body_positions().to_vec();
        let mut displacements = level(-3e-3);
        let start = level(0.0);
        displacements.iter_mut().zip(&start).for_each(|(x, start)| *x -= start);
        let mut step = between.contact.begin(SurfaceStart::new(&start, &bodies)).unwrap();
        step.limit(SurfaceTrial {
            start: &start,
            displacements: &mut displacements,
            held: &[],
            obstacle_time: 1.0,
            obstacle_advance: &mut 0.0,
        })
        .unwrap();
        step.commit(&start).unwrap();
        displacements[1]
    };
    assert_eq!(sink(&mut between), -3e-3, "the plate is 4 mm below");
    between.step([3e-3, 0.0], [0.0, 0.0]);
    let sunk = sink(&mut between);
    assert!((-8e-4..-1e-4).contains(&sunk), "{sunk} m, and the plate is 1 mm below");
}

/// Two squares of 10 mm, one above the other with a slit between them, in one plane, and the
/// contact of their sides, which a seam joins.
fn slit(width: f64) -> Vec<f64> {
    let rows = [-0.01 - 0.5 * width, -0.5 * width, 0.5 * width, 0.01 + 0.5 * width];
    rows.iter().flat_map(|y| [0.0, *y, 0.0, 0.01, *y, 0.0]).collect()
}

fn seam() -> SurfaceContact {
    let surface = Surface::new(SurfaceParts {
        rest_positions: slit(0.02),
        triangles: vec![[0, 1, 2], [1, 3, 2], [4, 5, 6], [5, 7, 6]],
        areas: vec![5e-5; 8],
        groups: vec![0, 0, 0, 0, 1, 1, 1, 1],
        distances: vec![ContactDistances { activation_distance: 1e-4, min_separation: 2e-5 }; 2],
        free_vertices: 8,
        seam_pairs: vec![[2, 4], [3, 5]],
        ties: Vec::new(),
    });
    let settings = SurfaceSettings::new(1e8, vec![0.0; 4]);
    SurfaceContact::new(surface.unwrap(), settings, Vec::new()).unwrap()
}

/// Gap at each vertex for an open seam of a width, in m; infinite away from the seam.
fn gaps(width: f64) -> Vec<f64> {
    (0..8).map(|v| if (2..6).contains(&v) { width } else { f64::INFINITY }).collect()
}

/// Narrows the gaps of the open seam to a width, in m, by a step that is rejected.
fn narrow(contact: &mut SurfaceContact, width: f64) {
    let (gaps, positions) = (gaps(width), slit(2e-4));
    let start = SurfaceStart { seam_gaps: Some(&gaps), ..SurfaceStart::new(&positions, &[]) };
    contact.begin(start).unwrap().reject();
}

#[test]
fn sides_of_an_open_seam_repel_each_other_below_half_of_its_gap() {
    let mut contact = seam();
    contact.setup().unwrap().open_seams(&gaps(2e-4), &slit(2e-4)).unwrap();
    assert_eq!(contact.energy(&slit(1.1e-4)).unwrap().potential(), 0.0);
    assert!(contact.energy(&slit(0.9e-4)).unwrap().potential() > 0.0);
    // They repel each other the later, the narrower the gap is, and not where they are one point.
    narrow(&mut contact, 1e-4);
    assert_eq!(contact.energy(&slit(0.6e-4)).unwrap().potential(), 0.0);
    assert!(contact.energy(&slit(0.4e-4)).unwrap().potential() > 0.0);
    narrow(&mut contact, 1e-13);
    assert_eq!(contact.energy(&slit(0.1e-4)).unwrap().potential(), 0.0);
    assert_eq!(contact.energy(&slit(0.0)).unwrap().potential(), 0.0, "not even where they meet");
}

#[test]
fn no_gap_is_wider_than_what_the_sides_are_apart_at_the_start() {
    let mut contact = seam();
    // They lie at a tenth of the gap that is given.
    contact.setup().unwrap().open_seams(&gaps(1e-3), &slit(1e-4)).unwrap();
    assert_eq!(
        contact.energy(&slit(1e-4)).unwrap().potential(),
        0.0,
        "none repels the other at the start"
    );
    assert!(contact.energy(&slit(0.8e-4)).unwrap().potential() > 0.0);
}

#[test]
fn a_contact_with_open_seams_goes_on_from_one_with_open_seams_alone() {
    let [mut open, mut other, mut closed] = [seam(), seam(), seam()];
    let start = slit(2e-4);
    open.setup().unwrap().open_seams(&gaps(2e-4), &start).unwrap();
    other.setup().unwrap().open_seams(&gaps(2e-4), &start).unwrap();
    narrow(&mut other, 1e-4);
    let saved = other.state().saved();
    open.resume(&start, &saved).unwrap();
    assert_eq!(open.energy(&slit(0.6e-4)).unwrap().potential(), 0.0, "its gap is the narrower one");
    assert!(closed.resume(&start, &saved).is_err());
    let closed_seams = closed.state().saved();
    assert!(open.resume(&start, &closed_seams).is_err());
}
