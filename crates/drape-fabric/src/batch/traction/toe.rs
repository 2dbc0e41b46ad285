//! End of the toe of a tensile curve, in arithmetic without branches.

use drape_hysteresis::exp_m1;

use crate::batch::lanes::positive;

/// Returns the strain at which the toe ends after the largest elongation `peak`, like the scalar
/// function `laws::traction::toe::toe_end`.
#[inline(always)]
pub(crate) fn toe_end(strain: f64, strain_after: f64, peak: f64) -> f64 {
    let beyond = positive(peak - strain) / strain;
    strain - (strain_after - strain) * exp_m1(-beyond)
}
