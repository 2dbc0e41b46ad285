//! Shear law from G, 2HG and 2HG5.
//!
//! For a given friction length the values are linear in the stiffness `$k_s$`, the plateau `$F_c$`
//! and its growth `$F_c\gamma$`: three values, three equations.

use drape_fabric::{BlimanSorine, Dahl, Law, Locking, ShearBackbone, ShearLaw, drive};
use drape_kes::{Curve, Direction, ShearPoints, ShearValues, Test};

use crate::forward::friction_path::{FrictionPath, UnitFriction};
use crate::values::assumed::SHEAR_FRICTION_LENGTH;
use crate::values::matched::Matched;
use crate::values::of_law::shear_angles;

/// Largest length of shear friction, a sine: the length of the whole test. A longer friction is a
/// stiffness.
const LARGEST_LENGTH: f64 = 0.139;
/// Largest growth of a plateau that a fabric may have.
const LARGEST_GROWTH: f64 = 1e3;

/// Bisections for a length: the bits of a double.
const BISECTIONS: usize = 60;

/// Returns the shear law that has the values `target`: G, 2HG and 2HG5, read at `points`.
///
/// The friction length is assumed, except for a loop that narrows (2HG5 < 2HG). A plateau cannot
/// shrink, so such a loop needs a length at which friction has not yet reached its plateau after
/// the reversal at 8°.
///
/// The deviation is the largest relative deviation of the values. It is rounding, except for loops
/// that widen more than tenfold or narrow to less than 0.63. For such loops the mean of both widths
/// is taken.
///
/// ```
/// use drape_fit::shear_from_values;
/// use drape_kes::{ShearPoints, ShearValues};
///
/// let target = ShearValues { stiffness: 33.7, loop_width: 0.5, wide_loop_width: 1.4 };
/// let found = shear_from_values(&target, &ShearPoints::default());
/// assert!(found.deviation < 1e-9 && found.law.growth > 0.0);
/// ```
#[must_use]
pub fn shear_from_values(target: &ShearValues, points: &ShearPoints) -> Matched<ShearLaw> {
    let unit = UnitValues::new(points);
    let growing = unit.growing(target, SHEAR_FRICTION_LENGTH);
    let law = growing
        .filter(|law| law.growth >= 0.0)
        .or_else(|| unit.narrowing(target))
        .unwrap_or_else(|| unit.even(target));
    Matched { law, deviation: unit.deviation(&law, target) }
}

/// Returns the law with a linear backbone and the default locking.
fn shear_law(stiffness: f64, growth: f64, friction: BlimanSorine) -> ShearLaw {
    ShearLaw {
        backbone: ShearBackbone::Linear { stiffness },
        friction,
        growth,
        locking: Some(Locking::default()),
    }
}

/// Values of the terms of a shear law, each with a coefficient of one.
struct Terms {
    /// Values of the linear backbone.
    linear: ShearValues,
    /// Values of a constant plateau.
    constant: ShearValues,
    /// Values of a plateau of the size of the sine.
    growing: ShearValues,
}

/// Simulated KES shear test for the terms of a shear law.
struct UnitValues<'a> {
    points: &'a ShearPoints,
    angles: Vec<f64>,
    path: FrictionPath,
    sines: Vec<f64>,
}

/// Simulates the standard test, read at `points`.
impl<'a> UnitValues<'a> {
    fn new(points: &'a ShearPoints) -> Self {
        let angles = shear_angles(points, Test::LARGEST_ANGLE);
        let sines: Vec<f64> = angles.iter().map(|angle| angle.sin()).collect();
        Self { points, path: FrictionPath::new(&sines), angles, sines }
    }

    /// Reads the values of the `load` along the test.
    fn read(&self, load: Vec<f64>) -> ShearValues {
        let curve = Curve::new(Test::Shear, Direction::Warp, self.angles.clone(), load);
        let values = curve.and_then(|curve| curve.shear_values(self.points));
        values.unwrap_or(ShearValues {
            stiffness: f64::NAN,
            loop_width: f64::NAN,
            wide_loop_width: f64::NAN,
        })
    }

    /// Returns the values of the terms with the friction `length`.
    fn terms_at(&self, length: f64) -> Terms {
        let UnitFriction { constant, growing, .. } = self.path.unit_friction(length);
        let [linear, constant, growing] =
            [self.sines.clone(), constant, growing].map(|load| self.read(load));
        Terms { linear, constant, growing }
    }

    /// Returns the law with the values `target`, if they are values of a loop that narrows.
    fn narrowing(&self, target: &ShearValues) -> Option<ShearLaw> {
        let wanted = target.wide_loop_width / target.loop_width;
        // A longer friction narrows the loop more.
        let (mut short, mut long) = (SHEAR_FRICTION_LENGTH, LARGEST_LENGTH);
        if !(wanted < self.width_ratio(short) && wanted > self.width_ratio(long)) {
            return None;
        }
        for _ in 0..BISECTIONS {
            let middle = (short * long).sqrt();
            if self.width_ratio(middle) > wanted {
                short = middle;
            } else {
                long = middle;
            }
        }
        self.constant(target, long)
    }

    /// Returns the wide width over the narrow width of a constant plateau with the friction
    /// `length`.
    fn width_ratio(&self, length: f64) -> f64 {
        let constant = self.terms_at(length).constant;
        constant.wide_loop_width / constant.loop_width
    }

