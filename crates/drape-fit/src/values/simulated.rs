//! KES values of a fabric's laws, from simulated KES tests.

use drape_fabric::Fabric;
use drape_kes::{Direction, EvaluationPoints, Test, Values};

use crate::values::of_law::{bending_values, shear_values, tensile_values};

/// Returns the KES values of one `direction` of `fabric`, read at `points`, in the laboratory's
/// units.
///
/// Each test is simulated with the fabric's laws from rest. Bending and shear go to one side, to
/// the other, and to the first again. The loads are read as
/// [`Curve::values`](drape_kes::Curve::values) reads measured curves. The tensile values are
/// missing for a fabric that never carries the load of the tensile test.
///
/// ```
/// use drape_fit::{FitSettings, fabric_values, identify};
/// use drape_kes::{Direction, Sheet, Values};
///
/// let mut sheet = Sheet::default();
/// sheet.name = "by values".into();
/// sheet.warp = Values { b: Some(0.09), two_hb: Some(0.06), ..Values::default() };
/// let fabric = identify(&sheet)?.fabric;
///
/// let points = FitSettings::default().evaluation_points(&sheet);
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
    let mut values = Values::default();
    let tensile = tensile_values(&laws.traction, points.maximum_tension);
    let bending = bending_values(&laws.bending, &points.bending, Test::LARGEST_CURVATURE);
    let shear = shear_values(&fabric.shear, &points.shear, Test::LARGEST_ANGLE);
    for read in tensile.into_iter().chain(bending).chain(shear) {
        *values.get_mut(read.symbol) = read.value;
    }
    values
}
