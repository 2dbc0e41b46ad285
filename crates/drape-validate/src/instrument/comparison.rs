//! Comparison of the curve of a simulated instrument with the ideal curve.
//!
//! The distance of two curves is the root mean square of the differences of their loads, over the
//! range of the ideal loads.

use drape_fabric::Fabric;
use drape_kes::{BendingPoints, Curve, Direction, EvaluationPoints, ShearPoints, Symbol, Test};

use super::cycle::LARGEST_TENSION;
use super::ideal::ideal;
use super::measurement::{Resolution, measure};
use crate::error::ValidationError;

/// Curve of a simulated instrument, and the ideal curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Curve of the simulated instrument.
    pub measured: Curve,
    /// Curve of the laws alone.
    pub ideal: Curve,
}

impl Comparison {
    /// Simulates `test` along `direction` as [`measure`] does, and drives the laws of `fabric`
    /// through equal deformations.
    ///
    /// # Errors
    /// The errors of [`measure`].
    pub fn run(
        fabric: &Fabric,
        test: Test,
        direction: Direction,
        resolution: Resolution,
    ) -> Result<Self, ValidationError> {
        let measured = measure(fabric, test, direction, resolution)?;
        Ok(Self { measured, ideal: ideal(fabric, test, direction, resolution.points)? })
    }

    /// Returns the root mean square of the differences of the loads, over the range of the ideal
    /// loads.
    #[must_use]
    pub fn distance(&self) -> f64 {
        let pairs = self.measured.load().iter().zip(self.ideal.load());
        let count = self.measured.load().len().min(self.ideal.load().len());
        let squares: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
        (squares / count as f64).sqrt() / self.ideal.load_range().span()
    }

    /// Returns the KES values that both curves have: symbol, measured value and ideal value, in the
    /// laboratory's units.
    #[must_use]
    pub fn values(&self) -> Vec<(Symbol, [f64; 2])> {
        let points = EvaluationPoints {
            maximum_tension: LARGEST_TENSION,
            bending: BendingPoints::default(),
            shear: ShearPoints::default(),
        };
        let [measured, ideal] = [&self.measured, &self.ideal].map(|curve| curve.values(&points));
        let pairs = measured.into_iter().zip(ideal);
        pairs.filter_map(|(a, b)| Some((a.symbol, [a.value.ok()?, b.value.ok()?]))).collect()
    }
}
