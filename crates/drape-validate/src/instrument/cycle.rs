//! Cycle: the deformations through which each KES test goes, point by point \[Kaw80\].
//!
//! Tensile: to 500 gf/cm and back. Bending: between ±2.5 1/cm. Shear: between ±8°. The laws alone
//! and the simulated instruments follow the same cycle.

use drape_fabric::Fabric;
use drape_kes::{Direction, Test};

use super::yarn::{extension, laws};

/// Load of the standard tensile test: 500 gf/cm in N/m.
pub const LARGEST_TENSION: f64 = 490.3325;

/// Tension of a specimen in the shear test: 10 gf/cm in N/m.
pub const SHEAR_TENSION: f64 = 9.80665;

/// Largest angle of the shear test, in degrees.
const LARGEST_ANGLE: f64 = 8.0;

/// Largest curvature of the bending test, 2.5 1/cm in 1/m.
pub(crate) const LARGEST_CURVATURE: f64 = 250.0;

/// Returns the deformations of `test`, with `points` points in a branch, in the units of a
/// [`drape_kes::Curve`]. The strains of a tensile test follow from the laws of `fabric` along
/// `direction`.
#[must_use]
pub fn cycle(fabric: &Fabric, test: Test, direction: Direction, points: usize) -> Vec<f64> {
    let turns: &[f64] = match test {
        Test::Tensile => &[0.0, extension(&laws(fabric, direction).traction, LARGEST_TENSION), 0.0],
        Test::Bending | Test::LoopBending => &there_and_back(LARGEST_CURVATURE),
        Test::Shear => &there_and_back(LARGEST_ANGLE.to_radians()),
    };
    path(turns, points)
}

/// Returns the turning points of a test that deforms a specimen by `largest` to both sides.
pub(super) fn there_and_back(largest: f64) -> [f64; 4] {
    [0.0, largest, -largest, largest]
}

/// Returns the path through the turning points `turns`, with `points` even steps from each turning
/// point to the next.
pub(super) fn path(turns: &[f64], points: usize) -> Vec<f64> {
    let branches = turns.windows(2).flat_map(|ends| {
        let [from, to] = [ends[0], ends[1]];
        (1..=points).map(move |i| from + (to - from) * i as f64 / points as f64)
    });
    std::iter::once(turns[0]).chain(branches).collect()
}
