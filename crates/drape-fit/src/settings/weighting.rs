//! Weights of the points of a curve.

use drape_kes::Curve;

/// Deformation, over the largest one, at which a point has half the weight of one at zero.
///
/// Uniform steps up to the largest deformation then have half of their weight below the deformation
/// `$\sqrt{a(1+a)} - a$` = 0.29 of the largest. The curvatures at which fabrics drape (up to 75 1/m
/// of the 250 1/m of a KES loop) count as much as all larger curvatures. Smaller values would fit
/// the slack start and little else.
const HALF_WEIGHT: f64 = 0.2;

/// Weights of the points of a curve in the fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Weighting {
    /// Weight `$1/(|q| + 0.2\,q_m)$` of a squared residual at the deformation `$q$`, with the
    /// largest deformation `$q_m$`.
    ///
    /// A fabric drapes at deformations well below the largest of the test. With this weighting the
    /// lowest 30 % of the deformations count as much as all above. Where the law follows the curve
    /// everywhere the weights change nothing but the errors, which grow by a tenth or so. The
    /// default.
    #[default]
    LowDeformation,
    /// Same weight for all points.
    Even,
}

/// Returns the weights of the points of `curve`, one on average. Deformations are counted from
/// `zero`. No weight is returned for [`Weighting::Even`].
impl Weighting {
    /// Returns the weights of the points of a curve, one on average; deformations are counted from
    /// `zero`.
    pub(crate) fn weights(self, curve: &Curve, zero: f64) -> Vec<f64> {
        if self == Self::Even {
            return Vec::new();
        }
        let sizes: Vec<f64> = curve
            .deformation()
            .iter()
            .map(|q| if curve.slack { (q - zero).max(0.0) } else { (q - zero).abs() })
            .collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let raw: Vec<f64> = sizes.iter().map(|q| 1.0 / (q + HALF_WEIGHT * largest)).collect();
        let mean = raw.iter().sum::<f64>() / raw.len() as f64;
        raw.iter().map(|weight| weight / mean).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_kes::{Direction, Test};

    #[test]
    fn the_curvatures_of_drape_count_as_much_as_all_above() {
        let curvature: Vec<f64> = (-250..=250).map(f64::from).collect();
        let load = curvature.clone();
        let curve = Curve::new(Test::Bending, Direction::Warp, curvature, load).unwrap();
        let weights = Weighting::LowDeformation.weights(&curve, 0.0);
        let low: f64 = weights[250 - 75..=250 + 75].iter().sum();
        let all: f64 = weights.iter().sum();
        assert!((all / 501.0 - 1.0).abs() < 1e-12, "{all}");
        assert!((low / all - 0.51).abs() < 0.01, "{low} of {all}");
    }
}
