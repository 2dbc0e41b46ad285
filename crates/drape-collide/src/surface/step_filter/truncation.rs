//! Truncation of a step vertex by vertex, by the room that each pair has to approach.
//!
//! All vertices move at the same time. Over the plane between the closest points of a pair, the
//! lowest height of the first primitive is then concave in time, and the highest of the second
//! convex. A pair that keeps a tenth of its clearance at the end of the step therefore keeps it all
//! along.

use std::sync::atomic::{AtomicU64, Ordering};

use super::safeguards::Safeguards;
use super::separating_planes::SeparatingPlane;
use super::trial::{CHUNK, CLOSED, Drift, Trial};
use crate::surface::broad_phase::CandidatePairs;
use crate::surface::distance::{Height, height};
use crate::surface::pair::Pair;
use crate::threads::*;
use crate::vector::{Vector, add, at, at_or_zero};

/// Fraction of the clearance by which a pair may approach including rounding. It is above
/// [`CLOSED`].
const ROUNDED: f64 = 0.95;

/// Fraction of its room by which a pair may approach without a test of the end.
const SAFE: f64 = 0.9;

/// Excess of an approach over its room, relative to the room, that counts as rounding.
const EXCESS: f64 = 1e-9;

/// Largest number of rounds in which fractions are limited. A layer that stops limits the layer
/// above it in the next round.
const ROUNDS: usize = 200;

/// Largest number of tests of the end of a step. After the last one no vertex moves.
const ENDS: usize = 20;

/// Result of a step that was truncated vertex by vertex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Truncation {
    /// Common fraction of the displacements of bodies and held vertices.
    pub body_fraction: f64,
    /// Smallest fraction of a vertex.
    pub least_fraction: f64,
    /// Number of vertices whose displacement is truncated.
    pub shortened: usize,
    /// Number of vertices that the drift budget limits. Pairs must be detected before the next
    /// step.
    pub at_drift_budget: usize,
    /// Number of pairs so near their minimum separation that their vertices may not approach.
    pub frozen: usize,
}

/// Step before its truncation, with the pairs that may meet on it.
#[derive(Clone, Copy)]
pub(super) struct WholeStep<'a> {
    pub(super) pairs: &'a CandidatePairs,
    pub(super) trial: Trial<'a>,
    pub(super) drift: &'a Drift,
    /// Group of each free vertex. If the list is empty, each vertex is a group.
    pub(super) groups: &'a [u32],
    pub(super) safeguards: Safeguards,
}

impl WholeStep<'_> {
    /// Returns the group of `vertex`. All bodies are one group, numbered by the count of free
    /// vertices.
    fn group(&self, vertex: usize) -> usize {
        match self.groups.get(vertex) {
            Some(&group) => group as usize,
            None => vertex.min(self.pairs.free),
        }
    }
}

/// Approach of a pair in a whole step, and its room.
#[derive(Debug, Clone, Copy)]
struct Approach {
    vertices: [u32; 4],
    groups: [u32; 4],
    /// Number of vertices of the first primitive.
    first: usize,
    /// Approach of each vertex to the other primitive, in m.
    approaches: [f64; 4],
    /// Excess distance of each vertex from the other primitive over the nearest vertex, in m.
    offsets: [f64; 4],
    /// Distance by which the two primitives may approach, in m.
    room: f64,
    normal: Vector,
    /// Smallest allowed difference of the primitives' heights at the end, in m.
    kept: f64,
}

/// Fractions of the groups of vertices and approaches of the pairs of a truncation.
#[derive(Debug, Default)]
pub(super) struct Truncator {
    /// Fraction of each group as bits, which have the order of positive numbers.
    fractions: Vec<AtomicU64>,
    /// Fractions before the current round.
    before: Vec<f64>,
    /// Pairs in each chunk of candidates that may come too near. Lists beyond the candidates are
    /// empty.
    chunks: Vec<Vec<Approach>>,
}

