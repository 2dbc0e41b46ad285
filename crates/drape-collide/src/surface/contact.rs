//! Contact of surfaces: the object that a solver holds.
//!
//! A [`SurfaceContact`] has four groups of calls:
//!
//! - detect: [`detect`](SurfaceContact::detect) finds the pairs that are near each other,
//! - energy: [`energy`](SurfaceContact::energy) gives potential, forces and stiffness,
//! - limit: [`OpenStep::limit`] shortens a trial step such that surfaces stay apart,
//! - test: [`intersections`](SurfaceContact::intersections) is the exact test.
//!
//! A solver works in steps. The types give the order of the calls:
//!
//! 1. [`begin`](SurfaceContact::begin) opens a step from a [`SurfaceStart`]: bodies get their
//!    positions at the end of the step, open seams their gaps, friction its normal forces.
//! 2. The [`OpenStep`] has the calls at trial positions. A solver that cannot hold this handle
//!    takes it from [`step`](SurfaceContact::step), which is refused while no step is open.
//! 3. [`OpenStep::commit`] or [`OpenStep::reject`] ends the step and consumes the handle.
//!
//! What may change between two steps only is in [`setup`](SurfaceContact::setup), which is refused
//! while a step is open. [`state`](SurfaceContact::state) reads the state between two steps, and
//! [`restore`](SurfaceContact::restore) and [`resume`](SurfaceContact::resume) return to such a
//! state.
//!
//! This chapter uses all other chapters of [`surface`](super), and owns their buffers. After the
//! first steps it allocates no memory.

mod active_pairs;
mod energy;
mod growth;
mod inspection;
mod obstacles;
mod open_seams;
mod open_step;
mod pairs;
mod pinch;
mod settings;
mod setup;
mod state;
mod surface_contact;
#[cfg(test)]
mod thrown_sheet_tests;

pub use energy::SurfaceEnergy;
pub use inspection::{SeamIntersections, SurfaceInspection};
pub use open_step::{OpenStep, SurfaceStart};
pub use pairs::{PairDistance, SurfacePairs, SurfaceSummary};
pub use pinch::PinchedVertices;
pub use settings::{PinchPolicy, SurfaceSettings};
pub use setup::{SewnPlacement, SurfaceSetup};
pub use state::{SavedContact, SurfaceMemory, SurfaceState};
pub use surface_contact::SurfaceContact;

use crate::error::Error;

impl SurfaceContact {
    /// Returns the [`SurfaceSetup`], which changes the contact between two steps.
    ///
    /// # Errors
    /// [`Error::StepIsOpen`].
    pub fn setup(&mut self) -> Result<SurfaceSetup<'_>, Error> {
        SurfaceSetup::new(self)
    }

    /// Opens a step from `start`. Friction takes its normal forces and tangent planes from the
    /// positions there.
    ///
    /// A step that is still open is rejected, so that a solver may repeat a step. The bodies start
    /// from their positions when the last step was committed.
    ///
    /// # Errors
    /// A list of `start` has the wrong length. Then no step is opened or rejected.
    pub fn begin(&mut self, start: SurfaceStart<'_>) -> Result<OpenStep<'_>, Error> {
        OpenStep::begin(self, start)
    }

    /// Returns the step that [`begin`](SurfaceContact::begin) opened and nothing has ended.
    ///
    /// # Errors
    /// [`Error::NoOpenStep`].
    pub fn step(&mut self) -> Result<OpenStep<'_>, Error> {
        OpenStep::resume(self)
    }

    /// Detects the pairs within their activation distances at the `positions` of the free vertices,
    /// in m, as [`SurfacePairs`].
    ///
    /// # Errors
    /// Positions are not finite, or there are too many pairs.
    pub fn detect(&mut self, positions: &[f64]) -> Result<SurfacePairs<'_>, Error> {
        self.detect_pairs(positions)
    }

    /// Returns the [`SurfacePairs`] at the positions of the last detection. Energies and commits
    /// detect, too.
    #[must_use]
    pub fn pairs(&self) -> SurfacePairs<'_> {
        SurfacePairs::new(&self.active)
    }

    /// Returns the [`SurfaceEnergy`] at the `positions` of the free vertices, in m.
    ///
    /// Positions that are not finite have an energy of NaN, which no line search accepts.
    /// [`detect`](SurfaceContact::detect) returns their error.
    ///
    /// # Errors
    /// There are not three coordinates for each free vertex.
    pub fn energy(&mut self, positions: &[f64]) -> Result<SurfaceEnergy<'_>, Error> {
        SurfaceEnergy::new(self, positions)
    }

    /// Returns the inspection at the `positions` of the free vertices, in m, as a
    /// [`SurfaceInspection`].
    ///
    /// # Errors
    /// There are not three coordinates for each free vertex.
    pub fn inspect<'a>(&'a self, positions: &'a [f64]) -> Result<SurfaceInspection<'a>, Error> {
        SurfaceInspection::new(self, positions)
    }

    /// Returns the state when the last step was committed, as a [`SurfaceState`].
    #[must_use]
    pub fn state(&self) -> SurfaceState<'_> {
        SurfaceState::new(self)
    }
}
