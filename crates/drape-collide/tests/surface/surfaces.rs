//! What a surface takes and tells, and that nothing depends on threads or on earlier calls.

use crate::sheets::{Between, KEPT, WIDE, level, sheets, surface};
use crate::support::Dice;
use drape_collide::{
    CandidatePairs, CcdFilter, ContactDistances, Detector, Error, FractionLimit, PinchPolicy,
    Surface, SurfaceParts, intersections,
};
use rayon::ThreadPoolBuilder;

#[test]
fn parts_that_make_no_surface_are_refused() {
    let good = sheets(2, 4, 0.01);
    let refused = |change: fn(&mut SurfaceParts)| {
        let mut parts = good.clone();
        change(&mut parts);
        Surface::new(parts).unwrap_err()
    };
    type Change = fn(&mut SurfaceParts);
    type Expected = fn(&Error) -> bool;
    let cases: [(Change, Expected); 16] = [
        (|p| _ = p.rest_positions.pop(), |e| matches!(e, Error::WrongLength { .. })),
        (|p| _ = p.groups.pop(), |e| matches!(e, Error::WrongLength { .. })),
        (|p| p.rest_positions[4] = f64::NAN, |e| matches!(e, Error::InvalidPosition { .. })),
        (|p| p.rest_positions[4] = 1e7, |e| matches!(e, Error::InvalidPosition { .. })),
        (|p| p.free_vertices = 33, |e| matches!(e, Error::OutOfRange { .. })),
        (|p| p.distances[1].activation_distance = 0.0, |e| matches!(e, Error::OutOfRange { .. })),
        (|p| p.distances[1].min_separation = 0.0, |e| matches!(e, Error::OutOfRange { .. })),
        (|p| p.distances[1].min_separation = 3e-4, |e| matches!(e, Error::OutOfRange { .. })),
        (|p| p.groups[5] = 2, |e| matches!(e, Error::MissingGroup { vertex: 5, .. })),
        (|p| p.areas[3] = -1.0, |e| matches!(e, Error::InvalidArea { particle: 3, .. })),
        (|p| p.seam_pairs.push([0, 32]), |e| matches!(e, Error::MissingSeamVertex { .. })),
        (|p| p.ties.push([0, 1, 32]), |e| matches!(e, Error::MissingSeamVertex { .. })),
        (|p| p.triangles[2][1] = 32, |e| matches!(e, Error::MissingVertex { .. })),
        (|p| p.triangles[2] = [1, 2, 1], |e| matches!(e, Error::RepeatedVertex { .. })),
        (|p| p.triangles[2] = [0, 1, 17], |e| matches!(e, Error::MixedTriangle { .. })),
        (|p| p.triangles[2] = [0, 1, 2], |e| matches!(e, Error::FlatTriangle { .. })),
    ];
    for (k, (change, expected)) in cases.into_iter().enumerate() {
        let error = refused(change);
        assert!(expected(&error), "case {k}: {error}");
    }
    // A body and cloth in one triangle; two corners of a sheet in one place at rest.
    let mixed = refused(|p| p.free_vertices = 30);
    assert!(matches!(mixed, Error::MixedTriangle { .. }), "{mixed}");
    let touching = refused(|p| p.rest_positions.copy_within(0..3, 45));
    assert!(matches!(touching, Error::ContactAtRest { .. }), "{touching}");
}

#[test]
fn the_edges_of_bodies_do_not_count_in_the_median() {
    let sheet = surface(&sheets(1, 4, 0.01)).median_edge_length();
    assert!((sheet - 0.01).abs() < 1e-12, "{sheet}");
    let mut parts = sheets(2, 4, 0.01);
    parts.free_vertices = 16;
    // A finely meshed body.
    parts.rest_positions[48..].iter_mut().for_each(|x| *x *= 0.01);
    assert_eq!(surface(&parts).median_edge_length(), sheet);
}

/// Two crumpled sheets and a displacement for them.
fn crumpled() -> (Surface, Vec<f64>, Vec<f64>) {
    let mut parts = sheets(2, 40, 5e-3);
    parts.distances.fill(ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 });
    let mut dice = Dice::new(71);
    let positions: Vec<f64> = parts
        .rest_positions
        .chunks(3)
        .zip(&parts.groups)
        .flat_map(|(x, group)| {
            let height = 0.02 * (60.0 * x[0]).sin() + 1e-3 * f64::from(*group);
            [0.3 * x[0], x[1], height]
        })
        .collect();
    let displacement = positions.iter().map(|_| 2e-3 * dice.roll()).collect();
    (surface(&parts), positions, displacement)
}

fn filtered(pairs: &CandidatePairs, positions: &[f64], displacement: &[f64]) -> (Vec<f64>, f64) {
    let mut filter = CcdFilter::default();
    let mut shortened = displacement.to_vec();
    filter.truncate(pairs, positions, &mut shortened).unwrap();
    (shortened, filter.common_fraction(pairs, positions, displacement).unwrap().value)
}

