//! Convergence: the error that the spacing of a grid leaves in a value, by Richardson's
//! extrapolation.
//!
//! The error of a value is assumed to be C hᵖ with the spacing h and the order p. Three spacings
//! give the limit, C and p [Cel08]. With two spacings p is [`GRID_ORDER`]. The uncertainty is a
//! multiple of the estimated error [Roa94].

/// Order of the cloth's grid, which is the highest order that is used.
pub const GRID_ORDER: f64 = 2.0;

/// Lowest order for which a limit is estimated.
const ORDER_MIN: f64 = 0.5;

/// Ratio of uncertainty to error if three spacings give the order.
const SAFETY: f64 = 1.25;

/// Ratio of uncertainty to error, or to the range of the values, if the spacings do not give the
/// order.
const SAFETY_WITHOUT_ORDER: f64 = 3.0;

/// Value that a run on a grid has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridValue {
    /// Spacing of the grid, above 0.
    pub spacing: f64,
    /// Value on this grid.
    pub value: f64,
}

/// Way in which the values of several grids approach a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Approach {
    /// With this order, which the three finest grids give. A higher order than [`GRID_ORDER`] is
    /// replaced by [`GRID_ORDER`].
    Measured(f64),
    /// With the order [`GRID_ORDER`], which is assumed because two grids cannot give an order.
    Assumed,
    /// Not at all: the values oscillate, or their differences do not become smaller.
    None,
}

/// Convergence of a value with the spacing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convergence {
    /// How the values approach the limit.
    pub approach: Approach,
    /// Estimated value at a spacing of 0, or the value on the finest grid if there is no approach.
    pub limit: f64,
    /// Uncertainty of the value on the finest grid.
    pub uncertainty: f64,
    /// Coefficient C of the error C hᵖ.
    coefficient: f64,
}

impl Convergence {
    /// Returns the convergence of `values` on two or more grids of different spacings. If there are
    /// more than three grids, the three finest are used. Returns `None` if there are fewer than two
    /// grids.
    ///
    /// ```
    /// use drape_sweep::{Convergence, GridValue};
    ///
    /// let value = |spacing: f64| GridValue { spacing, value: 422.0 + 0.024 * spacing * spacing };
    /// let convergence = Convergence::new(&[20.0, 14.0, 10.0].map(value)).expect("three grids");
    /// assert!((convergence.limit - 422.0).abs() < 1e-9);
    /// assert!((convergence.uncertainty - 1.25 * 2.4).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn new(values: &[GridValue]) -> Option<Self> {
        let mut values = values.to_vec();
        values.sort_by(|a, b| a.spacing.total_cmp(&b.spacing));
        match values[..] {
            [fine, coarse] => Some(Self::with_order(GRID_ORDER, [fine, coarse], Approach::Assumed)),
            [fine, middle, coarse, ..] => match order([fine, middle, coarse]) {
                Some(order) => {
                    Some(Self::with_order(order, [fine, middle], Approach::Measured(order)))
                }
                None => {
                    let values = [fine, middle, coarse].map(|grid| grid.value);
                    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
                    let uncertainty = SAFETY_WITHOUT_ORDER * (most - least);
                    let (approach, limit) = (Approach::None, fine.value);
                    Some(Self { approach, limit, uncertainty, coefficient: 0.0 })
                }
            },
            _ => None,
        }
    }

    /// Returns the convergence with the given `order` through the values on two grids.
    fn with_order(order: f64, [fine, coarse]: [GridValue; 2], approach: Approach) -> Self {
        let coefficient =
            (coarse.value - fine.value) / (coarse.spacing.powf(order) - fine.spacing.powf(order));
        let error = coefficient * fine.spacing.powf(order);
        let safety = if approach == Approach::Assumed { SAFETY_WITHOUT_ORDER } else { SAFETY };
        let (limit, uncertainty) = (fine.value - error, safety * error.abs());
        Self { approach, limit, uncertainty, coefficient }
    }

    /// Returns the value that the limit and the error C hᵖ predict for `spacing`.
    #[must_use]
    pub fn at(&self, spacing: f64) -> f64 {
        let order = match self.approach {
            Approach::Measured(order) => order,
            Approach::Assumed | Approach::None => GRID_ORDER,
        };
        self.limit + self.coefficient * spacing.powf(order)
    }
}

