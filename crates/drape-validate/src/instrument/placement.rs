//! Placement of the moving clamp, and the moment that it bears.
//!
//! A specimen bent evenly turns by `$\kappa h$` from row to row, with the curvature `$\kappa$` and
//! the distance `$h$` of rows; the clamp is placed where these turns lead it. Instruments and cases
//! of creases use it.

use drape_dynamics::PinLoad;
use drape_scene::Scene;

/// Placement of the moving clamp: shift of its pivot, in m, and turn about z, in rad.
#[derive(Clone, Copy, Default)]
pub(crate) struct Place {
    pub(crate) shift: [f64; 3],
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

/// A clamp that bends a specimen to a curvature, in 1/m: where equal turns of so many rows at a
/// distance, in m, lead it if they keep that. The clamp that stays has its line at 0, and both
/// lines are midway between two rows.
pub(crate) fn bent(Rows { distance: row, cells }: Rows, curvature: f64) -> Place {
    let turn = curvature * row;
    let mut shift = [(1.0 - cells as f64) * row, 0.0, 0.0];
    for cell in 1..cells {
        let (sin, cos) = (cell as f64 * turn).sin_cos();
        shift = [shift[0] + row * cos, shift[1] + row * sin, 0.0];
    }
    Place { shift, turn: cells as f64 * turn }
}

/// Returns the distance from a pivot to the middle of the second pin's particles along x, in m.
pub(crate) fn arm(scene: &Scene, pivot: f64) -> f64 {
    let held = scene.pins[1].particles.iter().map(|particle| scene.start.positions[3 * particle]);
    held.clone().sum::<f64>() / held.count() as f64 - pivot
}

/// Moment of a pin's load about z through a pivot, in N·m; the middle of what it holds is an arm
/// away, at a turn in rad.
pub(crate) fn moment(load: &PinLoad, arm: f64, turn: f64) -> f64 {
    let (sin, cos) = turn.sin_cos();
    load.moment[2] + arm * (cos * load.force[1] - sin * load.force[0])
}
