//! Bending of one connector in scalar form: energy and its derivatives with respect to the second
//! difference. The reference and the seams use it. `kernel::bending` and `kernel::crease` compute
//! the same in batches.

use drape_fabric::{BendingLaw, Law, Memory};

use crate::measure::block::{Matrix, identity, outer, sum};
use crate::measure::turning_angle::{CurvatureSlopes, TurningAngle, second_difference_of};
use crate::measure::vector::{Vector, add, dot, scale, subtract};

/// Second difference of a connector, the normal about which it bends, and the length of its
/// segments.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BendingMeasure {
    /// Second difference `$b$`, in 1/m.
    pub(crate) second_difference: Vector,
    /// Unit normal `$n$` of the surface at the start of the step.
    pub(crate) normal: Vector,
    /// Length `$h$` of a segment, in m.
    pub(crate) length: f64,
}

/// Energy of a connector per area and its derivatives with respect to the second difference.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BendingResponse {
    /// Energy per area, in J/m².
    pub(crate) energy: f64,
    /// First derivative, in N.
    pub(crate) gradient: Vector,
    /// Second derivative, in N·m.
    pub(crate) hessian: Matrix,
}

impl BendingMeasure {
    /// Returns the signed curvature about `normal`, in 1/m.
    pub(crate) fn curvature(&self) -> f64 {
        let along = dot(self.second_difference, self.normal);
        TurningAngle::new(along * along, self.length).curvature(along)
    }

    /// Returns the response of `law` with `memory`.
    ///
    /// The elastic part depends on the whole second difference less the one at rest,
    /// `$|b - b_0 n|$`, which also resists bending in the surface. The friction depends on the
    /// curvature about the normal. With `definite`, the part that makes the matrix indefinite is
    /// left out.
    pub(crate) fn respond(
        &self,
        law: &BendingLaw,
        memory: &Memory,
        definite: bool,
    ) -> BendingResponse {
        let Self { second_difference, normal, length: spacing } = *self;

        // Elastic part, by the chain rule from the curvature to the second difference.
        let rest = second_difference_of(law.rest_curvature, spacing);
        let excess = subtract(second_difference, scale(normal, rest));
        let length = dot(excess, excess).sqrt();
        let angle = TurningAngle::new(length * length, spacing);
        let size = angle.curvature(length);
        let elastic = law.backbone.respond(size);
        let CurvatureSlopes { first, second } = angle.curvature_slopes(length);
        let (load, tangent) =
            (elastic.load * first, elastic.tangent * first * first + elastic.load * second);
        let (secant, unit) = if length > 0.0 {
            (load / length, scale(excess, 1.0 / length))
        } else {
            (tangent, excess)
        };

        // Friction about the normal.
        let along = dot(second_difference, normal);
        let slip = self.curvature() - memory.position;
        let friction = law.friction.respond(memory.friction, slip);
        let angle = TurningAngle::new(along * along, spacing);
        let CurvatureSlopes { first, second } = angle.curvature_slopes(along);
        let slope = friction.tangent * first * first + friction.load * second;
        let friction = friction.load * first;
        let slope = if definite { slope.max(0.0) } else { slope };

        BendingResponse {
            energy: law.backbone.energy(size) + law.friction.work(memory.friction, slip),
            gradient: add(scale(excess, secant), scale(normal, friction)),
            hessian: sum([
                (slope, outer(normal, normal)),
                (secant, identity()),
                (tangent - secant, outer(unit, unit)),
            ]),
        }
    }

    /// Returns the response at a fold, which adds `fold` to the rest curvature, in 1/m.
    ///
    /// The elastic part depends on the curvature about the normal and, separately, on the second
    /// difference within the surface. With `definite`, the part that makes the matrix indefinite is
    /// left out.
    pub(crate) fn respond_folded(
        &self,
        law: &BendingLaw,
        memory: &Memory,
        fold: f64,
        definite: bool,
    ) -> BendingResponse {
        let Self { second_difference, normal, length: spacing } = *self;
        let along = dot(second_difference, normal);

        // Elastic part and friction about the normal.
        let to = self.curvature();
        let law = BendingLaw { rest_curvature: law.rest_curvature + fold, ..*law };
        let response = law.respond(memory, to);
        let angle = TurningAngle::new(along * along, spacing);
        let CurvatureSlopes { first, second } = angle.curvature_slopes(along);
        let slope = response.tangent * first * first + response.load * second;
        let slope = if definite { slope.max(0.0) } else { slope };

        // Elastic part within the surface.
        let within = subtract(second_difference, scale(normal, along));
        let size = dot(within, within).sqrt();
        let inner = law.backbone.respond(size);
        let (secant, unit) = if size > 0.0 {
            (inner.load / size, scale(within, 1.0 / size))
        } else {
            (inner.tangent, within)
        };
        let friction = law.friction.work(memory.friction, to - memory.position);
        let energy = law.backbone.energy(to - law.rest_curvature) + friction;
        BendingResponse {
            energy: energy + law.backbone.energy(size),
            gradient: add(scale(normal, response.load * first), scale(within, secant)),
            hessian: sum([
                (slope, outer(normal, normal)),
                (secant, sum([(1.0, identity()), (-1.0, outer(normal, normal))])),
                (inner.tangent - secant, outer(unit, unit)),
            ]),
        }
    }

    /// Returns the response of `law` about the normal alone, for connectors with a large rest
    /// curvature. The difference of two second differences is the difference of their angles only
    /// where both are small.
    pub(crate) fn respond_about_normal(
        &self,
        law: &BendingLaw,
        memory: &Memory,
        definite: bool,
    ) -> BendingResponse {
        let along = dot(self.second_difference, self.normal);
        let angle = TurningAngle::new(along * along, self.length);
        let CurvatureSlopes { first, second } = angle.curvature_slopes(along);
        let to = angle.curvature(along);
        let response = law.respond(memory, to);
        let slope = response.tangent * first * first + response.load * second;
        let slope = if definite { slope.max(0.0) } else { slope };
        let elastic = law.backbone.energy(to - law.rest_curvature);
        BendingResponse {
            energy: elastic + law.friction.work(memory.friction, to - memory.position),
            gradient: scale(self.normal, response.load * first),
            hessian: sum([(slope, outer(self.normal, self.normal))]),
        }
    }
}
