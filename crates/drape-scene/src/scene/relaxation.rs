//! Relaxation: how the cloth comes to rest, and when it is at rest.

use serde::{Deserialize, Serialize};

/// Relaxation of the cloth, and criteria of rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Relaxation {
    /// Largest speed of a particle at rest, in m/s.
    pub speed: f64,
    /// Largest root-mean-square acceleration at rest, over g: the imbalance of the forces.
    pub residual: f64,
    /// Largest displacement of a particle in one step, in m.
    pub stride: f64,
    /// Whether the cloth keeps its momentum.
    ///
    /// Without, its relaxation is quasi-static: each step starts from rest, ends in a state of less
    /// energy, and moves the memory of the fabric along; lengths of steps are then not durations.
    pub inertia: bool,
}
