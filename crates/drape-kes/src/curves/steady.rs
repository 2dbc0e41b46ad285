//! Removes the noise of a sensor from the path of a deformation between its turns.
//!
//! A fabric has memory, so each small step back of a noisy deformation would work as a cycle of the
//! fabric's friction. Between two turns a test moves in one direction. The path is smoothed along
//! the points, or along the time if it is known, and made monotone by isotonic regression
//! \[BBBB72\].

use crate::curves::branch::{REVERSAL_THRESHOLD, reversals_beyond};
use crate::curves::extent::Extent;

/// Part of the steps that go back above which the path is smoothed. With fewer backward steps the
/// path is only made monotone.
const NOISY: f64 = 0.02;

/// Part of the range of a deformation above which the extent of a branch is not noise.
const CLEAR: f64 = 0.05;

/// Change of the deformation over a smoothing window, relative to the error of the window's mean.
///
/// With this ratio the smoothed path hardly turns back, and the windows stay short relative to a
/// branch.
const TREND: f64 = 8.0;

/// Least number of points of a window on each side of its centre.
const LEAST_HALF: usize = 2;

/// Largest part of a branch in a window on each side of its centre. A longer window would blur a
/// change of the rate of the test.
const LARGEST_HALF: f64 = 0.05;

/// Changes of the path of a curve's deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyPath {
    /// Number of steps that went back against their branch.
    pub backward_steps: usize,
    /// Largest backward step, in the unit of the deformation in SI.
    pub largest_step: f64,
    /// Standard deviation of the noise of the deformation, in SI.
    pub noise: f64,
    /// Number of turns between the branches.
    pub turns: usize,
    /// Whether the path was smoothed. Otherwise the path was only made monotone.
    pub smoothed: bool,
}

impl SteadyPath {
    /// Returns the changes in words, for a deformation whose range has the width `span`, in SI.
    #[must_use]
    pub fn describe(&self, span: f64) -> String {
        let Self { backward_steps, largest_step, turns, smoothed, .. } = *self;

        let times =
            if backward_steps == 1 { "once".to_owned() } else { format!("{backward_steps} times") };
        let percent = 100.0 * largest_step / span;
        let most =
            if percent < 0.01 { "less than 0.01".into() } else { format!("at most {percent:.2}") };
        let verb = if smoothed { "smoothed" } else { "made monotone" };
        let between = match turns {
            0 => "as one branch".to_owned(),
            1 => "on both sides of its turn".to_owned(),
            _ => format!("between its {turns} turns"),
        };

        format!(
            "the deformation turns back {times}, by {most} % of its range; its path was {verb} \
             {between}"
        )
    }
}

/// Returns the deformations `q` moved to a path that moves in one direction between its turns, and
/// the changes. Returns `None` if `q` needs no change. The `time` of each point is used if it is
/// known.
pub(crate) fn steady_path(q: &[f64], time: Option<&[f64]>) -> Option<(Vec<f64>, SteadyPath)> {
    let span = Extent::from_values(q).span();
    if has_clear_branches(q, span) {
        return None;
    }
    let noise = noise_of(q);
    let threshold = (REVERSAL_THRESHOLD * span).max(noise_excursion(noise, q.len()));
    let turns = reversals_beyond(q, threshold);
    let (backward_steps, largest_step) = backward_steps(q, &turns);
    if backward_steps == 0 {
        return None;
    }

    let smoothed = backward_steps as f64 > NOISY * q.len() as f64;
    let abscissa: Vec<f64> = match time {
        Some(time) => time.to_vec(),
        None => (0..q.len()).map(|i| i as f64).collect(),
    };
    let turns = if smoothed { move_turns(&abscissa, q, &turns, noise) } else { turns };

    let mut path = q.to_vec();
    for ends in turns.windows(2) {
        let points = ends[0]..ends[1] + 1;
        let mut branch = if smoothed {
            smooth(&abscissa[points.clone()], &q[points.clone()], noise)
        } else {
            q[points.clone()].to_vec()
        };
        let rising = q[ends[1]] > q[ends[0]];
        make_monotone(&mut branch, rising);
        // A turn ends one branch and begins the next: its deformation is the mean of both.
        let shared = ends[0] > 0;
        let before = path[ends[0]];
        path[points].copy_from_slice(&branch);
        if shared {
            path[ends[0]] = 0.5 * (before + branch[0]);
        }
    }

    // The mean at a turn must not undo the order of its neighbours.
    for ends in turns.windows(2) {
        let rising = q[ends[1]] > q[ends[0]];
        make_monotone(&mut path[ends[0]..=ends[1]], rising);
    }
    let turns = turns.len() - 2;
    Some((path, SteadyPath { backward_steps, largest_step, noise, turns, smoothed }))
}

