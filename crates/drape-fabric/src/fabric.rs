//! The fabric: mass, thickness and laws. A fabric comes from a fit or from a file, and is the
//! material of a cloth.

use std::collections::BTreeMap;

use drape_hysteresis::BlimanSorine;

use crate::laws::bending::BendingLaw;
use crate::laws::shear::ShearLaw;
use crate::laws::traction::{TractionFriction, TractionLaw};

/// Coefficient of friction of a surface that was not measured, a ratio. KES MIU of apparel fabrics
/// lies between about 0.1 and 0.3.
pub const SURFACE_FRICTION: f64 = 0.2;

/// Woven fabric: all material data of a simulation, in SI units.
///
/// A fabric and its laws are data of serde. Their keys in JSON, and in other formats that describe
/// themselves, are the keys of `fabric.toml`. A number out of range is refused while it is read.
///
/// ```
/// use drape_fabric::Fabric;
/// use drape_input::Document;
///
/// let text = r#"
///     name = "plain weave"
///     density = 0.12
///     thickness = 0.0003
///     shear = { stiffness = 35.0, friction = [{ plateau = 0.5, length = 0.004 }] }
///     [warp]
///     traction.polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
///     bending.rigidity = 1.2e-5
///     [weft]
///     traction.polynomial = { quadratic = 6.0e4, quartic = 1.0e7 }
///     bending.rigidity = 0.8e-5
/// "#;
/// let fabric = Fabric::from_document(&Document::new("plain.toml", text))?;
/// assert!(fabric.problems().is_empty());
/// // A fabric that is written and read again has equal bits.
/// let again = Fabric::from_document(&Document::new("again.toml", fabric.to_toml()))?;
/// assert_eq!(again, fabric);
/// # Ok::<(), drape_input::Diagnostics>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Fabric {
    /// Name, for people.
    pub name: String,
    /// Source of the numbers: who measured them and when, and their licence.
    pub source: String,
    /// Mass per area, in kg/m².
    pub density: f64,
    /// Thickness under 49 Pa (0.5 gf/cm²), in m.
    pub thickness: f64,
    /// Thickness under 4.9 kPa (50 gf/cm²), in m, if it was measured (KES-FB3).
    pub pressed_thickness: Option<f64>,
    /// Ratio of the work of compression to 4.9 kPa to the work of a straight line to the same
    /// point, if it was measured (LC of KES-FB3). With a small ratio the fabric resists pressure
    /// late and then steeply.
    pub compression_linearity: Option<f64>,
    /// Coefficient of friction of the surface, a ratio.
    pub surface_friction: f64,
    /// Laws along the warp yarns.
    pub warp: YarnLaws,
    /// Laws along the weft yarns.
    pub weft: YarnLaws,
    /// Law of shear between warp and weft.
    pub shear: ShearLaw,
    /// Provenance of the numbers, if they were fitted.
    pub provenance: Option<Provenance>,
}

/// Laws of one yarn system, warp or weft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YarnLaws {
    /// Tension per width against strain.
    pub traction: TractionLaw,
    /// Moment per width against curvature.
    pub bending: BendingLaw,
}

/// Provenance of fitted numbers.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Sheet whose curves and values were fitted.
    pub sheet: String,
    /// Digest of the numbers of the sheet, which tells whether they have changed.
    #[serde(default)]
    pub digest: String,
    /// Program and version of the fit.
    pub fitted_by: String,
    /// Assumptions made where the sheet has no value.
    #[serde(default)]
    pub assumed: Vec<String>,
    /// Standard errors of the fitted numbers, in their units, by key path such as
    /// `warp.bending.rigidity`.
    #[serde(default)]
    pub standard_errors: BTreeMap<String, f64>,
    /// Correlations of the errors of two fitted numbers, by the key paths of both, each pair once;
    /// the errors of pairs that are not listed are independent.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub correlations: BTreeMap<String, BTreeMap<String, f64>>,
    /// Measured values that the model does not use, by their symbols such as `warp.MMD`, in the
    /// laboratory's units.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub unused: BTreeMap<String, f64>,
    /// Largest deformation at which each law was measured, by key path such as `warp.traction`: a
    /// strain, a curvature in 1/m, the sine of a shear angle. Its table in the file is `reach`.
    #[serde(rename = "reach", default, skip_serializing_if = "BTreeMap::is_empty")]
    pub measured_range: BTreeMap<String, f64>,
}

impl Fabric {
    /// Pressure of [`Fabric::thickness_under_pressure`], in Pa: 50 gf/cm².
    pub const PRESSURE: f64 = 4903.325;

    /// Returns a copy of `self` without friction in any law.
    #[must_use]
    pub fn without_friction(&self) -> Self {
        let mut fabric = self.clone();
        for laws in [&mut fabric.warp, &mut fabric.weft] {
            laws.traction.friction = TractionFriction::none();
            laws.bending.friction = BlimanSorine::default();
        }
        fabric.shear.friction = BlimanSorine::default();
        fabric
    }

    /// Returns the thickness under [`Fabric::PRESSURE`], in m: `pressed_thickness`, or 0.7 of
    /// `thickness` if it was not measured. Apparel weaves have 0.6 to 0.8.
    #[must_use]
    pub fn thickness_under_pressure(&self) -> f64 {
        self.pressed_thickness.unwrap_or(0.7 * self.thickness)
    }
}
