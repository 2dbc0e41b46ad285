//! Steps of a phase: control of their lengths, and their initial accuracy.

use drape_scene::Relaxation;

use crate::stepping::accuracy::Accuracy;

/// Largest displacement of a particle in one step while a garment is sewn, in spacings. With half
/// of it, and also with twice, a T-shirt took half as long again.
const SEWING_STRIDE: f64 = 1.0;

/// Steps of a phase.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PhaseSteps {
    /// Control of the lengths of steps by displacements, in relaxation and while a garment is sewn.
    pub(crate) relaxation: Option<Relaxation>,
    /// Accuracy of the first steps, if they are quasi-static.
    pub(crate) accuracy: Option<Accuracy>,
}

impl PhaseSteps {
    /// Returns the steps for sewing a garment whose particles are `spacing` apart, in m.
    pub(crate) fn sewing(spacing: f64) -> Self {
        let stride = SEWING_STRIDE * spacing;
        let relaxation = Relaxation { speed: 0.0, residual: 0.0, stride, inertia: false };
        Self { relaxation: Some(relaxation), accuracy: Some(Accuracy::SEWING) }
    }

    /// Returns the steps to rest by the criteria `relaxation`, or the steps in time without
    /// criteria.
    pub(crate) fn new(relaxation: Option<Relaxation>, quasi_static: bool) -> Self {
        Self { relaxation, accuracy: quasi_static.then_some(Accuracy::RELAXATION) }
    }
}