/// Returns whether every branch of `q` covers a clear part of `span`. Such a history has no noise:
/// coarse steps of a curve with few points are no noise.
fn has_clear_branches(q: &[f64], span: f64) -> bool {
    let least = CLEAR * span;
    let turns = reversals_beyond(q, 0.0);
    turns.windows(2).all(|ends| (q[ends[1]] - q[ends[0]]).abs() >= least)
}

/// Returns the standard deviation of the noise of `q`, a history that moves at a steady rate except
/// at its turns.
///
/// The deviation follows from the median of the second differences, whose variance is six times the
/// variance of the noise. If the steps of a sensor are coarse, most second differences are zero,
/// and so is their median. Then the mean square of all second differences except the largest
/// hundredth is used.
fn noise_of(q: &[f64]) -> f64 {
    /// Median of the absolute value of a normal variate of unit deviation.
    const NORMAL_MEDIAN: f64 = 0.6745;

    let mut second: Vec<f64> =
        q.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]).abs()).collect();
    if second.is_empty() {
        return 0.0;
    }
    second.sort_by(f64::total_cmp);
    let median = second[second.len() / 2] / NORMAL_MEDIAN;
    let kept = &second[..(second.len() * 99 / 100).max(1)];
    let mean_square = kept.iter().map(|d| d * d).sum::<f64>() / kept.len() as f64;
    let deviation = if median > 0.0 { median } else { mean_square.sqrt() };
    deviation / 6_f64.sqrt()
}

/// Returns the largest distance between two of `count` points that the standard deviation `noise`
/// explains.
///
/// The largest of `$n$` normal variates is about `$\sqrt{2\ln n}$`, and the smallest is its
/// negative.
fn noise_excursion(noise: f64, count: usize) -> f64 {
    noise * (2.0 * (2.0 * (count as f64).ln()).sqrt() + 1.0)
}

/// Returns the number of steps of `q` that go back against their branch between two `turns`, and
/// the largest such step.
fn backward_steps(q: &[f64], turns: &[usize]) -> (usize, f64) {
    let mut count = 0;
    let mut largest = 0.0_f64;
    for ends in turns.windows(2) {
        let sign = (q[ends[1]] - q[ends[0]]).signum();
        for pair in q[ends[0]..=ends[1]].windows(2) {
            let back = -sign * (pair[1] - pair[0]);
            if back > 0.0 {
                count += 1;
                largest = largest.max(back);
            }
        }
    }
    (count, largest)
}

/// Returns `turns` of `q` moved to the points where the lines through the points before and after
/// meet.
///
/// The extreme of noisy points is the point with the largest noise, and may lie anywhere near the
/// turn.
fn move_turns(abscissa: &[f64], q: &[f64], turns: &[usize], noise: f64) -> Vec<usize> {
    let mut moved_turns = turns.to_vec();
    for index in 1..turns.len().saturating_sub(1) {
        let (before, turn, after) = (turns[index - 1], turns[index], turns[index + 1]);
        // The lines are fitted to twice the half window of smoothing on each side.
        let span = (q[turn] - q[before]).abs();
        let reach_before = (half_window(turn - before, span, noise) * 2).min(turn - before);
        let reach_after = (half_window(after - turn, span, noise) * 2).min(after - turn);

        // Each point within half the reach is tried as the corner of two lines.
        let window = turn - reach_before..turn + reach_after + 1;
        let candidates = turn - reach_before / 2..turn + reach_after / 2 + 1;
        let errors = candidates.map(|corner| {
            let error = line_error(abscissa, q, window.start..corner + 1)
                + line_error(abscissa, q, corner..window.end);
            (corner, error)
        });
        let best = errors.min_by(|(_, a), (_, b)| a.total_cmp(b));
        moved_turns[index] = best.map_or(turn, |(corner, _)| corner);
    }
    moved_turns
}

