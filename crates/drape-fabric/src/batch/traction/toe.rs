//! End of the toe of a tensile curve, in straight arithmetic.

use drape_hysteresis::exp_m1;

use crate::batch::lanes::positive;

/// Returns the strain where the toe ends, as `laws::traction::toe::toe_end` does.
#[inline(always)]
pub(crate) fn toe_end(strain: f64, strain_after: f64, peak: f64) -> f64 {
    let beyond = positive(peak - strain) / strain;
    strain - (strain_after - strain) * exp_m1(-beyond)
}
