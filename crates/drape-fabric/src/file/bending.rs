//! Law of bending in the file of a fabric.

use drape_input::{BendingRigidity, Curvature, Given, MomentPerWidth};
use serde::{Deserialize, Serialize};

use crate::file::friction::{ElementFile, elements, friction};
use crate::file::piecewise::PiecewiseFile;
use crate::file::report::Report;
use crate::file::varying::VaryingFile;
use crate::laws::bending::{BendingBackbone, BendingLaw};

/// Law of bending.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = drape_input::one_of("rigidity, varying, piecewise")))]
#[serde(deny_unknown_fields)]
pub(super) struct BendingFile {
    /// Bending rigidity per width, in N·m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-7, 1e-3)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    rigidity: Option<Given<BendingRigidity>>,
    /// Curvature without load, in 1/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(-1e4, 1e4)))]
    #[serde(default)]
    rest_curvature: Given<Curvature>,
    /// Friction elements, one or two.
    #[cfg_attr(feature = "schema", schemars(extend("maxItems" = 2)))]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    friction: Vec<ElementFile<MomentPerWidth, Curvature>>,
    /// Backbone whose rigidity changes with the curvature.
    #[serde(skip_serializing_if = "Option::is_none")]
    varying: Option<VaryingFile<BendingRigidity, Curvature>>,
    /// Backbone of a quadratic and a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    piecewise: Option<PiecewiseFile<BendingRigidity, MomentPerWidth, Curvature>>,
}

impl BendingFile {
    /// Returns the law with the key `key`. Mistakes go to `report`.
    pub(super) fn law(self, key: &str, report: &mut Report<'_>) -> BendingLaw {
        let backbone = match (self.rigidity, self.varying, self.piecewise) {
            (Some(rigidity), None, None) => BendingBackbone::Linear { rigidity: rigidity.value() },
            (None, Some(varying), None) => BendingBackbone::Varying(varying.into()),
            (None, None, Some(piecewise)) => BendingBackbone::Piecewise(piecewise.into()),
            _ => {
                report(
                    key,
                    "the bending curve must be given once",
                    "give one of `rigidity` and the tables `varying` and `piecewise`",
                );
                BendingBackbone::Linear { rigidity: 1e-5 }
            }
        };
        let rest_curvature = self.rest_curvature.value();
        let friction = friction(&self.friction, key, report);
        BendingLaw { backbone, rest_curvature, friction }
    }
}

impl From<&BendingLaw> for BendingFile {
    fn from(law: &BendingLaw) -> Self {
        let (mut rigidity, mut varying, mut piecewise) = (None, None, None);
        match &law.backbone {
            BendingBackbone::Linear { rigidity: value } => rigidity = Some(Given::bare(*value)),
            BendingBackbone::Varying(law) => varying = Some(law.into()),
            BendingBackbone::Piecewise(law) => piecewise = Some(law.into()),
        }
        Self {
            rigidity,
            rest_curvature: Given::bare(law.rest_curvature),
            friction: elements(&law.friction),
            varying,
            piecewise,
        }
    }
}
