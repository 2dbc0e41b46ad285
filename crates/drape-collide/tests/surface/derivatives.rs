//! Energies, gradients and second derivatives of pairs.

use crate::support::{Dice, derivative, norm};
use drape_collide::{Gap, Pair, PairKind};

const STIFFNESS: f64 = 1e9;

/// Of the differences, in m.
const STEP: f64 = 2e-4;

/// A pair of four vertices with an activation distance of half a metre, near 1 m in size.
fn pair(kind: PairKind) -> Pair {
    Pair {
        kind,
        features: [0, 1],
        vertices: [0, 1, 2, 3],
        activation_distance: 0.5,
        min_separation: 0.05,
        area: 1e-3,
        parallel: if kind == PairKind::EdgeEdge { 1e-3 } else { 0.0 },
        distance: 0.0,
    }
}

/// How many vertices take part in the closest points: what they lie on.
fn feature(gap: &Gap) -> [usize; 2] {
    let taking = |list: &[f64]| list.iter().filter(|w| **w != 0.0).count();
    let weights = gap.weights();
    let first = weights.iter().filter(|w| **w > 0.0).count();
    [first, taking(&weights) - first]
}

/// Whether a difference about here meets no change of feature and no joint of the barrier.
///
/// The second derivative jumps at the one, the third at the other.
fn is_smooth(pair: &Pair, positions: &[f64], gap: &Gap) -> bool {
    let lies_on = |gap: &Gap| gap.weights().map(|w| w != 0.0);
    let joint = pair.min_separation + 0.5 * (pair.activation_distance - pair.min_separation);
    if (gap.distance() - joint).abs() < 4.0 * STEP {
        return false;
    }
    (0..24).all(|k| {
        let mut shifted = positions.to_vec();
        shifted[k / 2] += if k % 2 == 0 { 4.0 * STEP } else { -4.0 * STEP };
        lies_on(&Gap::new(pair, &shifted).unwrap()) == lies_on(gap)
    })
}

/// Many random pairs within activation distance, with the kinds of feature that came up.
fn sample(kind: PairKind, count: usize, mut check: impl FnMut(&Pair, &[f64], &Gap)) {
    let mut dice = Dice::new(21);
    let pair = pair(kind);
    let mut features = std::collections::BTreeMap::new();
    let mut checked = 0;
    while checked < count {
        let positions: Vec<f64> = (0..12).map(|_| dice.roll()).collect();
        let gap = Gap::new(&pair, &positions).unwrap();
        if gap.distance() > 0.45 || gap.distance() < 0.08 {
            continue;
        }
        if !is_smooth(&pair, &positions, &gap) {
            continue;
        }
        check(&pair, &positions, &gap);
        *features.entry(feature(&gap)).or_insert(0) += 1;
        checked += 1;
    }
    let kinds = match kind {
        PairKind::VertexFace => vec![[1, 1], [1, 2], [1, 3]],
        PairKind::EdgeEdge => vec![[1, 1], [1, 2], [2, 1], [2, 2]],
    };
    assert_eq!(features.keys().copied().collect::<Vec<_>>(), kinds, "{features:?}");
    assert!(features.values().all(|times| *times > count / 100), "{features:?}");
}

fn near(what: &str, exact: &[f64], differences: &[f64], tolerance: f64) {
    let size = exact.iter().fold(0.0, |size: f64, v| size.max(v.abs()));
    for (a, b) in exact.iter().zip(differences) {
        let miss = (a - b).abs() / size;
        assert!(miss < tolerance, "{what}: {a:e} against {b:e}, off by {miss:e}");
    }
}

#[test]
fn the_gradient_is_the_derivative_of_the_energy() {
    for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
        sample(kind, 2000, |pair, positions, gap| {
            let differences: Vec<f64> = (0..12)
                .map(|k| {
                    let mut energy = |x: &[f64]| [Gap::new(pair, x).unwrap().energy(STIFFNESS)];
                    derivative(positions, k, STEP, &mut energy)[0]
                })
                .collect();
            near("gradient", &gap.gradient(STIFFNESS), &differences, 1e-7);
        });
    }
}

#[test]
fn the_hessian_is_the_derivative_of_the_gradient() {
    for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
        sample(kind, 2000, |pair, positions, gap| {
            let hessian = gap.hessian(STIFFNESS).concat();
            let mut differences = Vec::new();
            for k in 0..12 {
                let mut gradient = |x: &[f64]| Gap::new(pair, x).unwrap().gradient(STIFFNESS);
                differences.extend(derivative(positions, k, STEP, &mut gradient));
            }
            near("hessian", &hessian, &differences, 1e-6);
        });
    }
}

#[test]
fn forces_balance_and_do_not_turn() {
    for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
        sample(kind, 2000, |_, positions, gap| {
            let gradient = gap.gradient(STIFFNESS);
            let size = gradient.iter().fold(0.0, |size: f64, v| size.max(v.abs()));
            let (mut force, mut torque) = ([0.0; 3], [0.0; 3]);
            for (g, x) in gradient.chunks(3).zip(positions.chunks(3)) {
                for k in 0..3 {
                    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                    force[k] += g[k];
                    torque[k] += x[i] * g[j] - x[j] * g[i];
                }
            }
            assert!(norm(force) < 1e-12 * size, "a force of {force:?} of {size}");
            assert!(norm(torque) < 1e-12 * size, "a torque of {torque:?} of {size}");
        });
    }
}
