//! Measured load–deformation curve, in SI.

use std::borrow::Cow;
use std::ops::Range;

use crate::curves::branch::{Branch, reversals};
use crate::curves::extent::Extent;
use crate::curves::preparation::Preparation;
use crate::error::Error;
use crate::test::{Direction, Test};

/// Point of a curve, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    pub(crate) deformation: f64,
    pub(crate) load: f64,
}

/// Load–deformation curve in the order of measurement, in SI.
///
/// The points are one history. A fabric has memory, so loading, unloading and repeated cycles must
/// stay in the order in which they were measured.
///
/// ```
/// use drape_kes::{Curve, Direction, Test};
///
/// // A strip stretched by 4 % and released.
/// let strain = vec![0.0, 0.02, 0.04, 0.02, 0.01];
/// let tension = vec![0.0, 60.0, 200.0, 30.0, 0.0];
/// let curve = Curve::new(Test::Tensile, Direction::Warp, strain, tension)?;
/// assert_eq!(curve.branches().len(), 2);
/// assert_eq!(curve.load_range().high, 200.0);
/// # Ok::<(), drape_kes::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name used in reports.
    pub name: String,
    /// Test, which fixes the meaning of deformation and load.
    pub test: Test,
    /// Yarns along which the strip was loaded.
    pub direction: Direction,
    /// Free length of the specimen between the clamps, if it was given; in metres.
    pub gauge: Option<f64>,
    /// Whether the strip hung slack at the start. The zeros of strain and force of a slack strip
    /// are unknown, and are fitted.
    pub slack: bool,
    deformation: Vec<f64>,
    load: Vec<f64>,
    time: Option<Vec<f64>>,
    preparation: Option<Preparation>,
    pub(crate) repeats: Vec<Curve>,
    pub(crate) scatter: Vec<f64>,
}

impl Curve {
    /// Creates a curve from its points in SI, in the order of measurement.
    ///
    /// # Errors
    /// The two columns differ in length, there are fewer than two points, a value is not finite, or
    /// the deformation never changes.
    pub fn new(
        test: Test,
        direction: Direction,
        deformation: Vec<f64>,
        load: Vec<f64>,
    ) -> Result<Self, Error> {
        if deformation.len() != load.len() {
            let (deformations, loads) = (deformation.len(), load.len());
            return Err(Error::UnpairedColumns { deformations, loads });
        }
        if deformation.len() < 2 {
            return Err(Error::TooFewPoints { points: deformation.len() });
        }
        for (index, (&q, &f)) in deformation.iter().zip(&load).enumerate() {
            if !(q.is_finite() && f.is_finite()) {
                return Err(Error::NotFinite { index, deformation: q, load: f });
            }
        }
        if deformation.iter().all(|&q| q == deformation[0]) {
            return Err(Error::ConstantDeformation { deformation: deformation[0] });
        }

        let name = format!("{} {}", test.name(), direction.name());
        Ok(Self {
            name,
            test,
            direction,
            gauge: None,
            slack: false,
            deformation,
            load,
            time: None,
            preparation: None,
            repeats: Vec::new(),
            scatter: Vec::new(),
        })
    }

    /// Returns the curve with the `time` of each point, in seconds or another unit.
    ///
    /// Times help to tell noise of the deformation from changes of its rate. The `time` is ignored
    /// if its length differs from the number of points, or if it does not rise.
    #[must_use]
    pub fn with_time(mut self, time: Vec<f64>) -> Self {
        let rises = time.windows(2).all(|pair| pair[0] < pair[1]);
        let usable = time.len() == self.load.len() && rises && time.iter().all(|t| t.is_finite());
        self.time = usable.then_some(time);
        self
    }

    /// Returns the time of each point in the unit of [`with_time`](Self::with_time), if it is
    /// known.
    #[must_use]
    pub fn time(&self) -> Option<&[f64]> {
        self.time.as_deref()
    }

    /// Returns what [`Curve::prepared`] changed and found; `None` for a curve as measured.
    #[must_use]
    pub fn preparation(&self) -> Option<&Preparation> {
        self.preparation.as_ref()
    }

    /// Stores the `preparation` of the curve.
    pub(crate) fn set_preparation(&mut self, preparation: Preparation) {
        self.preparation = Some(preparation);
    }

    /// Replaces the deformation of each point by `deformation`, in SI.
    pub(crate) fn set_deformation(&mut self, deformation: Vec<f64>) {
        self.deformation = deformation;
    }

    /// Returns the points, in the order of measurement.
    pub(crate) fn points(&self) -> impl Iterator<Item = Point> {
        let pairs = self.deformation.iter().zip(&self.load);
        pairs.map(|(&deformation, &load)| Point { deformation, load })
    }

    /// Returns about `count` of the points, evenly spaced in each branch, with every reversal. A
    /// curve of fewer points is returned unchanged.
    #[must_use]
    pub fn thinned(&self, count: usize) -> Cow<'_, Self> {
        let stride = self.load.len().div_ceil(count.max(1));
        if stride <= 1 {
            return Cow::Borrowed(self);
        }

