//! A bending or shear law driven along a measured history.

use drape_fabric::{BendingLaw, Law, Memory, ShearBackbone, ShearLaw};

/// A law whose elastic load can be had without its friction.
///
/// Committing a step already gives the friction at its end, so the load costs nothing more. Following a
/// history this way is twice as fast as asking for the response first.
pub(crate) trait Driven: Law {
    /// Elastic load at a deformation that follows a memory.
    fn elastic_load(&self, memory: &Memory, deformation: f64) -> f64;

    /// Load at a deformation, and the memory there.
    fn step(&self, memory: &Memory, deformation: f64) -> (f64, Memory) {
        let next = self.commit(memory, deformation);
        let [first, second] = next.friction;
        (self.elastic_load(memory, deformation) + first + second, next)
    }
}

impl Driven for BendingLaw {
    fn elastic_load(&self, _memory: &Memory, curvature: f64) -> f64 {
        self.backbone.respond(curvature - self.rest_curvature).load
    }
}

/// Without locking: no measured curve goes beyond its onset.
impl Driven for ShearLaw {
    fn elastic_load(&self, _memory: &Memory, shear: f64) -> f64 {
        match self.backbone {
            ShearBackbone::Linear { stiffness } => stiffness * shear,
            ShearBackbone::Piecewise(piecewise) => piecewise.load(shear),
        }
    }
}

/// Writes the loads that a virgin fabric shows along a history.
///
/// The history need not start at zero: the way to its first point is part of it, in one straight stretch.
pub(crate) fn along(law: &impl Driven, history: impl Iterator<Item = f64>, out: &mut [f64]) {
    let mut memory = law.virgin();
    for (load, deformation) in out.iter_mut().zip(history) {
        (*load, memory) = law.step(&memory, deformation);
    }
}
