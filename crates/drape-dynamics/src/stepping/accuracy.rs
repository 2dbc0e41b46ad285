//! Accuracy to which steps of quasi-static relaxation and of sewing are solved.

use drape_implicit::{Integrator, Method, Settings};
use drape_scene::Relaxation;
use serde::{Deserialize, Serialize};

use crate::stepping::scheme::{ENERGY_FORCING, Scheme};
use crate::world::closing_springs;

/// Fraction of the imbalance of a relaxing cloth to which its next step is solved. The forces that
/// drive the cloth are then accurate to some per cent. A higher accuracy costs more and leads to
/// the same rest.
const RELATIVE_TOLERANCE: f64 = 0.1;

/// Loosest tolerance of a step of relaxation, over g. Looser tolerances saved no time for a cloth
/// on a cube.
const TOLERANCE_MAX: f64 = 1e-2;

/// Energy that a step of relaxation may leave unminimized, as a fraction of its kinetic energy. The
/// forces are stiff, and after a few iterations most of the imbalance hardly moves the cloth. From
/// four starts a cloth on a cube took 1450 assemblies of the stiffness without this limit, 810 with
/// it, and 800 with three times as much. With three times as much a cloth on a sphere stored 2 %
/// more energy.
const ENERGY: f64 = 3e-3;

/// Multiple of the imbalance at rest below which steps minimize their energy fully.
const NEAR_REST: f64 = 2.0;

/// Sampling of the energy balance in a relaxation, whose steps are few and long: a run of twenty
/// steps has samples too.
const ENERGY_SAMPLING: u64 = 12;

/// Accuracy of a step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct Accuracy {
    /// Root-mean-square error of the acceleration that a step may leave, over g.
    pub(crate) tolerance: f64,
    /// Energy that a step may leave unminimized, as a fraction of its kinetic energy.
    pub(crate) energy: f64,
}

impl Accuracy {
    /// Accuracy of the first steps of a relaxation.
    pub(crate) const RELAXATION: Self = Self { tolerance: TOLERANCE_MAX, energy: ENERGY };

    /// Accuracy of steps while a garment is sewn.
    pub(crate) const SEWING: Self = Self { tolerance: closing_springs::TOLERANCE, energy: 1e-2 };

    /// Returns whether steps of this accuracy are accurate enough for the cloth to count as at rest
    /// by the criteria `rest`.
    pub(crate) fn suffices(self, settings: &Settings, rest: &Relaxation) -> bool {
        self.energy == 0.0
            && self.tolerance <= settings.tolerance.max(RELATIVE_TOLERANCE * rest.residual)
    }

    /// Returns the accuracy of the next step after a step that left `imbalance`, over g: higher the
    /// nearer the cloth is to `rest`.
    pub(crate) fn refined(self, settings: &Settings, rest: &Relaxation, imbalance: f64) -> Self {
        let decade = 10.0_f64.powf((RELATIVE_TOLERANCE * imbalance).log10().floor());
        let tolerance = self.tolerance.min(decade.max(settings.tolerance));
        let near = imbalance <= NEAR_REST * rest.residual;
        Self { tolerance, energy: if near { 0.0 } else { self.energy } }
    }
}

/// Scheme of the current steps, with their accuracy.
#[derive(Debug)]
pub(crate) struct PhaseScheme {
    pub(crate) scheme: Scheme,
    pub(crate) accuracy: Accuracy,
}

impl PhaseScheme {
    /// Returns `scheme`, or its variant for relaxation if the initial accuracy `relaxation` is
    /// given.
    pub(crate) fn new(scheme: &Scheme, relaxation: Option<Accuracy>) -> Self {
        match (scheme, relaxation) {
            (Scheme::Implicit(settings), Some(Accuracy { tolerance, energy })) => {
                let accuracy = Accuracy { tolerance: settings.tolerance.max(tolerance), energy };
                Self { scheme: relaxation_scheme(settings, accuracy), accuracy }
            }
            (Scheme::Implicit(settings), None) => {
                let accuracy = Accuracy { tolerance: settings.tolerance, energy: 0.0 };
                Self { scheme: scheme.clone(), accuracy }
            }
            (Scheme::Explicit, _) => {
                let accuracy = Accuracy { tolerance: 0.0, energy: 0.0 };
                Self { scheme: Scheme::Explicit, accuracy }
            }
        }
    }
}

/// Returns the scheme for steps of relaxation with `accuracy`: backward Euler, which needs no
/// previous step.
///
/// A stiffness that is kept for a second iteration saves no time in long steps. With a start at the
/// prediction of the last step, a cloth on a cube took 23 300 iterations of conjugate gradients
/// instead of 33 400, a cloth on a sphere 75 200 instead of 123 000, a gathered flounce 108 700
/// instead of 208 300, and a T-shirt equally many.
pub(crate) fn relaxation_scheme(settings: &Settings, accuracy: Accuracy) -> Scheme {
    let method = match settings.method {
        Method::Broyden => Method::Newton,
        chosen => chosen,
    };
    Scheme::Implicit(Settings {
        method,
        tolerance: accuracy.tolerance,
        energy_tolerance: accuracy.energy,
        error_fraction: 0.0,
        energy_forcing: ENERGY_FORCING,
        integrator: Integrator::BackwardEuler,
        begin_at_prediction: true,
        energy_sampling: settings.energy_sampling.min(ENERGY_SAMPLING),
        ..settings.clone()
    })
}
