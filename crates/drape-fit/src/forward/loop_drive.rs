//! Loads of a bending or shear law along a hysteresis loop.
//!
//! Used by the fits of `curves` whose law has no derivatives of its own.

use drape_fabric::{BendingLaw, Law, Memory, ShearBackbone, ShearLaw};

/// Law whose elastic load can be computed without its friction.
///
/// Committing a step already gives the friction at its end, so the load costs nothing more: a
/// history takes half the time of asking for the response first.
pub(crate) trait LoopLaw: Law {
    /// Returns the elastic load at a `deformation`.
    fn elastic_load(&self, deformation: f64) -> f64;
}

impl LoopLaw for BendingLaw {
    fn elastic_load(&self, curvature: f64) -> f64 {
        self.backbone.respond(curvature - self.rest_curvature).load
    }
}

/// Locking is left out: no measured curve goes beyond its onset.
impl LoopLaw for ShearLaw {
    fn elastic_load(&self, shear: f64) -> f64 {
        match self.backbone {
            ShearBackbone::Linear { stiffness } => stiffness * shear,
            ShearBackbone::Varying(varying) => varying.respond(shear).load,
            ShearBackbone::Piecewise(piecewise) => piecewise.load(shear),
        }
    }
}

/// Writes the loads of a virgin fabric along `history` to `out`.
///
/// The history need not start at zero: the fabric is first deformed monotonically to its first
/// point.
pub(crate) fn drive_loop(law: &impl LoopLaw, history: impl Iterator<Item = f64>, out: &mut [f64]) {
    let mut memory: Memory = law.virgin();
    for (load, deformation) in out.iter_mut().zip(history) {
        memory = law.commit(&memory, deformation);
        let [first, second] = memory.friction;
        *load = law.elastic_load(deformation) + first + second;
    }
}
