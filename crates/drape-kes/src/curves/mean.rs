//! Mean of several measurements of one test, with their scatter.

use crate::curves::curve::{Curve, Point};
use crate::error::Error;

impl Curve {
    /// Returns the mean of `repeats` of one test: curves of further specimens of the fabric.
    ///
    /// Repeats at equal deformations are averaged point by point. Other repeats, such as tensile
    /// tests that end at one load, are averaged at equal fractions of each branch: deformations and
    /// loads alike. Noise of the deformations is removed before ([`Curve::prepared`]). The mean
    /// keeps the repeats ([`Curve::repeats`]).
    ///
    /// ```
    /// use drape_kes::{Curve, Direction, Test};
    ///
    /// let strip = |load: f64| {
    ///     let strain = vec![0.0, 0.02, 0.04];
    ///     Curve::new(Test::Tensile, Direction::Warp, strain, vec![0.0, 0.3 * load, load])
    /// };
    /// let mean = Curve::mean(vec![strip(190.0)?, strip(200.0)?, strip(210.0)?])?;
    /// assert_eq!(mean.load()[2], 200.0);
    /// assert_eq!(mean.scatter()[2], 10.0);
    /// # Ok::<(), drape_kes::Error>(())
    /// ```
    ///
    /// # Errors
    /// `repeats` is empty, or the curves have different numbers of branches.
    pub fn mean(repeats: Vec<Self>) -> Result<Self, Error> {
        /// Difference of two deformations, over their range, up to which the deformations are
        /// equal.
        const EQUAL_DEFORMATION: f64 = 1e-9;

        let repeats: Vec<Self> =
            repeats.iter().map(|curve| curve.prepared().into_owned()).collect();
        let Some(first) = repeats.first().cloned() else {
            return Err(Error::TooFewPoints { points: 0 });
        };
        if repeats.len() == 1 {
            return Ok(first);
        }
        let expected = first.branches().len();
        for (index, repeat) in repeats.iter().enumerate() {
            let branches = repeat.branches().len();
            if branches != expected {
                return Err(Error::UnlikeRepeats { repeat: index + 1, branches, expected });
            }
        }

        // Repeats at the deformations of the first curve need no interpolation.
        let tolerance = EQUAL_DEFORMATION * first.deformation_range().span();
        let have_equal_deformations = repeats.iter().all(|repeat| {
            let deformation = repeat.deformation();
            deformation.len() == first.deformation().len()
                && deformation
                    .iter()
                    .zip(first.deformation())
                    .all(|(a, b)| (a - b).abs() <= tolerance)
        });
        let sampled: Vec<Vec<Point>> = if have_equal_deformations {
            repeats.iter().map(|curve| curve.points().collect()).collect()
        } else {
            repeats.iter().map(|curve| sample_like(&first, curve)).collect()
        };

        let count = repeats.len() as f64;
        let mut points = Vec::with_capacity(sampled[0].len());
        let mut scatter = Vec::with_capacity(sampled[0].len());
        for index in 0..sampled[0].len() {
            let at_index: Vec<Point> = sampled.iter().map(|points| points[index]).collect();
            let deformation = at_index.iter().map(|point| point.deformation).sum::<f64>() / count;
            let load = at_index.iter().map(|point| point.load).sum::<f64>() / count;
            let square = at_index.iter().map(|point| (point.load - load).powi(2)).sum::<f64>();
            points.push(Point { deformation, load });
            scatter.push((square / (count - 1.0)).sqrt());
        }
        let mut mean = first.with_points(points);
        (mean.repeats, mean.scatter) = (repeats, scatter);
        Ok(mean)
    }
}

/// Returns points of `curve` at the fractions of its branches at which `pattern` was measured.
fn sample_like(pattern: &Curve, curve: &Curve) -> Vec<Point> {
    let mut sampled = Vec::with_capacity(pattern.load().len());
    let branches = pattern.branches().into_iter().zip(curve.branches());
    for (index, (pattern_branch, branch)) in branches.enumerate() {
        let points: Vec<Point> =
            curve.points().skip(branch.points.start).take(branch.points.len()).collect();
        let pattern_points: Vec<Point> = pattern
            .points()
            .skip(pattern_branch.points.start)
            .take(pattern_branch.points.len())
            .collect();
        let reached = fractions(&points);
        let (start, end) = (points[0].deformation, points[points.len() - 1].deformation);

        // A reversal is the last point of the branch before.
        for fraction in fractions(&pattern_points).into_iter().skip(usize::from(index > 0)) {
            let after = reached.partition_point(|&reached| reached < fraction);
            let after = after.clamp(1, points.len() - 1);
            let (a, b) = (reached[after - 1], reached[after]);
            let part = if b > a { ((fraction - a) / (b - a)).clamp(0.0, 1.0) } else { 1.0 };
            let load =
                points[after - 1].load + part * (points[after].load - points[after - 1].load);
            sampled.push(Point { deformation: start + fraction * (end - start), load });
        }
    }
    sampled
}

/// Returns the fraction of the branch that each of `points` has reached. The fractions never fall.
fn fractions(points: &[Point]) -> Vec<f64> {
    let (start, end) = (points[0].deformation, points[points.len() - 1].deformation);
    let mut reached = 0.0_f64;
    let mut fractions = Vec::with_capacity(points.len());
    for point in points {
        reached = reached.max(((point.deformation - start) / (end - start)).clamp(0.0, 1.0));
        fractions.push(reached);
    }
    fractions
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test::{Direction, Test};

    /// Strip stretched to a strain and released, in some steps.
    fn strip(extension: f64, steps: u32) -> Curve {
        let up = (0..=steps).map(|i| extension * f64::from(i) / f64::from(steps));
        let down = (0..steps).rev().map(|i| extension * f64::from(i) / f64::from(steps));
        let strain: Vec<f64> = up.chain(down).collect();
        let load = strain.iter().map(|q| 490.0 * q / extension).collect();
        Curve::new(Test::Tensile, Direction::Warp, strain, load).unwrap()
    }

    #[test]
    fn tests_that_end_at_one_load_have_the_mean_extension() {
        let mean = Curve::mean(vec![strip(0.04, 20), strip(0.05, 33), strip(0.06, 20)]).unwrap();
        assert!((mean.deformation_range().high - 0.05).abs() < 1e-12);
        assert!((mean.load_range().high - 490.0).abs() < 1e-9);
        assert!(mean.scatter().iter().all(|&scatter| scatter < 1e-9));
        assert_eq!((mean.load().len(), mean.repeats().len()), (41, 3));
        assert_eq!(mean.branches().len(), 2);
    }

    #[test]
    fn repeats_of_other_histories_are_refused() {
        let line = vec![0.0, 0.02, 0.04];
        let loading = Curve::new(Test::Tensile, Direction::Warp, line.clone(), line).unwrap();
        let error = Curve::mean(vec![strip(0.04, 20), loading]).unwrap_err();
        assert!(matches!(error, Error::UnlikeRepeats { repeat: 2, branches: 1, expected: 2 }));
    }
}
