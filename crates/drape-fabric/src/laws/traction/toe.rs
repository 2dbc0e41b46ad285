//! End of the toe of a tensile curve as a function of the largest elongation.

/// Returns the strain at which the toe ends after the largest elongation `peak`, a ratio.
///
/// ```math
/// \varepsilon_c = \varepsilon_1 + (\varepsilon_1'-\varepsilon_1)
/// \left(1 - e^{-(\hat\varepsilon-\varepsilon_1)/\varepsilon_1}\right),
/// \qquad \hat\varepsilon > \varepsilon_1
/// ```
///
/// `strain` is `$\varepsilon_1$` of a virgin fabric, and `strain_after` is `$\varepsilon_1'$`.
pub(crate) fn toe_end(strain: f64, strain_after: f64, peak: f64) -> f64 {
    let beyond = (peak - strain).max(0.0) / strain;
    strain - (strain_after - strain) * (-beyond).exp_m1()
}
