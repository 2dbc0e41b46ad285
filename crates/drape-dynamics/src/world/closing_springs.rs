//! Springs that close the seams of a garment.

use drape_collide::equivalence_classes;
use drape_implicit::BlockMatrix;
use drape_scene::{SeamConstraint, SeamPairs};
use serde::{Deserialize, Serialize};

/// Stiffness of a closing spring, in N/m: about the stiffness of a yarn of a usual weave. The
/// remaining gaps close when the particles are merged, or after the springs are stiffened. At 1e5
/// N/m springs pressed panels onto each other, and a step of a T-shirt of 25 506 particles had no
/// solution. At 3e3 N/m trousers closed only after stiffening.
const STIFFNESS: f64 = 1e4;

/// Widest gap at which the two sides of a seam count as closed and are merged, in m. Where a seam
/// counts as closed, primitives that it joins are exempt from contact with each other. Contact at
/// so narrow a gap would stall the closing: a T-shirt of 25 506 particles took 1812 iterations for
/// three steps.
const CLOSED: f64 = drape_frames::CLOSED_GAP;

/// Multiple of the sewing time after which seams with a narrow gap may be merged.
const NEARLY_CLOSED_AFTER: f64 = 1.1;

/// Gap to which the springs close a seam, in m. It is larger than the deviation of a spring.
const CLOSING: f64 = 0.2 * CLOSED;

/// Gap to which stiffened springs are to close a seam, in m. If the sides of a gap wider than this
/// were merged, the cloth would move by more than the contact distance, and could enter a body.
const CLOSED_STRETCHED: f64 = 0.1 * CLOSED;

/// Multiple of the sewing time after which a seam that is still open ends the run.
const PATIENCE: f64 = 2.0;

/// Imbalance, over g, up to which steps are solved while a garment is sewn, and below which its
/// seams may be merged. Only the end of this motion matters: seams that are closed and untangled,
/// and calm cloth. With a third of this tolerance hems came to rest within 2 mm of their places
/// with this one.
pub(crate) const TOLERANCE: f64 = 0.3;

/// Springs between the two sides of the seams.
///
/// Each spring keeps the gap vector between its ends near the gap at the start times a fraction.
/// The fraction falls linearly from 1 to nearly 0, so the ends move together along straight lines,
/// and the energy is quadratic.
#[derive(Debug, Clone)]
pub(crate) struct ClosingSprings {
    seams: Vec<SeamConstraint>,
    /// Gap of each seam constraint at the start, in m.
    start_gaps: Vec<StartGap>,
    /// Sewing time: the time until the gaps are to be closed, in s.
    seconds: f64,
    /// Fraction of the sewing time that remains at the end of this step.
    remaining: f64,
    /// Class of the particles that each seam constraint joins: the smallest of them.
    classes: Vec<u32>,
    /// Whether the seams of each class count as closed. Once they do, they stay so.
    closed: Vec<bool>,
    /// Gap that contact must allow at each particle at the end of this step, in m: the prescribed
    /// gap, 0 where the seam counts as closed, and infinite without a seam.
    gaps: Vec<f64>,
    /// Stiffness of each spring in this step, in N/m.
    stiffness: f64,
    /// Increase of the stiffness, if the springs left a seam open.
    stiffening: Option<Stiffening>,
}

/// Gap of a seam constraint at the start.
#[derive(Debug, Clone, Copy)]
struct StartGap {
    /// Gap vector, in m.
    gap: [f64; 3],
    /// Length of `gap`, in m.
    width: f64,
}

impl StartGap {
    /// Returns the prescribed fraction of the gap when the fraction `remaining` of the sewing time
    /// remains.
    fn fraction(&self, remaining: f64) -> f64 {
        if self.width > CLOSING { remaining.max(CLOSING / self.width) } else { 1.0 }
    }
}

/// Increase of the stiffness of closing springs, linear over the sewing time.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Stiffening {
    /// Time at which the increase begins, in s.
    start: f64,
    /// Ratio of the stiffness at the end of the increase to the usual stiffness.
    factor: f64,
}

/// Closing springs between two steps.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SavedSprings {
    stiffening: Option<Stiffening>,
    /// Whether the seams of each class count as closed.
    closed: Vec<bool>,
}

/// State of the seams while they are closed.
#[derive(Debug, Clone, Copy)]
pub(crate) enum SeamState {
    /// The sewing time is not over, or the cloth is not calm yet.
    Open,
    /// All gaps are closed, and the cloth is calm or the springs had time enough.
    Closed {
        /// The widest gap.
        gap: WidestGap,
        /// Whether the springs had time enough.
        is_late: bool,
    },
    /// A narrow gap remains open, and the cloth is calm.
    NearlyClosed(WidestGap),
    /// A gap remains open although the springs had time enough.
    Failed(WidestGap),
}

