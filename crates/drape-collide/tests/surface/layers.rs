//! Stacked sheets under violent random moves through the filter.

use crate::sheets::{sheets, surface};
use crate::support::Dice;
use drape_collide::{
    CcdFilter, ContactDistances, Detector, PairKind, PinchPolicy, Surface, SurfaceContact,
    SurfaceParts, SurfaceSettings, SurfaceStart, SurfaceTrial, Sweep, Truncation, intersections,
};

const SPACING: f64 = 5e-3;
const LAYER_GAP: f64 = 4e-4;
const DISTANCES: ContactDistances =
    ContactDistances { activation_distance: 2e-4, min_separation: 1e-4 };
/// Room for displacements of 1 mm on one detection.
const MARGIN: f64 = 2.4e-3;

fn stack(layers: usize, side: usize) -> (SurfaceParts, Vec<f64>) {
    let mut parts = sheets(layers, side, SPACING);
    parts.distances.fill(DISTANCES);
    let mut positions = parts.rest_positions.clone();
    for (place, group) in positions.chunks_mut(3).zip(&parts.groups) {
        place[2] = LAYER_GAP * f64::from(*group);
    }
    (parts, positions)
}

/// A random displacement of up to 5 mm of each vertex: alone, or as one of waves of several
/// lengths.
fn random_move(dice: &mut Dice, kind: usize, positions: &[f64]) -> Vec<f64> {
    let size = 5e-3;
    let wave = dice.point(3000.0 / 4f64.powi(kind as i32));
    let displacement = dice.direction();
    let phases = positions.chunks(3).flat_map(|x| {
        let phase = (0..3).map(|k| wave[k] * x[k]).sum::<f64>();
        let alone = dice.direction();
        [0, 1, 2].map(|k| size * if kind == 0 { alone[k] } else { displacement[k] * phase.sin() })
    });
    phases.collect()
}

fn smallest(detector: &mut Detector, surface: &Surface, positions: &[f64]) -> f64 {
    let pairs = detector.detect(surface, positions, MARGIN).unwrap().as_slice();
    pairs.iter().map(|pair| pair.distance / pair.min_separation).fold(f64::INFINITY, f64::min)
}

fn shake(layers: usize, side: usize, moves: usize) {
    let (parts, mut positions) = stack(layers, side);
    let surface = surface(&parts);
    let (mut detector, mut filter) = (Detector::default(), CcdFilter::default());
    let mut dice = Dice::new(31);
    let (mut gone, mut shortened) = (0.0f64, 0);
    let mut nearest = f64::INFINITY;
    for k in 0..moves {
        let mut displacement = random_move(&mut dice, k % 5, &positions);
        let pairs = detector.detect(&surface, &positions, MARGIN).unwrap();
        if k % 3 == 2 {
            let fraction = filter.common_fraction(pairs, &positions, &displacement).unwrap().value;
            displacement.iter_mut().for_each(|component| *component *= fraction);
        } else {
            let truncation = filter.truncate(pairs, &positions, &mut displacement).unwrap();
            shortened += truncation.shortened;
        }
        gone += displacement.iter().map(|w| w * w).sum::<f64>().sqrt();
        positions.iter_mut().zip(&displacement).for_each(|(x, w)| *x += w);
        let met = intersections(&surface, &positions).unwrap();
        assert!(met.is_empty(), "after move {k}: {met:?}");
        nearest = nearest.min(smallest(&mut detector, &surface, &positions));
        assert!(nearest >= 1.0 - 1e-9, "after move {k}: {nearest} of the min_separation");
    }
    let size = (positions.len() as f64).sqrt();
    // The moves are not all zero, and they do bring the sheets together.
    assert!(gone / size > 0.01, "the moves come to {} m", gone / size);
    assert!(shortened > positions.len() && nearest < 1.1, "{shortened} shortened, {nearest}");
}

#[test]
fn five_small_sheets_never_cross() {
    shake(5, 14, 60);
}

