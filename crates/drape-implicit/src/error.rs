//! Error of the crate.

use crate::report::Stop;

/// Error of a step or of its input, one variant per remedy.
///
/// After any error the state and the system's memory are at the end of the last accepted sub-step.
/// A particle is named by its number, from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The equations of a step could not be solved, even with the shortest sub-step allowed.
    #[error(
        "the step from t = {time} s did not converge ({stop}): with dt = {dt:e} s the residual is \
         {residual:e} against a tolerance of {tolerance:e} after {iterations} iterations; {}",
        stop.remedy()
    )]
    NotConverged {
        /// Time at which the failing sub-step starts, in s.
        time: f64,
        /// Length of the failing sub-step, the shortest allowed, in s.
        dt: f64,
        /// Residual reached, in the relative unit of `tolerance`.
        residual: f64,
        /// Tolerance of the settings.
        tolerance: f64,
        /// Iterations of the failing attempt.
        iterations: usize,
        /// Reason why the attempt ended.
        stop: Stop,
    },
    /// A NaN or an infinity where a number is needed, even with the shortest sub-step allowed.
    #[error("{quantity} of particle {particle} not finite at t = {time} s (dt = {dt:e} s)")]
    NotFinite {
        /// Quantity that is not finite.
        quantity: Quantity,
        /// First particle with such a quantity.
        particle: usize,
        /// Time at which the failing (sub)step starts, in s.
        time: f64,
        /// Length of the failing (sub)step, in s.
        dt: f64,
    },
    /// A list has another length than the number of particles requires.
    #[error("{name}: {found} given for a system that needs {expected}")]
    Dimension {
        /// Name of the list.
        name: &'static str,
        /// Length that the number of particles requires.
        expected: usize,
        /// Length of the list.
        found: usize,
    },
    /// A mass is not a positive number.
    #[error("particle {particle} has a mass of {mass} kg; masses must be positive and finite")]
    Mass {
        /// First particle with such a mass.
        particle: usize,
        /// Mass of the particle, in kg.
        mass: f64,
    },
    /// A material point has coordinates that are not finite, or a spacing that is not a positive
    /// number.
    #[error(
        "the material point of particle {particle} must have finite coordinates and a positive \
         spacing"
    )]
    MaterialPoint {
        /// First particle with such a point.
        particle: usize,
    },
    /// The length of a step is not a positive number.
    #[error("a step of {dt} s: its length must be positive and finite")]
    StepLength {
        /// Length of the step, in s.
        dt: f64,
    },
    /// A setting is out of range.
    #[error("the setting {name} = {value} must be {range}")]
    Setting {
        /// Name of the field of [`Settings`](crate::Settings).
        name: &'static str,
        /// Value of the field.
        value: f64,
        /// Admissible range, in words.
        range: &'static str,
    },
    /// A sparsity is malformed.
    #[error("row {row} of the sparsity: {fault}")]
    Sparsity {
        /// First malformed row.
        row: usize,
        /// Fault of the row, in words.
        fault: &'static str,
    },
    /// The system's stiffness couples two particles that the system's sparsity does not couple.
    #[error("the stiffness couples particles {row} and {column}, which the sparsity does not")]
    OutsideSparsity {
        /// Particle of the block's row.
        row: usize,
        /// Particle of the block's column.
        column: usize,
    },
    /// The method does not support a step filter.
    #[error(
        "textbook Broyden and explicit steps cannot be limited by a step filter; \
         use Broyden's or Newton's method"
    )]
    UnfilteredMethod,
    /// The system cancelled the step. The caller discards the step or continues from the last
    /// accepted sub-step.
    #[error("the step was given up as asked")]
    Cancelled,
    /// The sparse factorisation does not fit into memory; conjugate gradients need far less.
    #[error("no memory to factorise a matrix of {blocks} blocks; use conjugate gradients")]
    TooLarge {
        /// Number of blocks of the sparsity.
        blocks: usize,
    },
    /// The crate was built without its feature `cholesky`, which the call needs.
    #[error(
        "drape-implicit was built without its feature `cholesky`; use conjugate gradients, or add the feature"
    )]
    WithoutCholesky,
}

/// Quantity that must be finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// Positions at the start of the step.
    Position,
    /// Velocities at the start of the step.
    Velocity,
    /// Prescribed end positions of held particles.
    Target,
    /// Forces, at the predicted positions as well as at the start of the step.
    Force,
    /// Stiffness at an iterate.
    Stiffness,
}

impl core::fmt::Display for Quantity {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Target => "prescribed position",
            Self::Force => "force",
            Self::Stiffness => "stiffness",
        })
    }
}
