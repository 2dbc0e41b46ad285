//! The exact test of crossings against another exact test.

use crate::exact::{Motion, apart};
use crate::sheets::{DISTANCES, surface};
use crate::support::{Dice, norm};
use drape_collide::{Gap, Intersection, Pair, PairKind, SurfaceParts, intersections};
use std::collections::BTreeSet;

/// Triangles on a small lattice, seen from afar: most meet, touch or lie in one plane.
fn lattice(dice: &mut Dice, triangles: usize, cells: i64) -> Vec<[i64; 3]> {
    let mut coordinate = || ((dice.roll() + 1.0) * 0.5 * cells as f64) as i64;
    (0..3 * triangles).map(|_| [coordinate(), coordinate(), coordinate()]).collect()
}

fn compare(places: &[[i64; 3]], scale: f64, shift: f64) -> [usize; 2] {
    let triangles = places.len() / 3;
    // At rest they are all the same, in groups of their own.
    let rest = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let surface = surface(&SurfaceParts {
        rest_positions: rest.iter().copied().cycle().take(3 * places.len()).collect(),
        triangles: (0..triangles as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        areas: vec![1.0; places.len()],
        groups: (0..places.len() as u32).map(|v| v / 3).collect(),
        distances: vec![DISTANCES; triangles],
        free_vertices: places.len(),
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    });
    let positions: Vec<f64> =
        places.as_flattened().iter().map(|&x| scale * x as f64 + shift).collect();
    let found = intersections(&surface, &positions).unwrap();
    assert!(found.is_sorted(), "{found:?}");
    let place = |v: u32| places[v as usize].map(i128::from);
    let mut all = BTreeSet::new();
    for (e, ends) in surface.edges().iter().enumerate() {
        for (t, corners) in surface.triangles().iter().enumerate() {
            let own = ends.iter().any(|end| corners.contains(end));
            if !own && !apart(&ends.map(place), &corners.map(place)) {
                all.insert(Intersection { edge: e as u32, triangle: t as u32 });
            }
        }
    }
    let found: BTreeSet<_> = found.into_iter().collect();
    assert_eq!(found, all, "{places:?}");
    [all.len(), surface.edges().len() * (triangles - 1) - all.len()]
}

#[test]
fn crossings_are_those_of_exact_separating_directions() {
    let mut dice = Dice::new(51);
    let (mut meeting, mut apart) = (0, 0);
    for case in 0..600 {
        let cells = [2, 3, 5, 1000][case % 4];
        let places = lattice(&mut dice, 5, cells);
        // All of these are exact in binary, so the doubles are the whole numbers.
        let (scale, shift) = [(1.0, 0.0), (2f64.powi(-30), 512.0), (64.0, -4096.0)][case % 3];
        let [met, missed] = compare(&places, scale, shift);
        (meeting, apart) = (meeting + met, apart + missed);
    }
    assert!(meeting > 5_000 && apart > 5_000, "{meeting} meet, {apart} do not");
}

#[test]
fn a_last_place_decides() {
    // A vertical edge that ends on the plane of a triangle, or one number above or below it.
    let square = [[0.0, 0.0, 0.1], [1.0, 0.0, 0.1], [0.0, 1.0, 0.1]];
    for (end, meets) in [(0.1, true), (0.1f64.next_up(), false), (0.1f64.next_down(), true)] {
        let other = [[0.3, 0.3, end], [0.3, 0.3, 1.0], [5.0, 5.0, 1.0]];
        let positions: Vec<f64> = square.iter().chain(&other).flatten().copied().collect();
        let surface = surface(&SurfaceParts {
            rest_positions: positions.clone(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            areas: vec![1.0; 6],
            groups: vec![0, 0, 0, 1, 1, 1],
            distances: vec![DISTANCES; 2],
            free_vertices: 3,
            seam_pairs: Vec::new(),
            ties: Vec::new(),
        });
        let found = intersections(&surface, &positions).unwrap();
        assert_eq!(!found.is_empty(), meets, "the edge ends at {end}: {found:?}");
    }
}

/// The computed distance is that of two points of the primitives, and so never too small; a plane
/// proves that it is not too large.
#[test]
fn distances_of_slivers_and_nearly_parallel_edges_are_exact() {
    let mut dice = Dice::new(52);
    for case in 0..2_000 {
        let kind = if case % 2 == 0 { PairKind::VertexFace } else { PairKind::EdgeEdge };
        let tiny = 10f64.powf(-8.0 + 8.0 * dice.roll());
        let mut x: [[f64; 3]; 4] = std::array::from_fn(|_| dice.point(1.0));
        // The last place is all but on the line of the second and the third, or the second edge
        // all but along the first; both about a hundredth apart from the first.
        let fraction = 2.0 * dice.roll();
        let rough = dice.point(tiny);
        match kind {
            PairKind::VertexFace => {
                x[3] = [0, 1, 2].map(|k| x[1][k] + fraction * (x[2][k] - x[1][k]) + rough[k]);
                // Over the sliver itself or beside it.
                let over = dice.roll();
                let beside = dice.point(1e-2);
                let [u, v] = [2, 3].map(|i| [0, 1, 2].map(|k| x[i][k] - x[1][k]));
                let up: [f64; 3] = std::array::from_fn(|k| {
                    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                    u[i] * v[j] - u[j] * v[i]
                });
                let away = if case % 4 == 0 { up.map(|c| 1e-2 * c / norm(up)) } else { beside };
                x[0] = [0, 1, 2].map(|k| x[1][k] + over * u[k] + 0.3 * rough[k] + away[k]);
            }
            PairKind::EdgeEdge => {
                let away = dice.point(1e-2);
                x[2] = [0, 1, 2].map(|k| x[0][k] + 0.5 * fraction * (x[1][k] - x[0][k]) + away[k]);
                x[3] = [0, 1, 2].map(|k| x[2][k] + (x[1][k] - x[0][k]) + rough[k]);
            }
        }
        let pair = Pair {
            kind,
            features: [0, 1],
            vertices: [0, 1, 2, 3],
            activation_distance: 1.0,
            min_separation: 1e-9,
            area: 1.0,
            parallel: 0.0,
            distance: 0.0,
        };
        let positions = x.as_flattened();
        let gap = Gap::new(&pair, positions).unwrap();
        let (distance, weights) = (gap.distance(), gap.weights());
        let first = if kind == PairKind::VertexFace { 1 } else { 2 };
        let sums = [&weights[..first], &weights[first..]].map(|list| list.iter().sum::<f64>());
        assert!((sums[0] - 1.0).abs() < 1e-14 && (sums[1] + 1.0).abs() < 1e-14, "{weights:?}");
        let displacement: [f64; 3] = [0, 1, 2].map(|k| (0..4).map(|i| weights[i] * x[i][k]).sum());
        for (k, component) in displacement.into_iter().enumerate() {
            let miss = (component - distance * gap.normal()[k]).abs();
            assert!(miss < 1e-14, "{kind:?} {x:?}: off by {miss}");
        }
        let least = distance - 1e-14;
        let still = Motion::new(&x, &x, least);
        let sides: [Vec<usize>; 2] = [(0..first).collect(), (first..4).collect()];
        let proved = still.starts_apart_by(&sides[0], &sides[1], least);
        assert!(proved, "{kind:?} {x:?} with {tiny:e}: nearer than {distance}");
    }
}
