//! Errors between the laboratory's files and curves in SI.

use drape_input::Diagnostics;

/// Reason why a sheet or a curve cannot be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
/// Mistakes in the sheet or in a table file of the sheet. All mistakes are listed: correct them.
pub enum Error {
    /// Mistakes in the sheet or in a file that it names, all that were found: correct them.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// Columns of different length: give one load for each deformation.
    #[error("a curve has {deformations} deformations but {loads} loads")]
    UnpairedColumns {
        /// Number of deformations.
        deformations: usize,
        /// Number of loads.
        loads: usize,
    },
    /// Curve of fewer than two points: measure more.
    #[error("a curve needs at least two points; this one has {points}")]
    TooFewPoints {
        /// Number of points.
        points: usize,
    },
    /// Value that is not a finite number: correct it.
    #[error("point {index} of a curve is not finite: deformation {deformation}, load {load}")]
    NotFinite {
        /// Index of the point, from 0.
        index: usize,
        /// Deformation at the point.
        deformation: f64,
        /// Load at the point.
        load: f64,
    },
    /// Same deformation at all points: the specimen was not deformed.
    #[error("all points of a curve have the deformation {deformation}: nothing was deformed")]
    ConstantDeformation {
        /// Deformation, in SI.
        deformation: f64,
    },
    /// Repeat whose history differs from the first curve: average only curves of one history.
    #[error("repeat {repeat} has {branches} branches where the first has {expected}")]
    UnlikeRepeats {
        /// Number of the repeat, from 1.
        repeat: usize,
        /// Number of branches of the repeat.
        branches: usize,
        /// Number of branches of the first curve.
        expected: usize,
    },
    /// Curve of another test than the value: choose a curve of the needed test.
    #[error("a {given} curve was given where a {needed} curve is needed")]
    WrongTest {
        /// Test of the curve.
        given: &'static str,
        /// Test that the value needs.
        needed: &'static str,
    },
    /// Evaluation point without a rising and a falling branch: measure further, or move the point.
    #[error("the curve has no loop at a deformation of {deformation}; it spans {low} to {high}")]
    OutOfRange {
        /// Deformation needed, in SI.
        deformation: f64,
        /// Lowest deformation measured, in SI.
        low: f64,
        /// Highest deformation measured, in SI.
        high: f64,
    },
    /// Slack strip, whose tensile values have no zero of strain: measure a strip under pretension.
    #[error("the strip hung slack, so that its strain has no zero of its own")]
    SlackStrip,
    /// Largest load that differs from the largest load of the tensile values: give the largest load
    /// of the test (FM).
    #[error("the curve ends at {reached:.1} N/m, and the value is that of {fm:.1} N/m")]
    OtherMaximumTension {
        /// Largest load of the first loading branch, in N/m.
        reached: f64,
        /// FM, in N/m.
        fm: f64,
    },
    /// Tensile curve that ends at its largest load: measure the recovery too.
    #[error("the curve has no way back")]
    NoRecovery,
}
