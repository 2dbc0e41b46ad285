//! Check of a system: forces against the potential, and stiffness against the forces.
//!
//! The check is for a caller's tests. The solver does not use it.

use crate::error::Error;
use crate::linear::block_matrix::BlockMatrix;
use crate::linear::cholesky::{Cholesky, Kernel};
use crate::linear::vector::{dot, norm};
use crate::system::{Stiffness, System};

/// Number of random directions along which derivatives are compared.
const DIRECTIONS: usize = 8;

/// Increments of the differences, as fractions of the system's extent. Each is a tenth of the one
/// before. The error of large increments is the curvature of the forces, the error of small ones
/// the rounding of the potential. The best increment depends on the system.
const INCREMENTS: [f64; 7] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// Errors of a system's forces and stiffness at one configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SystemCheck {
    /// Largest difference between the power of the forces along a direction and the decrease of the
    /// potential, relative to the sum of the magnitudes of the terms of this power.
    pub force_error: f64,
    /// Largest difference between the exact stiffness times a direction and the decrease of the
    /// forces along the direction, relative to this decrease.
    pub stiffness_error: f64,
    /// Smallest multiple of the identity that makes the definite stiffness positive definite: a
    /// power of ten, relative to the largest diagonal entry. Rounding alone requires about 1e-14.
    /// Infinite if the stiffness is not finite or 1 does not suffice.
    pub definite_shift: f64,
}

/// Compares the forces of `system` with its potential, and its stiffness with its forces, by
/// fourth-order central differences along random directions.
///
/// The system begins a step of length `dt`, in s, from the positions `start`. The comparison is at
/// the positions `trial`, which should not lie on a kink of the forces. Both lists are in m. The
/// errors of a correct system are about 1e-9. A wrong derivative gives 1e-3 or more. The step is
/// never accepted.
///
/// ```
/// # use drape_implicit::{BlockMatrix, Sparsity, Stiffness, System, check_system};
/// // A particle in a trap of 3 N/m.
/// struct Trap;
///
/// impl System for Trap {
///     fn forces(&mut self, x: &[f64], forces: &mut [f64]) {
///         (0..3).for_each(|k| forces[k] = -3.0 * x[k]);
///     }
///     fn potential(&mut self, x: &[f64]) -> f64 {
///         1.5 * x.iter().map(|x| x * x).sum::<f64>()
///     }
///     fn stiffness(&mut self, _x: &[f64], _kind: Stiffness, matrix: &mut BlockMatrix) {
///         matrix.add(0, 0, &[3.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 3.0]);
///     }
/// #     fn particle_count(&self) -> usize { 1 }
/// #     fn masses(&self) -> &[f64] { &[1.0] }
/// #     fn held(&self) -> &[bool] { &[false] }
/// #     fn begin(&mut self, _: f64, _: f64, _: &[f64], _: &mut [f64]) {}
/// #     fn sparsity(&self) -> Sparsity { Sparsity::from_pairs(1, []).unwrap() }
/// #     fn accept(&mut self, _: &[f64], _: &[f64], _: f64) {}
///     // … and the rest of the trait.
/// }
///
/// let check = check_system(&mut Trap, &[0.0; 3], &[0.1, -0.2, 0.3], 1e-3)?;
/// assert!(check.force_error < 1e-9 && check.stiffness_error < 1e-9, "{check:?}");
/// # Ok::<(), drape_implicit::Error>(())
/// ```
///
/// # Errors
/// [`Error::Dimension`], [`Error::OutsideSparsity`], [`Error::TooLarge`], or, without the feature
/// `cholesky`, [`Error::WithoutCholesky`].
pub fn check_system(
    system: &mut dyn System,
    start: &[f64],
    trial: &[f64],
    dt: f64,
) -> Result<SystemCheck, Error> {
    let length = 3 * system.particle_count();

    for (name, found) in [("start", start.len()), ("trial", trial.len())] {
        if found != length {
            return Err(Error::Dimension { name, expected: length, found });
        }
    }

    let mut target = start.to_vec();
    system.begin(dt, dt, start, &mut target);
    let exact = assemble(system, trial, Stiffness::Exact)?;
    let mut forces = vec![0.0; length];
    system.forces(trial, &mut forces);
    let extent = extent(trial);

    let mut check = SystemCheck { force_error: 0.0, stiffness_error: 0.0, definite_shift: 0.0 };
    let mut product = vec![0.0; length];
    for seed in 0..DIRECTIONS as u64 {
        let direction = direction(length, seed);
        exact.write_product(&direction, &mut product);
        let power = dot(&forces, &direction);
        let magnitude: f64 = forces.iter().zip(&direction).map(|(f, d)| (f * d).abs()).sum();

        // The increment with the smallest error counts, separately for forces and stiffness.
        let (mut force_error, mut stiffness_error) = (f64::INFINITY, f64::INFINITY);
        for increment in INCREMENTS.map(|fraction| fraction * extent) {
            let mut line = Line { system: &mut *system, trial, direction: &direction, increment };
            force_error = force_error.min(relative((power - line.power()).abs(), magnitude));
            let change = line.resistance();
            let scale = norm(&change);
            let difference: Vec<f64> = change.iter().zip(&product).map(|(a, b)| a - b).collect();
            stiffness_error = stiffness_error.min(relative(norm(&difference), scale));
        }

        check.force_error = check.force_error.max(force_error);
        check.stiffness_error = check.stiffness_error.max(stiffness_error);
    }
    check.definite_shift = definite_shift(assemble(system, trial, Stiffness::Definite)?)?;
    Ok(check)
}

