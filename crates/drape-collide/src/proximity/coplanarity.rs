//! Times at which four moving points lie in one plane.
//!
//! Two primitives that touch have their four vertices in one plane. With the differences
//! `$a, b, c$` of three points from the fourth, linear in time, the points lie in one plane where
//!
//! ```math
//! f(t) = a(t) \cdot (b(t) \times c(t)) = 0,
//! ```
//!
//! a cubic \[Pro97\]. As long as `$f$` has one sign, the primitives do not touch.

use crate::vector::{Vector, cross, dot, subtract};

/// Bound of the error of a coefficient, over the product of the sizes of the three differences. The
/// differences, the determinant, the mean and the subdivisions round some ten times by half of
/// EPSILON each.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Fraction of the tolerance below which a range of times is not divided further.
const RESOLUTION: f64 = 0.1;

/// Largest number of ranges that wait. A range is halved at most as often as an `f64` has bits.
const DEPTH: usize = 60;

/// Cubic `$f$` of four moving points.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coplanarity {
    /// Coefficients in the Bernstein basis for times from 0 to 1, in m³.
    coefficients: [f64; 4],
    /// Bound of the error of a value, in m³.
    error: f64,
}

/// Range of times without coplanar points, and the root behind it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Separation {
    /// Time up to which the cubic surely keeps its sign.
    pub(super) until: f64,
    /// Estimate of the root that follows `until`, if there may be one.
    pub(super) root: Option<f64>,
}

impl Coplanarity {
    /// Returns the cubic of points that move from `start` to `end`, in m.
    pub(super) fn new(start: [Vector; 4], end: [Vector; 4]) -> Coplanarity {
        let differences = |points: [Vector; 4]| {
            [points[1], points[2], points[3]].map(|point| subtract(point, points[0]))
        };
        let (start, end) = (differences(start), differences(end));
        let determinant = |ends: [bool; 3]| {
            let [a, b, c] = std::array::from_fn(|k| if ends[k] { end[k] } else { start[k] });
            dot(a, cross(b, c))
        };
        let mean = |a: f64, b: f64, c: f64| (a + b + c) / 3.0;
        let coefficients = [
            determinant([false; 3]),
            mean(
                determinant([true, false, false]),
                determinant([false, true, false]),
                determinant([false, false, true]),
            ),
            mean(
                determinant([false, true, true]),
                determinant([true, false, true]),
                determinant([true, true, false]),
            ),
            determinant([true; 3]),
        ];
        let sizes = start.into_iter().zip(end).map(|(start, end)| size(start).max(size(end)));
        let error = ROUNDING * sizes.product::<f64>() + f64::MIN_POSITIVE;
        Coplanarity { coefficients, error }
    }

    /// Returns the [`Separation`] from `time` to at most `end`. Ranges shorter than a part of
    /// `tolerance` are not divided further.
    pub(super) fn separation(&self, time: f64, end: f64, tolerance: f64) -> Separation {
        let [value, _] = self.value_and_slope(time);
        let sign = value.signum();
        let resolution = (RESOLUTION * tolerance).max(4.0 * f64::EPSILON);
        let mut until = time;

        // The earliest open range is tested first. Its lower hull ends the range, or divides it.
        let mut open = [[0.0; 2]; DEPTH];
        open[0] = [time, end];
        let mut waiting = 1;
        while waiting > 0 {
            let [low, high] = open[waiting - 1];
            let heights = self.between(low, high).map(|height| sign * height - self.error);
            // Without a certain sign at the beginning nothing is known.
            if !(heights[0] > 0.0) {
                break;
            }
            let Some(fraction) = hull_crossing(heights) else {
                until = high;
                waiting -= 1;
                continue;
            };
            let crossing = (low + fraction * (high - low)) * (1.0 - 4.0 * f64::EPSILON);
            until = until.max(crossing);
            if high - until <= resolution || waiting == DEPTH {
                break;
            }
            let middle = 0.5 * (until + high);
            open[waiting - 1] = [middle, high];
            open[waiting] = [until, middle];
            waiting += 1;
        }
        let root = if waiting > 0 { self.polished(until, end) } else { None };
        Separation { until, root }
    }

