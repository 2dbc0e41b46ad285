//! Measurement: the curve that a simulated instrument draws of a specimen.
//!
//! Every step of the simulation is a point of the curve. With force `$F$` and moment `$M$` of the
//! moving
//! clamp, the width `$b$` and the angle `$\varphi$`, the loads per width are `$-F_x/b$` in the
//! tensile test, `$(1+\varepsilon)(F_x\tan\varphi - F_z)/b$` in the shear test at the strain
//! `$\varepsilon$` of its tension, and `$-M/b$` in the bending test.

use drape_fabric::Fabric;
use drape_kes::{Curve, Direction, Test};

use super::bias::on_the_bias;
use super::cycle::{SHEAR_TENSION, cycle};
use super::ideal::curve;
use super::placement::{ClampPlacement, Rows, bending_placement};
use super::specimen::{GAUGE, Specimen, WIDTH};
use super::yarn::{extension, laws};
use crate::error::ValidationError;

/// Steps in which the tension of the shear test is put on.
const LOADING_STEPS: usize = 10;

/// Resolution of a simulated instrument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resolution {
    /// Distance of the particles along the yarns, in m.
    pub spacing: f64,
    /// Points of a branch of the curve.
    pub points: usize,
}

/// Returns the curve that a simulated instrument draws of a specimen of `fabric` along `direction`.
///
/// [`cycle`] returns the deformations, with the points of `resolution` in a branch. The
/// specimen has the spacing nearest to `resolution` that divides its free length.
///
/// # Errors
/// The specimen cannot be simulated, or a load is not a number.
pub fn measure(
    fabric: &Fabric,
    test: Test,
    direction: Direction,
    resolution: Resolution,
) -> Result<Curve, ValidationError> {
    let Resolution { spacing, points } = resolution;
    let path = cycle(fabric, test, direction, points);
    let load = match test {
        Test::Tensile => stretch(fabric, direction, spacing, &path)?,
        Test::Shear => shear(fabric, direction, spacing, &path)?,
        Test::Bending | Test::LoopBending => {
            bend(fabric, direction, &Specimen::in_clamps(spacing), &path)?
        }
    };
    Ok(curve(test, direction, path, load)?)
}

/// Returns the tensions per width at the strains of `path`, in N/m.
fn stretch(fabric: &Fabric, direction: Direction, spacing: f64, path: &[f64]) -> Loads {
    let specimen = Specimen::between_lines(spacing);
    let placements: Vec<ClampPlacement> = path[1..]
        .iter()
        .map(|strain| ClampPlacement { shift: [strain * GAUGE, 0.0, 0.0], turn: 0.0 })
        .collect();
    let loads = specimen.drive(fabric, direction, &placements)?;
    Ok(from_rest(loads.iter().map(|load| -load.force[0] / WIDTH)))
}

/// Returns the shear forces per width at the angles of `path`, without the part of the tension, in
/// N/m.
///
/// The clamp moves so that the yarns keep their length under the tension. The shear law is stated
/// per area of relaxed cloth, so the force counts by the stretched length over the relaxed length.
fn shear(fabric: &Fabric, direction: Direction, spacing: f64, path: &[f64]) -> Loads {
    let specimen = Specimen::between_lines(spacing);
    let strain = extension(&laws(fabric, direction).traction, SHEAR_TENSION);

    // First the tension is applied, then the clamp moves sideways.
    let loading = (1..=LOADING_STEPS)
        .map(|k| sheared_placement(strain * k as f64 / LOADING_STEPS as f64, 0.0));
    let placements: Vec<ClampPlacement> =
        loading.chain(path[1..].iter().map(|&angle| sheared_placement(strain, angle))).collect();
    let loads = specimen.drive(fabric, direction, &placements)?;

    let share = (1.0 + strain) / WIDTH;
    let across = loads[LOADING_STEPS..].iter().zip(&path[1..]);
    Ok(from_rest(across.map(|(load, angle)| share * (load.force[0] * angle.tan() - load.force[2]))))
}

/// Returns the placement of the clamp at which the yarns between the clamps have `strain` and are
/// sheared by `angle`, in rad.
fn sheared_placement(strain: f64, angle: f64) -> ClampPlacement {
    let (sin, cos) = angle.sin_cos();
    let length = (1.0 + strain) * GAUGE;
    ClampPlacement { shift: [length * cos - GAUGE, 0.0, length * sin], turn: 0.0 }
}

/// Returns the moments per width of `specimen` at the curvatures of `path`, in N.
fn bend(fabric: &Fabric, direction: Direction, specimen: &Specimen, path: &[f64]) -> Loads {
    let rows = Rows { distance: specimen.row, cells: specimen.cells };
    let placements: Vec<ClampPlacement> =
        path[1..].iter().map(|&curvature| bending_placement(rows, curvature)).collect();
    let loads = specimen.drive(fabric, direction, &placements)?;
    Ok(from_rest(loads.iter().map(|load| -load.moment[2] / WIDTH)))
}

/// Returns the curve of a bending specimen of `fabric` that is cut on the bias, up to the curvature
/// `largest`, in 1/m. The curve has the direction of the warp. The spacing of `resolution` is a
/// result of [`bias_spacing`].
///
/// # Errors
/// The errors of [`measure`].
pub fn bend_on_the_bias(
    fabric: &Fabric,
    largest: f64,
    resolution: Resolution,
) -> Result<Curve, ValidationError> {
    let Resolution { spacing, points } = resolution;
    let path = on_the_bias(fabric, largest, points)?.deformation().to_vec();
    let load = bend(fabric, Direction::Weft, &Specimen::on_the_bias(spacing), &path)?;
    Ok(curve(Test::Bending, Direction::Warp, path, load)?)
}

/// Returns the spacing nearest to `spacing`, in m, for which the rows of particles divide the free
/// length of a specimen on the bias. The result is below 8 mm.
#[must_use]
pub fn bias_spacing(spacing: f64) -> f64 {
    Specimen::on_the_bias(spacing).spacing
}

/// Loads per width at each deformation of a path.
type Loads = Result<Vec<f64>, ValidationError>;

/// Returns zero and then `loads`: a specimen starts without load.
fn from_rest(loads: impl Iterator<Item = f64>) -> Vec<f64> {
    std::iter::once(0.0).chain(loads).collect()
}