    /// Returns the law with the stiffness of `target` and the mean of its widths at all angles.
    fn even(&self, target: &ShearValues) -> ShearLaw {
        let mean = 0.5 * (target.loop_width + target.wide_loop_width);
        let even =
            ShearValues { stiffness: target.stiffness, loop_width: mean, wide_loop_width: mean };
        self.constant(&even, SHEAR_FRICTION_LENGTH).unwrap_or_else(|| {
            let friction =
                BlimanSorine::from(Dahl { plateau: 0.5 * mean, length: SHEAR_FRICTION_LENGTH });
            shear_law(target.stiffness, 0.0, friction)
        })
    }

    /// Returns the law with the values `target` and a growing plateau; `None` if there is no such
    /// law.
    fn growing(&self, target: &ShearValues, length: f64) -> Option<ShearLaw> {
        let Terms { linear, constant, growing } = self.terms_at(length);
        let (narrow, wide) = (target.loop_width, target.wide_loop_width);
        let determinant = constant.loop_width * growing.wide_loop_width
            - constant.wide_loop_width * growing.loop_width;
        let plateau = (narrow * growing.wide_loop_width - wide * growing.loop_width) / determinant;
        let rise = (constant.loop_width * wide - constant.wide_loop_width * narrow) / determinant;
        let stiffness =
            (target.stiffness - plateau * constant.stiffness - rise * growing.stiffness)
                / linear.stiffness;
        if narrow == 0.0 && wide == 0.0 {
            let friction = BlimanSorine::from(Dahl { plateau: 0.0, length });
            return (stiffness > 0.0).then(|| shear_law(stiffness, 0.0, friction));
        }

        let growth = rise / plateau;
        let possible = plateau > 0.0 && growth <= LARGEST_GROWTH && stiffness > 0.0;
        // The growth of a loop of even width is rounding.
        let growth = if growth.abs() < f64::EPSILON.sqrt() { 0.0 } else { growth };
        possible.then(|| shear_law(stiffness, growth, Dahl { plateau, length }.into()))
    }

    /// Returns the law with the stiffness and the narrow width of `target`, and a constant plateau;
    /// `None` if its stiffness is negative.
    fn constant(&self, target: &ShearValues, length: f64) -> Option<ShearLaw> {
        let Terms { linear, constant, .. } = self.terms_at(length);
        let plateau = target.loop_width / constant.loop_width;
        let stiffness = (target.stiffness - plateau * constant.stiffness) / linear.stiffness;
        let friction = BlimanSorine::from(Dahl { plateau, length });
        (stiffness > 0.0).then(|| shear_law(stiffness, 0.0, friction))
    }

    /// Returns the largest relative deviation of the values of `law` from `target`.
    fn deviation(&self, law: &ShearLaw, target: &ShearValues) -> f64 {
        let values = self.read(drive(law, law.virgin(), &self.sines));
        [
            (values.stiffness, target.stiffness),
            (values.loop_width, target.loop_width),
            (values.wide_loop_width, target.wide_loop_width),
        ]
        .into_iter()
        .map(|(value, wanted)| if value == wanted { 0.0 } else { (value / wanted - 1.0).abs() })
        .fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values of a law along a finely drawn cycle, which shares nothing with the search.
    fn values(law: &ShearLaw) -> [f64; 3] {
        const STEPS: usize = 4000;
        let reversals = [0.0, 8.0, -8.0, 8.0].map(f64::to_radians);
        let mut angles = vec![0.0];
        for ends in reversals.windows(2) {
            let at = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / STEPS as f64;
            angles.extend((1..=STEPS).map(at));
        }
        let sines: Vec<f64> = angles.iter().map(|angle| angle.sin()).collect();
        let load = drive(law, law.virgin(), &sines);
        let curve = Curve::new(Test::Shear, Direction::Warp, angles, load).unwrap();
        let v = curve.shear_values(&ShearPoints::default()).unwrap();
        [v.stiffness, v.loop_width, v.wide_loop_width]
    }

    fn target([loop_width, wide_loop_width]: [f64; 2]) -> ShearValues {
        ShearValues { stiffness: 33.7, loop_width, wide_loop_width }
    }

    #[test]
    fn the_shear_law_gives_its_values_back() {
        let points = ShearPoints::default();
        for widths in [[0.5, 1.4], [0.98, 1.0], [1.0, 1.0], [0.5, 2.5], [1.0, 0.8], [0.3, 0.2]] {
            let Matched { law, deviation } = shear_from_values(&target(widths), &points);
            assert!(deviation < 1e-9, "{widths:?}: {deviation}");
            for (found, exact) in values(&law).into_iter().zip([33.7, widths[0], widths[1]]) {
                // Interpolation on 0.004° of a bend with radius x_f: (h/x_f)²/8 = 5e-5 of its
                // share.
                let error = (found / exact - 1.0).abs();
                assert!(error < 1e-5, "{widths:?}: {found} where {exact} was asked for");
            }
        }
    }

    #[test]
    fn a_loop_that_no_friction_has_gets_the_mean_width_and_says_so() {
        let points = ShearPoints::default();
        for widths in [[1.0, 0.4], [0.1, 2.0]] {
            let Matched { law, deviation } = shear_from_values(&target(widths), &points);
            assert_eq!(law.growth, 0.0);
            let mean = 0.5 * (widths[0] + widths[1]);
            let exact = (mean / widths[0] - 1.0).abs().max((mean / widths[1] - 1.0).abs());
            assert!((deviation / exact - 1.0).abs() < 1e-3, "{widths:?}: {deviation} not {exact}");
            assert!((2.0 * law.friction.plateau() / mean - 1.0).abs() < 1e-3, "{law:?}");
        }
    }
}
