//! Shipped fabrics of the suite: fits to the sheets in the folder `fabrics` of the workspace.

use drape_fabric::Fabric;
use drape_input::Document;

use crate::error::ValidationError;

/// Cupro weave, from its stretch and loop-bending curves (see the sheet for the source).
pub const CUPRO: &str = include_str!("../../fabrics/cupro-weave.toml");

/// Matsudaira's fabric A, a cotton broad, from published KES values; its shear is assumed.
pub const COTTON: &str = include_str!("../../fabrics/matsudaira-a.toml");

/// Matsudaira's fabric B, a wool tropical, from published KES values; its shear is assumed.
pub const WOOL: &str = include_str!("../../fabrics/matsudaira-b.toml");

/// Cotton of \[THK03\], from its fitted law; its shear is assumed.
pub const TAGAWA: &str = include_str!("../../fabrics/tagawa-2003.toml");

/// Stand-in for the stiff cotton of \[BHW94\]: four times as stiff as [`COTTON`], by choice.
pub const STIFF_COTTON: &str = include_str!("../../fabrics/stiff-cotton-stand-in.toml");

/// Stand-in for the polyester/cotton of \[BHW94\]: [`COTTON`] with a quarter of the stiffness along
/// the weft, by choice.
pub const LIMP_WEFT: &str = include_str!("../../fabrics/polyester-cotton-stand-in.toml");

/// Returns the fabric that `text` states as TOML.
///
/// # Errors
/// `text` does not state a fabric.
pub fn fabric(text: &str) -> Result<Fabric, ValidationError> {
    Ok(Fabric::from_document(&Document::new("fabric.toml", text))?)
}
