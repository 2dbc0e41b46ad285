//! Cases of loops: KES tests of simulated specimens against the laws of the fabric.
//!
//! Specimens along the yarns, on the bias, and on the bias with a rim of triangles return the loops
//! that the laws alone give. The loop of bending has the area and the residual curvature of its
//! closed form.

mod bias_bending;
mod bias_rim;
mod hysteresis;
mod instruments;
mod plot;

pub(crate) use bias_bending::bias_bending;
pub(crate) use bias_rim::bias_rim;
pub(crate) use hysteresis::hysteresis;
pub(crate) use instruments::instruments;

/// Largest error of a KES value that is read from a simulated loop, over the value.
const VALUE_LIMIT: f64 = 0.02;
