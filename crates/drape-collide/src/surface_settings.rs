use crate::barrier::Barrier;
use crate::pinch::PinchPolicy;
use crate::surface::ContactDistances;

/// How stiff the contact of surfaces is, and when it slides.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceSettings {
    /// Stiffness `$k$` per area, in N/m³.
    pub stiffness: f64,
    /// Way `$\delta$` that two surfaces which stick give way before they slide, in m.
    ///
    /// A load below Coulomb's limit moves them by less than this, once. Shorter holds stiffer and is harder to solve.
    pub sticking_displacement: f64,
    /// Coefficient of friction of each two groups, row by row.
    pub friction_coefficients: Vec<f64>,
    /// What becomes of cloth that bodies close on.
    pub pinch: PinchPolicy,
}

impl SurfaceSettings {
    /// Default of [`sticking_displacement`](SurfaceSettings::sticking_displacement), in m.
    pub const STICKING_DISPLACEMENT: f64 = 5e-6;

    /// Stiffness in N/m³ at which two sheets alike, whose contact begins at a activation_distance and which always keep a min_separation,
    /// are so far apart as they are under a pressure in Pa; all lengths in m. Infinite where that is the activation_distance.
    ///
    /// Each of the two counts the area of contact once: by its vertices over the other's triangles, and by the edges
    /// that cross.
    #[must_use]
    pub fn stiffness_for_pressure(pressure: f64, distance: f64, of_pair: ContactDistances) -> f64 {
        let ContactDistances { activation_distance, min_separation } = of_pair;
        let slope =
            Barrier::strict(activation_distance - min_separation).slope(distance - min_separation);
        pressure / (-2.0 * slope)
    }
}
