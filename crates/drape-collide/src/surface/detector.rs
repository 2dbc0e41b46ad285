//! Detector of candidate pairs: the broad phase with its lists.

use super::broad_phase::{
    CandidatePairs, Detection, PairLimit, PairQuery, PairScan, PastDetection, Sweep,
};
use super::contact_surface::Surface;
use super::placement::Placement;
use crate::error::{Error, check};

/// Largest number of pairs in a list, if [`Detector::with_capacity`] sets no other.
///
/// The limit means a hundred pairs for each of half a million vertices, in 4 GB. More is a mistake
/// of the input.
const CAPACITY: usize = 50_000_000;

/// Detector of candidate pairs.
///
/// The detector keeps boxes and lists between calls and allocates memory only when they grow. It
/// may be used for one surface after another.
#[derive(Debug, Clone)]
pub struct Detector {
    scan: PairScan,
    pairs: CandidatePairs,
    capacity: usize,
    /// Revision of the bodies' positions and margin for which the boxes of the bodies were fitted;
    /// `None` if these boxes cannot be kept.
    fitted: Option<(u64, f64)>,
}

impl Default for Detector {
    fn default() -> Detector {
        Detector::with_capacity(CAPACITY)
    }
}

impl Detector {
    /// Returns a detector whose list may hold `capacity` pairs, instead of 50 million.
    #[must_use]
    pub fn with_capacity(capacity: usize) -> Detector {
        Detector {
            scan: PairScan::default(),
            pairs: CandidatePairs::default(),
            capacity,
            fitted: None,
        }
    }

    /// Returns the pairs of the last detection that succeeded.
    #[must_use]
    pub fn pairs(&self) -> &CandidatePairs {
        &self.pairs
    }

    /// Detects every pair whose distance at the flat `positions` is below its activation distance
    /// plus `margin`, in m.
    ///
    /// Pairs that share a vertex, directly or through a seam, and pairs without a free vertex are
    /// left out. After an error the pairs of the previous detection remain.
    ///
    /// # Errors
    ///
    /// There are not three coordinates for each vertex; a coordinate is not finite or beyond
    /// 1000 km; `margin` is not a positive number; or the list would be too long.
    pub fn detect(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        margin: f64,
    ) -> Result<&CandidatePairs, Error> {
        self.detect_swept(surface, positions, Sweep::Still, margin)
    }

    /// Detects every pair whose distance falls below its activation distance plus `margin`, in m,
    /// anywhere on the trajectories `sweep` from the flat `positions`. Some pairs that stay a
    /// little farther apart are listed too.
    ///
    /// # Errors
    ///
    /// As for [`detect`](Detector::detect).
    pub fn detect_swept(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        sweep: Sweep<'_>,
        margin: f64,
    ) -> Result<&CandidatePairs, Error> {
        self.run(surface, Detection { positions, revision: None, sweep, margin })
    }

    /// Detects like [`detect_swept`](Detector::detect_swept) at `placement`. The boxes of bodies
    /// are kept as long as the revision of `placement` is unchanged.
    pub(crate) fn detect_placed(
        &mut self,
        surface: &Surface,
        placement: &Placement,
        sweep: Sweep<'_>,
        margin: f64,
    ) -> Result<&CandidatePairs, Error> {
        self.run(
            surface,
            Detection { positions: placement, revision: placement.revision(), sweep, margin },
        )
    }

    /// Checks `detection` and runs it.
    fn run(
        &mut self,
        surface: &Surface,
        detection: Detection<'_>,
    ) -> Result<&CandidatePairs, Error> {
        let Detection { positions, revision, sweep, margin } = detection;
        surface.check_positions(positions)?;
        if let Some(displacements) = sweep.displacements() {
            surface.check_displacements(displacements)?;
        }
        check("the margin of contact (m)", margin, "above 0", margin > 0.0)?;

        // Subtracting the mean displacement makes the boxes of falling cloth smaller.
        let free = surface.free_count();
        let mean_displacement = sweep.mean_displacement(free, surface.vertex_count());
        let query = PairQuery {
            primitives: surface.primitives(),
            separations: &surface.separations,
            positions,
            limit: PairLimit::Margin { margin, sweep },
            mean_displacement: mean_displacement.unwrap_or_default(),
        };

        // The boxes of bodies stay valid while bodies, margin and reference frame are unchanged.
        let fitted =
            revision.filter(|_| mean_displacement.is_none()).map(|revision| (revision, margin));
        let keeps_bodies = fitted.is_some() && fitted == self.fitted;
        self.fitted = fitted;
        self.scan.run(&query, self.capacity, keeps_bodies)?;

        self.pairs.replace(self.scan.pairs(), &detection, free);
        Ok(&self.pairs)
    }