#[test]
fn all_answers_have_the_same_bits_for_any_number_of_threads() {
    let (surface, positions, displacement) = crumpled();
    let answers = [1, 2, 3, 8].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut detector = Detector::default();
            let pairs = detector.detect(&surface, &positions, 1e-3).unwrap();
            let filtered = filtered(pairs, &positions, &displacement);
            let met: Vec<f64> = positions.iter().zip(&displacement).map(|(x, w)| x + w).collect();
            (pairs.as_slice().to_vec(), filtered, intersections(&surface, &met).unwrap())
        })
    });
    let [(pairs, (_, share), met), ..] = &answers;
    assert!(
        pairs.len() > 1000 && met.len() > 100,
        "{} pairs, {} crossings",
        pairs.len(),
        met.len()
    );
    assert!(*share > 0.0 && *share < 0.5, "{share}");
    assert!(answers.iter().all(|answer| *answer == answers[0]));
}

#[test]
fn a_detector_and_a_filter_forget_what_they_did_before() {
    let (surface, positions, displacement) = crumpled();
    let (other, flat) = {
        let parts = sheets(3, 9, 1e-3);
        (crate::sheets::surface(&parts), parts.rest_positions)
    };
    let mut used = Detector::default();
    used.detect(&other, &flat, 5e-4).unwrap();
    let mut filter = CcdFilter::default();
    filter.truncate(used.pairs(), &flat, &mut vec![1e-5; flat.len()]).unwrap();
    let pairs = used.detect(&surface, &positions, 1e-3).unwrap();
    let mut new = Detector::default();
    let fresh = new.detect(&surface, &positions, 1e-3).unwrap();
    assert_eq!(pairs.as_slice(), fresh.as_slice());
    let mut shortened = displacement.clone();
    filter.truncate(pairs, &positions, &mut shortened).unwrap();
    assert_eq!(shortened, filtered(fresh, &positions, &displacement).0);
}

#[test]
fn a_filtered_step_is_shorter_straight_and_stays_as_it_is() {
    let (surface, positions, displacement) = crumpled();
    let displacement: Vec<f64> = displacement.iter().map(|w| 0.1 * w).collect();
    let mut detector = Detector::default();
    let pairs = detector.detect(&surface, &positions, 1e-3).unwrap();
    let (shortened, _) = filtered(pairs, &positions, &displacement);
    let mut shares = [0; 3];
    for (short, full) in shortened.chunks(3).zip(displacement.chunks(3)) {
        let share = short[0] / full[0];
        assert!((0.0..=1.0).contains(&share), "{short:?} of {full:?}");
        assert!(short.iter().zip(full).all(|(s, f)| (s - share * f).abs() <= 1e-15 * f.abs()));
        shares[usize::from(share > 0.0) + usize::from(share == 1.0)] += 1;
    }
    assert!(shares[1] > 100 && shares[2] > 100, "{shares:?}");
    // Each vertex has used its room to nine tenths or stands at its budget: little is left to
    // take away from the same step, and nothing from half of it.
    let half: Vec<f64> = shortened.iter().map(|s| 0.5 * s).collect();
    assert_eq!(filtered(pairs, &positions, &half).0, half);
}

#[test]
fn a_step_beyond_the_pairs_is_limited_or_refused() {
    let (surface, positions, _) = crumpled();
    let margin = 1e-3;
    let mut detector = Detector::default();
    let pairs = detector.detect(&surface, &positions, margin).unwrap();
    let mut filter = CcdFilter::default();
    // All together, so that only the budget can be in the displacement.
    let up: Vec<f64> = (0..positions.len()).map(|k| 1e-2 * f64::from(k % 3 == 1)).collect();
    let fraction = filter.common_fraction(pairs, &positions, &up).unwrap();
    assert_eq!(fraction.limit, FractionLimit::DriftBudget);
    assert!((fraction.value - 0.45 * margin / 1e-2).abs() < 1e-9, "{fraction:?}");
    let moved: Vec<f64> = positions.iter().zip(&up).map(|(x, u)| x + fraction.value * u).collect();
    let fraction = filter.common_fraction(pairs, &moved, &up).unwrap();
    assert!(fraction.value < 1e-9 && fraction.limit == FractionLimit::DriftBudget, "{fraction:?}");
    let back: Vec<f64> = up.iter().map(|u| -0.03 * u).collect();
    let fraction = filter.common_fraction(pairs, &moved, &back).unwrap();
    assert_eq!((fraction.value, fraction.limit), (1.0, FractionLimit::None));
    let truncation = filter.truncate(pairs, &moved, &mut up.clone()).unwrap();
    assert_eq!(truncation.at_drift_budget, surface.vertex_count());

    let beyond: Vec<f64> = positions.iter().zip(&up).map(|(x, u)| x + 0.05 * u).collect();
    let refused = filter.common_fraction(pairs, &beyond, &up);
    assert!(matches!(refused, Err(Error::DriftBudgetExceeded { vertex: 0, .. })), "{refused:?}");
    let mut bad = up.clone();
    bad[40] = f64::NAN;
    let refused = filter.truncate(pairs, &positions, &mut bad);
    assert!(matches!(refused, Err(Error::InvalidPosition { .. })), "{refused:?}");
    let refused = filter.common_fraction(pairs, &positions, &up[3..]);
    assert!(matches!(refused, Err(Error::WrongLength { .. })), "{refused:?}");
}