        let mut kept = Vec::new();
        for branch in self.branches() {
            let last = branch.points.end - 1;
            kept.extend(branch.points.step_by(stride));
            kept.push(last);
        }
        kept.dedup();

        // The repeats have other points, so the thinned curve has none.
        let points: Vec<Point> = self.points().collect();
        let points = kept.iter().map(|&index| points[index]).collect();
        let mut curve = self.clone().with_points(points);
        (curve.repeats, curve.scatter) = (Vec::new(), Vec::new());
        Cow::Owned(curve)
    }

    /// Returns the curve with strains that count from the strain `zero`, a ratio.
    pub(crate) fn counted_from(&self, zero: f64) -> Self {
        let mut curve = self.clone();
        curve.deformation.iter_mut().for_each(|strain| *strain -= zero);
        if let Some(Preparation { rupture: Some(rupture), .. }) = &mut curve.preparation {
            rupture.strain -= zero;
        }
        curve
    }

    /// Returns the curve without the points below zero strain at its start and at its end. Returns
    /// `None` if fewer than two points remain.
    pub(crate) fn taut(&self) -> Option<Self> {
        let first = self.deformation.iter().position(|&strain| strain >= 0.0)?;
        let last = self.deformation.iter().rposition(|&strain| strain >= 0.0)?;
        if last <= first {
            return None;
        }
        let points = self.points().skip(first).take(last + 1 - first).collect();
        let mut curve = self.clone().with_points(points);
        if let Some(preparation) = &mut curve.preparation {
            preparation.zero_is_given = true;
        }
        Some(curve)
    }

    /// Returns the curve with other `points`. The times are kept only if the number of points is
    /// unchanged.
    pub(crate) fn with_points(mut self, points: Vec<Point>) -> Self {
        self.time = self.time.filter(|time| time.len() == points.len());
        self.deformation = points.iter().map(|point| point.deformation).collect();
        self.load = points.iter().map(|point| point.load).collect();
        self
    }

    /// Returns the deformation at each point, in SI; see [`Test`].
    #[must_use]
    pub fn deformation(&self) -> &[f64] {
        &self.deformation
    }

    /// Returns the load per width at each point, in SI; see [`Test`].
    #[must_use]
    pub fn load(&self) -> &[f64] {
        &self.load
    }

    /// Returns the curves of which this curve is the mean. The slice is empty for a curve measured
    /// once.
    #[must_use]
    pub fn repeats(&self) -> &[Self] {
        &self.repeats
    }

    /// Returns the standard deviation of the load over the repeats at each point, in SI. The slice
    /// is empty for a curve measured once.
    #[must_use]
    pub fn scatter(&self) -> &[f64] {
        &self.scatter
    }

    /// Returns the [`Extent`] of the deformation, in SI.
    #[must_use]
    pub fn deformation_range(&self) -> Extent {
        Extent::from_values(&self.deformation)
    }

    /// Returns the [`Extent`] of the load, in SI.
    #[must_use]
    pub fn load_range(&self) -> Extent {
        Extent::from_values(&self.load)
    }

    /// Returns each [`Branch`] of the history, in order.
    #[must_use]
    pub fn branches(&self) -> Vec<Branch> {
        let q = self.deformation();
        reversals(q)
            .windows(2)
            .map(|ends| Branch { points: ends[0]..ends[1] + 1, rising: q[ends[1]] > q[ends[0]] })
            .collect()
    }

    /// Returns the cycles of the history as ranges of points. A cycle is a branch and the branch
    /// back.
    #[must_use]
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

    fn curve(deformation: &[f64], load: &[f64]) -> Result<Curve, Error> {
        Curve::new(Test::Bending, Direction::Warp, deformation.to_vec(), load.to_vec())
    }

    #[test]
    fn a_thinned_curve_keeps_its_turns_and_its_order() {
        let q: Vec<f64> = (0..=700).chain((0..700).rev()).map(f64::from).collect();
        let whole = curve(&q, &q).expect("a curve");
        let thin = whole.thinned(100);
        assert!((90..115).contains(&thin.load().len()), "{}", thin.load().len());
        assert_eq!(thin.deformation_range(), whole.deformation_range());
        assert_eq!((thin.branches().len(), thin.deformation()[0]), (2, 0.0));
        assert!(matches!(whole.thinned(5000), Cow::Borrowed(_)));
    }

    #[test]
    fn a_curve_needs_two_paired_finite_points_that_move() {
        assert!(curve(&[0.0, 1.0], &[0.0, 2.0]).is_ok());
        assert!(matches!(curve(&[0.0, 1.0], &[0.0]), Err(Error::UnpairedColumns { .. })));
        assert!(matches!(curve(&[0.0], &[0.0]), Err(Error::TooFewPoints { points: 1 })));
        let nan = curve(&[0.0, 1.0], &[0.0, f64::NAN]);
        assert!(matches!(nan, Err(Error::NotFinite { index: 1, .. })));
        assert!(matches!(curve(&[1.0, 1.0], &[0.0, 2.0]), Err(Error::ConstantDeformation { .. })));
    }
}
