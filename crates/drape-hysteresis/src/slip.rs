//! Monotone piece of a deformation path, the argument of every friction element.

/// Monotone piece of a deformation path, with the weight that multiplies the plateau along it.
///
/// The weight runs linearly from `weight_from` to `weight_to`. A constant weight of one is plain
/// Bliman–Sorine friction. A weight that grows with the shear angle widens the loop (KES 2HG5 >
/// 2HG). A weight that starts below one describes the priming zone of a yarn \[NB04, §4.3.1\].
///
/// ```
/// use drape_hysteresis::{Dahl, Slip};
///
/// let element = Dahl::new(0.5, 0.01)?;
/// // A number is a slip of weight one.
/// assert_eq!(element.advance(0.0, 0.02), element.advance(0.0, Slip::weighted(0.02, 1.0, 1.0)));
/// // Half of the weight gives half of the load.
/// let half = element.advance(0.0, Slip::weighted(0.02, 0.5, 0.5));
/// assert!((half / element.advance(0.0, 0.02) - 0.5).abs() < 1e-15);
/// # Ok::<(), drape_hysteresis::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slip {
    /// Signed change of the deformation over the piece, in the unit of the deformation.
    pub amount: f64,
    /// Weight of the plateau at the start of the piece, at least 0.
    pub weight_from: f64,
    /// Weight of the plateau at the end of the piece, at least 0.
    pub weight_to: f64,
}

impl Slip {
    /// Returns a piece of the given `amount`, along which the weight of the plateau runs from
    /// `weight_from` to `weight_to`.
    #[must_use]
    pub fn weighted(amount: f64, weight_from: f64, weight_to: f64) -> Self {
        Self { amount, weight_from, weight_to }
    }
}

impl From<f64> for Slip {
    /// Returns a piece of the given `amount` with the constant weight one.
    fn from(amount: f64) -> Self {
        Self::weighted(amount, 1.0, 1.0)
    }
}