/// Pairs are detected along the whole displacement, with little margin; a second, shorter
/// displacement then goes on from where the filter let the first end.
#[test]
fn sheets_never_cross_on_trajectories() {
    let (parts, mut positions) = stack(5, 14);
    let surface = surface(&parts);
    let (mut detector, mut filter) = (Detector::default(), CcdFilter::default());
    let mut dice = Dice::new(32);
    let margin = 2e-4;
    let (mut gone, mut nearest) = (0.0f64, f64::INFINITY);
    for k in 0..60 {
        let displacement = random_move(&mut dice, k % 5, &positions);
        for (turn, size) in [1.0, 0.01].into_iter().enumerate() {
            let mut displacement: Vec<f64> = displacement.iter().map(|w| size * w).collect();
            let together = k % 3 == 2;
            if turn == 0 {
                let sweep = if together {
                    Sweep::Common(&displacement)
                } else {
                    Sweep::Individual(&displacement)
                };
                detector.detect_swept(&surface, &positions, sweep, margin).unwrap();
            } else {
                detector.follow_trajectories(&positions);
            }
            let pairs = detector.pairs();
            if together {
                let fraction =
                    filter.common_fraction(pairs, &positions, &displacement).unwrap().value;
                // As a line search may.
                let fraction = if k % 2 == 0 { fraction } else { 0.5 * fraction };
                displacement.iter_mut().for_each(|component| *component *= fraction);
            } else {
                filter.truncate(pairs, &positions, &mut displacement).unwrap();
            }
            gone += displacement.iter().map(|w| w * w).sum::<f64>().sqrt();
            positions.iter_mut().zip(&displacement).for_each(|(x, w)| *x += w);
            let met = intersections(&surface, &positions).unwrap();
            assert!(met.is_empty(), "after move {k}: {met:?}");
            let list = Detector::default().detect(&surface, &positions, margin).unwrap().clone();
            let ratios = list.as_slice().iter().map(|pair| pair.distance / pair.min_separation);
            nearest = ratios.fold(nearest, f64::min);
            assert!(nearest >= 1.0 - 1e-9, "after move {k}: {nearest} of the min_separation");
        }
    }
    let size = (positions.len() as f64).sqrt();
    assert!(gone / size > 0.01 && nearest < 1.1, "{} m, {nearest}", gone / size);
}

#[test]
#[ignore = "takes two minutes of one core"]
fn five_sheets_never_cross() {
    shake(5, 50, 60);
}

#[test]
fn one_unfiltered_move_crosses_many_times() {
    let (parts, positions) = stack(5, 14);
    let displacement = random_move(&mut Dice::new(31), 0, &positions);
    let moved: Vec<f64> = positions.iter().zip(&displacement).map(|(x, w)| x + w).collect();
    let met = intersections(&surface(&parts), &moved).unwrap();
    assert!(met.len() > 300, "only {} crossings", met.len());
}

#[test]
fn a_body_goes_on_as_one_piece() {
    let (mut parts, mut positions) = stack(2, 10);
    parts.free_vertices = 100;
    // The upper sheet is a body that drops 5 mm on the lower, a corner of it tilted further.
    let mut displacement = vec![0.0; positions.len()];
    for v in 100..200 {
        displacement[3 * v + 2] = -5e-3 * (1.0 + 0.01 * (v % 10) as f64);
    }
    let full = displacement.clone();
    let surface = surface(&parts);
    let mut detector = Detector::default();
    let mut filter = CcdFilter::default();
    let pairs = detector.detect(&surface, &positions, MARGIN).unwrap();
    assert!(pairs.as_slice().iter().all(|pair| pair.vertices.iter().any(|v| *v < 100)));
    assert!(pairs.as_slice().iter().any(|pair| pair.kind == PairKind::EdgeEdge));
    let truncation = filter.truncate(pairs, &positions, &mut displacement).unwrap();
    assert!(truncation.body_fraction > 0.02 && truncation.body_fraction < 0.04, "{truncation:?}");
    let Truncation { shortened, at_drift_budget, frozen, least_fraction, .. } = truncation;
    assert_eq!((shortened, at_drift_budget, frozen), (100, 100, 0));
    assert_eq!(least_fraction, truncation.body_fraction);
    for (shortened, full) in displacement.iter().zip(&full) {
        assert_eq!(*shortened, full * truncation.body_fraction);
    }
    positions.iter_mut().zip(&displacement).for_each(|(x, w)| *x += w);
    assert!(smallest(&mut detector, &surface, &positions) >= 1.0);
}

