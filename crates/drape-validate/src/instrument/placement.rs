//! Placement of the moving clamp, and the moment that it bears.
//!
//! A specimen bent evenly turns by `$\kappa h$` from row to row, with the curvature `$\kappa$` and
//! the distance `$h$` of rows. These turns lead to the placement of the clamp. Instruments and
//! cases of creases use this module.

use drape_dynamics::PinLoad;
use drape_scene::Scene;

/// Placement of the moving clamp: shift of its pivot, in m, and turn about z, in rad.
#[derive(Clone, Copy, Default)]
pub(crate) struct ClampPlacement {
    /// Shift of the pivot, in m.
    pub(crate) shift: [f64; 3],
    /// Turn about z, in rad.
    pub(crate) turn: f64,
}

/// Rows of particles across a specimen between two clamps.
#[derive(Clone, Copy)]
pub(crate) struct Rows {
    /// Distance of neighbouring rows, in m.
    pub(crate) distance: f64,
    /// Whole distances between the lines of the clamps.
    pub(crate) cells: usize,
}

/// Returns the placement of the clamp that bends a specimen with `rows` to `curvature`, in 1/m.
///
/// Neighbouring rows keep their distance and turn by equal angles. The fixed clamp has its line
/// at 0. The lines of both clamps are midway between two rows.
pub(crate) fn bending_placement(rows: Rows, curvature: f64) -> ClampPlacement {
    let Rows { distance: row, cells } = rows;
    let turn = curvature * row;
    let mut shift = [(1.0 - cells as f64) * row, 0.0, 0.0];
    for cell in 1..cells {
        let (sin, cos) = (cell as f64 * turn).sin_cos();
        shift = [shift[0] + row * cos, shift[1] + row * sin, 0.0];
    }
    ClampPlacement { shift, turn: cells as f64 * turn }
}

/// Returns the lever arm of the second pin of `scene`, in m: the distance along x from `pivot` to
/// the middle of the pin's particles.
pub(crate) fn lever_arm(scene: &Scene, pivot: f64) -> f64 {
    let held = scene.pins[1].particles.iter().map(|particle| scene.start.positions[3 * particle]);
    held.clone().sum::<f64>() / held.count() as f64 - pivot
}

/// Returns the moment about z that `load` of a pin has at a pivot, in N·m. The middle of the pin's
/// particles is the distance `arm`, in m, away from the pivot, and turned about it by `turn`, in
/// rad.
pub(crate) fn pivot_moment(load: &PinLoad, arm: f64, turn: f64) -> f64 {
    let (sin, cos) = turn.sin_cos();
    load.moment[2] + arm * (cos * load.force[1] - sin * load.force[0])
}
