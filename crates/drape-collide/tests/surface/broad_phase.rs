//! The list of near pairs against all pairs tried one by one.

use crate::sheets::{DISTANCES, sheets, soup, surface};
use crate::support::{Dice, norm, sub};
use drape_collide::{ContactDistances, Detector, Error, PairKind, Surface, SurfaceParts, Sweep};
use std::collections::BTreeSet;

type Place = [f64; 3];
type Key = (PairKind, [u32; 2]);

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Nearest point of a segment by minimising along it.
fn to_segment(p: Place, a: Place, b: Place) -> f64 {
    let along = sub(b, a);
    let t = (dot(sub(p, a), along) / dot(along, along)).clamp(0.0, 1.0);
    norm([0, 1, 2].map(|k| p[k] - a[k] - t * along[k]))
}

/// Distance by solving the normal equations over the interior and falling back to the sides.
fn vertex_face(p: Place, [a, b, c]: [Place; 3]) -> f64 {
    let (u, v, w) = (sub(b, a), sub(c, a), sub(p, a));
    let [uu, uv, vv, uw, vw] = [dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)];
    let det = uu * vv - uv * uv;
    let (s, t) = ((uw * vv - vw * uv) / det, (vw * uu - uw * uv) / det);
    if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        return norm([0, 1, 2].map(|k| w[k] - s * u[k] - t * v[k]));
    }
    to_segment(p, a, b).min(to_segment(p, b, c)).min(to_segment(p, c, a))
}

fn edge_edge([a, b]: [Place; 2], [c, d]: [Place; 2]) -> f64 {
    let (u, v, w) = (sub(b, a), sub(d, c), sub(c, a));
    let [uu, uv, vv, uw, vw] = [dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w)];
    let det = uu * vv - uv * uv;
    let (s, t) = ((uw * vv - vw * uv) / det, (uw * uv - vw * uu) / det);
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        return norm([0, 1, 2].map(|k| w[k] + t * v[k] - s * u[k]));
    }
    let ends = [to_segment(a, c, d), to_segment(b, c, d), to_segment(c, a, b), to_segment(d, a, b)];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

/// All pairs by trying each with each.
fn brute_force(
    surface: &Surface,
    parts: &SurfaceParts,
    (x, query): (&[f64], f64),
) -> BTreeSet<Key> {
    let SurfaceParts { seam_pairs, ties, .. } = parts;
    let place = |v: u32| [0, 1, 2].map(|k| x[3 * v as usize + k]);
    let same =
        |a: u32, b: u32| a == b || seam_pairs.contains(&[a, b]) || seam_pairs.contains(&[b, a]);
    let has = |list: &[u32], v: u32| list.iter().any(|&w| same(v, w));
    let lies = |v: u32, list: &[u32]| {
        ties.iter().any(|&[tied, a, b]| same(tied, v) && has(list, a) && has(list, b))
    };
    let joined = |one: &[u32], other: &[u32]| {
        one.iter().any(|&v| has(other, v) || lies(v, other)) || other.iter().any(|&v| lies(v, one))
    };
    let free = |list: &[u32]| list.iter().any(|&v| (v as usize) < surface.free_count());
    let mut keys = BTreeSet::new();
    for vertex in 0..surface.vertex_count() as u32 {
        for (t, corners) in surface.triangles().iter().enumerate() {
            if !joined(&[vertex], corners)
                && (free(&[vertex]) || free(corners))
                && vertex_face(place(vertex), corners.map(place)) < query
            {
                keys.insert((PairKind::VertexFace, [vertex, t as u32]));
            }
        }
    }
    for (e, a) in surface.edges().iter().enumerate() {
        for (f, b) in surface.edges().iter().enumerate().skip(e + 1) {
            if !joined(a, b)
                && (free(a) || free(b))
                && edge_edge(a.map(place), b.map(place)) < query
            {
                keys.insert((PairKind::EdgeEdge, [e as u32, f as u32]));
            }
        }
    }
    keys
}

fn compare(parts: &SurfaceParts, positions: &[f64], margin: f64) -> usize {
    let surface = surface(parts);
    let mut detector = Detector::default();
    let pairs = detector.detect(&surface, positions, margin).unwrap();
    let keys: Vec<Key> = pairs.as_slice().iter().map(|pair| pair.key()).collect();
    assert!(keys.is_sorted(), "the list is sorted");
    let found: BTreeSet<Key> = keys.iter().copied().collect();
    assert_eq!(found.len(), keys.len(), "no pair is there twice");
    let all =
        brute_force(&surface, parts, (positions, 2.0 * DISTANCES.activation_distance + margin));
    let missing: Vec<_> = all.difference(&found).collect();
    let extra: Vec<_> = found.difference(&all).collect();
    assert!(missing.is_empty() && extra.is_empty(), "missing {missing:?}, extra {extra:?}");
    found.len()
}

#[test]
fn random_meshes_have_the_pairs_of_brute_force() {
    let mut dice = Dice::new(11);
    let mut pairs = 0;
    for case in 0..300 {
        let size = [0.05, 0.2, 1.0][case % 3];
        let parts = soup(&mut dice, 4 + case % 37, size);
        let positions: Vec<f64> =
            parts.rest_positions.iter().map(|x| x + 0.1 * dice.roll()).collect();
        let margin = 10f64.powf(-2.0 + 1.5 * dice.roll());
        pairs += compare(&parts, &positions, margin);
    }
    assert!(pairs > 3000, "only {pairs} pairs");
}

