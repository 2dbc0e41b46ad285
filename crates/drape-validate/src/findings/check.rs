//! Check: a figure of a simulation beside its reference, and whether it passes.
//!
//! With the measured figure `$m$`, the reference `$r$` and the limit `$\epsilon$`, a check of equality
//! passes if `$|m - r| \le \epsilon\,|r|$`. Cases write checks; pages and the command line read them.

use serde::{Deserialize, Deserializer, Serialize};

/// A figure of a simulation beside what it should be.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// What was measured, with the circumstances.
    pub what: String,
    /// The figure of the simulation.
    #[serde(deserialize_with = "number")]
    pub measured: f64,
    /// What it should be; no number where there is none.
    #[serde(deserialize_with = "number")]
    pub reference: f64,
    /// How far it may be off, a part of the reference.
    pub limit: f64,
    /// How it is held against the reference.
    pub kind: Kind,
}

/// How a figure is held against its reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// It may differ by a part of the reference either way.
    Equal,
    /// It must be at least as large.
    AtLeast,
    /// It must be at most as large.
    AtMost,
    /// It has none, and is told for what it is.
    #[serde(rename = "told")]
    Reported,
}

/// JSON has no word for what is no number but null.
fn number<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}

impl Check {
    /// A figure that may differ from its reference by a part of it.
    pub fn within(what: impl Into<String>, measured: f64, reference: f64, limit: f64) -> Self {
        Self { what: what.into(), measured, reference, limit, kind: Kind::Equal }
    }

    /// A figure that must be at most as large as its reference.
    pub fn at_most(what: impl Into<String>, measured: f64, reference: f64) -> Self {
        Self { what: what.into(), measured, reference, limit: 0.0, kind: Kind::AtMost }
    }

    /// A figure that must be at least as large as its reference.
    pub fn at_least(what: impl Into<String>, measured: f64, reference: f64) -> Self {
        Self { what: what.into(), measured, reference, limit: 0.0, kind: Kind::AtLeast }
    }

    /// A figure that has no reference.
    pub fn reported(what: impl Into<String>, measured: f64) -> Self {
        Self { what: what.into(), measured, reference: f64::NAN, limit: 0.0, kind: Kind::Reported }
    }

    /// How far the figure is off, as a part of the reference.
    pub fn error(&self) -> f64 {
        (self.measured - self.reference) / self.reference.abs()
    }

    /// Whether the figure is within its limit; one that is no number is not.
    pub fn passes(&self) -> bool {
        match self.kind {
            Kind::Equal => self.error().abs() <= self.limit,
            Kind::AtLeast => self.measured >= self.reference,
            Kind::AtMost => self.measured <= self.reference,
            Kind::Reported => self.measured.is_finite(),
        }
    }

    /// Whether the figure is within its limit, if it has one; false too for one without that is no number.
    pub fn verdict(&self) -> Option<bool> {
        let passes = self.passes();
        (self.kind != Kind::Reported || !passes).then_some(passes)
    }
}