/// Widest gap of all seams.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WidestGap {
    /// Width, in m.
    pub(crate) width: f64,
    /// Particles on both sides of the gap.
    pub(crate) ends: [u32; 2],
}

impl ClosingSprings {
    /// Returns the springs of `pairs` between particles that start at `positions`, in m. The
    /// springs close the gaps within `seconds`.
    pub(crate) fn new(pairs: &SeamPairs, positions: &[f64], seconds: f64) -> Self {
        let seams: Vec<SeamConstraint> = pairs.constraints().collect();
        let start_gaps = seams
            .iter()
            .map(|seam| StartGap { gap: seam.gap(positions), width: seam.width(positions) });
        let start_gaps: Vec<StartGap> = start_gaps.collect();

        let particles = positions.len() / 3;
        let class_of_particle =
            equivalence_classes(particles, &pairs.pairs).expect("pairs name particles");
        let joined = seams.iter().map(|seam| class_of_particle[seam.weights[0].particle as usize]);
        let classes: Vec<u32> = joined.collect();
        // Sides that start as one point cannot be kept apart.
        let mut closed = vec![false; particles];
        for (class, start) in classes.iter().zip(&start_gaps) {
            closed[*class as usize] |= start.width <= CLOSED;
        }

        Self {
            start_gaps,
            classes,
            closed,
            gaps: pairs.gaps_at_particles(positions),
            seams,
            seconds,
            remaining: 1.0,
            stiffness: STIFFNESS,
            stiffening: None,
        }
    }

    /// Returns the pairs of particles that the springs couple.
    pub(crate) fn coupled_pairs(&self) -> Vec<[u32; 2]> {
        let pairs = self.seams.iter().flat_map(|seam| {
            let particles = seam.weights.iter().map(|end| end.particle).enumerate();
            particles
                .flat_map(|(k, a)| seam.weights[k + 1..].iter().map(move |end| [a, end.particle]))
        });
        pairs.collect()
    }

    /// Prepares a step that begins at `positions`, in m, and ends at `end_time`, in s.
    pub(crate) fn begin(&mut self, positions: &[f64], end_time: f64) {
        self.remaining = (1.0 - end_time / self.seconds).max(0.0);
        self.close_classes(positions);
        self.gaps.fill(f64::INFINITY);
        for ((seam, start), class) in self.seams.iter().zip(&self.start_gaps).zip(&self.classes) {
            let gap = start.fraction(self.remaining) * start.width;
            // Contact keeps the sides of a seam apart until it counts as closed.
            let is_closed = self.closed[*class as usize];
            seam.narrow(if is_closed { 0.0 } else { gap.max(CLOSED) }, &mut self.gaps);
        }

        if let Some(Stiffening { start, factor }) = self.stiffening {
            let part = ((end_time - start) / self.seconds).clamp(0.0, 1.0);
            self.stiffness = STIFFNESS * (1.0 + part * (factor - 1.0));
        }
    }

    /// Counts the classes as closed whose gaps are all prescribed to close in this step, and are
    /// closed at `positions`, in m.
    fn close_classes(&mut self, positions: &[f64]) {
        let mut closes = vec![true; self.closed.len()];
        for ((seam, start), class) in self.seams.iter().zip(&self.start_gaps).zip(&self.classes) {
            let prescribed = start.fraction(self.remaining) * start.width;
            closes[*class as usize] &= prescribed <= CLOSED && seam.width(positions) <= CLOSED;
        }
        for (closed, closes) in self.closed.iter_mut().zip(closes) {
            *closed |= closes;
        }
    }

    /// Returns the gap that contact must allow at each particle at the end of this step, in m: the
    /// prescribed gap, 0 where the seam counts as closed, and infinite without a seam.
    pub(crate) fn gaps(&self) -> &[f64] {
        &self.gaps
    }

    /// Stiffens the springs from `time` on, in s, so that a remaining gap `gap`, in m, closes.
    /// Returns whether the springs had their usual stiffness before.
    pub(crate) fn stiffen(&mut self, time: f64, gap: f64) -> bool {
        let is_usual = self.stiffening.is_none();
        if is_usual {
            let factor = (gap / CLOSED_STRETCHED).max(1.0);
            self.stiffening = Some(Stiffening { start: time, factor });
        }
        is_usual
    }

