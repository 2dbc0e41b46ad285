//! KES values of one law, from a simulated KES test of it.

use drape_fabric::{BendingLaw, Law, ShearLaw, TractionLaw, drive};
use drape_kes::{BendingPoints, Curve, Direction, EvaluationPoints, ShearPoints, Symbol, Test};

use crate::values::traction::cycle_values;

/// Deformation of the tip of a cycle, at least, over the outermost deformation that is read.
const TIP: f64 = 1.1;

/// KES value of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LawValue {
    pub(crate) symbol: Symbol,
    /// Value in the laboratory's unit; `None` where the law never carries the load of the test.
    pub(crate) value: Option<f64>,
}

/// Returns LT, WT, RT and EM of the traction law `law`, for an exact cycle up to the load
/// `maximum`, in N/m, and back to zero load.
pub(crate) fn tensile_values(law: &TractionLaw, maximum: f64) -> Vec<LawValue> {
    let extension = law.strain_at(maximum);
    let values = extension.map(|extension| {
        let [load, work, recovered] = cycle_values(law, extension);
        [work / (0.5 * load * extension), work, recovered / work, extension]
    });
    [Symbol::Lt, Symbol::Wt, Symbol::Rt, Symbol::Em]
        .into_iter()
        .enumerate()
        .map(|(index, symbol)| LawValue {
            symbol,
            value: values.map(|values| values[index] / symbol.factor()),
        })
        .collect()
}

/// Returns B and 2HB of the bending law `law`, for a test to ±`largest`, in 1/m.
pub(crate) fn bending_values(
    law: &BendingLaw,
    points: &BendingPoints,
    largest: f64,
) -> Vec<LawValue> {
    let [low, high] = points.slope;
    let path = cycle(&[low, high, points.width], largest, Test::LARGEST_CURVATURE);
    let load = drive(law, law.virgin(), &path);
    let points =
        EvaluationPoints { maximum_tension: 0.0, bending: *points, shear: ShearPoints::default() };
    read_values(Test::Bending, path, load, &points)
}

/// Returns G, 2HG and 2HG5 of the shear law `law`, for a test to ±`largest`, in rad.
pub(crate) fn shear_values(law: &ShearLaw, points: &ShearPoints, largest: f64) -> Vec<LawValue> {
    let angles = shear_angles(points, largest);
    let sines: Vec<f64> = angles.iter().map(|angle| angle.sin()).collect();
    let load = drive(law, law.virgin(), &sines);
    let points = EvaluationPoints {
        maximum_tension: 0.0,
        bending: BendingPoints::default(),
        shear: *points,
    };
    read_values(Test::Shear, angles, load, &points)
}

/// Reads the values of the `load` along the `path` of a test.
fn read_values(
    test: Test,
    path: Vec<f64>,
    load: Vec<f64>,
    points: &EvaluationPoints,
) -> Vec<LawValue> {
    let curve = Curve::new(test, Direction::Warp, path, load);
    let values = curve.map_or_else(|_| Vec::new(), |curve| curve.values(points));
    values.into_iter().map(|v| LawValue { symbol: v.symbol, value: v.value.ok() }).collect()
}

/// Returns the angles of a shear test to ±`largest` that passes the evaluation `points`.
pub(crate) fn shear_angles(points: &ShearPoints, largest: f64) -> Vec<f64> {
    let [low, high] = points.slope;
    cycle(&[low, high, points.width, points.wide], largest, Test::LARGEST_ANGLE)
}

/// Returns a cycle from rest to one side, to the other side, and back, with a point at each
/// deformation in `read`.
///
/// Laws are exact over any distance, so no point is needed between. The cycle goes to `largest`, or
/// to the deformation of the `standard` test if a value is read close to `largest`: at the tip of a
/// loop no value can be read.
fn cycle(read: &[f64], largest: f64, standard: f64) -> Vec<f64> {
    let mut points: Vec<f64> = read.iter().map(|q| q.abs()).collect();
    let outermost = points.iter().fold(0.0_f64, |outermost, q| outermost.max(*q));
    let tip = if largest >= TIP * outermost { largest } else { standard.max(TIP * outermost) };
    points.push(tip);
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

#[cfg(test)]
mod tests {
    use drape_fabric::{BlimanSorine, Buckling, Primed, TractionBackbone};

    use super::*;

    #[test]
    fn a_cycle_passes_every_point_both_ways_on_both_sides() {
        let path = cycle(&[0.5, 2.5, 0.5, 5.0], 8.0, 8.0);
        assert_eq!(
            path,
            [
                0.0, 0.5, 2.5, 5.0, 8.0, 5.0, 2.5, 0.5, -0.5, -2.5, -5.0, -8.0, -5.0, -2.5, -0.5,
                0.5, 2.5, 5.0, 8.0
            ]
        );
    }

    #[test]
    fn a_cycle_never_ends_where_it_is_read() {
        let tip =
            |largest: f64| cycle(&[50.0, 150.0], largest, 250.0).into_iter().fold(0.0, f64::max);
        assert_eq!([100.0, 150.0, 170.0, 400.0].map(tip), [250.0, 250.0, 170.0, 400.0]);
    }

    #[test]
    fn the_tensile_values_of_a_law_are_read_off_its_curve() {
        let law = TractionLaw {
            backbone: TractionBackbone::Primed(Primed {
                stiffness: 1.2e4,
                toe_ratio: 0.6,
                toe_strain: 0.02,
                toe_strain_after: 0.025,
            }),
            friction: BlimanSorine::first_order(20.0, 0.002).expect("a friction").into(),
            buckling: Buckling::default(),
        };
        let exact = tensile_values(&law, 490.0);
        let extension = 0.01 * exact[3].value.expect("it carries 490 N/m");
        let steps = 4000;
        let up = (0..=steps).map(|i| extension * f64::from(i) / f64::from(steps));
        let strain: Vec<f64> = up.clone().chain(up.rev().skip(1)).collect();
        let load = drive(&law, law.virgin(), &strain);
        let curve = Curve::new(Test::Tensile, Direction::Warp, strain, load).expect("a curve");
        let points = EvaluationPoints {
            maximum_tension: 490.0,
            bending: BendingPoints::default(),
            shear: ShearPoints::default(),
        };
        // Trapezoids of 4000 steps err by less than 1e-6 of the work.
        for (exact, read) in exact.iter().zip(curve.values(&points)) {
            let (exact, read) = (exact.value.expect("a value"), read.value.expect("a value"));
            assert!((read / exact - 1.0).abs() < 2e-6, "{read} is not {exact}");
        }
    }
}
