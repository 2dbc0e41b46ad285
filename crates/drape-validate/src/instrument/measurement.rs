//! Measurement: the curve that a simulated instrument draws of a specimen.
//!
//! Every step of the simulation is a point. With the force `$F$` and the moment `$M$` of the moving
//! clamp, the width `$b$` and the angle `$\varphi$`, the loads per width are `$-F_x/b$` in the
//! tensile test, `$(1+\varepsilon)(F_x\tan\varphi - F_z)/b$` in the shear test at the strain
//! `$\varepsilon$` of its tension, and `$-M/b$` in the bending test.

use drape_fabric::Fabric;
use drape_kes::{Curve, Direction, Test};

use super::bias::on_the_bias;
use super::cycle::{SHEAR_TENSION, cycle};
use super::ideal::curve;
use super::placement::{Place, Rows, bent};
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

/// Returns the curve that a simulated instrument draws of a specimen.
///
/// The path is [`cycle`]'s with so many points in a branch; the spacing is the nearest that divides
/// the free length.
///
/// # Errors
/// A specimen that cannot be simulated, or a load that is no number.
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

/// Returns the tensions per width at strains, in N/m.
fn stretch(fabric: &Fabric, direction: Direction, spacing: f64, path: &[f64]) -> Loads {
    let specimen = Specimen::between_lines(spacing);
    let place = |strain: &f64| Place { shift: [strain * GAUGE, 0.0, 0.0], turn: 0.0 };
    let places: Vec<Place> = path[1..].iter().map(place).collect();
    let loads = specimen.drive(fabric, direction, &places)?;
    Ok(from_rest(loads.iter().map(|load| -load.force[0] / WIDTH)))
}

/// Returns the shear forces per width at angles, less the part of the tension, in N/m.
///
/// The clamp moves so that the yarns keep the length that the tension has given them. The law is
/// one per area of relaxed cloth, so the force counts by that length over the relaxed one.
fn shear(fabric: &Fabric, direction: Direction, spacing: f64, path: &[f64]) -> Loads {
    let specimen = Specimen::between_lines(spacing);
    let strain = extension(&laws(fabric, direction).traction, SHEAR_TENSION);
    let pulled = |strain: f64, angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let length = (1.0 + strain) * GAUGE;
        Place { shift: [length * cos - GAUGE, 0.0, length * sin], turn: 0.0 }
    };
    let loading =
        (1..=LOADING_STEPS).map(|k| pulled(strain * k as f64 / LOADING_STEPS as f64, 0.0));
    let places: Vec<Place> =
        loading.chain(path[1..].iter().map(|&angle| pulled(strain, angle))).collect();
    let loads = specimen.drive(fabric, direction, &places)?;
    let share = (1.0 + strain) / WIDTH;
    let across = loads[LOADING_STEPS..].iter().zip(&path[1..]);
    Ok(from_rest(across.map(|(load, angle)| share * (load.force[0] * angle.tan() - load.force[2]))))
}

/// Returns the moments per width at curvatures, in N.
fn bend(fabric: &Fabric, direction: Direction, specimen: &Specimen, path: &[f64]) -> Loads {
    let rows = Rows { distance: specimen.row, cells: specimen.cells };
    let places: Vec<Place> = path[1..].iter().map(|&curvature| bent(rows, curvature)).collect();
    let loads = specimen.drive(fabric, direction, &places)?;
    Ok(from_rest(loads.iter().map(|load| -load.moment[2] / WIDTH)))
}

/// The curve of a bending specimen cut on the bias, up to a curvature in 1/m; it stands as one of
/// the warp. The spacing is one of [`bias_spacing`].
///
/// # Errors
/// Those of [`measure`].
pub fn bend_on_the_bias(
    fabric: &Fabric,
    largest: f64,
    resolution: Resolution,
) -> Result<Curve, ValidationError> {
    let Resolution { spacing, points } = resolution;
    let path = on_the_bias(fabric, largest, points).deformation().to_vec();
    let load = bend(fabric, Direction::Weft, &Specimen::on_the_bias(spacing), &path)?;
    Ok(curve(Test::Bending, Direction::Warp, path, load)?)
}

/// The spacing nearest to one in m, and below 8 mm, whose rows across a specimen on the bias divide
/// its free length.
#[must_use]
pub fn bias_spacing(spacing: f64) -> f64 {
    Specimen::on_the_bias(spacing).spacing
}

type Loads = Result<Vec<f64>, ValidationError>;

/// Returns a history of loads that begins without load.
fn from_rest(loads: impl Iterator<Item = f64>) -> Vec<f64> {
    std::iter::once(0.0).chain(loads).collect()
}
