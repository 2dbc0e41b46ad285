//! Load of the tensile test: EM, LT, WT and RT of two loads are different quantities.
//!
//! The standard test ends at 500 gf/cm, the "high sensitivity" test at 50 gf/cm \[Kaw80\]; other
//! machines end anywhere.

use drape_input::Quantity;

use crate::curves::evaluation::NEAR_MAXIMUM;
use crate::sheets::findings::Findings;
use crate::sheets::sheet::Sheet;
use crate::test::{Direction, Test};

impl Sheet {
    /// Returns the largest load of the tensile curves, in N/m. Returns `None` without a curve that
    /// begins taut.
    pub(crate) fn load_of_curves(&self) -> Option<f64> {
        let tensile =
            self.curves.iter().filter(|curve| curve.test == Test::Tensile && !curve.slack);
        let loads = tensile.filter_map(|curve| Some(curve.tensile_values().ok()?.maximum_tension));
        loads.max_by(f64::total_cmp)
    }

    /// Returns whether the sheet has a value of the tensile test in `warp` or `weft`.
    pub(crate) fn has_tensile_values(&self) -> bool {
        [&self.warp, &self.weft]
            .into_iter()
            .any(|values| [values.lt, values.wt, values.rt, values.em].iter().any(Option::is_some))
    }

    /// Warns about tensile curves that end at another load than the values of their direction.
    pub(crate) fn compare_loads(&self, findings: &mut Findings<'_>) {
        let unit = Quantity::ForcePerWidth.laboratory().factor;
        let wanted = self.maximum_tension();

        for direction in [Direction::Warp, Direction::Weft] {
            let values = self.values(direction);
            let given = [values.lt, values.wt, values.rt, values.em];
            let Some(curve) = self.curves_of(Test::Tensile, direction).find(|curve| !curve.slack)
            else {
                continue;
            };
            let Ok(reached) = curve.tensile_values().map(|values| values.maximum_tension) else {
                continue;
            };
            if given.iter().all(Option::is_none) || (reached / wanted - 1.0).abs() <= NEAR_MAXIMUM {
                continue;
            }

            let name = direction.name();
            let (reached, wanted) = (reached / unit, wanted / unit);
            let origin = if self.fm.is_some() { "FM" } else { "the standard FM" };
            findings.warn(
                name,
                format!(
                    "the tensile curve of the {name} ends at {reached:.1} gf/cm, the values are of \
                     {wanted:.1} gf/cm ({origin}): they are not compared, and the law follows the curve"
                ),
                format!("if the values were measured in the test of the curve, write FM = {reached:.1}"),
            );
        }
    }
}
