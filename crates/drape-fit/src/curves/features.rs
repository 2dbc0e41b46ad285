//! Features of a curve before any fit: its test, its slope, its size.

use drape_kes::{Curve, Test};
use drape_lm::Parameter;

use crate::error::Error;

/// Checks that `curve` is of the test `needed`, and has a load that changes.
pub(crate) fn check(curve: &Curve, needed: Test) -> Result<(), Error> {
    let name = curve.name.clone();
    if curve.test != needed {
        return Err(Error::WrongTest { name, given: curve.test, needed });
    }
    let load = curve.load_range();
    if load.low == load.high {
        return Err(Error::ConstantLoad { name, load: load.low });
    }
    Ok(())
}

/// Returns the error of a `curve` whose load does not rise.
pub(crate) fn falling(curve: &Curve) -> Error {
    Error::FallingLoad { name: curve.name.clone() }
}

/// Returns the largest magnitude of a `deformation`.
pub(crate) fn largest(deformation: &[f64]) -> f64 {
    deformation.iter().fold(0.0, |largest: f64, q| largest.max(q.abs()))
}

/// Straight line through points.
#[derive(Clone, Copy)]
pub(crate) struct StraightLine {
    pub(crate) slope: f64,
    pub(crate) intercept: f64,
}

impl StraightLine {
    /// Fits a line to `points`, each `[x, y]`, by least squares; `None` if all have one `x`.
    pub(crate) fn through(points: impl Iterator<Item = [f64; 2]> + Clone) -> Option<Self> {
        let count = points.clone().count() as f64;
        let [sx, sy] = points.clone().fold([0.0, 0.0], |[sx, sy], [x, y]| [sx + x, sy + y]);
        let (mx, my) = (sx / count, sy / count);
        let [xx, xy] = points
            .fold([0.0, 0.0], |[xx, xy], [x, y]| [xx + (x - mx).powi(2), xy + (x - mx) * (y - my)]);
        let slope = xy / xx;
        slope.is_finite().then_some(Self { slope, intercept: my - slope * mx })
    }
}

/// Returns the slope of the line through all points of `curve`.
///
/// The slope is the stiffness of the backbone. Friction hardly changes it, because friction has
/// both signs.
pub(crate) fn mean_slope(curve: &Curve) -> Result<f64, Error> {
    let points = curve.deformation().iter().zip(curve.load()).map(|(q, load)| [*q, *load]);
    let slope = StraightLine::through(points).map(|line| line.slope);
    slope.filter(|slope| *slope > 0.0).ok_or_else(|| falling(curve))
}

/// Returns the unknown zero of the load of `curve` as a parameter, at most half of the load range
/// away.
pub(crate) fn zero(curve: &Curve) -> Parameter {
    let load = curve.load_range().span();
    Parameter::new(0.0).with_scale(load).between(-0.5 * load, 0.5 * load)
}

#[cfg(test)]
mod tests {
    use drape_kes::Direction;

    use super::*;

    fn curve(deformation: &[f64], load: &[f64]) -> Curve {
        let columns = (deformation.to_vec(), load.to_vec());
        Curve::new(Test::Bending, Direction::Warp, columns.0, columns.1).expect("it is a curve")
    }

    #[test]
    fn the_mean_slope_is_that_of_least_squares_whatever_the_zeros() {
        // Sums by hand: mean x = 4, Σ(x − 4)² = 20, mean y = 9, Σ(x − 4)(y − 9) = 32.
        let found = mean_slope(&curve(&[1.0, 3.0, 5.0, 7.0], &[4.0, 8.0, 10.0, 14.0]));
        let slope = found.expect("the load rises");
        assert!((slope - 1.6).abs() < 1e-14, "{slope}");
        let line =
            StraightLine::through([[1.0, 4.0], [3.0, 8.0], [5.0, 10.0], [7.0, 14.0]].into_iter());
        let intercept = line.expect("the points have several x").intercept;
        assert!((intercept - 2.6).abs() < 1e-14, "{intercept}");
    }

    #[test]
    fn a_load_that_falls_or_stays_on_average_has_no_mean_slope() {
        for load in [[4.0, 2.0, 1.0], [1.0, 2.0, 1.0]] {
            let found = mean_slope(&curve(&[1.0, 2.0, 3.0], &load));
            assert!(matches!(found, Err(Error::FallingLoad { .. })), "{load:?}: {found:?}");
        }
    }

    #[test]
    fn the_zero_of_the_load_lies_within_half_of_its_range() {
        let zero = zero(&curve(&[0.0, 1.0, 2.0], &[-1.0, 2.0, 5.0]));
        assert_eq!(zero, Parameter::new(0.0).with_scale(6.0).between(-3.0, 3.0));
    }
}
