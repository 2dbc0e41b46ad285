//! What a text beside numbers says of them, besides the item.

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
    /// Mean whose cells have a coefficient of variation beside it, in percent.
    MeanWithVariation,
    /// Mean whose cells have its standard error beside it.
    MeanWithError,
    Deviation,
    /// In percent of the mean.
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

/// Words at the head of a row or a column of names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axis {
    Specimen,
    Fabric,
    /// Samples: specimens, or fabrics.
    Sample,
    /// Units.
    Unit,
}
