//! Settings of the solver that a scene asks for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Settings of the solver that a scene asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolverSettings {
    /// Formula of a step.
    pub integrator: Integrator,
    /// Iteration that solves the equations of an implicit step.
    pub method: Method,
    /// Root-mean-square error of the acceleration that a step may leave, over g.
    pub tolerance: f64,
    /// Error that the solver may leave in a step, as a fraction of the step's own.
    pub error_fraction: f64,
    /// Whether the balance of the energy is kept.
    pub energy_balance: bool,
}

/// Formula of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// Backward differences of second order.
    #[default]
    Bdf2,
    /// Backward Euler, of first order.
    BackwardEuler,
}

/// Iteration that solves the equations of an implicit step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Broyden's quasi-Newton method, begun with the system matrix.
    #[default]
    Broyden,
    /// Newton's method.
    Newton,
}
