//! Step filter: what it lets through keeps all primitives apart, in exact arithmetic.

use drape::collide::{CcdFilter, ContactDistances, Detector, Surface, SurfaceParts, Sweep};
use num_traits::Zero;

use crate::rational::{Exact, Point, Proof, exact, keeps, square_distance};
use crate::shapes::Source;

/// Half distances of both quadrangles, in m.
const DISTANCES: ContactDistances =
    ContactDistances { activation_distance: 1e-3, min_separation: 1e-4 };

/// Separation of two quadrangles of which a proof is asked: a little below the minimum separation,
/// which rounding may take.
const SEPARATION: f64 = 2e-4 * (1.0 - 1e-9);

/// Number of steps.
const STEPS: usize = 3;

/// Two triangles with a common edge.
const QUADRANGLE: [[u32; 3]; 2] = [[0, 1, 2], [1, 3, 2]];

/// Pair of primitives without a common vertex: its vertices, how many are the first's, and whether
/// the two are of one quadrangle.
struct Both {
    vertices: [usize; 4],
    first: usize,
    is_own: bool,
}

/// Returns all pairs of two quadrangles.
fn pairs(free: usize) -> Vec<Both> {
    let triangles = [0, 4].map(|k| QUADRANGLE.map(|own| own.map(|vertex| vertex as usize + k)));
    let edges = [0, 4]
        .map(|k| [[0, 1], [1, 2], [0, 2], [1, 3], [2, 3]].map(|own| own.map(|vertex| vertex + k)));
    let faces = triangles
        .as_flattened()
        .iter()
        .flat_map(|&[a, b, c]| (0..8).map(move |vertex| ([vertex, a, b, c], 1)));
    let edges = edges.as_flattened();
    let crossed = edges
        .iter()
        .enumerate()
        .flat_map(|(k, &[a, b])| edges[k + 1..].iter().map(move |&[c, d]| ([a, b, c, d], 2)));
    let all = faces.chain(crossed).filter(|(own, first)| {
        let (one, other) = own.split_at(*first);
        !one.iter().any(|vertex| other.contains(vertex)) && own.iter().any(|vertex| *vertex < free)
    });
    let both = all.map(|(vertices, first)| Both {
        vertices,
        first,
        is_own: vertices.iter().all(|k| (*k < 4) == (vertices[0] < 4)),
    });
    both.collect()
}

fn surface(free: usize) -> Surface {
    let rest = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| [x, y, 0.0]);
    let rest = [rest, rest.map(|[x, y, _]| [x, y, 5.0])];
    let second = QUADRANGLE.map(|own| own.map(|vertex| vertex + 4));
    let parts = SurfaceParts {
        rest_positions: rest.as_flattened().as_flattened().to_vec(),
        triangles: [QUADRANGLE, second].concat(),
        areas: vec![0.25; 8],
        groups: vec![0, 0, 0, 0, 1, 1, 1, 1],
        distances: vec![DISTANCES; 2],
        free_vertices: free,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    };
    Surface::new(parts).expect("it is right")
}

fn places(positions: &[f64]) -> Vec<Exact> {
    positions.as_chunks::<3>().0.iter().map(|point: &Point| exact(*point)).collect()
}

/// Draws two quadrangles that lie near each other, mostly.
fn start(source: &mut Source<'_>) -> Vec<f64> {
    let flat = source.power(-6.0, 0.0);
    let size = source.power(-3.0, 0.0);
    let gap = [2e-4, 1e-3, source.power(-6.0, -1.0)][source.below(3) as usize];
    let shift = [0.0, 1.0, -1000.0][source.below(3) as usize];
    let mut positions = Vec::new();
    for k in 0..8 {
        let corner = [(k % 2) as f64, (k / 2 % 2) as f64];
        let [x, y, z] = source.point();
        let height = if k < 4 { 0.0 } else { gap };
        let near =
            [size * (corner[0] + 0.4 * x), size * (corner[1] + 0.4 * y), height + flat * size * z];
        positions.extend(near.map(|x| x + shift));
    }
    positions
}

/// Filter with the pairs of a surface.
struct Walk {
    surface: Surface,
    detector: Detector,
    filter: CcdFilter,
    margin: f64,
}

impl Walk {
    /// Returns the limited displacements, after a detection if that is due; none if the filter
    /// refuses.
    fn limit(
        &mut self,
        (positions, wanted): (&[f64], &[f64]),
        (detects, sweeps, is_common): (bool, bool, bool),
    ) -> Option<Vec<f64>> {
        let mut displacements = wanted.to_vec();
        if detects {
            let sweep = match (sweeps, is_common) {
                (false, _) => Sweep::Still,
                (true, true) => Sweep::Common(wanted),
                (true, false) => Sweep::Individual(wanted),
            };
            self.detector.detect_swept(&self.surface, positions, sweep, self.margin).ok()?;
        } else {
            self.detector.follow_trajectories(positions);
        }
        let pairs = self.detector.pairs();
        if is_common {
            let fraction = self.filter.common_fraction(pairs, positions, wanted).ok()?;
            displacements.iter_mut().for_each(|component| *component *= fraction.value);
        } else {
            self.filter.truncate(pairs, positions, &mut displacements).ok()?;
        }
        Some(displacements)
    }
}

/// Takes some steps of eight points, and proves of each that no two primitives come below their
/// minimum separation, or meet.
pub fn filter(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let free = [8, 4][source.below(2) as usize];
    let mut positions = start(&mut source);
    let all = pairs(free);
    let mut walk = Walk {
        surface: surface(free),
        detector: Detector::default(),
        filter: CcdFilter::default(),
        margin: source.power(-5.0, -1.0),
    };
    for step in 0..STEPS {
        let before = places(&positions);
        let length = source.power(-6.0, 1.0);
        let common = source.point();
        let wanted: Vec<f64> = (0..8)
            .flat_map(|k| {
                let sign = if k < 4 { 1.0 } else { -1.0 };
                let own = source.point();
                [0, 1, 2].map(|x| length * (sign * common[x] + 0.3 * own[x]))
            })
            .collect();
        let how = (step == 0 || source.below(2) == 0, source.below(2) == 0, source.below(2) == 0);
        let Some(limited) = walk.limit((&positions, &wanted), how) else { return };
        positions.iter_mut().zip(&limited).for_each(|(x, dx)| *x += dx);
        let after = places(&positions);
        for Both { vertices, first, is_own } in &all {
            let [from, to] = [&before, &after].map(|all| vertices.map(|k| all[k].clone()));
            let square = square_distance(&from, *first);
            // What crosses at the start is not the filter's.
            if square.is_zero() {
                return;
            }
            let apart = num_traits::ToPrimitive::to_f64(&square).unwrap_or(0.0).sqrt();
            let kept = if !is_own && apart > 2e-4 { SEPARATION } else { 0.0 };
            let proof = keeps(&from, &to, (*first, kept));
            assert!(
                proof == Proof::SavedRun,
                "step {step}, {how:?}: {vertices:?} at {apart} m keep {kept}: {proof:?}\n{before:?}\n{limited:?}"
            );
        }
    }
}
