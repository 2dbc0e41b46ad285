//! Reasons why a fabric could not be identified.

use drape_kes::Test;

/// Reason why a curve or a sheet gives no law.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Curve of another test: choose a curve of the needed test.
    #[error("{name}: a {} curve was given where a {} curve is needed", given.name(), needed.name())]
    WrongTest {
        /// Name of the curve.
        name: String,
        /// Test of the curve.
        given: Test,
        /// Test that is needed.
        needed: Test,
    },
    /// Load that never changes: check the column and the clamps.
    #[error(
        "{name}: the load is {load} throughout; check the column, and that the strip was clamped"
    )]
    ConstantLoad {
        /// Name of the curve.
        name: String,
        /// Load, in SI.
        load: f64,
    },
    /// Load that does not rise from its start: check the signs of the columns.
    #[error("{name}: the load does not rise with the deformation; check the signs of the columns")]
    FallingLoad {
        /// Name of the curve.
        name: String,
    },
    /// Curve with fewer points than any law needs: measure more points.
    #[error("{name}: a law needs {needed} points, and there are {points}; measure more points")]
    TooFewPoints {
        /// Name of the curve.
        name: String,
        /// Number of points of the curve.
        points: usize,
        /// Number of points that the law with the fewest parameters needs.
        needed: usize,
    },
    /// Curve without a later cycle that goes further than the cycles before it: measure such a
    /// cycle.
    #[error(
        "{name}: the last cycle is not a second one that goes further; there is nothing to predict"
    )]
    SingleCycle {
        /// Name of the curve.
        name: String,
    },
    /// Loop-bending strip of unknown length: give the gauge.
    #[error("{name}: the length of the strip is not known; give the gauge of the deformation")]
    MissingGauge {
        /// Name of the curve.
        name: String,
    },
    /// Loop-bending strip that is hardly bent: bring the clamps closer.
    #[error("{name}: the clamps came closer by less than {needed:.0} % of the strip's length")]
    FlatArch {
        /// Name of the curve.
        name: String,
        /// Shortening needed, in percent.
        needed: f64,
    },
    /// Tensile values that no law has: check LT, RT, WT and EM.
    #[error(
        "{name}: no law here has a linearity LT of {linearity:.3} with a resilience RT of {:.1} %; check LT, RT, WT and EM",
        100.0 * resilience
    )]
    IncompatibleValues {
        /// Direction.
        name: String,
        /// LT of the values, a ratio.
        linearity: f64,
        /// RT of the values, a ratio.
        resilience: f64,
    },
    /// Resilience that is not between 0 and 100 %, the fraction of the work that is recovered.
    #[error(
        "{name}: RT is {percent:.1} %; a fabric gives back more than nothing and less than was spent"
    )]
    InvalidResilience {
        /// Direction.
        name: String,
        /// RT, in percent.
        percent: f64,
    },
    /// Linearity that is not between 0 and 2. The work under a rising curve is less than twice the
    /// work of a straight line.
    #[error(
        "{name}: LT is {linearity:.3}, {origin}; a rising curve has more than 0 and less than 2; check LT, WT and EM"
    )]
    InvalidLinearity {
        /// Direction.
        name: String,
        /// LT, a ratio.
        linearity: f64,
        /// Source of LT, in words.
        origin: &'static str,
    },
    /// Impossible number in the identified fabric: check the units of the sheet.
    #[error("the fabric identified has {key} that {message}; check the sheet ({help})")]
    InvalidFabric {
        /// Key path of the number in the fabric.
        key: String,
        /// Problem with it, in words.
        message: String,
        /// Admissible values, in words.
        help: String,
    },
}
