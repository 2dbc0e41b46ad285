//! Why a fabric could not be identified.

use drape_kes::Test;

/// Why a curve or a sheet does not give a law.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A curve of another test was given: choose a curve of the right one.
    #[error("{name}: a {} curve was given where a {} curve is needed", found.name(), wanted.name())]
    WrongTest {
        /// The curve's name.
        name: String,
        /// Its test.
        found: Test,
        /// The test that is needed.
        wanted: Test,
    },
    /// The load of a curve never changes: check the column and the clamps.
    #[error(
        "{name}: the load is {load} throughout; check the column, and that the strip was clamped"
    )]
    NoLoad {
        /// The curve's name.
        name: String,
        /// That load, in SI.
        load: f64,
    },
    /// A curve never rises from its start: check the sign of its columns.
    #[error("{name}: the load does not rise with the deformation; check the signs of the columns")]
    Falling {
        /// The curve's name.
        name: String,
    },
    /// A curve has no last cycle that goes further than those before: pull again, further.
    #[error(
        "{name}: the last cycle is not a second one that goes further; there is nothing to predict"
    )]
    OneCycle {
        /// The curve's name.
        name: String,
    },
    /// A loop-bending curve does not say how long its strip is: give the gauge.
    #[error("{name}: the length of the strip is not known; give the gauge of the deformation")]
    NoGauge {
        /// The curve's name.
        name: String,
    },
    /// A loop-bending strip is hardly bent: bring the clamps closer.
    #[error("{name}: the clamps came closer by less than {needed:.0} % of the strip's length")]
    HardlyBent {
        /// The curve's name.
        name: String,
        /// The shortening needed, in percent.
        needed: f64,
    },
    /// No law has these tensile values: check LT, RT, WT and EM.
    #[error(
        "{name}: no law here has a linearity LT of {linearity:.3} with a resilience RT of {:.1} %; check LT, RT, WT and EM",
        100.0 * resilience
    )]
    Unreachable {
        /// The direction.
        name: String,
        /// LT asked for, a ratio.
        linearity: f64,
        /// RT asked for, a ratio.
        resilience: f64,
    },
    /// The resilience is none: it is a part of the work spent.
    #[error(
        "{name}: RT is {percent:.1} %; a fabric gives back more than nothing and less than was spent"
    )]
    Resilience {
        /// The direction.
        name: String,
        /// RT, in percent.
        percent: f64,
    },
    /// The linearity is none: the work under a rising curve is less than twice that of a straight line.
    #[error(
        "{name}: LT is {linearity:.3}, {origin}; a rising curve has more than 0 and less than 2; check LT, WT and EM"
    )]
    Linearity {
        /// The direction.
        name: String,
        /// LT, a ratio.
        linearity: f64,
        /// Where it comes from, in words.
        origin: &'static str,
    },
    /// The numbers found are not those of a fabric: check the sheet's units.
    #[error("the fabric identified has {key} that {message}; check the sheet ({help})")]
    Impossible {
        /// Key path of the value in the fabric.
        key: String,
        /// What is wrong with it.
        message: String,
        /// What it should be.
        help: String,
    },
}
