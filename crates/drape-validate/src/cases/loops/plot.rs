//! Axes and points of plots of loops, in the units of laboratories.

use drape_kes::{Curve, Test};

use crate::findings::Axis;

/// Returns the axes of deformation and load of `test`, in the units of laboratories.
pub(super) fn axes(test: Test) -> [Axis; 2] {
    match test {
        Test::Tensile => [Axis::new("strain", "%", 0.01), Axis::new("tension", "N/m", 1.0)],
        Test::Bending | Test::LoopBending => {
            [Axis::new("curvature", "1/cm", 100.0), Axis::new("moment per width", "mN", 1e-3)]
        }
        Test::Shear => {
            [Axis::new("angle", "°", 1_f64.to_radians()), Axis::new("shear force", "N/m", 1.0)]
        }
    }
}

/// Returns the points of `curve`: deformation and load, in SI.
pub(super) fn points(curve: &Curve) -> Vec<[f64; 2]> {
    curve.deformation().iter().zip(curve.load()).map(|(&q, &load)| [q, load]).collect()
}
