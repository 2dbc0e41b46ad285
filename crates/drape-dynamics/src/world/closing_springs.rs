//! Springs that close the seams of a garment.

use drape_implicit::BlockMatrix;
use drape_scene::{SeamConstraint, SeamPairs};
use serde::{Deserialize, Serialize};

/// Stiffness of a closing spring, in N/m: about that of a yarn of a usual weave. The gaps that it
/// leaves close when the particles are merged, or after the springs are stiffened. At 1e5 N/m springs
/// pressed panels onto each other, and a step of a T-shirt of 25 506 particles had no solution. At 3e3
/// N/m trousers closed only after stiffening.
const STIFFNESS: f64 = 1e4;

/// Widest gap at which the two sides of a seam are merged, in m. Where a narrower one is wanted,
/// primitives that the seam joins are exempt from contact with each other, as they are once it is
/// closed. Kept apart by as little as the gap they would stall: a T-shirt of 25 506 particles took
/// 1812 iterations for three steps.
const CLOSED: f64 = 1e-4;

/// Multiple of its length that the closing of the seams takes before they may be merged with a narrow gap.
const NEARLY_CLOSED_AFTER: f64 = 1.1;

/// Gap to which the springs close a seam, in m. The deviation of a spring from it is smaller.
const CLOSING: f64 = 0.2 * CLOSED;

/// Gap to which stiffened springs are to close a seam, in m. A wider one moves cloth by more than
/// contact leaves to bodies when its sides are merged.
const CLOSED_STRETCHED: f64 = 0.1 * CLOSED;

/// Multiple of its length that the closing of the seams may take before the run fails.
const PATIENCE: f64 = 2.0;

/// Imbalance, over g, up to which steps are solved while a garment is sewn, and at which its seams
/// may be merged: of the motion only the end matters, with seams that are closed, untangled and
/// calm. With a third of it hems came to rest within 2 mm of where they do now.
pub(crate) const TOLERANCE: f64 = 0.3;

/// Springs between the two sides of the seams.
///
/// Each keeps the gap between its ends, a vector, near the gap at the start times a fraction that
/// falls evenly from 1 to nearly 0. So the ends are drawn together along straight lines, and the energy
/// is quadratic.
#[derive(Debug, Clone)]
pub(crate) struct ClosingSprings {
    seams: Vec<SeamConstraint>,
    /// Gap of each at the start, in m.
    start_gaps: Vec<StartGap>,
    /// Time until the gaps are to be closed, in s.
    seconds: f64,
    /// Fraction of the time for it that remains at the end of this step.
    remaining: f64,
    /// Gap that contact is to leave at each particle at the end of this step, in m: that which is wanted,
    /// 0 where it counts as closed, and infinite without a seam.
    gaps: Vec<f64>,
    /// Stiffness of each in this step, in N/m.
    stiffness: f64,
    /// Increase of their stiffness, for a seam that they did not close.
    stiffening: Option<Stiffening>,
}

/// Gap of a closing spring at the start.
#[derive(Debug, Clone, Copy)]
struct StartGap {
    /// Gap, in m.
    gap: [f64; 3],
    /// Its width, in m.
    width: f64,
}

impl StartGap {
    /// Fraction of the gap that is wanted when some of the time remains.
    fn fraction(&self, remaining: f64) -> f64 {
        if self.width > CLOSING { remaining.max(CLOSING / self.width) } else { 1.0 }
    }
}

/// Increase of the stiffness of closing springs, evenly within the time of the sewing.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct Stiffening {
    /// Time at which it begins, in s.
    start: f64,
    /// Stiffness at its end over the usual one.
    factor: f64,
}

/// State of the seams while they are closed.
#[derive(Debug, Clone, Copy)]
pub(crate) enum SeamState {
    /// The time for it is not over, or the cloth is not calm yet.
    Open,
    /// All gaps are closed, and the cloth is calm.
    Closed,
    /// A narrow gap stays open, and the cloth is calm.
    NearlyClosed(WidestGap),
    /// A gap stays open.
    Failed(WidestGap),
}

/// Widest gap of all seams.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WidestGap {
    /// Width, in m.
    pub(crate) width: f64,
    /// Two particles that it is between.
    pub(crate) ends: [u32; 2],
}

impl ClosingSprings {
    /// Springs between particles at their positions at the start, in m, that close the gaps within
    /// a time, in s.
    pub(crate) fn new(pairs: &SeamPairs, positions: &[f64], seconds: f64) -> Self {
        let seams: Vec<SeamConstraint> = pairs.constraints().collect();
        let start_gap = |seam: &SeamConstraint| StartGap {
            gap: seam.gap(positions),
            width: seam.width(positions),
        };
        Self {
            start_gaps: seams.iter().map(start_gap).collect(),
            gaps: pairs.gaps_at_particles(positions),
            seams,
            seconds,
            remaining: 1.0,
            stiffness: STIFFNESS,
            stiffening: None,
        }
    }