/// Returns the order p with which three `values`, finest first, approach a limit, at most
/// [`GRID_ORDER`]. Returns `None` if the order is below [`ORDER_MIN`], or if the values do not
/// approach a limit.
fn order(values: [GridValue; 3]) -> Option<f64> {
    let [fine, middle, coarse] = values;
    let differences = [middle.value - fine.value, coarse.value - middle.value];
    if differences == [0.0, 0.0] {
        return Some(GRID_ORDER);
    }
    let ratio = differences[1] / differences[0];

    // The ratio of the differences grows with the order, which is found by bisection.
    let spacings = values.map(|grid| grid.spacing);
    if ratio.is_nan() || ratio < difference_ratio(spacings, ORDER_MIN) {
        return None;
    }
    let (mut low, mut high) = (ORDER_MIN, GRID_ORDER);
    if ratio >= difference_ratio(spacings, GRID_ORDER) {
        return Some(GRID_ORDER);
    }
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if difference_ratio(spacings, middle) < ratio { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// Returns the ratio of the differences of values with an error of the given `order` on grids with
/// the `spacings`, finest first.
fn difference_ratio(spacings: [f64; 3], order: f64) -> f64 {
    let [fine, middle, coarse] = spacings.map(|spacing| spacing.powf(order));
    (coarse - middle) / (middle - fine)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(pairs: &[(f64, f64)]) -> Vec<GridValue> {
        pairs.iter().map(|&(spacing, value)| GridValue { spacing, value }).collect()
    }

    #[test]
    fn a_power_of_the_spacing_is_found_with_its_limit() {
        for order in [0.7, 1.0, 1.6, 2.0] {
            let value = |h: f64| (h, 5.0 - 0.3 * h.powf(order));
            let found = Convergence::new(&values(&[0.5, 2.0, 1.3].map(value))).expect("three");
            let Approach::Measured(measured) = found.approach else { panic!("{found:?}") };
            assert!((measured - order).abs() < 1e-9, "{order}: {found:?}");
            assert!((found.limit - 5.0).abs() < 1e-9, "{found:?}");
            assert!((found.uncertainty - 1.25 * 0.3 * 0.5_f64.powf(order)).abs() < 1e-9);
            assert!((found.at(1.3) - value(1.3).1).abs() < 1e-9);
        }
    }

    #[test]
    fn a_higher_order_is_taken_as_that_of_the_grid() {
        let value = |h: f64| (h, 1.0 + h.powi(4));
        let found = Convergence::new(&values(&[1.0, 2.0, 4.0].map(value))).expect("three");
        assert_eq!(found.approach, Approach::Measured(GRID_ORDER));
        assert!((found.limit - (2.0 - 15.0 / 3.0)).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn two_grids_have_the_order_assumed_and_a_wider_uncertainty() {
        let found = Convergence::new(&values(&[(2.0, 14.0), (1.0, 11.0)])).expect("two");
        assert_eq!((found.approach, found.limit), (Approach::Assumed, 10.0));
        assert_eq!(found.uncertainty, 3.0);
        assert_eq!(Convergence::new(&values(&[(2.0, 14.0)])), None);
    }

    #[test]
    fn values_that_swing_or_spread_have_no_limit() {
        for numbers in [[1.0, 2.0, 1.5], [1.0, 2.0, 2.5], [1.0, 1.0, 2.0]] {
            let [fine, middle, coarse] = numbers;
            let found = Convergence::new(&values(&[(1.0, fine), (2.0, middle), (4.0, coarse)]));
            let found = found.expect("three");
            if numbers == [1.0, 1.0, 2.0] {
                // The fine grids agree: nothing is left.
                assert_eq!((found.limit, found.uncertainty), (1.0, 0.0));
                continue;
            }
            assert_eq!((found.approach, found.limit), (Approach::None, 1.0));
            assert!(
                (found.uncertainty - 3.0 * (numbers.iter().fold(0.0_f64, |a, &b| a.max(b)) - 1.0))
                    .abs()
                    < 1e-12
            );
        }
        let same = Convergence::new(&values(&[(1.0, 3.0), (2.0, 3.0), (4.0, 3.0)])).expect("three");
        assert_eq!((same.limit, same.uncertainty), (3.0, 0.0));
    }
}
