//! Stacked sheets under violent random moves through the filter.

use crate::sheets::{sheets, surface};
use crate::support::Dice;
use drape_collide::{
    CcdFilter, ContactDistances, Detector, PairKind, Surface, SurfaceParts, Sweep, intersections,
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
    for (shortened, full) in displacement.iter().zip(&full) {
        assert_eq!(*shortened, full * truncation.body_fraction);
    }
    positions.iter_mut().zip(&displacement).for_each(|(x, w)| *x += w);
    assert!(smallest(&mut detector, &surface, &positions) >= 1.0);
}
