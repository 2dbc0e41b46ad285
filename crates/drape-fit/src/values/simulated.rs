//! KES values of a fabric's laws, from simulated KES tests.

use drape_fabric::{Fabric, Law, TractionLaw, drive};
use drape_kes::{Curve, Direction, EvaluationPoints, ShearPoints, Test, Values};

/// Number of points of each branch of a simulated tensile test: trapezoids err by 1e-6 of the work.
const TENSILE_POINTS: usize = 1000;
/// Largest curvature of the bending test, in 1/m.
pub(crate) const LARGEST_CURVATURE: f64 = 250.0;
/// Largest angle of the shear test, in rad: 8°.
pub(crate) const LARGEST_ANGLE: f64 = 8.0 * std::f64::consts::PI / 180.0;
/// Largest strain at which a law may have the largest load of the tensile test, a ratio.
const LARGEST_STRAIN: f64 = 10.0;
/// Bisections for the strain at a load: the bits of a double.
const BISECTIONS: usize = 60;

/// Returns the KES values of one direction of a fabric, in the laboratory's units.
///
/// Each test is simulated with the fabric's laws from rest, bending and shear to one side, the
/// other, and the first again, and read as [`Curve::values`] reads measured curves. The tensile
/// values are left out for a fabric that never carries the load of the tensile test.
///
/// ```
/// use drape_fit::{Settings, fabric_values, identify};
/// use drape_kes::{Direction, Sheet, Values};
///
/// let mut sheet = Sheet::default();
/// sheet.name = "by values".into();
/// sheet.warp = Values { b: Some(0.09), two_hb: Some(0.06), ..Values::default() };
/// let fabric = identify(&sheet)?.fabric;
///
/// let points = Settings::default().evaluation_points(&sheet);
/// let values = fabric_values(&fabric, Direction::Warp, &points);
/// assert!((values.b.expect("a fabric bends") / 0.09 - 1.0).abs() < 1e-9);
/// # Ok::<(), drape_fit::Error>(())
/// ```
#[must_use]
pub fn fabric_values(fabric: &Fabric, direction: Direction, points: &EvaluationPoints) -> Values {
    let laws = match direction {
        Direction::Warp => &fabric.warp,
        Direction::Weft => &fabric.weft,
    };
    let tensile = tensile_test(&laws.traction, points.maximum_tension);
    let [low, high] = points.bending.slope;
    let bending = cycle(&[low, high, points.bending.width], LARGEST_CURVATURE);
    let bending = curve(Test::Bending, &laws.bending, bending);
    let shear = curve(Test::Shear, &fabric.shear, shear_angles(&points.shear));
    let mut values = Values::default();
    for curve in [tensile, bending, shear].into_iter().flatten() {
        for read in curve.values(points) {
            *values.get_mut(read.symbol) = read.value.ok();
        }
    }
    values
}

/// Returns the angles of a shear test that passes the evaluation points.
pub(crate) fn shear_angles(points: &ShearPoints) -> Vec<f64> {
    let [low, high] = points.slope;
    cycle(&[low, high, points.width, points.wide], LARGEST_ANGLE)
}

/// Returns a cycle from rest to one side, the other, and back, with a point wherever a value is
/// read.
///
/// Laws are exact over any distance, so nothing is needed between these points.
fn cycle(read: &[f64], largest: f64) -> Vec<f64> {
    let mut points: Vec<f64> = read.iter().map(|q| q.abs()).collect();
    points.push(read.iter().fold(largest, |largest, q| largest.max(q.abs())));
    points.sort_by(f64::total_cmp);
    points.dedup();
    let (up, down) = (points.clone(), points.iter().rev().copied());
    let below = up.iter().map(|q| -q).rev();
    let mut path = vec![0.0];
    path.extend(&up);
    path.extend(down.clone().skip(1).chain(up.iter().map(|q| -q)));
    path.extend(below.skip(1).chain(up.iter().copied()));
    path
}

/// Simulates a tensile test to a load and back, if the law carries it.
fn tensile_test(law: &TractionLaw, maximum: f64) -> Option<Curve> {
    let virgin = law.virgin();
    let below = |strain: f64| law.respond(&virgin, strain).load < maximum;
    let (mut low, mut high) = (0.0, LARGEST_STRAIN);
    if below(high) {
        return None;
    }
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let at = |i: usize| high * i as f64 / TENSILE_POINTS as f64;
    let strain = (0..=TENSILE_POINTS).map(at).chain((0..TENSILE_POINTS).rev().map(at));
    curve(Test::Tensile, law, strain.collect())
}

/// Returns the curve of a law along a history of the test's deformation.
fn curve(test: Test, law: &impl Law, deformation: Vec<f64>) -> Option<Curve> {
    let load = match test {
        Test::Shear => {
            let sines: Vec<f64> = deformation.iter().map(|angle| angle.sin()).collect();
            drive(law, law.virgin(), &sines)
        }
        _ => drive(law, law.virgin(), &deformation),
    };
    Curve::new(test, Direction::Warp, deformation, load).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_passes_every_point_both_ways_on_both_sides() {
        let path = cycle(&[0.5, 2.5, 0.5, 5.0], 8.0);
        assert_eq!(
            path,
            [
                0.0, 0.5, 2.5, 5.0, 8.0, 5.0, 2.5, 0.5, -0.5, -2.5, -5.0, -8.0, -5.0, -2.5, -0.5,
                0.5, 2.5, 5.0, 8.0
            ]
        );
    }
}
