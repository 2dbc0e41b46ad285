//! Check: a figure of a simulation beside its reference, and whether it passes.
//!
//! With the measured figure `$m$`, the reference `$r$` and the limit `$\epsilon$`, a check of
//! equality passes if `$|m - r| \le \epsilon\,|r|$`. Cases write checks; pages and the command line
//! read them.

use serde::{Deserialize, Deserializer, Serialize};

/// Figure of a simulation beside its reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// Name of the figure, with its unit and circumstances.
    pub what: String,
    /// The figure of the simulation.
    #[serde(deserialize_with = "number")]
    pub measured: f64,
    /// Reference. Not a number if the figure has no reference.
    #[serde(deserialize_with = "number")]
    pub reference: f64,
    /// Limit of the difference, over the reference.
    pub limit: f64,
    /// Kind of the comparison.
    pub kind: Kind,
}

/// Kind of the comparison of a figure with its reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Equal, up to a part of the reference to either side.
    Equal,
    /// At least as large.
    AtLeast,
    /// At most as large.
    AtMost,
    /// Reported without a reference.
    #[serde(rename = "told")]
    Reported,
}

/// Reads a number from `deserializer`. JSON writes a number that is not finite as null, which
/// becomes NaN.
fn number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}

impl Check {
    /// Returns a check that `measured` equals `reference` up to the part `limit` of `reference`.
    #[must_use]
    pub fn within(what: impl Into<String>, measured: f64, reference: f64, limit: f64) -> Self {
        Self { what: what.into(), measured, reference, limit, kind: Kind::Equal }
    }

    /// Returns a check that `measured` is at most `reference`.
    #[must_use]
    pub fn at_most(what: impl Into<String>, measured: f64, reference: f64) -> Self {
        Self { what: what.into(), measured, reference, limit: 0.0, kind: Kind::AtMost }
    }

    /// Returns a check that `measured` is at least `reference`.
    #[must_use]
    pub fn at_least(what: impl Into<String>, measured: f64, reference: f64) -> Self {
        Self { what: what.into(), measured, reference, limit: 0.0, kind: Kind::AtLeast }
    }

    /// Returns the figure `measured` without a reference.
    #[must_use]
    pub fn reported(what: impl Into<String>, measured: f64) -> Self {
        Self { what: what.into(), measured, reference: f64::NAN, limit: 0.0, kind: Kind::Reported }
    }

    /// Returns the error of the figure: `measured` less `reference`, over the size of `reference`.
    #[must_use]
    pub fn error(&self) -> f64 {
        (self.measured - self.reference) / self.reference.abs()
    }

    /// Returns whether the figure is within its limit. `false` if the figure is not a number.
    #[must_use]
    pub fn passes(&self) -> bool {
        match self.kind {
            Kind::Equal => self.error().abs() <= self.limit,
            Kind::AtLeast => self.measured >= self.reference,
            Kind::AtMost => self.measured <= self.reference,
            Kind::Reported => self.measured.is_finite(),
        }
    }

    /// Returns whether the figure passes. `None` if the figure is only reported and is finite.
    #[must_use]
    pub fn verdict(&self) -> Option<bool> {
        let passes = self.passes();
        (self.kind != Kind::Reported || !passes).then_some(passes)
    }
}