    /// Returns whether the springs are stiffened.
    pub(crate) fn are_stiffened(&self) -> bool {
        self.stiffening.is_some()
    }

    /// Returns the state between two steps, for [`Self::restore`].
    pub(crate) fn saved(&self) -> SavedSprings {
        SavedSprings { stiffening: self.stiffening, closed: self.closed.clone() }
    }

    /// Restores the state `saved`. Returns `false` if it is the state of other seams.
    pub(crate) fn restore(&mut self, saved: SavedSprings) -> bool {
        let fits = saved.closed.len() == self.closed.len();
        if fits {
            (self.stiffening, self.closed) = (saved.stiffening, saved.closed);
        }
        fits
    }

    /// Returns the time until the gaps are to be closed, in s.
    pub(crate) fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Returns the state of the seams with the particles at `positions`, in m, at `time`, in s.
    /// `imbalance` is the imbalance of the last step over g, and `narrow` the widest gap that
    /// counts as narrow, in m.
    pub(crate) fn state(
        &self,
        positions: &[f64],
        time: f64,
        imbalance: f64,
        narrow: f64,
    ) -> SeamState {
        let elapsed = time - self.stiffening.map_or(0.0, |stiffening| stiffening.start);
        if elapsed < self.seconds {
            return SeamState::Open;
        }

        let gap = self.widest_gap(positions);
        let is_late = elapsed >= PATIENCE * self.seconds;
        let is_calm = imbalance <= TOLERANCE;
        let is_nearly_closed = gap.width <= narrow && elapsed >= NEARLY_CLOSED_AFTER * self.seconds;
        if gap.width <= CLOSED && (is_late || is_calm) {
            SeamState::Closed { gap, is_late }
        } else if is_late {
            SeamState::Failed(gap)
        } else if is_calm && is_nearly_closed {
            SeamState::NearlyClosed(gap)
        } else {
            SeamState::Open
        }
    }

    /// Returns the widest gap of all seams with the particles at `positions`, in m.
    pub(crate) fn widest_gap(&self, positions: &[f64]) -> WidestGap {
        let start = WidestGap { width: 0.0, ends: [0; 2] };
        let gaps = self.seams.iter().map(|seam| WidestGap {
            width: seam.width(positions),
            ends: [0, 1].map(|k| seam.weights[k].particle),
        });
        gaps.fold(start, |widest, gap| if gap.width > widest.width { gap } else { widest })
    }

    /// Returns the largest force of a spring with the particles at `positions`, in N.
    pub(crate) fn largest_force(&self, positions: &[f64]) -> f64 {
        let squares = self.excess(positions).map(|e| e.iter().map(|x| x * x).sum::<f64>());
        self.stiffness * squares.fold(0.0, f64::max).sqrt()
    }

    /// Adds the forces of the springs at `positions` to `forces`, in N.
    pub(crate) fn add_forces(&self, positions: &[f64], forces: &mut [f64]) {
        for (seam, excess) in self.seams.iter().zip(self.excess(positions)) {
            for end in &seam.weights {
                for (axis, excess) in excess.iter().enumerate() {
                    forces[3 * end.particle as usize + axis] -=
                        end.weight * self.stiffness * excess;
                }
            }
        }
    }

    /// Returns the potential of the springs at `positions`, in J.
    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        let squares = self.excess(positions).map(|e| e.iter().map(|x| x * x).sum::<f64>());
        0.5 * self.stiffness * squares.sum::<f64>()
    }

    /// Adds the stiffness of the springs to `matrix`.
    pub(crate) fn add_stiffness(&self, matrix: &mut BlockMatrix) {
        for seam in &self.seams {
            for (k, a) in seam.weights.iter().enumerate() {
                for b in &seam.weights[k..] {
                    let size = a.weight * b.weight * self.stiffness;
                    let block = std::array::from_fn(|k| if k % 4 == 0 { size } else { 0.0 });
                    matrix.add(a.particle as usize, b.particle as usize, &block);
                }
            }
        }
    }

    /// Returns the difference between the gap at `positions` and the prescribed gap of each seam
    /// constraint, in m.
    fn excess(&self, positions: &[f64]) -> impl Iterator<Item = [f64; 3]> {
        self.seams.iter().zip(&self.start_gaps).map(move |(seam, start)| {
            let now = seam.gap(positions);
            let fraction = start.fraction(self.remaining);
            [0, 1, 2].map(|axis| now[axis] - fraction * start.gap[axis])
        })
    }
}
