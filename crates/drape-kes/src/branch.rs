//! Branches and reversals of a history, found through the noise of its sampling.

use std::ops::Range;

use crate::Curve;

/// Motion against the branch that counts as a reversal, as a part of the whole range.
///
/// Lower, and the jitter of a clamp splits a branch; higher, and small inner loops are missed. Position
/// sensors jitter below 0.1 % of the range, and the smallest inner loop of a test worth measuring is some
/// 5 % of it.
const REVERSAL_THRESHOLD: f64 = 0.01;

/// A stretch of a history during which the deformation goes one way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Branch {
    /// The points of the branch; neighbouring branches share the point where they meet.
    pub points: Range<usize>,
    /// Whether the deformation rises.
    pub rising: bool,
}

/// Where a history turns back, from its first point to its last: the ends of its branches.
///
/// A point is a turn once the deformation has moved back from it by 1 % of the whole range, so the jitter
/// of a sensor makes none.
pub fn reversals(deformation: &[f64]) -> Vec<usize> {
    let Some(&first) = deformation.first() else {
        return Vec::new();
    };
    let (low, high) =
        deformation.iter().fold((first, first), |(low, high), &q| (low.min(q), high.max(q)));
    let threshold = REVERSAL_THRESHOLD * (high - low);
    let moved = |from: usize, to: usize| deformation[to] - deformation[from];
    let Some(start) = (0..deformation.len()).find(|&i| moved(0, i).abs() > threshold) else {
        return vec![0, deformation.len() - 1];
    };
    let mut turns = vec![0];
    let mut extreme = start;
    let mut sense = moved(0, start).signum();
    for index in start..deformation.len() {
        let ahead = sense * moved(extreme, index);
        if ahead > 0.0 {
            extreme = index;
        } else if -ahead > threshold {
            turns.push(extreme);
            extreme = index;
            sense = -sense;
        }
    }
    if turns.last() != Some(&(deformation.len() - 1)) {
        turns.push(deformation.len() - 1);
    }
    turns
}

impl Curve {
    /// The branches of the history, in order.
    pub fn branches(&self) -> Vec<Branch> {
        let q = self.deformation();
        reversals(q)
            .windows(2)
            .map(|ends| Branch { points: ends[0]..ends[1] + 1, rising: q[ends[1]] > q[ends[0]] })
            .collect()
    }

    /// The cycles of the history: each branch out with the branch back, as ranges of points.
    pub fn cycles(&self) -> Vec<Range<usize>> {
        let branches = self.branches();
        branches
            .chunks(2)
            .filter(|pair| pair.len() == 2)
            .map(|pair| pair[0].points.start..pair[1].points.end)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangle wave 0 → 1 → −1 → 1 → … with `steps` points per unit.
    fn wave(steps: usize, ends: &[f64]) -> Vec<f64> {
        let mut q = vec![ends[0]];
        for pair in ends.windows(2) {
            let count = ((pair[1] - pair[0]).abs() * steps as f64) as usize;
            q.extend((1..=count).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / count as f64));
        }
        q
    }

    #[test]
    fn the_turns_of_a_clean_history_are_its_extremes() {
        let q = wave(20, &[0.0, 1.0, -1.0, 0.5]);
        assert_eq!(reversals(&q), [0, 20, 60, 90]);
        assert_eq!(reversals(&wave(20, &[0.0, -1.0, 1.0])), [0, 20, 60]);
        assert_eq!(reversals(&[0.0, 1.0]), [0, 1]);
    }

    #[test]
    fn jitter_below_the_threshold_makes_no_turn() {
        let mut q = wave(50, &[0.0, 1.0, 0.0, 1.0, 0.0]);
        for (index, value) in q.iter_mut().enumerate() {
            // A sawtooth of ±0.4 % of the range, above the step's own direction now and then.
            *value += 0.004 * if index % 2 == 0 { 1.0 } else { -1.0 };
        }
        let turns = reversals(&q);
        assert_eq!(turns.len(), 5, "{turns:?}");
        for (turn, exact) in turns.iter().zip([0usize, 50, 100, 150, 200]) {
            assert!(turn.abs_diff(exact) <= 1, "turn at {turn}, exact {exact}");
        }
    }

    #[test]
    fn a_rest_at_the_end_of_a_branch_belongs_to_it() {
        let q = [0.0, 0.5, 1.0, 1.0, 1.0, 0.5, 0.0, 0.0];
        assert_eq!(reversals(&q), [0, 2, 7]);
    }
}