/// Returns the sum of squared distances of the `points` of `x` and `y` from their least-squares
/// line.
fn line_error(x: &[f64], y: &[f64], points: std::ops::Range<usize>) -> f64 {
    let (x, y) = (&x[points.clone()], &y[points]);
    let line = Line::through(x, y);
    x.iter().zip(y).map(|(x, y)| (line.at(*x) - y).powi(2)).sum()
}

/// Straight line through the mean of its points.
pub(crate) struct Line {
    x: f64,
    y: f64,
    slope: f64,
}

impl Line {
    /// Returns the least-squares line through the points of `x` and `y`.
    pub(crate) fn through(x: &[f64], y: &[f64]) -> Self {
        let count = x.len() as f64;
        let (mean_x, mean_y) = (x.iter().sum::<f64>() / count, y.iter().sum::<f64>() / count);
        let (mut xx, mut xy) = (0.0, 0.0);
        for (x, y) in x.iter().zip(y) {
            xx += (x - mean_x) * (x - mean_x);
            xy += (x - mean_x) * (y - mean_y);
        }
        Self { x: mean_x, y: mean_y, slope: if xx > 0.0 { xy / xx } else { 0.0 } }
    }

    /// Returns the ordinate at `x`.
    pub(crate) fn at(&self, x: f64) -> f64 {
        self.y + self.slope * (x - self.x)
    }
}

/// Returns the number of points of a window on each side of its centre, for a branch of `points`
/// points that covers `span`.
///
/// Over a window of `$m$` points the path moves by `$m$` steps, and the mean of the window errs by
/// `$\sigma/\sqrt m$`.
fn half_window(points: usize, span: f64, noise: f64) -> usize {
    let step = span / points.max(1) as f64;
    let needed = if step > 0.0 { (TREND * noise / step).powf(2.0 / 3.0) } else { 0.0 };
    let most = ((LARGEST_HALF * points as f64) as usize).max(LEAST_HALF);
    (0.5 * needed).ceil().clamp(LEAST_HALF as f64, most as f64) as usize
}

/// Returns the ordinates `y` of one branch, each replaced by the line through the points of its
/// window.
fn smooth(x: &[f64], y: &[f64], noise: f64) -> Vec<f64> {
    let last = y.len() - 1;
    let half = half_window(y.len(), (y[last] - y[0]).abs(), noise);
    let mut smoothed = Vec::with_capacity(y.len());
    for (i, &x_i) in x.iter().enumerate() {
        // At an end of the branch the window reaches to one side only, and keeps its length.
        let start = i.saturating_sub(half).min(last.saturating_sub(2 * half));
        let end = (start + 2 * half).min(last).max((i + half).min(last));
        smoothed.push(Line::through(&x[start..=end], &y[start..=end]).at(x_i));
    }
    smoothed
}

