//! Shear law from G, 2HG and 2HG5.
//!
//! For a given friction length the values are linear in the stiffness `$k_s$`, the plateau `$F_c$`
//! and its growth `$F_c\gamma$`: three values, three equations.

use drape_fabric::{BlimanSorine, Law, Locking, ShearBackbone, ShearLaw, drive};
use drape_kes::{Curve, Direction, ShearPoints, ShearValues, Test};

use crate::forward::friction_path::{FrictionPath, UnitFriction};
use crate::values::assumed::SHEAR_FRICTION_LENGTH;
use crate::values::matched::Matched;
use crate::values::of_law::shear_angles;

/// Largest length of shear friction, a sine: that of the whole test. A longer one is a stiffness.
const LARGEST_LENGTH: f64 = 0.139;
/// Largest growth of a plateau that a fabric may have.
const LARGEST_GROWTH: f64 = 1e3;

/// Bisections for a length: the bits of a double.
const BISECTIONS: usize = 60;

/// Returns the shear law that has the values G, 2HG and 2HG5, read at the given points.
///
/// The friction length is assumed, except for a loop that narrows (2HG5 < 2HG): a plateau cannot
/// shrink, and the length at which friction has not yet reached its plateau after the reversal at
/// 8° gives such a loop.
///
/// The deviation is the largest relative deviation of the values: rounding, except for loops that
/// widen more than tenfold or narrow to less than 0.63, for which the mean of both widths is taken.
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
    let matched = |law: ShearLaw| Matched { law, deviation: unit.deviation(&law, target) };
    let growing = unit.growing(target, SHEAR_FRICTION_LENGTH);
    if let Some(law) = growing.filter(|law| law.growth >= 0.0) {
        return matched(law);
    }
    let ShearValues { stiffness, loop_width: narrow, wide_loop_width: wide } = *target;
    // The loop narrows the more the longer the length.
    let (mut short, mut long) = (SHEAR_FRICTION_LENGTH, LARGEST_LENGTH);
    let ratio = |length: f64| {
        let constant = unit.of(length).constant;
        constant.wide_loop_width / constant.loop_width
    };
    let wanted = wide / narrow;
    if wanted < ratio(short) && wanted > ratio(long) {
        for _ in 0..BISECTIONS {
            let middle = (short * long).sqrt();
            if ratio(middle) > wanted {
                short = middle;
            } else {
                long = middle;
            }
        }
        if let Some(law) = unit.constant(target, long) {
            return matched(law);
        }
    }
    let mean = 0.5 * (narrow + wide);
    let even = ShearValues { stiffness, loop_width: mean, wide_loop_width: mean };
    let law = unit.constant(&even, SHEAR_FRICTION_LENGTH);
    let without_correction =
        || shear_law(stiffness, 0.0, BlimanSorine::first_order(0.5 * mean, SHEAR_FRICTION_LENGTH));
    matched(law.unwrap_or_else(without_correction))
}

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

impl<'a> UnitValues<'a> {
    fn new(points: &'a ShearPoints) -> Self {
        let angles = shear_angles(points, Test::LARGEST_ANGLE);
        let sines: Vec<f64> = angles.iter().map(|angle| angle.sin()).collect();
        Self { points, path: FrictionPath::new(&sines), angles, sines }
    }

    /// Reads the values of loads along the test.
    fn read(&self, load: Vec<f64>) -> ShearValues {
        let curve = Curve::new(Test::Shear, Direction::Warp, self.angles.clone(), load);
        let values = curve.and_then(|curve| curve.shear_values(self.points));
        values.unwrap_or(ShearValues {
            stiffness: f64::NAN,
            loop_width: f64::NAN,
            wide_loop_width: f64::NAN,
        })
    }

    /// Returns the values of the terms with a friction length.
    fn of(&self, length: f64) -> Terms {
        let UnitFriction { constant, growing, .. } = self.path.unit_friction(length);
        let [linear, constant, growing] =
            [self.sines.clone(), constant, growing].map(|load| self.read(load));
        Terms { linear, constant, growing }
    }

    /// Returns the law with these values and a growing plateau; `None` where there is none.
    fn growing(&self, target: &ShearValues, length: f64) -> Option<ShearLaw> {
        let Terms { linear, constant, growing } = self.of(length);
        let (narrow, wide) = (target.loop_width, target.wide_loop_width);
        let determinant = constant.loop_width * growing.wide_loop_width
            - constant.wide_loop_width * growing.loop_width;
        let plateau = (narrow * growing.wide_loop_width - wide * growing.loop_width) / determinant;
        let rise = (constant.loop_width * wide - constant.wide_loop_width * narrow) / determinant;
        let stiffness =
            (target.stiffness - plateau * constant.stiffness - rise * growing.stiffness)
                / linear.stiffness;
        if narrow == 0.0 && wide == 0.0 {
            let friction = BlimanSorine::first_order(0.0, length);
            return (stiffness > 0.0).then(|| shear_law(stiffness, 0.0, friction));
        }
        let growth = rise / plateau;
        let possible = plateau > 0.0 && growth <= LARGEST_GROWTH && stiffness > 0.0;
        // A loop of even width has a growth of rounding.
        let growth = if growth.abs() < f64::EPSILON.sqrt() { 0.0 } else { growth };
        possible.then(|| shear_law(stiffness, growth, BlimanSorine::first_order(plateau, length)))
    }

    /// Returns the law with the stiffness and the narrow width, and a constant plateau.
    fn constant(&self, target: &ShearValues, length: f64) -> Option<ShearLaw> {
        let Terms { linear, constant, .. } = self.of(length);
        let plateau = target.loop_width / constant.loop_width;
        let stiffness = (target.stiffness - plateau * constant.stiffness) / linear.stiffness;
        let friction = BlimanSorine::first_order(plateau, length);
        (stiffness > 0.0).then(|| shear_law(stiffness, 0.0, friction))
    }

    /// Returns the largest relative deviation of a law's values from others.
    fn deviation(&self, law: &ShearLaw, target: &ShearValues) -> f64 {
        let found = self.read(drive(law, law.virgin(), &self.sines));
        let relative = |found: f64, wanted: f64| {
            if found == wanted { 0.0 } else { (found / wanted - 1.0).abs() }
        };
        [
            relative(found.stiffness, target.stiffness),
            relative(found.loop_width, target.loop_width),
            relative(found.wide_loop_width, target.wide_loop_width),
        ]
        .into_iter()
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
