//! Values of the compression test, and the values that follow from them.
//!
//! With the pressure `$P_m$` of 50 gf/cm² at which TM is measured \[Kaw80\],
//!
//! ```math
//! WC = \int_{T_m}^{T_0} P\,dT, \qquad LC = \frac{WC}{\tfrac12 P_m (T_0 - T_m)}
//! ```
//!
//! so each of TM, LC and WC follows from T0 and the other two.

use crate::sheets::findings::Findings;
use crate::sheets::sheet::Sheet;
use drape_input::Quantity;

/// Pressure at which TM is measured, in gf/cm².
const LARGEST_PRESSURE: f64 = 50.0;
/// Millimetres of a centimetre, the length in WC.
const MILLIMETRES: f64 = 10.0;
/// Relative difference between the given LC and the LC of the other values from which a warning is
/// given.
///
/// The values are printed with two or three digits, and TM is measured on other specimens than WC.
const REPORTED_DIFFERENCE: f64 = 0.25;

impl Sheet {
    /// Returns TM: thickness under 50 gf/cm² (4.9 kPa), in metres. A missing `tm` is computed from
    /// `lc` and `wc`.
    ///
    /// ```
    /// use drape_kes::Sheet;
    ///
    /// let mut sheet = Sheet::default();
    /// (sheet.t0, sheet.lc, sheet.wc) = (Some(0.8), Some(0.4), Some(0.1));
    /// // 0.1 gf·cm/cm² over half of 0.4 · 50 gf/cm² is 0.1 mm.
    /// let pressed = sheet.pressed_thickness().expect("LC and WC give it");
    /// assert!((pressed - 0.7e-3).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn pressed_thickness(&self) -> Option<f64> {
        let given = self.tm.or_else(|| self.pressed_by_work());
        given.map(|tm| tm * Quantity::Length.laboratory().factor)
    }

    /// Returns LC: linearity of the compression curve, a ratio. A missing `lc` is computed from
    /// `t0`, `tm` and `wc`.
    #[must_use]
    pub fn compression_linearity(&self) -> Option<f64> {
        self.lc.or_else(|| self.linearity_by_work()).filter(|lc| (0.0..=1.0).contains(lc))
    }

    /// Returns TM from `t0`, `lc` and `wc`, in mm. Returns `None` where the computed TM is less
    /// than a tenth of T0.
    fn pressed_by_work(&self) -> Option<f64> {
        let (t0, lc, wc) = (self.t0.or(self.t)?, self.lc?, self.wc?);
        let compressed = MILLIMETRES * 2.0 * wc / (lc * LARGEST_PRESSURE);
        Some(t0 - compressed).filter(|tm| *tm > 0.1 * t0)
    }

    /// Returns LC from `t0`, `tm` and `wc`.
    fn linearity_by_work(&self) -> Option<f64> {
        let (t0, tm, wc) = (self.t0.or(self.t)?, self.tm?, self.wc?);
        (t0 > tm).then(|| MILLIMETRES * 2.0 * wc / (LARGEST_PRESSURE * (t0 - tm)))
    }

    /// Warns about values of the compression test that contradict each other.
    pub(crate) fn compare_compression(&self, findings: &mut Findings<'_>) {
        let key = "LC";
        if let (Some(given), Some(computed)) = (self.lc, self.linearity_by_work())
            && (computed / given - 1.0).abs() > REPORTED_DIFFERENCE
        {
            let message =
                format!("{given} does not agree with T0, TM and WC, which give {computed:.3}");
            findings.warn(
                key,
                message,
                "check the four values and their units; LC and TM were taken",
            );
        }

        let has_all = self.t0.or(self.t).is_some() && self.lc.is_some() && self.wc.is_some();
        if has_all && self.tm.is_none() && self.pressed_by_work().is_none() {
            let message = "with WC leaves nothing of the thickness at 50 gf/cm²";
            findings.warn(key, message, "check T, LC and WC and their units; a default was taken");
        }
    }
}
