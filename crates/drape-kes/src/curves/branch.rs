//! Branches and reversals of a history, found through the noise of its sampling.

use std::ops::Range;

/// Motion against the branch that counts as a reversal, over the whole range.
///
/// A smaller threshold would let the jitter of a clamp split a branch. A larger one would miss
/// small inner loops. Position sensors jitter below 0.1 % of the range, and the smallest inner loop
/// worth measuring is some 5 % of it.
pub(crate) const REVERSAL_THRESHOLD: f64 = 0.01;

/// Part of a history on which the deformation rises or falls.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Branch {
    /// Points of the branch; neighbouring branches share their reversal.
    pub points: Range<usize>,
    /// Whether the deformation rises.
    pub rising: bool,
}

/// Returns the indices of the reversals of `deformation`, with the first and the last point: the
/// ends of the branches.
///
/// A point is a reversal once the deformation has moved back from it by 1 % of the whole range. The
/// jitter of a sensor is smaller, and therefore no reversal.
///
/// ```
/// use drape_kes::reversals;
///
/// assert_eq!(reversals(&[0.0, 0.5, 1.0, 0.4, -0.2, 0.3]), [0, 2, 4, 5]);
/// ```
#[must_use]
pub fn reversals(deformation: &[f64]) -> Vec<usize> {
    let Some(&first) = deformation.first() else {
        return Vec::new();
    };
    let (low, high) =
        deformation.iter().fold((first, first), |(low, high), &q| (low.min(q), high.max(q)));
    reversals_beyond(deformation, REVERSAL_THRESHOLD * (high - low))
}

/// Returns the indices of the reversals of a `deformation` that is not empty, with the first and
/// the last point.
///
/// A point is a reversal once the deformation has moved back from it by more than `threshold`.
pub(crate) fn reversals_beyond(deformation: &[f64], threshold: f64) -> Vec<usize> {
    let has_moved = |&index: &usize| (deformation[index] - deformation[0]).abs() > threshold;
    let Some(start) = (0..deformation.len()).find(has_moved) else {
        return vec![0, deformation.len() - 1];
    };

    // The extreme of the current branch becomes a reversal once the deformation is back from it.
    let mut reversals = vec![0];
    let mut extreme = start;
    let mut sign = (deformation[start] - deformation[0]).signum();
    for index in start..deformation.len() {
        let advance = sign * (deformation[index] - deformation[extreme]);
        if advance > 0.0 {
            extreme = index;
        } else if -advance > threshold {
            reversals.push(extreme);
            extreme = index;
            sign = -sign;
        }
    }

    if reversals.last() != Some(&(deformation.len() - 1)) {
        reversals.push(deformation.len() - 1);
    }
    reversals
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangle wave through some ends, with `steps` points per unit.
    fn wave(steps: usize, ends: &[f64]) -> Vec<f64> {
        let mut q = vec![ends[0]];
        for pair in ends.windows(2) {
            let count = ((pair[1] - pair[0]).abs() * steps as f64) as usize;
            q.extend((1..=count).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / count as f64));
        }
        q
    }

    #[test]
    fn the_reversals_of_a_clean_history_are_its_extremes() {
        let q = wave(20, &[0.0, 1.0, -1.0, 0.5]);
        assert_eq!(reversals(&q), [0, 20, 60, 90]);
        assert_eq!(reversals(&wave(20, &[0.0, -1.0, 1.0])), [0, 20, 60]);
        assert_eq!(reversals(&[0.0, 1.0]), [0, 1]);
    }

    #[test]
    fn jitter_below_the_threshold_makes_no_reversal() {
        let mut q = wave(50, &[0.0, 1.0, 0.0, 1.0, 0.0]);
        for (index, value) in q.iter_mut().enumerate() {
            // A sawtooth of ±0.4 % of the range, above the step's own direction now and then.
            *value += 0.004 * if index % 2 == 0 { 1.0 } else { -1.0 };
        }
        let found = reversals(&q);
        assert_eq!(found.len(), 5, "{found:?}");
        for (found, exact) in found.iter().zip([0usize, 50, 100, 150, 200]) {
            assert!(found.abs_diff(exact) <= 1, "reversal at {found}, exact {exact}");
        }
    }

    #[test]
    fn a_rest_at_the_end_of_a_branch_belongs_to_it() {
        let q = [0.0, 0.5, 1.0, 1.0, 1.0, 0.5, 0.0, 0.0];
        assert_eq!(reversals(&q), [0, 2, 7]);
    }
}
