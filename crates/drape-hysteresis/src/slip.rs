/// One monotone piece of a deformation path, with the weight that the friction carries along it.
///
/// The weight multiplies the plateau of the friction and runs linearly from `weight_from` to
/// `weight_to` over the piece. A constant weight of one is plain Bliman–Sorine friction; a weight
/// that grows with the shear angle widens the loop (KES 2HG5 > 2HG), and one that starts below one
/// is the priming zone of a yarn [Ngo Ngoc & Boivin 2004, §4.3.1].
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
    /// A piece along which the plateau is weighted from `weight_from` to `weight_to`.
    #[must_use]
    pub fn weighted(amount: f64, weight_from: f64, weight_to: f64) -> Self {
        Self { amount, weight_from, weight_to }
    }
}

impl From<f64> for Slip {
    /// A piece of constant weight one.
    fn from(amount: f64) -> Self {
        Self::weighted(amount, 1.0, 1.0)
    }
}
