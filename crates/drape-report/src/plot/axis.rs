//! Axis of a plot: its quantity and its unit, as plain data. The horizontal pixels are shared by
//! frame and legend.

use serde::Serialize;

use crate::check;
use crate::error::Error;

/// Width of a plot, in px.
pub(crate) const WIDTH: f64 = 720.0;

/// Room for the labels left of a frame, in px.
pub(crate) const LEFT: f64 = 68.0;

/// Room right of a frame, in px.
pub(crate) const RIGHT: f64 = 14.0;

/// First and last pixel across a frame.
pub(crate) const ACROSS: [f64; 2] = [LEFT, WIDTH - RIGHT];

/// Axis of a plot: quantity and unit.
///
/// ```
/// use drape_report::plot::Axis;
///
/// let strain = Axis::new("strain", "%", 0.01);
/// assert_eq!(strain.in_si, 0.01);
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Axis {
    /// Quantity, as in "strain".
    pub label: String,
    /// Unit, as in "%". Empty for a ratio.
    pub unit: String,
    /// Size of the unit in SI: 0.01 for %, 0.980665 for gf/cm.
    pub in_si: f64,
}

impl Axis {
    /// Returns an axis with a `label` and a `unit` that is `in_si` SI units.
    #[must_use]
    pub fn new(label: &str, unit: &str, in_si: f64) -> Axis {
        Axis { label: label.to_owned(), unit: unit.to_owned(), in_si }
    }

    /// Returns a `value`, given in SI, in the unit of the axis.
    pub(crate) fn in_unit(&self, value: f64) -> f64 {
        value / self.in_si
    }

    /// Returns the `label` with its `unit`.
    pub(crate) fn title(&self) -> String {
        if self.unit.is_empty() {
            self.label.clone()
        } else {
            format!("{}, {}", self.label, self.unit)
        }
    }

    /// Refuses texts that cannot be shown and a unit out of range. The error names the plot by
    /// `owner`.
    pub(crate) fn check(&self, owner: &str) -> Result<(), Error> {
        check::text(&format!("{owner}: the label of an axis"), &self.label)?;
        check::text(&format!("{owner}: the unit of an axis"), &self.unit)?;
        check::unit(self.in_si)
    }
}
