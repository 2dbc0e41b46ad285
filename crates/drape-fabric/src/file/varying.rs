//! Backbone whose stiffness changes, in the file of a fabric.

use drape_input::{Dimension, Given};
use serde::{Deserialize, Serialize};

use crate::laws::varying::Varying;

/// Curve whose stiffness changes from an initial to a final value.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(bound = ""))]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct VaryingFile<S: Dimension, D: Dimension> {
    /// Stiffness at rest.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    initial_stiffness: Given<S>,
    /// Stiffness far beyond the transition.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    final_stiffness: Given<S>,
    /// Deformation about which the stiffness changes.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    transition: Given<D>,
}

impl<S: Dimension, D: Dimension> From<VaryingFile<S, D>> for Varying {
    fn from(file: VaryingFile<S, D>) -> Self {
        Self {
            initial_stiffness: file.initial_stiffness.value(),
            final_stiffness: file.final_stiffness.value(),
            transition: file.transition.value(),
        }
    }
}

impl<S: Dimension, D: Dimension> From<&Varying> for VaryingFile<S, D> {
    fn from(law: &Varying) -> Self {
        Self {
            initial_stiffness: Given::bare(law.initial_stiffness),
            final_stiffness: Given::bare(law.final_stiffness),
            transition: Given::bare(law.transition),
        }
    }
}
