//! Backbone of a quadratic and a line in the file of a fabric.

use drape_input::{Dimension, Given};
use serde::{Deserialize, Serialize};

use crate::laws::piecewise::Piecewise;

/// Quadratic through the origin that continues as a straight line.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(bound = ""))]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct PiecewiseFile<S: Dimension, L: Dimension, D: Dimension> {
    /// Slope of the line, in load per deformation.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    slope: Given<S>,
    /// Load at which the line, continued to smaller deformations, meets deformation 0.
    intercept: Given<L>,
    /// Deformation at which the line begins.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    knot: Given<D>,
}

impl<S: Dimension, L: Dimension, D: Dimension> From<PiecewiseFile<S, L, D>> for Piecewise {
    fn from(file: PiecewiseFile<S, L, D>) -> Self {
        Self {
            slope: file.slope.value(),
            intercept: file.intercept.value(),
            knot: file.knot.value(),
        }
    }
}

impl<S: Dimension, L: Dimension, D: Dimension> From<&Piecewise> for PiecewiseFile<S, L, D> {
    fn from(law: &Piecewise) -> Self {
        Self {
            slope: Given::bare(law.slope),
            intercept: Given::bare(law.intercept),
            knot: Given::bare(law.knot),
        }
    }
}
