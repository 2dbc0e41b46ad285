//! Filtered motions of two triangles against exact proofs.

use crate::exact::Motion;
use crate::sheets::surface;
use crate::support::Dice;
use drape_collide::{CcdFilter, ContactDistances, Detector, Surface, SurfaceParts};

type Places = [[f64; 3]; 6];

/// Everything in units of a length.
const REACH: f64 = 0.02;
const SEPARATION: f64 = 0.005;
const MARGIN: f64 = 1.0;

/// Lengths of the triangles, in m, and how far they are from the origin at most.
const SIZES: [(f64, f64); 5] = [(1e-6, 0.0), (1e-2, 0.0), (1e-2, 1e6), (1.0, 1e3), (1e5, 4e5)];

/// Primitives of the two triangles 0 1 2 and 3 4 5, of which all pairs are judged.
fn judged() -> Vec<(Vec<usize>, Vec<usize>)> {
    let mut pairs = Vec::new();
    for v in 0..3 {
        pairs.push((vec![v], vec![3, 4, 5]));
        pairs.push((vec![3 + v], vec![0, 1, 2]));
        for w in 0..3 {
            pairs.push((vec![v, (v + 1) % 3], vec![3 + w, 3 + (w + 1) % 3]));
        }
    }
    pairs
}

fn two_triangles(size: f64, free: usize) -> Surface {
    let half = |distance: f64| 0.5 * distance * size;
    surface(&SurfaceParts {
        rest_positions: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]
            .iter()
            .cycle()
            .take(6)
            .flat_map(|[x, y]| [size * x, size * y, 0.0])
            .collect(),
        triangles: vec![[0, 1, 2], [3, 4, 5]],
        areas: vec![1e-4; 6],
        groups: vec![0, 0, 0, 1, 1, 1],
        distances: vec![
            ContactDistances {
                activation_distance: half(REACH),
                min_separation: half(SEPARATION)
            };
            2
        ],
        free_vertices: free,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    })
}

fn along(a: [f64; 3], b: [f64; 3], fraction: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + fraction * (b[k] - a[k]))
}

