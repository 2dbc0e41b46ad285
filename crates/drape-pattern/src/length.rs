//! Lengths as messages show them.

use std::fmt;

/// Length that is shown in mm, with as many digits as can be read.
pub(crate) struct Millimetres(pub f64);

impl fmt::Display for Millimetres {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = 1000.0 * self.0;
        match value.abs() {
            100.0.. => write!(f, "{value:.0} mm"),
            0.05.. => write!(f, "{value:.1} mm"),
            _ => write!(f, "{value:.3} mm"),
        }
    }
}
