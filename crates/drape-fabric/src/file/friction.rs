//! Friction elements in the file of a fabric.

use drape_hysteresis::{BlimanSorine, Dahl};
use drape_input::{Dimension, Given};
use serde::{Deserialize, Serialize};

use crate::file::report::Report;

/// Friction element: a load, and a deformation.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(bound = ""))]
#[serde(deny_unknown_fields, bound = "")]
pub(super) struct ElementFile<L: Dimension, D: Dimension> {
    /// Load that friction tends to.
    plateau: Given<L>,
    /// Deformation within which it comes to 63 % of it.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    length: Given<D>,
}

/// Returns the friction of one or two `elements` of the law with the key `key`. More than two
/// elements are a mistake, which goes to `report`. The check of the fabric checks the numbers.
pub(super) fn friction<L: Dimension, D: Dimension>(
    elements: &[ElementFile<L, D>],
    key: &str,
    report: &mut Report<'_>,
) -> BlimanSorine {
    if elements.len() > 2 {
        report(
            &format!("{key}.friction[2]"),
            "there are more than two friction elements",
            "the model has one (first order) or two (second order, or nested loops)",
        );
    }
    let [first, second] = [0, 1].map(|index| {
        let element = elements.get(index);
        element
            .map_or(Dahl::NONE, |e| Dahl { plateau: e.plateau.value(), length: e.length.value() })
    });
    BlimanSorine { elements: [first, second] }
}

/// Returns the elements of `friction` with a plateau.
pub(super) fn elements<L: Dimension, D: Dimension>(
    friction: &BlimanSorine,
) -> Vec<ElementFile<L, D>> {
    friction
        .elements
        .iter()
        .filter(|e| e.plateau != 0.0)
        .map(|e| ElementFile { plateau: Given::bare(e.plateau), length: Given::bare(e.length) })
        .collect()
}
