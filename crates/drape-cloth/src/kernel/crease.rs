//! Bending of one connector at a fold, for batches where a panel is folded at rest.

use drape_fabric::{BendingBackbone, Response};

use crate::measure::half::HALF;
use crate::measure::turning_angle::{CurvatureSlopes, TurningAngle};
use crate::measure::vector::{Vector, add, dot, scale, subtract};

/// Bending of a connector at a fold.
///
/// The difference of two second differences is the difference of their angles only where both are
/// small. At a fold the curvature is therefore counted about the normal, less the rest curvature.
/// The part `$b_\parallel$` of the second difference within the surface is counted separately:
///
/// ```math
/// E = E_e(\kappa - \kappa_0) + E_e(|b_\parallel|)
/// ```
pub(crate) struct Crease {
    normal: Vector,
    /// Part of the second difference within the surface, in 1/m.
    within: Vector,
    /// Length of `within`, in 1/m.
    size: f64,
    /// Direction of `within`.
    unit: Vector,
    /// Curvature less the rest curvature, in 1/m.
    excess: f64,
    /// Derivatives of the curvature with respect to the second difference along the normal.
    slopes: CurvatureSlopes,
}

impl Crease {
    /// Returns the bending of a connector with `second_difference`, in 1/m, about `normal`, with
    /// segments of `length`, in m, and with `rest_curvature`, in 1/m.
    pub(crate) fn new(
        second_difference: Vector,
        normal: Vector,
        length: f64,
        rest_curvature: f64,
    ) -> Self {
        let along = dot(second_difference, normal);
        let within = subtract(second_difference, scale(normal, along));
        let size = dot(within, within).sqrt();
        let angle = TurningAngle::new(along * along, length);
        Self {
            normal,
            within,
            size,
            unit: if size > 0.0 { scale(within, 1.0 / size) } else { [0.0; 3] },
            excess: angle.curvature(along) - rest_curvature,
            slopes: angle.curvature_slopes(along),
        }
    }

    /// Returns the elastic energy per area for `backbone`, in J/m².
    pub(crate) fn energy(&self, backbone: &BendingBackbone) -> f64 {
        backbone.energy(self.excess) + backbone.energy(self.size)
    }

    /// Returns the derivative of the energy with respect to the second difference, in N, including
    /// the load `friction`.
    pub(crate) fn moment(&self, backbone: &BendingBackbone, friction: f64) -> Vector {
        let load = (backbone.respond(self.excess).load + friction) * self.slopes.first;
        let secant = self.within_surface(backbone).secant;
        add(scale(self.normal, load), scale(self.within, secant))
    }

    /// Returns the stiffness of `backbone` within the surface.
    fn within_surface(&self, backbone: &BendingBackbone) -> WithinSurface {
        let Response { load, tangent } = backbone.respond(self.size);
        let secant = if self.size > 0.0 { load / self.size } else { tangent };
        WithinSurface { secant, tangent }
    }

    /// Returns the upper half of the second derivative of the energy with respect to the second
    /// difference, including the response of the `friction`. With `definite`, the part that makes
    /// the matrix indefinite is left out.
    pub(crate) fn block(
        &self,
        backbone: &BendingBackbone,
        friction: Response,
        definite: bool,
    ) -> [f64; 6] {
        let elastic = backbone.respond(self.excess);
        let CurvatureSlopes { first, second } = self.slopes;
        let (load, tangent) = (elastic.load + friction.load, elastic.tangent + friction.tangent);
        let slope = tangent * first * first + load * second;
        let slope = if definite { slope.max(0.0) } else { slope };
        let WithinSurface { secant, tangent } = self.within_surface(backbone);
        HALF.map(|(row, column)| {
            let diagonal = if row == column { secant } else { 0.0 };
            (slope - secant) * self.normal[row] * self.normal[column]
                + (tangent - secant) * self.unit[row] * self.unit[column]
                + diagonal
        })
    }
}

/// Secant and tangent stiffness within the surface.
struct WithinSurface {
    secant: f64,
    tangent: f64,
}