impl Truncator {
    /// Writes the truncated displacements of `step` to `truncated`, in m. The vertices of a group
    /// move by a common fraction.
    pub(super) fn truncate(&mut self, step: WholeStep<'_>, truncated: &mut [f64]) -> Truncation {
        let WholeStep { pairs, trial, drift, safeguards, .. } = step;
        let vertices = trial.positions.len() / 3;
        self.fractions.resize_with(vertices + 1, AtomicU64::default);
        self.fractions.iter_mut().for_each(|fraction| *fraction.get_mut() = 1f64.to_bits());

        let mut at_drift_budget = 0;
        if safeguards.drift_budget {
            for vertex in 0..drift.vertices() {
                let fraction = drift.budget_fraction(pairs, &trial, vertex);
                at_drift_budget += usize::from(fraction < 1.0);
                self.limit(step.group(vertex), fraction);
            }
        }
        let frozen = self.find_approaches(&step);

        // Fractions within the rooms are tested at the end of the step, with all rounding. Vertices
        // of pairs that fail the test stop, which may affect other pairs.
        for end in 0..=ENDS {
            self.settle();
            if end == ENDS {
                self.fractions.iter_mut().for_each(|fraction| *fraction.get_mut() = 0);
            }
            let all = truncated.as_chunks_mut::<3>().0.iter_mut().enumerate();
            for ((vertex, displacement), whole) in all.zip(trial.displacements.as_chunks::<3>().0) {
                let fraction = self.fraction(step.group(vertex));
                *displacement = whole.map(|component| fraction * component);
            }
            if self.stop_unproved(trial.positions, truncated) {
                break;
            }
        }

        let fractions = (0..vertices).map(|vertex| self.fraction(step.group(vertex)));
        Truncation {
            body_fraction: self.fraction(pairs.free),
            least_fraction: fractions.clone().fold(1.0, f64::min),
            shortened: fractions.filter(|fraction| *fraction < 1.0).count(),
            at_drift_budget,
            frozen,
        }
    }

    /// Returns the fraction of `group`, 0 to 1.
    fn fraction(&self, group: usize) -> f64 {
        f64::from_bits(self.fractions[group].load(Ordering::Relaxed))
    }

    /// Limits the fraction of `group` to `fraction`. The least limit does not depend on the order.
    fn limit(&self, group: usize, fraction: f64) {
        let fraction = if fraction > 0.0 { fraction } else { 0.0 };
        self.fractions[group].fetch_min(fraction.to_bits(), Ordering::Relaxed);
    }

    /// Finds the pairs of `step` that may come too near, and freezes pairs without room. Returns
    /// the number of frozen pairs.
    fn find_approaches(&mut self, step: &WholeStep<'_>) -> usize {
        let candidates = step.pairs.as_slice().par_chunks(CHUNK);
        let mut chunks = std::mem::take(&mut self.chunks);
        if chunks.len() < candidates.len() {
            chunks.resize_with(candidates.len(), Vec::new);
        }
        chunks.iter_mut().for_each(Vec::clear);

        let frozen = candidates.zip(&mut chunks).map(|(candidates, chunk)| {
            let mut frozen = 0;
            for pair in candidates.iter().filter(|pair| !step.drift.stays_apart(pair, &step.trial))
            {
                let plane = SeparatingPlane::new(pair, pair.points(step.trial.positions));
                let approach = Approach::new(pair, &plane, step);
                if approach.room > 0.0 {
                    chunk.extend((!approach.is_safe()).then_some(approach));
                    continue;
                }
                frozen += 1;
                if step.safeguards.freeze {
                    self.freeze(&approach, plane.low > plane.high);
                    chunk.push(approach);
                }
            }
            frozen
        });
        let frozen = frozen.sum();
        self.chunks = chunks;
        frozen
    }

    /// Lets no vertex of `pair` approach. If its primitives are not `parted`, no vertex moves.
    fn freeze(&self, pair: &Approach, parted: bool) {
        for (group, approach) in pair.groups.into_iter().zip(pair.approaches) {
            if !(parted && approach <= 0.0) {
                self.limit(group as usize, 0.0);
            }
        }
    }

