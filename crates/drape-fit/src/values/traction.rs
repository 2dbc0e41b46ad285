//! Traction law from EM, LT and RT.
//!
//! ```math
//! r = \left(\frac{F(EM)}{F_m},\ \frac{W}{\tfrac12 LT\,F_m\,EM},\ \frac{W'}{RT\,W}\right) - 1
//! ```
//!
//! Three residuals, three parameters (elastic load, plateau, shape), solved by drape-lm.

use drape_fabric::{
    BlimanSorine, Buckling, Dahl, ExponentialToe, FRICTION_RATIO_MAX, Law, Primed,
    ProportionalFriction, STEEPNESS_MIN, TOE_RATIO_MIN, TractionBackbone, TractionLaw,
};
use drape_lm::{MinimiserSettings, Parameter, Problem, minimise};

use crate::error::Error;
use crate::values::assumed::TENSILE_FRICTION_LENGTH;
use crate::values::matched::Matched;

/// Relative deviation of the values of a law below which they are met.
pub(crate) const VALUE_TOLERANCE: f64 = 1e-6;
/// Largest relative deviation of the nearest law with which the values are accepted.
const LARGEST_DEVIATION: f64 = 0.1;
/// Largest steepness of a toe: LT 0.05, which is less than any fabric has.
const LARGEST_STEEPNESS: f64 = 40.0;
/// Bisections for the strain at which the recovery reaches zero load.
const BISECTIONS: usize = 60;

/// KES values of a tensile test, in SI, that a law is to have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensileTarget {
    /// Largest load, per width; in N/m.
    pub maximum_tension: f64,
    /// EM: strain at the largest load, a ratio.
    pub extension: f64,
    /// LT: work over the work of a straight line, a ratio.
    pub linearity: f64,
    /// RT: recovered work over work spent, a ratio.
    pub resilience: f64,
}

/// Returns the traction law that has the values EM, LT and RT of `target` at the given load.
///
/// A priming zone that ends at EM is made as deep as LT needs: among priming zones with these
/// values it leaves the fabric stiffest at rest. A curve with a lower linearity (an elastic LT
/// below 0.67) gets an exponential toe that ends at EM, with friction in proportion to the tension.
/// The values contain no information on changes of a stretched fabric, so the toe does not move.
///
/// The deviation is the root mean square of the relative deviations of the values, and is usually
/// rounding.
///
/// ```
/// use drape_fit::{TensileTarget, tensile_from_values};
///
/// // FM = 490 N/m, EM = 5 %, LT = 0.75, RT = 55 %.
/// let target = TensileTarget {
///     maximum_tension: 490.0,
///     extension: 0.05,
///     linearity: 0.75,
///     resilience: 0.55,
/// };
/// assert!(tensile_from_values(&target)?.deviation < 1e-6);
/// # Ok::<(), drape_fit::Error>(())
/// ```
///
/// # Errors
/// No law comes near these values.
pub fn tensile_from_values(target: &TensileTarget) -> Result<Matched<TractionLaw>, Error> {
    // The exponential toe is for curves that the priming zone cannot follow.
    let primed = nearest_law(Shape::Primed, target);
    let best = if primed.deviation <= VALUE_TOLERANCE {
        primed
    } else {
        let exponential = nearest_law(Shape::Exponential, target);
        if primed.deviation <= exponential.deviation { primed } else { exponential }
    };
    if best.deviation < LARGEST_DEVIATION {
        return Ok(best);
    }
    let TensileTarget { linearity, resilience, .. } = *target;
    Err(Error::IncompatibleValues { name: "tension".into(), linearity, resilience })
}

/// Returns the law of a `shape` whose values are nearest to `target`.
fn nearest_law(shape: Shape, target: &TensileTarget) -> Matched<TractionLaw> {
    let problem = TensileProblem { shape, target };
    let report = minimise(&problem, &problem.parameters(), &MinimiserSettings::default());
    Matched { law: problem.law(&report.parameters), deviation: report.rms }
}