#[test]
fn folded_sheets_have_the_pairs_of_brute_force() {
    let mut dice = Dice::new(12);
    for case in 0..12 {
        let (layers, side, spacing) = (1 + case % 3, 4 + case % 7, 0.01);
        let mut parts = sheets(layers, side, spacing);
        let last = (side * side) as u32 - 1;
        if layers > 1 && case % 2 == 0 {
            parts.seam_pairs = vec![[0, last + 1], [last, 2 * last + 1]];
            // Of the second sheet's side three vertices lie on the first two edges of the first
            // sheet's.
            let tie = |own: u32, first: u32| [last + 1 + own, first, first + 1];
            parts.ties = vec![tie(1, 0), tie(3, 1), tie(2, 0)];
        }
        let mut positions = Vec::new();
        for (v, place) in parts.rest_positions.chunks(3).enumerate() {
            // Rolled up about a line across, with the layers just apart.
            let radius = 0.008 + 0.0007 * parts.groups[v] as f64;
            let angle = 120.0 * (place[0] + 0.3 * place[1]);
            let rough = dice.point(2e-4);
            positions.extend([
                radius * angle.cos() + rough[0],
                place[1] + rough[1],
                radius * angle.sin() + rough[2],
            ]);
        }
        let pairs = compare(&parts, &positions, 1e-3);
        assert!(layers == 1 || pairs > 10, "case {case}: only {pairs} pairs");
    }
}

#[test]
fn what_comes_near_on_a_trajectory_is_found() {
    let mut dice = Dice::new(13);
    let (mut met, mut found) = (0, [0; 3]);
    for case in 0..200 {
        let mut parts = soup(&mut dice, 8 + case % 23, 0.3);
        let activation_distance = 0.03;
        parts.distances.fill(ContactDistances {
            activation_distance,
            min_separation: 0.5 * activation_distance,
        });
        let surface = surface(&parts);
        let common = dice.point(1.0);
        let margin = 0.02;
        let vertices = surface.vertex_count();
        let displacements: Vec<f64> = (0..vertices)
            .flat_map(|_| {
                let own = dice.point(0.2);
                [0, 1, 2].map(|k| common[k] + own[k])
            })
            .collect();
        let mut detector = Detector::default();
        let together = case % 2 == 0;
        let sweep = if together {
            Sweep::Common(&displacements)
        } else {
            Sweep::Individual(&displacements)
        };
        let pairs = detector.detect_swept(&surface, &parts.rest_positions, sweep, margin).unwrap();
        let listed: BTreeSet<Key> = pairs.as_slice().iter().map(|pair| pair.key()).collect();
        found[case % 2] += listed.len();
        found[2] += vertices * surface.triangles().len();
        for _ in 0..10 {
            let all = 0.5 + dice.roll();
            let mut there = parts.rest_positions.clone();
            for vertex in 0..vertices {
                let fraction = if together { all } else { 0.5 + dice.roll() }.clamp(0.0, 1.0);
                let beside = dice.direction();
                for k in 0..3 {
                    let displacement =
                        fraction * displacements[3 * vertex + k] + 0.49 * margin * beside[k];
                    there[3 * vertex + k] += displacement;
                }
            }
            let near = brute_force(&surface, &parts, (&there, 2.0 * activation_distance));
            met += near.len();
            let missing: Vec<_> = near.difference(&listed).collect();
            assert!(missing.is_empty(), "case {case}: missing {missing:?}");
        }
    }
    assert!(met > 3000, "only {met} pairs met");
    // What all have in common brings none nearer: the list is far from being all pairs.
    assert!(2 * found[0] < found[1] && 2 * found[1] < found[2], "{found:?}");
}

#[test]
fn a_fine_mesh_does_not_push_itself_at_rest() {
    let parts = sheets(1, 8, 4e-4);
    let surface = surface(&parts);
    let mut detector = Detector::default();
    let pairs = detector.detect(&surface, &parts.rest_positions, 1e-3).unwrap();
    // Neighbours but one are 0.28 or 0.4 mm apart, less than the activation distance of 0.6 mm.
    assert!(!pairs.as_slice().is_empty());
    for pair in pairs.as_slice() {
        let half = 0.5 * pair.distance;
        assert!(pair.activation_distance <= half && pair.min_separation <= 0.5 * half, "{pair:?}");
    }
}

#[test]
fn what_cannot_be_detected_is_an_error() {
    let parts = sheets(2, 4, 0.01);
    let surface = surface(&parts);
    let mut positions = parts.rest_positions.clone();
    let mut detector = Detector::with_capacity(3);
    let many = detector.detect(&surface, &positions, 1e-3);
    assert!(matches!(many, Err(Error::TooManyPairs { capacity: 3 })));
    let short = detector.detect(&surface, &positions[3..], 1e-3);
    assert!(matches!(short, Err(Error::WrongLength { found: 93, needed: 96, .. })));
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        positions[7] = bad;
        let bad = detector.detect(&surface, &positions, 1e-3);
        assert!(matches!(bad, Err(Error::InvalidPosition { .. })));
    }
    let places = &parts.rest_positions;
    let still = vec![0.0; places.len()];
    let mut lost = still.clone();
    lost[95] = f64::NAN;
    for sweep in [Sweep::Common, Sweep::Individual] {
        let short = detector.detect_swept(&surface, places, sweep(&still[1..]), 1e-3);
        assert!(matches!(short, Err(Error::WrongLength { found: 95, .. })));
        let bad = detector.detect_swept(&surface, places, sweep(&lost), 1e-3);
        assert!(matches!(bad, Err(Error::InvalidPosition { .. })));
    }
    for margin in [0.0, -1.0, f64::NAN] {
        let bad = detector.detect(&surface, &parts.rest_positions, margin);
        assert!(matches!(bad, Err(Error::OutOfRange { .. })));
    }
    assert!(detector.pairs().as_slice().is_empty());
}
