//! Load and tangent, which friction models and fabric laws return.

/// Load at the end of a path and its derivative there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Load, in the unit of the load. The load of a fabric's law is per width: N/m for traction and
    /// shear, N for bending.
    pub load: f64,
    /// Derivative of the load with respect to the deformation, in load per deformation.
    pub tangent: f64,
}
