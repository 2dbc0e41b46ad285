//! The interface of all laws, the memory of a connector, and the response of a law to a history.

use drape_hysteresis::{Loads, Response};
use serde::{Deserialize, Serialize};

/// Memory of a connector: the state after the past deformation path, on which a law depends.
///
/// The unit of the deformation is a ratio for traction and shear, and 1/m for bending.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Memory {
    /// Deformation at the last commit, in the unit of the deformation.
    pub position: f64,
    /// Loads of the two friction elements, in the unit of the load.
    pub friction: Loads,
    /// Largest deformation so far, in the unit of the deformation.
    pub peak: f64,
}

/// One-dimensional law of load against deformation with memory, as a KES instrument measures it.
///
/// A trial deformation never changes the memory. Only [`Law::commit`] returns a new memory. Between
/// two commits the load is a single-valued function of the trial deformation, so the load has a
/// potential, [`Law::work`], in spite of the friction.
///
/// | law | deformation | load, per width | tangent |
/// |---|---|---|---|
/// | [`TractionLaw`](crate::TractionLaw) | strain, a ratio | tension, in N/m | in N/m |
/// | [`ShearLaw`](crate::ShearLaw) | sine of the shear angle | force, in N/m | in N/m |
/// | [`BendingLaw`](crate::BendingLaw) | curvature, in 1/m | moment, in N | in N·m |
pub trait Law {
    /// Returns the memory of a fabric that was never deformed.
    #[must_use]
    fn virgin(&self) -> Memory {
        Memory::default()
    }

    /// Returns load and tangent at a trial `deformation`.
    #[must_use]
    fn respond(&self, memory: &Memory, deformation: f64) -> Response;

    /// Returns the work per area from the deformation of `memory` to a trial `deformation`, in
    /// J/m².
    #[must_use]
    fn work(&self, memory: &Memory, deformation: f64) -> f64;

    /// Returns the memory after a straight path from the deformation of `memory` to `deformation`.
    #[must_use]
    fn commit(&self, memory: &Memory, deformation: f64) -> Memory;

    /// Returns the energy per area that the fabric can return from the state `memory`, in J/m².
    #[must_use]
    fn stored(&self, memory: &Memory) -> f64;
}

/// Returns the load of `law` at every point of the deformation `history`, in the unit of the load.
/// The history begins at `memory`, and leads to each point along a straight path.
#[must_use]
pub fn drive(law: &impl Law, memory: Memory, history: &[f64]) -> Vec<f64> {
    let mut memory = memory;
    history
        .iter()
        .map(|&deformation| {
            let load = law.respond(&memory, deformation).load;
            memory = law.commit(&memory, deformation);
            load
        })
        .collect()
}
