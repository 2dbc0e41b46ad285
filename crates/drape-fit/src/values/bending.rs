//! Bending law from B and 2HB.

use drape_fabric::{BendingBackbone, BendingLaw, Dahl};
use drape_kes::BendingValues;

use crate::values::assumed::BENDING_FRICTION_LENGTH;

/// Returns the bending law that has the given `values`, B and 2HB.
///
/// The friction length, which 2HB does not determine, is taken from the one published measurement
/// \[THK03, fig. 8b\]. The friction has reached its plateau well before the curvatures at which B
/// and 2HB are read (to `$e^{-37}$`), so B is the rigidity and 2HB twice the plateau.
///
/// ```
/// use drape_fit::bending_from_values;
/// use drape_kes::BendingValues;
///
/// let law = bending_from_values(&BendingValues { rigidity: 1.2e-5, loop_width: 1.2e-3 });
/// assert_eq!(law.friction.plateau(), 6e-4);
/// ```
#[must_use]
pub fn bending_from_values(values: &BendingValues) -> BendingLaw {
    BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: values.rigidity },
        rest_curvature: 0.0,
        friction: Dahl { plateau: 0.5 * values.loop_width, length: BENDING_FRICTION_LENGTH }.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::{Law, drive};
    use drape_kes::{BendingPoints, Curve, Direction, Test};

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
    fn the_bending_law_gives_its_values_back() {
        let law = bending_from_values(&BendingValues { rigidity: 1.157e-5, loop_width: 1.216e-3 });
        let curve = cycle(Test::Bending, &law, &[0.0, 250.0, -250.0, 250.0]);
        let values = curve.bending_values(&BendingPoints::default()).unwrap();
        same(values.rigidity, 1.157e-5, 1e-9);
        same(values.loop_width, 1.216e-3, 1e-9);
    }
}