    /// Limits the fractions until no pair approaches by more than its room.
    fn settle(&mut self) {
        for _ in 0..ROUNDS {
            let now = self
                .fractions
                .iter()
                .map(|fraction| f64::from_bits(fraction.load(Ordering::Relaxed)));
            self.before.clear();
            self.before.extend(now);

            // Limits refer to the fractions before the round, so their order does not matter.
            let changed = self.chunks.par_iter().map(|chunk| {
                let mut changed = false;
                for approach in chunk {
                    let Some(limits) = approach.limits(&self.before) else { continue };
                    changed = true;
                    for (group, limit) in approach.groups.into_iter().zip(limits) {
                        self.limit(group as usize, limit);
                    }
                }
                changed
            });
            // All chunks set their limits, so the loop must not stop at the first change.
            if changed.filter(|is_changed| *is_changed).count() == 0 {
                return;
            }
        }

        // After too many rounds all fractions shrink together: a smaller part of all motion takes
        // less of each room.
        let parts = self.chunks.iter().flatten().map(|approach| {
            let [above, below] =
                approach.at_fractions(approach.groups.map(|group| self.fraction(group as usize)));
            if above + below > approach.room { approach.room / (above + below) } else { 1.0 }
        });
        let part = parts.fold(1.0, f64::min);
        for group in 0..self.fractions.len() {
            self.limit(group, part * self.fraction(group));
        }
    }

    /// Stops the vertices of pairs that are not proved apart at the end of the step from
    /// `positions` along `displacements`. Returns whether all pairs are proved apart.
    fn stop_unproved(&self, positions: &[f64], displacements: &[f64]) -> bool {
        let proved = self.chunks.par_iter().map(|chunk| {
            let mut proved = true;
            for approach in chunk {
                let start = approach.vertices.map(|vertex| at(positions, vertex as usize));
                let end = approach.vertices.map(|vertex| {
                    let vertex = vertex as usize;
                    add(at(positions, vertex), at_or_zero(displacements, vertex))
                });
                if !(start == end || approach.is_proved(end, start[0])) {
                    proved = false;
                    approach.groups.iter().for_each(|&group| self.limit(group as usize, 0.0));
                }
            }
            proved
        });
        // Every chunk is tested, so the loop must not stop at the first chunk without a proof.
        proved.filter(|is_proved| !is_proved).count() == 0
    }
}

impl Approach {
    /// Returns the approach of `pair` over the `plane` that separates its primitives. It has no
    /// room if the primitives must not approach.
    fn new(pair: &Pair, plane: &SeparatingPlane, step: &WholeStep<'_>) -> Approach {
        let clearance = plane.clearance(pair.min_separation);
        let apart = plane.low - plane.high;
        let kept = apart - ROUNDED * clearance;
        // A clearance of NaN leaves no room.
        let open = clearance > step.trial.smallest
            && SeparatingPlane::holds(kept, 0.0, pair.min_separation);
        Approach {
            vertices: pair.vertices,
            groups: pair.vertices.map(|vertex| step.group(vertex as usize) as u32),
            first: pair.first_vertex_count(),
            approaches: plane.approaches(pair, step.trial.displacements(pair)),
            offsets: plane.offsets(pair),
            room: if open { CLOSED * clearance } else { 0.0 },
            normal: plane.normal,
            kept: if open { kept } else { apart },
        }
    }

    /// Returns whether the room suffices with all rounding, for any fractions of the step.
    fn is_safe(&self) -> bool {
        let [above, below] = self.at_fractions([1.0; 4]);
        above.max(0.0) + below.max(0.0) < SAFE * self.room
    }