/// Line through the positions `trial` along `direction`, with points `increment` apart.
struct Line<'a> {
    system: &'a mut dyn System,
    trial: &'a [f64],
    direction: &'a [f64],
    increment: f64,
}

impl Line<'_> {
    /// Offsets, in increments, and weights of the fourth-order central difference.
    const WEIGHTS: [(f64, f64); 4] =
        [(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)];

    /// Returns the positions at `offset`, in increments.
    fn positions(&self, offset: f64) -> Vec<f64> {
        let step = offset * self.increment;
        self.trial.iter().zip(self.direction).map(|(x, d)| x + step * d).collect()
    }

    /// Returns the decrease of the potential per unit length along the line, in N.
    fn power(&mut self) -> f64 {
        let mut sum = 0.0;
        for (offset, weight) in Self::WEIGHTS {
            let positions = self.positions(offset);
            sum -= weight * self.system.potential(&positions);
        }
        sum / self.increment
    }

    /// Returns the decrease of the forces per unit length along the line, in N/m.
    fn resistance(&mut self) -> Vec<f64> {
        let mut sum = vec![0.0; self.trial.len()];
        let mut forces = sum.clone();
        for (offset, weight) in Self::WEIGHTS {
            let positions = self.positions(offset);
            self.system.forces(&positions, &mut forces);
            for (sum, force) in sum.iter_mut().zip(&forces) {
                *sum -= weight * force / self.increment;
            }
        }
        sum
    }
}

/// Returns the stiffness of `system` at `positions`.
fn assemble(
    system: &mut dyn System,
    positions: &[f64],
    kind: Stiffness,
) -> Result<BlockMatrix, Error> {
    let mut matrix = BlockMatrix::zeros(system.sparsity());
    let (expected, found) = (system.particle_count(), matrix.sparsity().particle_count());
    if expected != found {
        return Err(Error::Dimension { name: "sparsity", expected, found });
    }
    system.stiffness(positions, kind, &mut matrix);
    match matrix.outside_sparsity() {
        Some([row, column]) => Err(Error::OutsideSparsity { row, column }),
        None => Ok(matrix),
    }
}

/// Returns the smallest shift of the diagonal with which `matrix` has a Cholesky factor; see
/// [`SystemCheck::definite_shift`].
fn definite_shift(matrix: BlockMatrix) -> Result<f64, Error> {
    if matrix.sparsity().particle_count() == 0 {
        return Ok(0.0);
    }

    let largest = (0..matrix.sparsity().particle_count())
        .map(|row| matrix.blocks()[matrix.sparsity().row(row).start])
        .flat_map(|diagonal| [0, 4, 8].map(|k| diagonal[k]))
        .fold(0.0, f64::max);
    if largest == 0.0 && matrix.values().iter().all(|&x| x == 0.0) {
        return Ok(0.0);
    }
    if matrix.values().iter().any(|x| !x.is_finite()) {
        return Ok(f64::INFINITY);
    }

    // Inertia on the diagonal of a matrix without held particles shifts the whole diagonal.
    let held = vec![false; matrix.sparsity().particle_count()];
    let mut cholesky = Cholesky::new(matrix.sparsity(), Kernel::Vector)?;
    for power in -16..=0 {
        let shift = 10_f64.powi(power);
        let mut shifted = matrix.clone();
        shifted.add_inertia(&vec![shift * largest; held.len()], &held);
        if cholesky.factorise(&shifted).is_ok() {
            return Ok(shift);
        }
    }
    Ok(f64::INFINITY)
}

/// Returns the largest extent of `positions` along an axis, in m.
fn extent(positions: &[f64]) -> f64 {
    let mut extent: f64 = 0.0;
    for axis in 0..3 {
        let along = positions.iter().skip(axis).step_by(3);
        let low = along.clone().copied().fold(f64::INFINITY, f64::min);
        let high = along.copied().fold(f64::NEG_INFINITY, f64::max);
        extent = extent.max(high - low);
    }
    // A single particle has no extent. Its increments are fractions of 1 m.
    if extent > 0.0 { extent } else { 1.0 }
}

/// Returns `difference / scale`, and 0 for a `difference` of 0 even where `scale` is 0.
fn relative(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / scale }
}

/// Returns `length` pseudo-random entries between −1 and 1, equal on every machine (the generator
/// SplitMix64 \[SLF14\]).
fn direction(length: usize, seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0xD134_2543_DE82_EF95);
    let mut entries = Vec::with_capacity(length);
    for _ in 0..length {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        entries.push((z >> 11) as f64 * 2.0_f64.powi(-52) - 1.0);
    }
    entries
}