    /// Returns a root near `time` and before `end` by Newton's method, or `None` if the method
    /// leaves the range.
    fn polished(&self, time: f64, end: f64) -> Option<f64> {
        let mut root = time;
        for _ in 0..8 {
            let [value, slope] = self.value_and_slope(root);
            let step = -value / slope;
            if !step.is_finite() {
                return None;
            }
            root += step;
            if !(root >= 0.0 && root <= end) {
                return None;
            }
            if step.abs() <= 2.0 * f64::EPSILON * root {
                break;
            }
        }
        Some(root.max(time))
    }

    /// Returns value and slope of the cubic at `time`.
    fn value_and_slope(&self, time: f64) -> [f64; 2] {
        let [b0, b1, b2, b3] = self.coefficients;
        let mix = |a: f64, b: f64| (1.0 - time) * a + time * b;
        let [c0, c1, c2] = [mix(b0, b1), mix(b1, b2), mix(b2, b3)];
        let [d0, d1] = [mix(c0, c1), mix(c1, c2)];
        [mix(d0, d1), 3.0 * (d1 - d0)]
    }

    /// Returns the coefficients for times from `start` to `end`, by the values of the polar form.
    fn between(&self, start: f64, end: f64) -> [f64; 4] {
        [[start; 3], [start, start, end], [start, end, end], [end; 3]].map(|[r, s, t]| {
            let mix = |a: f64, b: f64, time: f64| (1.0 - time) * a + time * b;
            let [b0, b1, b2, b3] = self.coefficients;
            let [c0, c1, c2] = [mix(b0, b1, r), mix(b1, b2, r), mix(b2, b3, r)];
            mix(mix(c0, c1, s), mix(c1, c2, s), t)
        })
    }
}

/// Returns the sum of the magnitudes of the components of `vector`.
fn size(vector: Vector) -> f64 {
    vector.iter().map(|component| component.abs()).sum()
}

/// Returns the first fraction at which the lower hull of the control points `heights` falls to 0,
/// or `None` if all are above 0. The first height is above 0. No curve with these control points
/// falls to 0 earlier.
fn hull_crossing(heights: [f64; 4]) -> Option<f64> {
    let mut first: Option<f64> = None;
    for (j, low) in heights.into_iter().enumerate().filter(|(_, height)| *height <= 0.0) {
        for (i, high) in heights[..j].iter().enumerate().filter(|(_, height)| **height > 0.0) {
            let (i, j) = (i as f64 / 3.0, j as f64 / 3.0);
            let crossing = i + (j - i) * (high / (high - low));
            first = Some(first.map_or(crossing, |first| first.min(crossing)));
        }
    }
    first.map(|crossing| crossing * (1.0 - 4.0 * f64::EPSILON))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_ends_just_before_the_first_root() {
        // A point falls on a triangle that swings, from 1 m to -1 m.
        let start = [[0.2, 0.3, 1.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.3], [0.0, 1.0, 0.0]];
        let end = [[0.2, 0.3, -1.0], [0.0, 0.0, 0.2], [1.0, 0.0, -0.4], [0.0, 1.0, 0.1]];
        let cubic = Coplanarity::new(start, end);
        // The root by bisection.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if cubic.value_and_slope(middle)[0] * cubic.coefficients[0] > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        for tolerance in [1e-2, 1e-6, 1e-12] {
            let separation = cubic.separation(0.0, 1.0, tolerance);
            assert!(
                separation.until <= low && low - separation.until <= tolerance,
                "{separation:?}, {low}"
            );
            assert!(
                (separation.root.expect("a root") - low).abs() < 1e-14,
                "{separation:?}, {low}"
            );
        }
    }

    #[test]
    fn a_cubic_that_only_nears_zero_has_no_root() {
        // Heights of a point over a resting plane: 1, 0, 0, 1 in the Bernstein basis would touch 0.
        let cubic = Coplanarity { coefficients: [1.0, -0.32, -0.32, 1.0], error: 1e-15 };
        let separation = cubic.separation(0.0, 1.0, 1e-9);
        assert!(separation.until == 1.0 && separation.root.is_none(), "{separation:?}");
        let below = Coplanarity { coefficients: [1.0, -0.34, -0.34, 1.0], error: 1e-15 };
        let separation = below.separation(0.0, 1.0, 1e-9);
        assert!(separation.until < 0.5 && separation.root.is_some(), "{separation:?}");
    }
}
