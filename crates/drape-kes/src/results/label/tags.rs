//! Tags of a text beside numbers: direction, statistic, face, and the kind of names.

use crate::test::Direction;

/// Direction in which a specimen is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Cut {
    Along(Direction),
    /// At 45° to the yarns.
    Bias,
}

/// Statistic of several specimens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Statistic {
    Mean,
    /// Mean with a coefficient of variation in the cell, in percent.
    MeanWithVariation,
    /// Mean with its standard error in the cell.
    MeanWithError,
    Deviation,
    /// Coefficient of variation, in percent of the mean.
    Variation,
    /// Standard error of the mean.
    Error,
    Count,
    Other,
}

/// Side of a fabric, or sense of a deformation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Face {
    Face,
    Back,
}

/// Kind of the names in a row or a column, which its head states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HeadKind {
    Specimen,
    Fabric,
    /// Samples, which may be specimens or fabrics.
    Sample,
    /// Units.
    Unit,
}
