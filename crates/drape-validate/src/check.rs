use serde::Serialize;

/// A figure of a simulation beside what it should be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// What was measured, with the circumstances.
    pub what: String,
    /// The figure of the simulation.
    pub measured: f64,
    /// What it should be.
    pub reference: f64,
    /// How far it may be off, in the unit of [`error`](Self::error).
    pub limit: f64,
    /// Whether the limit is a part of the reference, or in the unit of the figure.
    pub relative: bool,
}

impl Check {
    /// A figure that may differ from its reference by a part of it.
    pub fn within(what: impl Into<String>, measured: f64, reference: f64, limit: f64) -> Self {
        Self { what: what.into(), measured, reference, limit, relative: true }
    }

    /// A figure that should be nought, or at least no larger than a limit.
    pub fn at_most(what: impl Into<String>, measured: f64, limit: f64) -> Self {
        Self { what: what.into(), measured, reference: 0.0, limit, relative: false }
    }

    /// How far the figure is off, with its sign.
    pub fn error(&self) -> f64 {
        let error = self.measured - self.reference;
        if self.relative { error / self.reference } else { error }
    }

    /// Whether the figure is within its limit; one that is no number is not.
    pub fn passes(&self) -> bool {
        self.error().abs() <= self.limit
    }
}