/// Two triangles and where they are to go, in units of their size.
fn adversary(dice: &mut Dice, kind: usize) -> (Places, Places) {
    let mut x: Places = std::array::from_fn(|_| dice.point(0.6));
    let tiny = 10f64.powf(-6.0 + 6.0 * dice.roll());
    let up = [0.0, 0.0, 1.0];
    // Some begin within the minimum separation.
    let excess = 10f64.powf(-4.0 + 4.0 * dice.roll());
    let gap = SEPARATION * if dice.roll() > 0.6 { 1.0 - 0.9 * excess } else { 1.0 + excess };
    let mut displacement: Places = std::array::from_fn(|_| dice.point(0.5));
    match kind {
        // Anything.
        0 => {}
        // An edge of the one nearly along an edge of the other, just above it.
        1 => {
            for k in 0..2 {
                let rough = dice.point(tiny);
                x[3 + k] = along(x[0], x[1], 0.3 * dice.roll() + k as f64);
                x[3 + k] = [0, 1, 2].map(|i| x[3 + k][i] + rough[i] + 2.0 * gap * up[i]);
            }
        }
        // In one plane or in two parallel ones, moving in it or across it.
        2 => {
            let flat = dice.roll() > 0.0;
            for k in 0..6 {
                x[k][2] = if k < 3 { 0.0 } else { 2.0 * gap * f64::from(flat) };
                displacement[k][2] *= f64::from(dice.roll() > 0.0);
            }
        }
        // Slivers.
        3 => {
            for first in [0, 3] {
                let rough = dice.point(1e-12);
                let foot = along(x[first], x[first + 1], dice.roll());
                x[first + 2] = [0, 1, 2].map(|i| foot[i] + rough[i]);
            }
        }
        // All at rest, or all but one.
        4 => {
            let moving = (dice.roll().abs() * 12.0) as usize;
            for (k, displacement) in displacement.iter_mut().enumerate() {
                *displacement = if k == moving { *displacement } else { [0.0; 3] };
            }
        }
        // A vertex just over a face that goes to touch it, and through it.
        5 => {
            let fraction = dice.roll().abs();
            let foot = along(along(x[0], x[1], fraction), x[2], dice.roll().abs());
            let normal = {
                let (u, v) = (along([0.0; 3], x[1], 1.0), x[2]);
                let (u, v) = ([0, 1, 2].map(|i| u[i] - x[0][i]), [0, 1, 2].map(|i| v[i] - x[0][i]));
                let n = [0, 1, 2]
                    .map(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
                let length = n.iter().map(|c| c * c).sum::<f64>().sqrt().max(1e-3);
                n.map(|c| c / length)
            };
            x[3] = [0, 1, 2].map(|i| foot[i] + gap * normal[i]);
            for place in &mut x[4..] {
                let apart = dice.roll().abs() + 2.0 * gap;
                *place = [0, 1, 2].map(|i| place[i] + apart * normal[i]);
            }
            displacement = [[0.0; 3]; 6];
            // To the touch exactly, or on.
            let factor = if dice.roll() > 0.0 { 1.0 } else { 1.0 + tiny };
            displacement[3] = [0, 1, 2].map(|i| factor * (foot[i] - x[3][i]));
        }
        // Very fast, or all together but for a little.
        6 => {
            let (common, fast) = (dice.point(3.0), dice.roll() > 0.0);
            for displacement in &mut displacement {
                let alone = dice.point(tiny);
                *displacement = [0, 1, 2]
                    .map(|i| if fast { 1e3 * displacement[i] } else { common[i] + alone[i] });
            }
        }
        // Edges that cross each other, one just over the other.
        _ => {
            let (s, t) = (dice.roll().abs(), dice.roll().abs());
            let (a, b) = (along(x[0], x[1], s), along(x[3], x[4], t));
            for place in &mut x[3..] {
                *place = [0, 1, 2].map(|i| place[i] + a[i] - b[i] + gap * up[i]);
            }
            displacement[3..].iter_mut().for_each(|displacement| displacement[2] -= 0.5);
        }
    }
    (x, displacement)
}

/// What came of some cases.
#[derive(Debug, Default)]
struct Tally {
    /// Motions that would have brought two primitives within the minimum separation, or made them
    /// cross.
    dangerous: usize,
    /// Steps that were shortened, and among them those that still go on.
    shortened: usize,
    moving: usize,
    /// CandidatePairs that were apart by the minimum separation at the start and judged.
    proved: usize,
}

fn run(cases: usize, seed: u64) -> Tally {
    let mut dice = Dice::new(seed);
    let surfaces: Vec<[Surface; 2]> =
        SIZES.iter().map(|&(size, _)| [6, 3].map(|free| two_triangles(size, free))).collect();
    let (mut detector, mut filter) = (Detector::default(), CcdFilter::default());
    let mut tally = Tally::default();
    for case in 0..cases {
        let (size, far) = SIZES[case % SIZES.len()];
        let surface = &surfaces[case % SIZES.len()][case / 7 % 2];
        let (places, displacements) = adversary(&mut dice, case / SIZES.len() % 8);
        let offset = dice.point(0.9 * far);
        let place = |k: usize, x: f64| size * x + offset[k];
        let mut positions: Vec<f64> =
            places.iter().flat_map(|p| [0, 1, 2].map(|k| place(k, p[k]))).collect();
        let limit = 4e5;
        let full: Vec<f64> =
            displacements.as_flattened().iter().map(|w| (size * w).clamp(-limit, limit)).collect();
        let pairs = detector.detect(surface, &positions, MARGIN * size).unwrap();
        for round in 0..3 {
            let mut displacement = full.clone();
            if (case + round) % 2 == 0 {
                let fraction = filter.common_fraction(pairs, &positions, &displacement).unwrap();
                assert!((0.0..=1.0).contains(&fraction.value));
                displacement.iter_mut().for_each(|component| *component *= fraction.value);
            } else {
                filter.truncate(pairs, &positions, &mut displacement).unwrap();
            }
            let end: Vec<f64> = positions.iter().zip(&displacement).map(|(x, w)| x + w).collect();
            judge(&mut tally, (&positions, &end), SEPARATION * size, (case, round));
            if round == 0 {
                let end: Vec<f64> = positions.iter().zip(&full).map(|(x, w)| x + w).collect();
                tally.dangerous += usize::from(!harmless((&positions, &end), 0.0));
                tally.shortened += usize::from(displacement != full);
                tally.moving +=
                    usize::from(displacement != full && displacement.iter().any(|w| *w != 0.0));
            }
            positions = end;
        }
    }
    tally
}

fn motion((start, end): (&[f64], &[f64]), target: f64) -> Motion {
    let places = |flat: &[f64]| -> Vec<[f64; 3]> {
        flat.chunks(3).map(|place| [place[0], place[1], place[2]]).collect()
    };
    Motion::new(&places(start), &places(end), target)
}

/// Whether the triangles are surely apart at many times of a motion.
fn harmless(motion_of: (&[f64], &[f64]), target: f64) -> bool {
    let motion = motion(motion_of, target);
    (0..=16).all(|time| motion.apart_at(&[0, 1, 2], &[3, 4, 5], (time, 4)))
}

/// Every pair that kept the minimum separation at the start keeps it all the displacement; every
/// other pair that was apart stays apart.
fn judge(tally: &mut Tally, ends: (&[f64], &[f64]), min_separation: f64, case: (usize, usize)) {
    // The promise is the minimum separation to a billionth.
    let target = min_separation * (1.0 - 1e-9);
    let whole = motion(ends, target);
    let standing = motion((ends.0, ends.0), min_separation);
    for (a, b) in judged() {
        if standing.keeps(&a, &b, min_separation) {
            assert!(whole.keeps(&a, &b, target), "case {case:?}: {a:?} and {b:?} come too near");
            tally.proved += 1;
        } else if standing.apart_at(&a, &b, (0, 0)) {
            assert!(whole.keeps(&a, &b, 0.0), "case {case:?}: {a:?} and {b:?} cross");
        }
    }
    let apart = |motion: &Motion, time| motion.apart_at(&[0, 1, 2], &[3, 4, 5], time);
    if apart(&whole, (0, 0)) {
        for time in 1..=8 {
            assert!(apart(&whole, (time, 3)), "case {case:?}: the triangles meet");
        }
    }
}

#[test]
fn filtered_motions_never_come_too_near() {
    let tally = run(1_000, 41);
    let Tally { dangerous, shortened, moving, proved } = tally;
    assert!(dangerous > 400 && shortened > 800 && moving > 700 && proved > 40_000, "{tally:?}");
}

#[test]
#[ignore = "takes some minutes"]
fn many_filtered_motions_never_come_too_near() {
    let tally = run(20_000, 42);
    assert!(tally.dangerous > 8_000 && tally.proved > 800_000, "{tally:?}");
}