/// Replaces `values` by the nearest values that never turn back. Neighbours that turn back are
/// pooled.
fn make_monotone(values: &mut [f64], rising: bool) {
    // Each pool has a mean and a size.
    let mut pools: Vec<(f64, usize)> = Vec::with_capacity(values.len());
    for &value in values.iter() {
        pools.push((value, 1));
        while let [.., (before, m), (after, n)] = pools[..] {
            let turns_back = if rising { after < before } else { after > before };
            if !turns_back {
                break;
            }
            let (total, size) = (before * m as f64 + after * n as f64, m + n);
            pools.truncate(pools.len() - 2);
            pools.push((total / size as f64, size));
        }
    }
    let pooled = pools.iter().flat_map(|&(mean, size)| std::iter::repeat_n(mean, size));
    for (value, mean) in values.iter_mut().zip(pooled) {
        *value = mean;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Normal deviates by a generator that is the same everywhere.
    struct Random(u64);

    impl Random {
        fn normal(&mut self) -> f64 {
            let mut uniform = || {
                self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                (self.0 >> 11) as f64 / (1_u64 << 53) as f64
            };
            (0..12).map(|_| uniform()).sum::<f64>() - 6.0
        }
    }

    /// Triangle wave through some ends at a steady rate, with so many points in all.
    fn wave(ends: &[f64], points: usize) -> Vec<f64> {
        let total: f64 = ends.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
        let mut q = vec![ends[0]];
        for pair in ends.windows(2) {
            let count = (points as f64 * (pair[1] - pair[0]).abs() / total).round();
            q.extend(
                (1..=count as usize).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / count),
            );
        }
        q
    }

    #[test]
    fn a_noisy_path_comes_back_to_the_true_one() {
        let ends = [0.0, 1.0, -1.0, 0.0];
        for points in [400, 3000, 10_000] {
            for noise in [1e-5, 3e-4, 1e-3, 3e-3] {
                let truth = wave(&ends, points);
                let mut random = Random(points as u64);
                let q: Vec<f64> = truth.iter().map(|q| q + noise * random.normal()).collect();
                let Some((path, done)) = steady_path(&q, None) else {
                    assert!(noise < 4.0 / points as f64, "{points} points with {noise}");
                    continue;
                };
                assert_eq!(done.turns, 2, "{points} points with {noise}");
                let errors = path.iter().zip(&truth).map(|(a, b)| (a - b).powi(2));
                let rms = (errors.sum::<f64>() / truth.len() as f64).sqrt();
                let worst = path.iter().zip(&truth).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(rms < 1.1 * noise, "{points} points, noise {noise}: rms {rms}");
                // A turn is known to a few times the noise of a window.
                assert!(worst < 4.0 * noise, "{points} points, noise {noise}: {worst}");
            }
        }
    }

    #[test]
    fn the_noise_is_found_from_the_path_itself() {
        let mut random = Random(3);
        let q: Vec<f64> =
            wave(&[0.0, 1.0, 0.0], 2000).iter().map(|q| q + 2e-3 * random.normal()).collect();
        assert!((noise_of(&q) / 2e-3 - 1.0).abs() < 0.1, "{}", noise_of(&q));
    }

    #[test]
    fn cycles_of_growing_size_keep_their_turns_through_noise() {
        let ends = [0.0, 0.1, 0.0, 0.4, 0.0, 1.0, 0.0];
        let mut random = Random(5);
        let q: Vec<f64> = wave(&ends, 4000).iter().map(|q| q + 2e-3 * random.normal()).collect();
        let (path, done) = steady_path(&q, None).expect("it turns back");
        assert_eq!(done.turns, 5);
        assert_eq!(reversals_beyond(&path, 0.01).len(), 7);
    }

    #[test]
    fn a_path_without_steps_back_stays_as_it_is() {
        assert!(steady_path(&wave(&[0.0, 0.04, 0.0], 200), None).is_none());
    }

    #[test]
    fn a_single_slip_is_pooled_and_nothing_is_smoothed() {
        let mut q = wave(&[0.0, 1.0, 0.0], 400);
        q[50] = q[48];
        let (path, done) = steady_path(&q, None).expect("it turns back");
        assert!(!done.smoothed && done.backward_steps == 1, "{done:?}");
        let changed: Vec<usize> = (0..q.len()).filter(|&i| path[i] != q[i]).collect();
        assert_eq!(changed, [49, 50]);
    }

    #[test]
    fn coarse_steps_of_a_sensor_are_its_noise() {
        // A converter of 1 % steps that flickers by one step.
        let q: Vec<f64> = wave(&[0.0, 1.0, 0.0], 3000)
            .iter()
            .enumerate()
            .map(|(i, q)| ((q * 100.0).round() + f64::from(u8::from(i % 7 == 0))) / 100.0)
            .collect();
        let (path, done) = steady_path(&q, None).expect("it turns back");
        assert_eq!(done.turns, 1, "{done:?}");
        assert!((path[750] - 0.5).abs() < 0.01, "{}", path[750]);
    }

    #[test]
    fn a_curve_of_few_points_at_any_distance_is_left_as_it_is() {
        // Points read off a printed loop.
        let q = [0.0, 0.03, 0.11, 0.31, 0.35, 0.72, 1.0, 0.93, 0.4, 0.38, 0.12, 0.05];
        assert_eq!(steady_path(&q, None), None);
    }
}
