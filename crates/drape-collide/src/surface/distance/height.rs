//! Height of a point over a plane, with a bound of its rounding.

use crate::vector::Vector;

/// Bound of the error of a dot product of differences, over the sum of the magnitudes of its terms.
///
/// The difference, the product and two sums round once each, by half of EPSILON. Together they give
/// 2 EPSILON and terms of second order. The remainder covers the rounding of the bound itself.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Height of a point over a plane, in m, with a bound of its error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Height {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

/// Returns the height `$n \cdot (x - o)$` of `point` over the plane through `origin`.
pub(crate) fn height(normal: Vector, point: Vector, origin: Vector) -> Height {
    let terms: Vector = std::array::from_fn(|k| normal[k] * (point[k] - origin[k]));
    let size = terms[0].abs() + terms[1].abs() + terms[2].abs();
    // Products below the smallest normal number may lose all their digits.

    Height { value: terms[0] + terms[1] + terms[2], error: ROUNDING * size + f64::MIN_POSITIVE }
}