    /// Returns the approach of each primitive at the vertices' `fractions` of the whole step, in m.
    /// The vertex that is then nearest to the other primitive counts. An approach is negative where
    /// the primitive moves away.
    fn at_fractions(&self, fractions: [f64; 4]) -> [f64; 2] {
        let mut nearest = [f64::NEG_INFINITY; 2];
        for (k, fraction) in fractions.into_iter().enumerate() {
            let approach = &mut nearest[usize::from(k >= self.first)];
            *approach = approach.max(fraction * self.approaches[k] - self.offsets[k]);
        }
        nearest
    }

    /// Returns limits of the vertices' fractions if the primitives would approach by more than the
    /// room, else `None`. `fractions` holds the fractions of all groups.
    ///
    /// Two primitives that approach each other share the room by their speeds. A primitive that
    /// follows the other may also go as far as the other.
    fn limits(&self, fractions: &[f64]) -> Option<[f64; 4]> {
        let current = self.groups.map(|group| fractions[group as usize]);
        let [above, below] = self.at_fractions(current);
        if above + below <= self.room * (1.0 + EXCESS) {
            return None;
        }

        let shares = if below <= 0.0 {
            [self.room - below, f64::INFINITY]
        } else if above <= 0.0 {
            [f64::INFINITY, self.room - above]
        } else {
            [above, below].map(|approach| self.room * approach / (above + below))
        };
        Some(std::array::from_fn(|k| {
            let allowed = shares[usize::from(k >= self.first)] + self.offsets[k];
            let wanted = current[k] * self.approaches[k];
            if wanted > allowed { allowed / self.approaches[k] } else { 1.0 }
        }))
    }

    /// Returns whether the primitives are surely far enough apart with the vertices at `end`.
    /// Heights count from `origin`.
    fn is_proved(&self, end: [Vector; 4], origin: Vector) -> bool {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, point) in end.into_iter().enumerate() {
            let Height { value, error } = height(self.normal, point, origin);
            if k < self.first {
                low = low.min(value - error)
            } else {
                high = high.max(value + error)
            }
        }
        low - high >= self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Truncator of whole displacements, with chunks of one pair each.
    fn truncator(groups: usize, pairs: Vec<Approach>) -> Truncator {
        Truncator {
            fractions: (0..groups).map(|_| AtomicU64::new(1f64.to_bits())).collect(),
            before: Vec::new(),
            chunks: pairs.into_iter().map(|pair| vec![pair]).collect(),
        }
    }

    fn fractions(truncator: &Truncator) -> Vec<f64> {
        (0..truncator.fractions.len()).map(|group| truncator.fraction(group)).collect()
    }

    /// Edge of vertices 0 and 1 at a height of 1 over one of vertices 2 and 3.
    fn edges(approaches: [f64; 4], room: f64) -> Approach {
        Approach {
            vertices: [0, 1, 2, 3],
            groups: [0, 1, 2, 3],
            first: 2,
            approaches,
            offsets: [0.0; 4],
            room,
            normal: [0.0, 0.0, 1.0],
            kept: 1.0 - room,
        }
    }

    #[test]
    fn an_approach_is_safe_that_leaves_a_tenth_of_its_room() {
        for (approaches, is_safe) in [
            ([0.2, 0.4, 0.4, 0.1], true),
            ([0.2, 0.4, 0.55, 0.1], false),
            // One that moves away gives no room: the other may be truncated.
            ([0.95, 0.0, -2.0, -3.0], false),
            ([-1.0, -1.0, -2.0, -3.0], true),
        ] {
            assert_eq!(edges(approaches, 1.0).is_safe(), is_safe, "{approaches:?}");
        }
    }

    #[test]
    fn two_that_approach_share_their_room_by_their_speeds() {
        let pair = Approach { offsets: [0.0, 0.1, 0.0, 0.0], ..edges([1.2, 1.0, 0.6, 0.1], 0.3) };
        let limits = pair.limits(&[0.5; 4]).expect("they approach by 0.9 m");
        for (limit, expected) in limits.into_iter().zip([0.2 / 1.2, 0.3, 0.1 / 0.6, 1.0]) {
            assert!((limit - expected).abs() < 1e-15, "{limits:?}");
        }
        assert!(pair.limits(&[0.5 / 3.0; 4]).is_none());
    }

