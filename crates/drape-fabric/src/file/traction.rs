//! Law of traction in the file of a fabric.

use drape_input::{ForcePerWidth, Given, Ratio};
use serde::{Deserialize, Serialize};

use crate::file::friction::{ElementFile, elements, friction};
use crate::file::report::Report;
use crate::laws::traction::buckling::Buckling;
use crate::laws::traction::exponential::ExponentialToe;
#[cfg(feature = "schema")]
use crate::laws::traction::exponential::STEEPNESS_MIN;
use crate::laws::traction::polynomial::Polynomial;
use crate::laws::traction::primed::Primed;
#[cfg(feature = "schema")]
use crate::laws::traction::primed::TOE_RATIO_MIN;
#[cfg(feature = "schema")]
use crate::laws::traction::proportional::FRICTION_RATIO_MAX;
use crate::laws::traction::proportional::ProportionalFriction;
use crate::laws::traction::{TractionBackbone, TractionFriction, TractionLaw};

/// Law of traction.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = drape_input::one_of("exponential, primed, polynomial")))]
#[serde(deny_unknown_fields)]
pub(super) struct TractionFile {
    /// Friction elements, one or two.
    #[cfg_attr(feature = "schema", schemars(extend("maxItems" = 2)))]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    friction: Vec<ElementFile<ForcePerWidth, Ratio>>,
    /// Friction in proportion to the elastic load, for an exponential toe.
    #[serde(skip_serializing_if = "Option::is_none")]
    proportional_friction: Option<ProportionalFile>,
    /// Backbone with an exponential toe that continues as its tangent.
    #[serde(skip_serializing_if = "Option::is_none")]
    exponential: Option<ExponentialFile>,
    /// Backbone with a priming zone and a line.
    #[serde(skip_serializing_if = "Option::is_none")]
    primed: Option<PrimedFile>,
    /// Backbone as a polynomial.
    #[serde(skip_serializing_if = "Option::is_none")]
    polynomial: Option<PolynomialFile>,
    /// Compression, in which yarns buckle.
    #[serde(skip_serializing_if = "Option::is_none")]
    buckling: Option<BucklingFile>,
}

/// Friction in proportion to the elastic load.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct ProportionalFile {
    /// Friction over elastic load.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, FRICTION_RATIO_MAX)))]
    ratio: f64,
    /// Friction of yarns without tension, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e5)))]
    #[serde(default)]
    plateau: Given<ForcePerWidth>,
    /// Friction length, a strain.
    length: Given<Ratio>,
}

/// Backbone of traction with an exponential toe that continues as its tangent.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct ExponentialFile {
    /// Stiffness that is there at every strain, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e7)))]
    #[serde(default)]
    base_stiffness: Given<ForcePerWidth>,
    /// Stiffness that the toe has added at its end, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1.0, 1e10)))]
    stiffness: Given<ForcePerWidth>,
    /// Natural logarithm of the growth of the added stiffness over the toe.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(STEEPNESS_MIN, 60.0)))]
    steepness: f64,
    /// Strain at the end of the toe, of virgin fabric.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 3.0)))]
    toe_strain: Given<Ratio>,
    /// Strain at the end of the toe, once stretched.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 6.0)))]
    toe_strain_after: Given<Ratio>,
}

/// Backbone of traction with a priming zone and a line.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct PrimedFile {
    /// Slope of the line, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1.0, 1e7)))]
    stiffness: Given<ForcePerWidth>,
    /// Ratio of the load at the end of the priming zone to the load of the line there.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(TOE_RATIO_MIN, 1.0)))]
    toe_ratio: f64,
    /// Strain at the end of the priming zone, of virgin fabric.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 1.0)))]
    toe_strain: Given<Ratio>,
    /// Strain at the end of the priming zone, once stretched.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 2.0)))]
    toe_strain_after: Given<Ratio>,
}

/// Backbone of traction as a polynomial.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct PolynomialFile {
    /// Coefficient of the squared strain, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e12)))]
    quadratic: Given<ForcePerWidth>,
    /// Coefficient of the fourth power of the strain, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e15)))]
    quartic: Given<ForcePerWidth>,
}