#[test]
fn a_second_detection_allocates_nothing() {
    let (surface, positions, displacement) = crumpled();
    let pool = ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| {
        let (mut detector, mut filter) = (Detector::default(), CcdFilter::default());
        let mut shortened = displacement.clone();
        let mut work = || {
            let pairs = detector.detect(&surface, &positions, 1e-3).unwrap();
            filter.common_fraction(pairs, &positions, &displacement).unwrap();
            shortened.copy_from_slice(&displacement);
            filter.truncate(pairs, &positions, &mut shortened).unwrap();
        };
        work();
        let counted = allocation_counter::measure(work);
        assert_eq!(counted.count_total, 0, "{counted:?}");
    });
}

#[test]
fn a_head_on_approach_of_any_length_leaves_a_tenth_of_the_room() {
    // A small triangle over a large one; they approach straight, alone or each by its share.
    let size = 0.01;
    let flat = [[-4.0, -4.0], [4.0, -4.0], [0.0, 8.0], [-1.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let (min_separation, room) = (1e-4, 2e-4);
    let rest: Vec<f64> = (0..6)
        .flat_map(|k| {
            let height = if k < 3 { 0.0 } else { min_separation + room };
            [size * flat[k][0], size * flat[k][1], height]
        })
        .collect();
    let surface = surface(&SurfaceParts {
        rest_positions: rest.clone(),
        triangles: vec![[0, 1, 2], [3, 4, 5]],
        areas: vec![1e-4; 6],
        groups: vec![0, 0, 0, 1, 1, 1],
        distances: vec![
            ContactDistances {
                activation_distance: 1e-4,
                min_separation: 0.5 * min_separation
            };
            2
        ],
        free_vertices: 6,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    });
    let mut detector = Detector::default();
    let mut filter = CcdFilter::default();
    let pairs = detector.detect(&surface, &rest, 5e-3).unwrap();
    for share in [0.0, 0.02, 0.3, 0.5, 1.0] {
        for length in (1..60).map(|k| 0.05 * f64::from(k) * room) {
            let displacement: Vec<f64> = (0..18)
                .map(|k| match (k % 3, k / 9) {
                    (2, 0) => length * share,
                    (2, _) => -length * (1.0 - share),
                    _ => 0.0,
                })
                .collect();
            let left = |displacement: &[f64]| {
                (rest[11] + displacement[11] - displacement[2] - min_separation) / room
            };
            let wanted = left(&displacement);
            let least = filter.common_fraction(pairs, &rest, &displacement).unwrap();
            let scaled: Vec<f64> = displacement.iter().map(|w| least.value * w).collect();
            let mut shortened = displacement.clone();
            filter.truncate(pairs, &rest, &mut shortened).unwrap();
            // Rounding of the proof takes a billionth; the scalar filter stops a fiftieth short.
            for (left, most) in [(left(&scaled), 0.103), (left(&shortened), 0.15)] {
                assert!(left >= 0.1 - 1e-6, "{left} of the room is left of {wanted}");
                assert!(left <= wanted.max(most) + 1e-6, "{left} of the room is left of {wanted}");
            }
        }
    }
}

#[test]
fn a_plate_that_was_far_away_is_found() {
    let mut between = Between::new(PinchPolicy::Error, WIDE, [-0.2, 0.2]);
    assert_eq!(between.contact.energy(&level(0.0)).unwrap().potential(), 0.0);
    assert!(between.contact.energy(&level(-0.1997)).unwrap().potential() > 0.0);
}

#[test]
fn the_closest_pair_and_those_that_are_too_close_are_told() {
    let mut between = Between::new(PinchPolicy::Error, WIDE, [-4e-4, 2.5e-4]);
    between.contact.detect(&level(-1e-4)).unwrap();
    assert_eq!(between.contact.pairs().below_min_separation().count(), 0);
    let closest = between.contact.pairs().closest().unwrap();
    assert!((closest.distance - 3e-4).abs() < 1e-12, "{closest:?}");
    between.contact.detect(&level(-3e-4)).unwrap();
    let active = between.contact.pairs().summary().touching;
    let below: Vec<_> = between.contact.pairs().below_min_separation().collect();
    assert!(!below.is_empty() && below.len() < active, "{} of {active}", below.len());
    assert!(below.iter().all(|own| own.distance < KEPT), "{below:?}");
    let none = Between::new(PinchPolicy::Error, WIDE, [-0.2, 0.2]);
    assert!(none.contact.pairs().closest().is_none());
}
