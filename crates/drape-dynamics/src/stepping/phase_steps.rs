//! Steps of a phase: how their lengths are controlled, and how well they are solved.

use drape_scene::Relaxation;

use crate::stepping::accuracy::Accuracy;

/// Largest displacement of a particle in one step while a garment is sewn, in spacings. Half of it took a T-shirt half as
/// long again, twice of it as well.
const SEWING_STRIDE: f64 = 1.0;

/// Steps of a phase.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PhaseSteps {
    /// Control of the lengths of steps by displacements, on the way to rest and while a garment is sewn.
    pub(crate) relaxation: Option<Relaxation>,
    /// Accuracy of the first steps, where they are quasi-static.
    pub(crate) accuracy: Option<Accuracy>,
}

impl PhaseSteps {
    /// Steps while a garment is sewn, of particles that are a spacing apart, in m.
    pub(crate) fn sewing(spacing: f64) -> Self {
        let stride = SEWING_STRIDE * spacing;
        let relaxation = Relaxation { speed: 0.0, residual: 0.0, stride, inertia: false };
        Self { relaxation: Some(relaxation), accuracy: Some(Accuracy::SEWING) }
    }

    /// Steps to rest, if that is asked for, or in time; quasi-static or not.
    pub(crate) fn new(relaxation: Option<Relaxation>, quasi_static: bool) -> Self {
        Self { relaxation, accuracy: quasi_static.then_some(Accuracy::RELAXATION) }
    }
}
