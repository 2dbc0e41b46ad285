//! Load of a Dahl element of given length along a deformation history, for all points at once.
//!
//! The linear regression for initial guesses needs it for many lengths, and the linear loop models
//! need its derivative by the length.

use drape_hysteresis::exp_m1;

/// Part of a history on which the deformation keeps its sign and its direction.
struct Segment {
    /// Slip, the amount of deformation covered.
    slip: f64,
    /// Sign of the rate of deformation.
    sign: f64,
    /// Size of the deformation at the start.
    from: f64,
    /// Growth of that size per slip: 1 or −1.
    growth: f64,
    /// Whether a measured point is at its end.
    measured: bool,
}

/// History of deformations from rest through measured points.
pub(crate) struct FrictionPath {
    segments: Vec<Segment>,
    points: usize,
}

/// Loads of a friction element at the measured points, and their derivatives by its length.
///
/// The load of an element whose plateau `$F_c$` grows by `$\gamma$` per unit of deformation is
/// `$F_c(c + \gamma g)$`.
pub(crate) struct UnitFriction {
    /// Load `$c$` with a plateau of one.
    pub(crate) constant: Vec<f64>,
    /// Load `$g$` with a plateau of the size of the deformation.
    pub(crate) growing: Vec<f64>,
    /// Derivative of `$c$` by the length.
    pub(crate) constant_slope: Vec<f64>,
    /// Derivative of `$g$` by the length.
    pub(crate) growing_slope: Vec<f64>,
}

impl FrictionPath {
    /// Splits `history` at its points and at zero.
    pub(crate) fn new(history: &[f64]) -> Self {
        let mut segments = Vec::with_capacity(history.len() + 8);
        let mut at = 0.0_f64;
        for &point in history {
            let changes_sign = at * point < 0.0;
            for (end, measured) in [(0.0, false), (point, true)] {
                if measured || changes_sign {
                    segments.push(Segment::new(at, end, measured));
                    at = end;
                }
            }
        }
        Self { segments, points: history.len() }
    }

    /// Returns the loads of an element of the given `length`. On each segment the loads are the
    /// exact solution of [`Dahl`](drape_fabric::Dahl).
    ///
    /// The loads are computed for all points at once: first the exponentials, then each load with
    /// its derivative from the load before.
    pub(crate) fn unit_friction(&self, length: f64) -> UnitFriction {
        let mut lost: Vec<f64> =
            self.segments.iter().map(|segment| -segment.slip / length).collect();
        lost.iter_mut().for_each(|lost| *lost = -exp_m1(*lost));
        let [mut constant, mut growing, mut constant_slope, mut growing_slope] =
            [(); 4].map(|()| Vec::with_capacity(self.points));

        let (mut c, mut g, mut c_slope, mut g_slope) = (0.0, 0.0, 0.0, 0.0);
        let inverse = 1.0 / length;
        for (segment, &lost) in self.segments.iter().zip(&lost) {
            let Segment { slip, sign, from, growth, measured } = *segment;
            let kept = 1.0 - lost;
            // Derivative of the factor `kept` by the length.
            let kept_slope = kept * slip * inverse * inverse;
            let lag = slip - length * lost;
            c_slope = c_slope * kept + (c - sign) * kept_slope;
            g_slope = g_slope * kept + g * kept_slope
                - sign * (from * kept_slope + growth * (lost - length * kept_slope));
            c = c * kept + sign * lost;
            g = g * kept + sign * (from * lost + growth * lag);
            if measured {
                constant.push(c);
                growing.push(g);
                constant_slope.push(c_slope);
                growing_slope.push(g_slope);
            }
        }
        UnitFriction { constant, growing, constant_slope, growing_slope }
    }
}

impl Segment {
    /// Returns the segment between two deformations. `measured` tells whether a point is at its
    /// end.
    fn new(from: f64, to: f64, measured: bool) -> Self {
        let slip = (to - from).abs();
        let growth = if slip > 0.0 { (to.abs() - from.abs()) / slip } else { 0.0 };
        Self { slip, sign: (to - from).signum(), from: from.abs(), growth, measured }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::{BlimanSorine, Law, ShearBackbone, ShearLaw, drive};

    /// Loading, through zero twice, one point twice, and loading again.
    fn path() -> Vec<f64> {
        let mut path: Vec<f64> = (0..40).map(|i| 0.14 * (0.3 * f64::from(i)).sin()).collect();
        path.extend([0.05, 0.05, -0.02, 0.14]);
        path
    }

    #[test]
    fn elements_side_by_side_are_the_friction_of_the_law() {
        let path = path();
        let friction = FrictionPath::new(&path);
        for length in [1e-4, 0.004, 0.03, 0.5] {
            let law = ShearLaw {
                backbone: ShearBackbone::Linear { stiffness: 0.0 },
                friction: BlimanSorine::first_order(0.7, length).expect("a friction"),
                growth: 9.0,
                locking: None,
            };
            let exact = drive(&law, law.virgin(), &path);
            let element = friction.unit_friction(length);
            let columns = element.constant.iter().zip(&element.growing);
            for (exact, (constant, growing)) in exact.iter().zip(columns) {
                let found = 0.7 * (constant + 9.0 * growing);
                assert!((found - exact).abs() < 1e-14, "length {length}: {found} not {exact}");
            }
        }
    }

    #[test]
    fn their_derivatives_are_those_of_differences() {
        let friction = FrictionPath::new(&path());
        for length in [0.004, 0.03, 0.5] {
            let step = 1e-5 * length;
            let (less, more) =
                (friction.unit_friction(length - step), friction.unit_friction(length + step));
            let at = friction.unit_friction(length);
            let pairs = [
                (&at.constant_slope, &less.constant, &more.constant),
                (&at.growing_slope, &less.growing, &more.growing),
            ];
            for (slopes, less, more) in pairs {
                for ((slope, less), more) in slopes.iter().zip(less).zip(more) {
                    let difference = 0.5 * (more - less) / step;
                    // The formula errs by the square of the step, rounding by 1e-16 over the step.
                    assert!((slope - difference).abs() * length < 1e-9, "{slope} not {difference}");
                }
            }
        }
    }
}