    /// Pairs of particles that the springs couple.
    pub(crate) fn coupled_pairs(&self) -> Vec<[u32; 2]> {
        let pairs = self.seams.iter().flat_map(|seam| {
            let particles = seam.weights.iter().map(|end| end.particle).enumerate();
            particles
                .flat_map(|(k, a)| seam.weights[k + 1..].iter().map(move |end| [a, end.particle]))
        });
        pairs.collect()
    }

    /// Opens a step that ends at a time, in s.
    pub(crate) fn begin(&mut self, end_time: f64) {
        self.remaining = (1.0 - end_time / self.seconds).max(0.0);
        self.gaps.fill(f64::INFINITY);
        for (seam, start) in self.seams.iter().zip(&self.start_gaps) {
            let gap = start.fraction(self.remaining) * start.width;
            let gap = if gap <= CLOSED { 0.0 } else { gap };
            seam.narrow(gap, &mut self.gaps);
        }
        if let Some(Stiffening { start, factor }) = self.stiffening {
            let part = ((end_time - start) / self.seconds).clamp(0.0, 1.0);
            self.stiffness = STIFFNESS * (1.0 + part * (factor - 1.0));
        }
    }

    /// Gap that contact is to leave at each particle at the end of this step, in m: that which is wanted,
    /// 0 where it counts as closed, and infinite without a seam.
    pub(crate) fn gaps(&self) -> &[f64] {
        &self.gaps
    }

    /// Stiffens the springs from a time on, in s, so far that a gap closes which they left open;
    /// returns whether they were as usual before.
    pub(crate) fn stiffen(&mut self, time: f64, gap: f64) -> bool {
        let is_usual = self.stiffening.is_none();
        if is_usual {
            let factor = (gap / CLOSED_STRETCHED).max(1.0);
            self.stiffening = Some(Stiffening { start: time, factor });
        }
        is_usual
    }

    /// Increase of the stiffness, if there is one.
    pub(crate) fn stiffening(&self) -> Option<Stiffening> {
        self.stiffening
    }

    /// Returns to an increase of the stiffness, or to none.
    pub(crate) fn restore(&mut self, stiffening: Option<Stiffening>) {
        self.stiffening = stiffening;
    }

    /// Returns the time until the gaps are to be closed, in s.
    pub(crate) fn seconds(&self) -> f64 {
        self.seconds
    }

    /// State of the seams at some positions and a time, in s, after a step that left an imbalance,
    /// over g, with the width of a gap that counts as narrow, in m.
    pub(crate) fn state(
        &self,
        positions: &[f64],
        time: f64,
        imbalance: f64,
        narrow: f64,
    ) -> SeamState {
        let time = time - self.stiffening.map_or(0.0, |stiffening| stiffening.start);
        if time < self.seconds {
            return SeamState::Open;
        }
        let gap = self.widest_gap(positions);
        let late = time >= PATIENCE * self.seconds;
        let is_calm = imbalance <= TOLERANCE;
        let is_nearly_closed = gap.width <= narrow && time >= NEARLY_CLOSED_AFTER * self.seconds;
        match gap.width <= CLOSED && (late || is_calm) {
            true => SeamState::Closed,
            false if late => SeamState::Failed(gap),
            false if is_calm && is_nearly_closed => SeamState::NearlyClosed(gap),
            false => SeamState::Open,
        }
    }

    /// Widest gap at some positions.
    pub(crate) fn widest_gap(&self, positions: &[f64]) -> WidestGap {
        let start = WidestGap { width: 0.0, ends: [0; 2] };
        let gaps = self.seams.iter().map(|seam| WidestGap {
            width: seam.width(positions),
            ends: [0, 1].map(|k| seam.weights[k].particle),
        });
        gaps.fold(start, |widest, gap| if gap.width > widest.width { gap } else { widest })
    }

    /// Largest force of a spring at some positions, in N.
    pub(crate) fn largest_force(&self, positions: &[f64]) -> f64 {
        let squares = self.excess(positions).map(|e| e.iter().map(|x| x * x).sum::<f64>());
        self.stiffness * squares.fold(0.0, f64::max).sqrt()
    }

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

    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        let squares = self.excess(positions).map(|e| e.iter().map(|x| x * x).sum::<f64>());
        0.5 * self.stiffness * squares.sum::<f64>()
    }

    pub(crate) fn add_stiffness(&self, matrix: &mut BlockMatrix) {
        let block = |size: f64| -> [f64; 9] {
            std::array::from_fn(|k| if k % 4 == 0 { size } else { 0.0 })
        };
        for seam in &self.seams {
            for (k, a) in seam.weights.iter().enumerate() {
                for b in &seam.weights[k..] {
                    let block = block(a.weight * b.weight * self.stiffness);
                    matrix.add(a.particle as usize, b.particle as usize, &block);
                }
            }
        }
    }

    /// Differences between the gaps and those that are wanted.
    fn excess(&self, positions: &[f64]) -> impl Iterator<Item = [f64; 3]> {
        self.seams.iter().zip(&self.start_gaps).map(move |(seam, start)| {
            let now = seam.gap(positions);
            let fraction = start.fraction(self.remaining);
            [0, 1, 2].map(|axis| now[axis] - fraction * start.gap[axis])
        })
    }
}