#[test]
fn pairs_without_room_are_counted_and_may_part() {
    let (parts, mut positions) = stack(2, 6);
    // Half a nanometre of room.
    let height = 2.0 * DISTANCES.min_separation + 5e-10;
    positions[108..].iter_mut().skip(2).step_by(3).for_each(|place| *place = height);
    let surface = surface(&parts);
    let mut detector = Detector::default();
    let pairs = detector.detect(&surface, &positions, MARGIN).unwrap();
    let has_room = |distance: f64| distance - 2.0 * DISTANCES.min_separation > 1e-9;
    let tight =
        pairs.as_slice().iter().filter(|pair| !has_room(pair.distance_at(&positions).unwrap()));
    let tight = tight.count();
    let mut up = vec![0.0; positions.len()];
    up[108..].iter_mut().skip(2).step_by(3).for_each(|component| *component = 2e-4);
    let whole = up.clone();
    let mut filter = CcdFilter::default();
    let truncation = filter.truncate(pairs, &positions, &mut up).unwrap();
    assert!(up == whole && truncation.frozen == tight && tight > 100, "{truncation:?}, {tight}");
    assert_eq!(truncation.shortened, 0);
    let mut down = vec![0.0; positions.len()];
    down[110] = -2e-4;
    let truncation = filter.truncate(pairs, &positions, &mut down).unwrap();
    assert!(down.iter().all(|component| *component == 0.0));
    assert_eq!((truncation.shortened, truncation.least_fraction), (1, 0.0));
}

/// Height of each layer of a stack after all but the lowest were told to go down by so much.
fn fall(layers: usize, side: usize, drop: f64, rests: bool) -> Vec<f64> {
    let (parts, mut positions) = stack(layers, side);
    let surface = surface(&parts);
    let moves = |k: usize| k % 3 == 2 && !(rests && parts.groups[k / 3] == 0);
    let mut displacement: Vec<f64> =
        (0..positions.len()).map(|k| if moves(k) { -drop } else { 0.0 }).collect();
    let mut detector = Detector::default();
    detector.detect_swept(&surface, &positions, Sweep::Individual(&displacement), 1e-4).unwrap();
    CcdFilter::default().truncate(detector.pairs(), &positions, &mut displacement).unwrap();
    positions.iter_mut().zip(&displacement).for_each(|(x, w)| *x += w);
    assert!(intersections(&surface, &positions).unwrap().is_empty());
    let heights = positions.chunks(3 * side * side).map(|layer| {
        assert!(layer.chunks(3).all(|place| (place[2] - layer[2]).abs() < 1e-9));
        layer[2]
    });
    heights.collect()
}

#[test]
fn layers_that_move_together_keep_their_step() {
    let drop = 12.0 * LAYER_GAP;
    for (layer, height) in fall(6, 6, drop, false).into_iter().enumerate() {
        assert!((height - (LAYER_GAP * layer as f64 - drop)).abs() < 1e-12, "{layer}: {height}");
    }
}

#[test]
fn a_layer_falls_as_far_as_the_one_below_it_and_the_room_between_them() {
    let kept = 2.0 * DISTANCES.min_separation;
    let left = kept + 0.1 * (LAYER_GAP - kept);
    for (layer, height) in fall(6, 6, 12.0 * LAYER_GAP, true).into_iter().enumerate() {
        assert!((height - left * layer as f64).abs() < 1e-9, "{layer}: {height}");
    }
}

/// Settings of contact of two groups without friction.
fn frictionless() -> SurfaceSettings {
    SurfaceSettings {
        stiffness: 1e8,
        sticking_displacement: 1e-5,
        friction_coefficients: vec![0.0; 4],
        pinch: PinchPolicy::Error,
    }
}

/// Displacements that are left where one corner of the upper of two sheets is told to go through
/// the lower one and the rest of it sinks a little, with seams and held vertices.
fn sink(parts: SurfaceParts, positions: &[f64], held: &[usize]) -> (Vec<f64>, f64) {
    let mut contact =
        SurfaceContact::new(Surface::new(parts).unwrap(), frictionless(), vec![]).unwrap();
    let mut step = contact.begin(SurfaceStart::new(positions, &[])).unwrap();
    let vertices = positions.len() / 3;
    let mut displacements: Vec<f64> = (0..positions.len())
        .map(|k| match k / 3 {
            vertex if k % 3 < 2 || vertex < vertices / 2 => 0.0,
            vertex if vertex == vertices / 2 => -100.0 * LAYER_GAP,
            _ => -0.1 * LAYER_GAP,
        })
        .collect();
    let mut obstacle_advance = 1.0;
    let whole = step
        .limit(SurfaceTrial {
            start: positions,
            displacements: &mut displacements,
            held,
            obstacle_time: 0.0,
            obstacle_advance: &mut obstacle_advance,
        })
        .unwrap();
    assert!(!whole);
    (displacements.chunks(3).map(|displacement| displacement[2]).collect(), obstacle_advance)
}