    /// Moves the reference positions of the pairs along their trajectories to the points nearest to
    /// the flat `positions`, in m. A [`CcdFilter`](crate::CcdFilter) then takes further steps from
    /// there.
    pub fn follow_trajectories(&mut self, positions: &[f64]) {
        self.pairs.follow_trajectories(positions);
    }

    /// Repeats the detection `past`.
    pub(crate) fn repeat(&mut self, surface: &Surface, past: &PastDetection) -> Result<(), Error> {
        self.detect_swept(surface, &past.start, past.sweep(), past.margin)?;
        self.pairs.restore_reference(past);
        Ok(())
    }

    /// Drops all pairs, because their distances have changed.
    pub(crate) fn clear(&mut self) {
        self.fitted = None;
        self.pairs.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::exact::IntersectionTest;
    use crate::{ContactDistances, SurfaceParts, intersections};

    /// Returns positions, in m, and triangles of a square grid with `side` vertices along each side
    /// at `height`. The first vertex has the number `first`.
    fn grid(side: u32, spacing: f64, height: f64, first: u32) -> (Vec<f64>, Vec<[u32; 3]>) {
        let vertices = (0..side * side)
            .flat_map(|k| [spacing * f64::from(k % side), spacing * f64::from(k / side), height]);
        let cells =
            (0..(side - 1) * (side - 1)).map(|k| first + k / (side - 1) * side + k % (side - 1));
        let triangles = cells.flat_map(|a| [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]]);
        (vertices.collect(), triangles.collect())
    }

    #[test]
    fn boxes_of_bodies_that_rest_find_the_same_pairs_and_intersections() {
        let (sheet, mut triangles) = grid(6, 0.01, 2e-3, 0);
        let (body, faces) = grid(48, 4e-3, 0.0, 36);
        triangles.extend(faces);
        let rest: Vec<f64> = sheet.iter().chain(&body).copied().collect();
        let vertices = rest.len() / 3;
        let surface = Surface::new(SurfaceParts {
            rest_positions: rest,
            triangles,
            areas: vec![1e-5; vertices],
            groups: (0..vertices).map(|vertex| u32::from(vertex >= 36)).collect(),
            distances: vec![
                ContactDistances { activation_distance: 5e-4, min_separation: 1e-4 };
                2
            ],
            free_vertices: 36,
            seam_pairs: Vec::new(),
            ties: Vec::new(),
        })
        .unwrap();
        let (mut detector, mut test) = (Detector::default(), IntersectionTest::default());
        let mut placement = Placement::default();
        let (mut found, mut met, mut kept) = (0, 0, 0);
        for round in 0..40_u32 {
            let wave = |k: usize| (f64::from(round) * 0.7 + k as f64).sin();
            // Sheet and body move in turn, and the sheet wanders along the body and through it.
            let free: Vec<f64> = (0..sheet.len())
                .map(|k| {
                    sheet[k] + if k % 3 == 2 { 2e-3 } else { 3e-3 * f64::from(round) } * wave(k)
                })
                .collect();
            let revision = u64::from(round / 4);
            let bodies = body.iter().map(|x| x + 1e-3 * revision as f64);
            let moves = round % 4 == 0;
            placement.place(&free, (!moves).then_some(revision), bodies);
            let mut displacements: Vec<f64> = (0..free.len()).map(|k| 1e-3 * wave(k + 5)).collect();
            if moves {
                displacements.resize(3 * vertices, 0.0);
            }
            let sweep = match round % 3 {
                0 => Sweep::Still,
                1 => Sweep::Common(&displacements),
                _ => Sweep::Individual(&displacements),
            };
            let margin = if round % 16 < 10 { 2e-3 } else { 4e-3 };
            let before = detector.fitted;
            let pairs = detector.detect_placed(&surface, &placement, sweep, margin).unwrap();
            let list = format!("{:?}", pairs.as_slice());
            found += pairs.as_slice().len();
            kept += usize::from(before.is_some() && before == detector.fitted);
            let mut fresh = Detector::default();
            let pairs = fresh.detect_swept(&surface, &placement, sweep, margin).unwrap();
            assert!(list == format!("{:?}", pairs.as_slice()), "round {round}");
            test.run_placed(&surface, &placement).unwrap();
            let expected = intersections(&surface, &placement).unwrap();
            assert_eq!(test.intersections, expected, "round {round}");
            met += expected.len();
        }
        assert!(found > 10_000 && met > 100 && kept > 10, "{found} pairs, {met} met, {kept} kept");
    }
}