    #[test]
    fn an_end_is_proved_with_its_rounding() {
        let at_heights = |heights: [f64; 4]| heights.map(|height| [0.0, 0.0, height]);
        let pair = Approach { kept: 0.75, ..edges([0.0; 4], 0.25) };
        for heights in [[0.75, 1.0, 0.0, 0.0], [0.0, 0.0, -0.75, -1.0]] {
            assert!(!pair.is_proved(at_heights(heights), [0.0; 3]), "{heights:?}");
            let farther = heights.map(|height| height * (1.0 + 1e-14));
            assert!(pair.is_proved(at_heights(farther), [0.0; 3]), "{heights:?}");
        }
    }

    #[test]
    fn a_frozen_pair_may_part_but_not_approach_and_a_pair_in_touch_rests() {
        let pair = edges([0.1, 0.0, -0.1, 1e-9], 0.0);
        let own = truncator(4, Vec::new());
        own.freeze(&pair, true);
        assert_eq!(fractions(&own), [0.0, 1.0, 1.0, 0.0]);
        own.freeze(&pair, false);
        assert_eq!(fractions(&own), [0.0; 4]);
        for none in [-0.0, -1.0, f64::NAN] {
            let own = truncator(1, Vec::new());
            own.limit(0, none);
            assert_eq!(own.fraction(0).to_bits(), 0, "{none}");
        }
    }

    #[test]
    fn limits_that_do_not_end_are_replaced_by_a_common_fraction_that_leaves_all_rooms() {
        // Two that follow each other, each a little more slowly: their limits fall for ever.
        let slower = 0.9995;
        let one = Approach { groups: [0, 0, 1, 1], ..edges([1.0, 1.0, -slower, -slower], 1e-4) };
        let other = Approach { groups: [1, 1, 0, 0], ..one };
        let mut own = truncator(3, vec![one, other]);
        own.settle();
        let found = fractions(&own);
        assert!(
            found[2] > 0.0 && found[2] < 1.0,
            "a group without a pair has the common part: {found:?}"
        );
        for (pair, chunk) in [one, other].iter().zip(&own.chunks) {
            assert_eq!(pair.groups, chunk[0].groups);
            let [above, below] = pair.at_fractions(pair.groups.map(|group| found[group as usize]));
            assert!(above + below <= pair.room * (1.0 + EXCESS), "{above} {below} {}", pair.room);
            // As much of its room is taken as a pair may.
            assert!(above + below > 0.5 * pair.room || above < below, "{above} {below}");
        }
    }

    #[test]
    fn vertices_of_pairs_that_are_not_proved_apart_stop() {
        let positions = [0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let sinks = |depth: f64| {
            let mut displacements = [0.0; 12];
            displacements[5] = -depth;
            displacements
        };
        let pair = edges([0.0; 4], 0.5);
        let far = Approach { kept: -10.0, ..pair };
        for (depth, proved) in [(0.0, true), (0.4, true), (0.6, false)] {
            for pairs in [vec![pair], vec![far, pair], vec![pair, far]] {
                let own = truncator(4, pairs);
                assert_eq!(own.stop_unproved(&positions, &sinks(depth)), proved, "{depth}");
                let expected = if proved { [1.0; 4] } else { [0.0; 4] };
                assert_eq!(fractions(&own), expected, "{depth}");
            }
        }
        // A pair that has no room is proved if it rests, and only then.
        let tight = Approach { kept: 1.5, ..pair };
        let own = truncator(4, vec![tight]);
        assert!(own.stop_unproved(&positions, &sinks(0.0)) && fractions(&own) == [1.0; 4]);
        assert!(!own.stop_unproved(&positions, &sinks(-0.1)) && fractions(&own) == [0.0; 4]);
    }
}
