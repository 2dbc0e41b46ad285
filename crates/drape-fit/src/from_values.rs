//! Bending and traction laws from KES values alone, such that the laws have those values.

use drape_fabric::{
    BendingBackbone, BendingLaw, BlimanSorine, Buckling, Law, Polynomial, Primed, TOE_RATIO_MIN,
    TractionBackbone, TractionLaw,
};

use crate::Error;
use crate::assumed::{BENDING_SLIP, TENSILE_SLIP};
use drape_lm::{self as lm, Parameter, Problem, Settings};

/// How near the values of a law are to those asked for, relative, when it has them.
pub(crate) const VALUE_TOLERANCE: f64 = 1e-6;
/// How far the nearest law may be, relative, before the values are taken for mistaken.
///
/// The roundest curves with the widest loops (LT 0.5 with RT 40 %) are met to a few percent only.
const NEAREST: f64 = 0.1;
/// Halvings when looking for the strain at which the recovery reaches zero load.
const HALVINGS: usize = 60;

/// KES values of a tensile test, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensileTarget {
    /// The largest load, per width; in N/m.
    pub maximum_tension: f64,
    /// EM: strain at the largest load, a ratio.
    pub extension: f64,
    /// LT: work over that of a straight line, a ratio.
    pub linearity: f64,
    /// RT: work given back over work spent, a ratio.
    pub resilience: f64,
}

/// The bending law that has the values B (in N·m) and 2HB (in N).
///
/// The friction slips within a curvature that 2HB does not tell and that is taken from the one published
/// measurement. It has slipped long before the curvatures where B and 2HB are read (to `$e^{-37}$`), so B is
/// the rigidity and 2HB twice the plateau.
pub fn bending_from_values(rigidity: f64, loop_width: f64) -> BendingLaw {
    BendingLaw {
        backbone: BendingBackbone::Linear { rigidity },
        rest_curvature: 0.0,
        friction: BlimanSorine::first_order(0.5 * loop_width, BENDING_SLIP),
    }
}

/// The traction law that has the values EM, LT and RT at the given load.
///
/// A priming zone that reaches to EM is made as deep as LT needs: of all priming zones with these values it
/// leaves the fabric stiffest at rest. Of a curve rounder than that can be (an elastic LT below 0.67) the
/// even polynomial is taken. How the fabric changes once it has been stretched is
/// not in the values: the toe does not move.
///
/// Returned with the law is the root mean square deviation of its values from those asked for, relative:
/// nothing but rounding, except for the roundest curves with the widest loops.
///
/// # Errors
/// No law here comes near these values.
pub fn tensile_from_values(target: &TensileTarget) -> Result<(TractionLaw, f64), Error> {
    let nearest = |shape: Shape| {
        let problem = Values { shape, target };
        let report = lm::minimise(&problem, &problem.parameters(), &Settings::default());
        (problem.law(&report.parameters), report.rms)
    };
    let (primed, polynomial) = (nearest(Shape::Primed), nearest(Shape::Polynomial));
    // The priming zone is the model; the polynomial is for curves that it cannot follow.
    let best = if primed.1 <= polynomial.1.max(VALUE_TOLERANCE) { primed } else { polynomial };
    if best.1 < NEAREST {
        return Ok(best);
    }
    let TensileTarget { linearity, resilience, .. } = *target;
    Err(Error::Unreachable { name: "tension".into(), linearity, resilience })
}

/// EM's load, WT and RT·WT of a law: one pull to EM and back to zero load, exactly.
fn pull(law: &TractionLaw, extension: f64) -> [f64; 3] {
    let virgin = law.virgin();
    let load = law.respond(&virgin, extension).load;
    let work = law.work(&virgin, extension);
    let stretched = law.commit(&virgin, extension);
    let (mut slack, mut taut) = (0.0, extension);
    if law.respond(&stretched, slack).load < 0.0 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (slack + taut);
            if law.respond(&stretched, middle).load < 0.0 {
                slack = middle;
            } else {
                taut = middle;
            }
        }
    } else {
        taut = slack;
    }
    [load, work, -law.work(&stretched, taut)]
}

/// Family of laws with one parameter of shape.
#[derive(Clone, Copy)]
enum Shape {
    /// Toe ratio of a toe that reaches to EM.
    Primed,
    /// Share of the fourth power in the load at EM.
    Polynomial,
}

struct Values<'a> {
    shape: Shape,
    target: &'a TensileTarget,
}