/// Returns load at EM, WT and RT·WT of `law`, for one exact cycle to EM, the `extension`, and back
/// to zero load.
pub(crate) fn cycle_values(law: &TractionLaw, extension: f64) -> [f64; 3] {
    let virgin = law.virgin();
    let load = law.respond(&virgin, extension).load;
    let work = law.work(&virgin, extension);
    let stretched = law.commit(&virgin, extension);

    // The recovery ends where the load vanishes.
    let (mut slack, mut taut) = (0.0, extension);
    if law.respond(&stretched, slack).load < 0.0 {
        for _ in 0..BISECTIONS {
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

/// Family of backbones with one shape parameter.
#[derive(Clone, Copy)]
enum Shape {
    /// Priming zone that ends at EM; the parameter is its toe ratio.
    Primed,
    /// Exponential toe that ends at EM; the parameter is its steepness.
    Exponential,
}

struct TensileProblem<'a> {
    shape: Shape,
    target: &'a TensileTarget,
}

impl TensileProblem<'_> {
    /// Returns the parameters of the `shape`: elastic load at EM over the largest load, friction
    /// over its reference load (the largest load for a plateau, else the elastic load), and the
    /// shape parameter.
    fn parameters(&self) -> [Parameter; 3] {
        let (shape, most) = match self.shape {
            Shape::Primed => (Parameter::new(0.7).between(TOE_RATIO_MIN, 1.0), 1.0),
            Shape::Exponential => {
                let steepness = Parameter::new(2.0).between(STEEPNESS_MIN, LARGEST_STEEPNESS);
                (steepness, FRICTION_RATIO_MAX)
            }
        };
        let friction = 0.25 * (1.0 - self.target.resilience);
        [
            Parameter::new(1.0).between(0.0, 2.0),
            Parameter::new(friction).with_scale(0.01).between(0.0, most),
            shape,
        ]
    }

    /// Returns the law with the parameters `p`.
    fn law(&self, p: &[f64]) -> TractionLaw {
        let TensileTarget { maximum_tension, extension, .. } = *self.target;
        let elastic = p[0] * maximum_tension;
        let length = TENSILE_FRICTION_LENGTH * extension;

        let (backbone, friction) = match self.shape {
            Shape::Primed => {
                let (toe_ratio, toe_strain) = (p[2], extension);
                let primed = Primed {
                    stiffness: elastic / (toe_ratio * toe_strain),
                    toe_ratio,
                    toe_strain,
                    toe_strain_after: toe_strain,
                };
                let friction = BlimanSorine::from(Dahl { plateau: p[1] * maximum_tension, length });
                (TractionBackbone::Primed(primed), friction.into())
            }
            Shape::Exponential => {
                let steepness = p[2];
                // The load at the end of a toe of unit stiffness.
                let unit = -extension * (-steepness).exp_m1() / steepness;
                let toe = ExponentialToe {
                    base_stiffness: 0.0,
                    stiffness: elastic / unit,
                    steepness,
                    toe_strain: extension,
                    toe_strain_after: extension,
                };
                let friction = ProportionalFriction { ratio: p[1], plateau: 0.0, length };
                (TractionBackbone::Exponential(toe), friction.into())
            }
        };

        TractionLaw { backbone, friction, buckling: Buckling::default() }
    }
}

impl Problem for TensileProblem<'_> {
    fn residual_count(&self) -> usize {
        3
    }

    fn residuals(&self, p: &[f64], out: &mut [f64]) {
        let target = self.target;
        let work = 0.5 * target.linearity * target.maximum_tension * target.extension;
        let exact = [target.maximum_tension, work, target.resilience * work];
        let found = cycle_values(&self.law(p), target.extension);
        for ((residual, found), exact) in out.iter_mut().zip(found).zip(exact) {
            *residual = found / exact - 1.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::drive;
    use drape_kes::{Curve, Direction, Test};

    /// Points per branch; interpolation and trapezoids between them err by less than the tolerance.
    const STEPS: usize = 4000;

    fn cycle(test: Test, law: &impl Law, reversals: &[f64]) -> Curve {
        let mut q = vec![reversals[0]];
        for ends in reversals.windows(2) {
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
    fn the_traction_law_gives_its_values_back_over_the_range_of_fabrics() {
        for linearity in [0.3, 0.5, 0.6, 0.7, 0.8, 0.9] {
            for resilience in [0.4, 0.55, 0.7, 0.9] {
                for extension in [0.015, 0.05, 0.12] {
                    let target = TensileTarget {
                        maximum_tension: 490.3325,
                        extension,
                        linearity,
                        resilience,
                    };
                    let Matched { law, deviation } = tensile_from_values(&target)
                        .unwrap_or_else(|error| panic!("{target:?}: {error}"));
                    assert!(deviation < VALUE_TOLERANCE, "{target:?}: {deviation}");
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
        for (linearity, resilience) in [(0.03, 0.5), (1.6, 0.5)] {
            let target =
                TensileTarget { maximum_tension: 490.3325, extension: 0.05, linearity, resilience };
            let result = tensile_from_values(&target);
            assert!(
                matches!(result, Err(Error::IncompatibleValues { .. })),
                "{target:?}: {result:?}"
            );
        }
    }
}