/// Compression of a yarn.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct BucklingFile {
    /// Compressive strain at which yarns buckle.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-5, 0.5)))]
    strain: Given<Ratio>,
    /// Slope beyond, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e6)))]
    stiffness: Given<ForcePerWidth>,
}

impl TractionFile {
    /// Returns the law with the key `key`. Mistakes go to `report`.
    pub(super) fn law(self, key: &str, report: &mut Report<'_>) -> TractionLaw {
        let backbone = match (self.exponential, self.primed, self.polynomial) {
            (Some(e), None, None) => TractionBackbone::Exponential(ExponentialToe {
                base_stiffness: e.base_stiffness.value(),
                stiffness: e.stiffness.value(),
                steepness: e.steepness,
                toe_strain: e.toe_strain.value(),
                toe_strain_after: e.toe_strain_after.value(),
            }),
            (None, Some(p), None) => TractionBackbone::Primed(Primed {
                stiffness: p.stiffness.value(),
                toe_ratio: p.toe_ratio,
                toe_strain: p.toe_strain.value(),
                toe_strain_after: p.toe_strain_after.value(),
            }),
            (None, None, Some(p)) => TractionBackbone::Polynomial(Polynomial {
                quadratic: p.quadratic.value(),
                quartic: p.quartic.value(),
            }),
            _ => {
                report(
                    key,
                    "the tensile curve must be given once",
                    "give one of the tables `exponential`, `primed` and `polynomial`",
                );
                TractionBackbone::Polynomial(Polynomial { quadratic: 1.0, quartic: 0.0 })
            }
        };

        let buckling = self.buckling.map_or(Buckling::default(), |b| Buckling {
            strain: b.strain.value(),
            stiffness: b.stiffness.value(),
        });

        if self.proportional_friction.is_some() && !self.friction.is_empty() {
            report(
                &format!("{key}.friction"),
                "the friction is given twice",
                "leave out `friction` or `proportional_friction`",
            );
        }
        let friction = match self.proportional_friction {
            Some(p) => TractionFriction::Proportional(ProportionalFriction {
                ratio: p.ratio,
                plateau: p.plateau.value(),
                length: p.length.value(),
            }),
            None => friction(&self.friction, key, report).into(),
        };
        TractionLaw { backbone, friction, buckling }
    }
}

impl From<&TractionLaw> for TractionFile {
    fn from(law: &TractionLaw) -> Self {
        let (mut exponential, mut primed, mut polynomial) = (None, None, None);
        match &law.backbone {
            TractionBackbone::Exponential(toe) => {
                exponential = Some(ExponentialFile {
                    base_stiffness: Given::bare(toe.base_stiffness),
                    stiffness: Given::bare(toe.stiffness),
                    steepness: toe.steepness,
                    toe_strain: Given::bare(toe.toe_strain),
                    toe_strain_after: Given::bare(toe.toe_strain_after),
                });
            }
            TractionBackbone::Primed(p) => {
                primed = Some(PrimedFile {
                    stiffness: Given::bare(p.stiffness),
                    toe_ratio: p.toe_ratio,
                    toe_strain: Given::bare(p.toe_strain),
                    toe_strain_after: Given::bare(p.toe_strain_after),
                });
            }
            TractionBackbone::Polynomial(p) => {
                polynomial = Some(PolynomialFile {
                    quadratic: Given::bare(p.quadratic),
                    quartic: Given::bare(p.quartic),
                });
            }
        }

        let (friction, proportional_friction) = match &law.friction {
            TractionFriction::Plateau(friction) => (elements(friction), None),
            TractionFriction::Proportional(friction) => {
                let ProportionalFriction { ratio, plateau, length } = *friction;
                let (plateau, length) = (Given::bare(plateau), Given::bare(length));
                (Vec::new(), Some(ProportionalFile { ratio, plateau, length }))
            }
        };

        let Buckling { strain, stiffness } = law.buckling;
        let (strain, stiffness) = (Given::bare(strain), Given::bare(stiffness));
        let buckling = Some(BucklingFile { strain, stiffness });
        Self { friction, proportional_friction, exponential, primed, polynomial, buckling }
    }
}
