//! Model of the internal forces of the cloth.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Model of the internal forces of the cloth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Yarn connectors with the laws of the fabric, friction included \[NB04\].
    #[default]
    Kes,
    /// Interacting particles without friction \[BHW94\]: see [`drape_cloth::Breen`].
    #[serde(rename = "breen-1994")]
    Breen1994,
}
