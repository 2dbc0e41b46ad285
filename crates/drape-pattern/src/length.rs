//! Lengths and sizes as messages show them.

use std::fmt;

/// Length that is shown in mm, with the digits that a person can use.
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

/// Width and height that are shown in mm, or in m if both are long.
pub(crate) struct Extents(pub [f64; 2]);

impl fmt::Display for Extents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.0;
        match width.min(height) {
            1.0.. => write!(f, "{width:.2} × {height:.2} m"),
            0.01.. => write!(f, "{:.0} × {:.0} mm", 1e3 * width, 1e3 * height),
            _ => write!(f, "{:.1} × {:.1} mm", 1e3 * width, 1e3 * height),
        }
    }
}