impl Values<'_> {
    /// Elastic load at EM and plateau, over the largest load, and the shape.
    fn parameters(&self) -> [Parameter; 3] {
        let shape = match self.shape {
            Shape::Primed => Parameter::new(0.7).between(TOE_RATIO_MIN, 1.0),
            Shape::Polynomial => Parameter::new(0.3).between(0.0, 1.0),
        };
        let plateau = 0.25 * (1.0 - self.target.resilience);
        [
            Parameter::new(1.0).between(0.0, 2.0),
            Parameter::new(plateau).with_scale(0.01).between(0.0, 1.0),
            shape,
        ]
    }

    fn law(&self, p: &[f64]) -> TractionLaw {
        let TensileTarget { maximum_tension, extension, .. } = *self.target;
        let elastic = p[0] * maximum_tension;
        let backbone = match self.shape {
            Shape::Primed => {
                let (toe_ratio, toe_strain) = (p[2], extension);
                TractionBackbone::Primed(Primed {
                    stiffness: elastic / (toe_ratio * toe_strain),
                    toe_ratio,
                    toe_strain,
                    toe_strain_after: toe_strain,
                })
            }
            Shape::Polynomial => TractionBackbone::Polynomial(Polynomial {
                quadratic: elastic * (1.0 - p[2]) / extension.powi(2),
                quartic: elastic * p[2] / extension.powi(4),
            }),
        };
        let friction = BlimanSorine::first_order(p[1] * maximum_tension, TENSILE_SLIP * extension);
        TractionLaw { backbone, friction, buckling: Buckling::default() }
    }
}

impl Problem for Values<'_> {
    fn residual_count(&self) -> usize {
        3
    }

    fn residuals(&self, p: &[f64], out: &mut [f64]) {
        let target = self.target;
        let work = 0.5 * target.linearity * target.maximum_tension * target.extension;
        let exact = [target.maximum_tension, work, target.resilience * work];
        let found = pull(&self.law(p), target.extension);
        for ((residual, found), exact) in out.iter_mut().zip(found).zip(exact) {
            *residual = found / exact - 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::drive;
    use drape_kes::{BendingPoints, Curve, Direction, Test};

    /// Points per branch; interpolation and trapezoids between them err by less than the tolerance.
    const STEPS: usize = 4000;

    fn cycle(test: Test, law: &impl Law, turns: &[f64]) -> Curve {
        let mut q = vec![turns[0]];
        for ends in turns.windows(2) {
            let at = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / STEPS as f64;
            q.extend((1..=STEPS).map(at));
        }
        let load = drive(law, law.virgin(), &q);
        Curve::new(test, Direction::Warp, q, load).unwrap()
    }

    fn same(found: f64, exact: f64, tolerance: f64) {
        let error = (found / exact - 1.0).abs();
        assert!(error < tolerance, "{found} where {exact} was asked for");
    }

    #[test]
    fn the_bending_law_gives_its_values_back() {
        let law = bending_from_values(1.157e-5, 1.216e-3);
        let curve = cycle(Test::Bending, &law, &[0.0, 250.0, -250.0, 250.0]);
        let values = curve.bending_values(&BendingPoints::default()).unwrap();
        same(values.rigidity, 1.157e-5, 1e-9);
        same(values.loop_width, 1.216e-3, 1e-9);
    }

    #[test]
    fn the_traction_law_gives_its_values_back_over_the_range_of_fabrics() {
        for linearity in [0.5, 0.6, 0.7, 0.8, 0.9] {
            for resilience in [0.4, 0.55, 0.7, 0.9] {
                for extension in [0.015, 0.05, 0.12] {
                    let target = TensileTarget {
                        maximum_tension: 490.3325,
                        extension,
                        linearity,
                        resilience,
                    };
                    let (law, misfit) = tensile_from_values(&target)
                        .unwrap_or_else(|error| panic!("{target:?}: {error}"));
                    if linearity < 0.6 && resilience < 0.6 {
                        assert!(misfit < NEAREST, "{target:?}: {misfit}");
                        continue;
                    }
                    let curve = cycle(Test::Tensile, &law, &[0.0, extension, 0.0]);
                    let values = curve.tensile_values().unwrap();
                    same(values.maximum_tension, 490.3325, 1e-5);
                    same(values.linearity, linearity, 1e-4);
                    same(values.resilience.unwrap(), resilience, 1e-4);
                }
            }
        }
    }

    #[test]
    fn values_that_no_curve_has_are_refused() {
        for (linearity, resilience) in [(0.2, 0.5), (1.6, 0.5)] {
            let target =
                TensileTarget { maximum_tension: 490.3325, extension: 0.05, linearity, resilience };
            let result = tensile_from_values(&target);
            assert!(matches!(result, Err(Error::Unreachable { .. })), "{target:?}: {result:?}");
        }
    }
}
