//! Law of shear in the file of a fabric.

use drape_input::{ForcePerWidth, Given, Ratio, ShearStiffness};
use serde::{Deserialize, Serialize};

use crate::file::friction::{ElementFile, elements, friction};
use crate::file::piecewise::PiecewiseFile;
use crate::file::report::Report;
use crate::file::varying::VaryingFile;
use crate::laws::shear::{Locking, ShearBackbone, ShearLaw};

/// Law of shear.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = drape_input::one_of("stiffness, varying, piecewise")))]
#[serde(deny_unknown_fields)]
pub(super) struct ShearFile {
    /// Stiffness, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.01, 1e5)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness: Option<Given<ShearStiffness>>,
    /// Increase of friction per unit of the sine of the angle.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e3)))]
    #[serde(default)]
    growth: f64,
    /// Friction elements, one or two.
    #[cfg_attr(feature = "schema", schemars(extend("maxItems" = 2)))]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    friction: Vec<ElementFile<ForcePerWidth, Ratio>>,
    /// Backbone whose stiffness changes with the angle.
    #[serde(skip_serializing_if = "Option::is_none")]
    varying: Option<VaryingFile<ShearStiffness, Ratio>>,
    /// Backbone of a quadratic and a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    piecewise: Option<PiecewiseFile<ShearStiffness, ForcePerWidth, Ratio>>,
    /// Rise of the force where yarns jam.
    #[serde(skip_serializing_if = "Option::is_none")]
    locking: Option<LockingFile>,
}

/// Rise of the shear force where yarns jam.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct LockingFile {
    /// Sine of the angle at which it begins.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.01, 0.99)))]
    onset: f64,
    /// Sine of the angle that is never passed.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.01, 1.0)))]
    limit: f64,
}

impl ShearFile {
    /// Returns the law of the table `shear`. Mistakes go to `report`.
    pub(super) fn law(self, report: &mut Report<'_>) -> ShearLaw {
        let backbone = match (self.stiffness, self.varying, self.piecewise) {
            (Some(stiffness), None, None) => ShearBackbone::Linear { stiffness: stiffness.value() },
            (None, Some(varying), None) => ShearBackbone::Varying(varying.into()),
            (None, None, Some(piecewise)) => ShearBackbone::Piecewise(piecewise.into()),
            _ => {
                report(
                    "shear",
                    "the shear curve must be given once",
                    "give one of `stiffness` and the tables `varying` and `piecewise`",
                );
                ShearBackbone::Linear { stiffness: 1.0 }
            }
        };
        ShearLaw {
            backbone,
            friction: friction(&self.friction, "shear", report),
            growth: self.growth,
            locking: self.locking.map(|l| Locking { onset: l.onset, limit: l.limit }),
        }
    }
}

impl From<&ShearLaw> for ShearFile {
    fn from(law: &ShearLaw) -> Self {
        let (mut stiffness, mut varying, mut piecewise) = (None, None, None);
        match &law.backbone {
            ShearBackbone::Linear { stiffness: value } => stiffness = Some(Given::bare(*value)),
            ShearBackbone::Varying(law) => varying = Some(law.into()),
            ShearBackbone::Piecewise(p) => piecewise = Some(p.into()),
        }
        Self {
            stiffness,
            growth: law.growth,
            friction: elements(&law.friction),
            varying,
            piecewise,
            locking: law.locking.map(|l| LockingFile { onset: l.onset, limit: l.limit }),
        }
    }
}
