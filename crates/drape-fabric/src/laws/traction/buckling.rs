//! Load of a yarn in compression.

use drape_hysteresis::Response;

/// Strain over which a compressed yarn buckles, a ratio.
///
/// Larger values make compression stiffer and the equations easier to solve. Smaller values sharpen
/// the corner of the load at zero strain, which slows quasi-Newton iterations. A fifth of a per
/// cent is well below the strains of a KES tensile curve (1 to 10 %).
pub const BUCKLING_STRAIN: f64 = 0.002;

/// Post-buckling stiffness of a yarn, in N/m.
///
/// The load grows with the square of the compression: 0.5 N/m at 10 %, a quarter of the weight of
/// a metre of cloth. Without this stiffness a segment could shrink to zero length without any load.
pub const POST_BUCKLING_STIFFNESS: f64 = 100.0;

/// Load of a compressed yarn. The yarn buckles at a wavelength below the spacing of the particles.
///
/// ```math
/// F = k_0\varepsilon_b\left(e^{\varepsilon/\varepsilon_b}-1\right) - \tfrac12 k_p\varepsilon^2,
/// \qquad \varepsilon < 0
/// ```
///
/// with the stiffness `$k_0$` at rest, so that the slope is continuous. No KES test measures this
/// load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Buckling {
    /// Strain `$\varepsilon_b$` over which the stiffness at rest decays, a ratio.
    pub strain: f64,
    /// Increase `$k_p$` of the stiffness per strain after buckling, in N/m.
    pub stiffness: f64,
}

impl Default for Buckling {
    fn default() -> Self {
        Self { strain: BUCKLING_STRAIN, stiffness: POST_BUCKLING_STIFFNESS }
    }
}

impl Buckling {
    /// Returns load and tangent at a negative `strain` of a yarn with the stiffness `rest` at rest.
    pub(crate) fn respond(&self, rest: f64, strain: f64) -> Response {
        let lost = (strain / self.strain).exp_m1();
        Response {
            load: rest * self.strain * lost - 0.5 * self.stiffness * strain * strain,
            tangent: rest * (1.0 + lost) - self.stiffness * strain,
        }
    }

    /// Returns the integral of the load from 0 to a negative `strain`, in J/m², with the stiffness
    /// `rest` at rest.
    pub(crate) fn energy(&self, rest: f64, strain: f64) -> f64 {
        let scale = self.strain;
        rest * scale * (scale * (strain / scale).exp_m1() - strain)
            - self.stiffness * strain * strain * strain / 6.0
    }
}
