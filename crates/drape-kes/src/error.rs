//! Errors between the laboratory's files and curves in SI.

use drape_input::Diagnostics;

/// Reason why a sheet or a curve cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The sheet or a file that it names has mistakes: correct them; all that were found are
    /// listed.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// The two columns of a curve differ in length: give one load for each deformation.
    #[error("a curve has {deformations} deformations but {loads} loads")]
    UnpairedColumns {
        /// Number of deformations.
        deformations: usize,
        /// Number of loads.
        loads: usize,
    },
    /// The curve has fewer than two points: measure more.
    #[error("a curve needs at least two points; this one has {points}")]
    TooFewPoints {
        /// Number of points.
        points: usize,
    },
    /// A value of the curve is not a finite number: correct it.
    #[error("point {index} of a curve is not finite: deformation {deformation}, load {load}")]
    NotFinite {
        /// Index of the point, from 0.
        index: usize,
        /// Its deformation.
        deformation: f64,
        /// Its load.
        load: f64,
    },
    /// All points of the curve have the same deformation: the specimen was not deformed.
    #[error("all points of a curve have the deformation {deformation}: nothing was deformed")]
    ConstantDeformation {
        /// That deformation.
        deformation: f64,
    },
    /// The curve is of another test than the value: choose a curve of the right one.
    #[error("a {found} curve was given where a {wanted} curve is needed")]
    WrongTest {
        /// Test of the curve.
        found: &'static str,
        /// Test that is needed.
        wanted: &'static str,
    },
    /// The curve has no rising and falling branch at an evaluation point: measure further, or move
    /// the point.
    #[error("the curve has no loop at a deformation of {deformation}; it spans {low} to {high}")]
    OutOfRange {
        /// Deformation needed, in SI.
        deformation: f64,
        /// Lowest deformation measured, in SI.
        low: f64,
        /// Highest deformation measured, in SI.
        high: f64,
    },
    /// A tensile value needs a strip that was straight at zero strain: measure one under
    /// pretension.
    #[error("the strip hung slack, so that its strain has no zero of its own")]
    SlackStrip,
    /// The largest load of the curve is not that of the tensile values: say what the test's was
    /// (FM).
    #[error("the curve ends at {reached:.1} N/m, and the value is that of {wanted:.1} N/m")]
    OtherMaximumTension {
        /// Largest load of the first loading branch, in N/m.
        reached: f64,
        /// FM, in N/m.
        wanted: f64,
    },
    /// The tensile curve ends at its largest load: measure the recovery too.
    #[error("the curve has no way back")]
    NoRecovery,
}
