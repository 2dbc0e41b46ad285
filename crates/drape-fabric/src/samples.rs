//! Sample fabrics for examples and tests, here and in the crates that simulate cloth.
//!
//! The numbers are of the order that plain weaves of cotton have. Nobody measured them: a fabric of
//! a study comes from a sheet, by `drape-fit`.

use drape_input::Document;

use crate::fabric::Fabric;

/// Text of a `fabric.toml`: a plain weave whose laws have no friction.
///
/// Keys at the top of the file may be added before the text, such as `surface_friction`.
pub const PLAIN_WEAVE: &str = "\
name = \"plain weave\"
density = 0.12
thickness = 0.0003
shear.stiffness = 35
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
bending.rigidity = 1.2e-5
[weft]
traction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
bending.rigidity = 0.8e-5
";

/// Text of a `fabric.toml`: a heavier plain weave with friction in every law.
pub const PLAIN_WEAVE_WITH_FRICTION: &str = "\
name = \"plain weave with friction\"
density = 0.15
thickness = 0.0003
shear = { stiffness = 35, growth = 4, friction = [{ plateau = 0.5, length = 0.004 }] }
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
traction.friction = [{ plateau = 4, length = 0.001 }]
bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4 }] }
[weft]
traction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
traction.friction = [{ plateau = 3, length = 0.001 }]
bending = { rigidity = 0.8e-5, friction = [{ plateau = 4e-4, length = 4 }] }
";

/// Text of a `fabric.toml`: a heavy plain weave, equal along warp and weft, with friction in shear
/// and bending.
pub const HEAVY_WEAVE: &str = "\
name = \"heavy plain weave\"
density = 0.2
thickness = 0.0004
shear = { stiffness = 50, friction = [{ plateau = 0.5, length = 0.004 }] }
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.6, toe_strain = 0.015, toe_strain_after = 0.02 }
bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4 }] }
[weft]
traction.primed = { stiffness = 5000, toe_ratio = 0.6, toe_strain = 0.015, toe_strain_after = 0.02 }
bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4 }] }
";

/// Returns the fabric of [`PLAIN_WEAVE`].
///
/// ```
/// use drape_fabric::samples;
///
/// assert_eq!(samples::plain_weave().warp.bending.friction.plateau(), 0.0);
/// ```
#[must_use]
pub fn plain_weave() -> Fabric {
    fabric(PLAIN_WEAVE)
}

/// Returns the fabric of [`PLAIN_WEAVE_WITH_FRICTION`].
///
/// ```
/// use drape_fabric::samples;
///
/// assert_eq!(samples::plain_weave_with_friction().warp.bending.friction.plateau(), 6e-4);
/// ```
#[must_use]
pub fn plain_weave_with_friction() -> Fabric {
    fabric(PLAIN_WEAVE_WITH_FRICTION)
}

/// Returns the fabric of a `text` of this module.
fn fabric(text: &str) -> Fabric {
    let document = Document::new("fabric.toml", text);
    Fabric::from_document(&document).expect("the texts of this module are right, as its tests show")
}
