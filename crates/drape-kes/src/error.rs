//! Everything that can go wrong between the laboratory's files and curves in SI.

use drape_input::Diagnostics;

/// Why a sheet or a curve could not be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The sheet or a file that it names has mistakes: correct them; all that were found are listed.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// Two columns of a curve differ in length: give one load for each deformation.
    #[error("a curve has {deformations} deformations but {loads} loads")]
    Unpaired {
        /// How many deformations there are.
        deformations: usize,
        /// How many loads there are.
        loads: usize,
    },
    /// A curve has too few points to be one: measure at least two.
    #[error("a curve needs at least two points; this one has {points}")]
    TooShort {
        /// How many points there are.
        points: usize,
    },
    /// A curve holds a value that is not a finite number: correct the value.
    #[error("point {index} of a curve is not finite: deformation {deformation}, load {load}")]
    NotFinite {
        /// The point, from 0.
        index: usize,
        /// Its deformation.
        deformation: f64,
        /// Its load.
        load: f64,
    },
    /// All points of a curve have the same deformation: the test did not move.
    #[error("all points of a curve have the deformation {deformation}: nothing was deformed")]
    NoMotion {
        /// That deformation.
        deformation: f64,
    },
    /// A value was asked of a curve of another test: choose a curve of the right test.
    #[error("a {found} curve was given where a {wanted} curve is needed")]
    WrongTest {
        /// The test of the curve.
        found: &'static str,
        /// The test that was needed.
        wanted: &'static str,
    },
    /// A value needs a deformation that the curve does not reach in both senses: measure further, or move
    /// the evaluation points.
    #[error("the curve has no loop at a deformation of {deformation}; it spans {low} to {high}")]
    OutOfRange {
        /// The deformation needed, in SI.
        deformation: f64,
        /// The lowest deformation measured, in SI.
        low: f64,
        /// The highest deformation measured, in SI.
        high: f64,
    },
    /// A tensile value needs a strip that was straight at zero strain: measure one under pretension.
    #[error("the strip hung slack, so that its strain has no zero of its own")]
    Slack,
    /// A tensile value is that of another load than the curve's largest: say what the test's was (FM).
    #[error("the curve ends at {reached:.1} N/m, and the value is that of {wanted:.1} N/m")]
    OtherLoad {
        /// The largest load of the first pull, in N/m.
        reached: f64,
        /// FM, in N/m.
        wanted: f64,
    },
    /// A tensile curve ends at its largest load: measure the way back too.
    #[error("the curve has no way back")]
    NoRecovery,
}
