use crate::barrier::Barrier;
use crate::pinch::Pinch;

/// How stiff the contact of surfaces is, and when it slides.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceSettings {
    /// Stiffness `$k$` per area, in N/m³.
    pub stiffness: f64,
    /// Way `$\delta$` that two surfaces which stick give way before they slide, in m.
    ///
    /// A load below Coulomb's limit moves them by less than this, once. Shorter holds stiffer and is harder to solve.
    pub stick: f64,
    /// Coefficient of friction of each two groups, row by row.
    pub friction: Vec<f64>,
    /// What becomes of cloth that bodies close on.
    pub pinch: Pinch,
}

impl SurfaceSettings {
    /// Default of [`stick`](SurfaceSettings::stick), in m.
    pub const STICK: f64 = 5e-6;

    /// Stiffness in N/m³ at which two sheets alike, whose contact begins at a reach and which always keep a separation,
    /// are so far apart as they are under a pressure in Pa; all lengths in m. Infinite where that is the reach.
    ///
    /// Each of the two counts the area of contact once: by its vertices over the other's triangles, and by the edges
    /// that cross.
    #[must_use]
    pub fn stiffness_under(pressure: f64, distance: f64, [reach, separation]: [f64; 2]) -> f64 {
        let slope = Barrier::strict(reach - separation).slope(distance - separation);
        pressure / (-2.0 * slope)
    }
}
