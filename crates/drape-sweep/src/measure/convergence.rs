//! Convergence: what the spacing of a grid leaves in a value, by Richardson's extrapolation.
//!
//! The error of a value is taken as C hᵖ, h being the spacing and p the order. Three spacings give
//! the value, C and p [Cel08]; of two, p is [`GRID_ORDER`]. The uncertainty is a multiple of the error so
//! found [Roa94].

/// Order of the cloth's grid, which is the highest that is used.
pub const GRID_ORDER: f64 = 2.0;

/// Lowest order with which a limit is given.
const ORDER_MIN: f64 = 0.5;

/// Uncertainty over the error where three spacings give the order.
const SAFETY: f64 = 1.25;

/// Uncertainty over the error, or over the range of the values, where they do not give it.
const SAFETY_WITHOUT_ORDER: f64 = 3.0;

/// Value on a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridValue {
    /// Spacing, above 0.
    pub spacing: f64,
    /// Value.
    pub value: f64,
}

/// How the values of several grids approach a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Approach {
    /// With an order that the three finest grids give, at most [`GRID_ORDER`]: it is 2 too where they give a
    /// higher one.
    Measured(f64),
    /// With the order [`GRID_ORDER`], which two grids cannot give.
    Assumed,
    /// Not at all: the values swing, or their differences do not become smaller.
    None,
}

/// Convergence of a value with the spacing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Convergence {
    /// How the values approach the limit.
    pub approach: Approach,
    /// Value at a spacing of 0; that of the finest grid where there is no approach.
    pub limit: f64,
    /// Uncertainty of the value of the finest grid.
    pub uncertainty: f64,
    /// C of the error C hᵖ.
    coefficient: f64,
}

impl Convergence {
    /// Returns the convergence of values on two grids or more, each with its own spacing; of the three
    /// finest if there are more. `None` of fewer.
    ///
    /// ```
    /// use drape_sweep::{Convergence, GridValue};
    ///
    /// let value = |spacing: f64| GridValue { spacing, value: 422.0 + 0.024 * spacing * spacing };
    /// let found = Convergence::new(&[20.0, 14.0, 10.0].map(value)).expect("three grids");
    /// assert!((found.limit - 422.0).abs() < 1e-9);
    /// assert!((found.uncertainty - 1.25 * 2.4).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn new(values: &[GridValue]) -> Option<Self> {
        let mut values = values.to_vec();
        values.sort_by(|a, b| a.spacing.total_cmp(&b.spacing));
        let found = match values[..] {
            [fine, coarse] => Self::with_order(GRID_ORDER, [fine, coarse], Approach::Assumed),
            [fine, middle, coarse, ..] => match order([fine, middle, coarse]) {
                Some(order) => Self::with_order(order, [fine, middle], Approach::Measured(order)),
                None => {
                    let three = [fine, middle, coarse].map(|own| own.value);
                    let most = three.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    let least = three.iter().copied().fold(f64::INFINITY, f64::min);
                    Self {
                        approach: Approach::None,
                        limit: fine.value,
                        uncertainty: SAFETY_WITHOUT_ORDER * (most - least),
                        coefficient: 0.0,
                    }
                }
            },
            _ => return None,
        };
        Some(found)
    }

    fn with_order(order: f64, [fine, coarse]: [GridValue; 2], approach: Approach) -> Self {
        let coefficient =
            (coarse.value - fine.value) / (coarse.spacing.powf(order) - fine.spacing.powf(order));
        let error = coefficient * fine.spacing.powf(order);
        let safety = if approach == Approach::Assumed { SAFETY_WITHOUT_ORDER } else { SAFETY };
        let (limit, uncertainty) = (fine.value - error, safety * error.abs());
        Self { approach, limit, uncertainty, coefficient }
    }

    /// Returns the value at a spacing by the limit and the error.
    #[must_use]
    pub fn at(&self, spacing: f64) -> f64 {
        let order = match self.approach {
            Approach::Measured(order) => order,
            Approach::Assumed | Approach::None => GRID_ORDER,
        };
        self.limit + self.coefficient * spacing.powf(order)
    }
}

/// Returns the order p with which three values, finest first, approach a limit, at most [`GRID_ORDER`];
/// `None` if it is below [`ORDER_MIN`], or if there is none.
fn order(values: [GridValue; 3]) -> Option<f64> {
    let [fine, middle, coarse] = values;
    let differences = [middle.value - fine.value, coarse.value - middle.value];
    if differences == [0.0, 0.0] {
        return Some(GRID_ORDER);
    }
    let ratio = differences[1] / differences[0];
    // The ratio of the differences grows with the order.
    let ratio_of = |order: f64| {
        let [fine, middle, coarse] = values.map(|own| own.spacing.powf(order));
        (coarse - middle) / (middle - fine)
    };
    if ratio.is_nan() || ratio < ratio_of(ORDER_MIN) {
        return None;
    }
    let (mut low, mut high) = (ORDER_MIN, GRID_ORDER);
    if ratio >= ratio_of(GRID_ORDER) {
        return Some(GRID_ORDER);
    }
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if ratio_of(middle) < ratio { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(own: &[(f64, f64)]) -> Vec<GridValue> {
        own.iter().map(|&(spacing, value)| GridValue { spacing, value }).collect()
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
        for own in [[1.0, 2.0, 1.5], [1.0, 2.0, 2.5], [1.0, 1.0, 2.0]] {
            let found = Convergence::new(&values(&[(1.0, own[0]), (2.0, own[1]), (4.0, own[2])]));
            let found = found.expect("three");
            if own == [1.0, 1.0, 2.0] {
                // The fine grids agree: nothing is left.
                assert_eq!((found.limit, found.uncertainty), (1.0, 0.0));
                continue;
            }
            assert_eq!((found.approach, found.limit), (Approach::None, 1.0));
            assert!(
                (found.uncertainty - 3.0 * (own.iter().fold(0.0_f64, |a, &b| a.max(b)) - 1.0))
                    .abs()
                    < 1e-12
            );
        }
        let same = Convergence::new(&values(&[(1.0, 3.0), (2.0, 3.0), (4.0, 3.0)])).expect("three");
        assert_eq!((same.limit, same.uncertainty), (3.0, 0.0));
    }
}