#[test]
fn vertices_that_seams_join_or_tie_and_held_ones_keep_a_common_fraction() {
    let side = 5;
    let corner = side * side;
    let others = [corner + 12, corner + 18, corner + 24];
    let [a, b, c] = others.map(|vertex| vertex as u32);
    let (parts, positions) = stack(2, side);
    let small = -0.1 * LAYER_GAP;
    let (free, advance) = sink(parts.clone(), &positions, &[]);
    let fraction = free[corner] / (-100.0 * LAYER_GAP);
    assert!(fraction > 0.0 && fraction < 0.01 && advance == 1.0, "{fraction} {advance}");
    assert!(others.iter().all(|&vertex| free[vertex] == small), "{free:?}");
    let seams = SurfaceParts {
        seam_pairs: vec![[corner as u32, a]],
        ties: vec![[a, b, c]],
        ..parts.clone()
    };
    let (sewn, _) = sink(seams, &positions, &[]);
    let (held, advance) = sink(parts, &positions, &[corner, others[0], others[1], others[2]]);
    assert!((advance / fraction - 1.0).abs() < 1e-9, "{advance} {fraction}");
    for left in [sewn, held] {
        assert!((left[corner] / free[corner] - 1.0).abs() < 1e-9);
        for vertex in others {
            assert!((left[vertex] / (fraction * small) - 1.0).abs() < 1e-9, "{}", left[vertex]);
        }
        assert_eq!(left[corner + 6], small);
    }
}

/// Limited displacement of a free sheet, in m, and limited fraction of the motion of a body that is
/// so far above it, where the step lifts both by so much each.
fn rise(apart: f64, sheet: f64, body: f64) -> (f64, f64) {
    let side = 5;
    let (mut parts, mut positions) = stack(2, side);
    let free = 3 * side * side;
    parts.free_vertices = side * side;
    positions[free..].iter_mut().skip(2).step_by(3).for_each(|height| *height = apart);
    let bodies = positions.split_off(free);
    let mut end = bodies.clone();
    end.iter_mut().skip(2).step_by(3).for_each(|height| *height += body);
    let surface = Surface::new(parts).unwrap();
    let mut contact = SurfaceContact::new(surface, frictionless(), bodies).unwrap();
    let mut step = contact.begin(SurfaceStart::new(&positions, &end)).unwrap();
    let mut displacements: Vec<f64> =
        (0..free).map(|k| if k % 3 == 2 { sheet } else { 0.0 }).collect();
    let mut obstacle_advance = 1.0;
    let whole = step
        .limit(SurfaceTrial {
            start: &positions,
            displacements: &mut displacements,
            held: &[],
            obstacle_time: 0.0,
            obstacle_advance: &mut obstacle_advance,
        })
        .unwrap();
    assert!(!whole);
    let heights: Vec<f64> = displacements.chunks(3).map(|displacement| displacement[2]).collect();
    assert!(heights.iter().all(|height| *height == heights[0]), "{heights:?}");
    (heights[0], obstacle_advance)
}

#[test]
fn steps_of_many_edges_are_shortened_before_pairs_are_detected() {
    let equal = |found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} instead of {expected}");
    };
    let long = 40.0 * SPACING;
    // To four edges, where nothing is met.
    let (sheet, advance) = rise(0.01, -long, 0.5 * long);
    equal(sheet, -4.0 * SPACING);
    equal(advance, 0.1);
    // To nine tenths of the room below a body at rest.
    let (sheet, advance) = rise(0.01, long, 0.0);
    equal(sheet, 0.9 * (0.01 - 2.0 * DISTANCES.min_separation));
    equal(advance, sheet / long);
    // To half an edge each, where the sheet would soon meet the body.
    let (sheet, advance) = rise(LAYER_GAP, long, 0.5 * long);
    equal(sheet, 0.5 * SPACING);
    equal(advance, 1.0 / 40.0);
}
