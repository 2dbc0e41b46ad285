//! Stiffness of strips cut at an angle to the yarns \[Kil63\]. The case `bias-strip` calls it.

/// Returns the stiffness of a strip cut at `angle` (in rad) to its first yarns, in N/m.
///
/// ```math
/// \frac1E = \frac{\cos^4\vartheta}{E_1} + \frac{\sin^4\vartheta}{E_2}
///   + \frac{\sin^2\vartheta\cos^2\vartheta}{G}
/// ```
///
/// from the stiffnesses `first` and `second` of the two yarn systems and the stiffness `shear`, all
/// in N/m, for a fabric without coupling between the yarns \[Kil63\]. The strip must be so long
/// that its ends do not change its stiffness.
#[must_use]
pub fn bias_stiffness(angle: f64, [first, second]: [f64; 2], shear: f64) -> f64 {
    let (s, c) = (angle.sin().powi(2), angle.cos().powi(2));
    1.0 / (c * c / first + s * s / second + s * c / shear)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

    #[test]
    fn along_the_yarns_it_is_theirs_and_on_the_bias_mostly_the_shears() {
        let yarns = [4000.0, 3000.0];
        assert_eq!(bias_stiffness(0.0, yarns, 30.0), 4000.0);
        assert!((bias_stiffness(FRAC_PI_2, yarns, 30.0) / 3000.0 - 1.0).abs() < 1e-12);
        // Inextensible yarns at 45°: four times the shear stiffness.
        let bias = bias_stiffness(FRAC_PI_4, [1e12, 1e12], 30.0);
        assert!((bias / 120.0 - 1.0).abs() < 1e-9, "{bias}");
    }
}
