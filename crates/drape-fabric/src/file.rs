//! The TOML form of a fabric: its mirror, and the conversions in both directions. The only module
//! that knows the keys of the file.

use std::path::Path;

use drape_hysteresis::{BlimanSorine, Dahl};
use drape_input::{
    BendingRigidity, Curvature, Diagnostic, Diagnostics, Dimension, Document, ForcePerWidth, Given,
    Length, MassPerArea, MomentPerWidth, Ratio, ShearStiffness,
};
use serde::{Deserialize, Serialize};

use crate::assumed;
use crate::check::Problem;
use crate::fabric::{Fabric, Provenance, SURFACE_FRICTION, YarnLaws};
use crate::laws::bending::{BendingBackbone, BendingLaw};
use crate::laws::piecewise::Piecewise;
use crate::laws::shear::{Locking, ShearBackbone, ShearLaw};
use crate::laws::traction::{Buckling, Polynomial, Primed, TractionBackbone, TractionLaw};

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct FabricFile {
    name: String,
    #[serde(default)]
    source: String,
    density: Given<MassPerArea>,
    thickness: Given<Length>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pressed_thickness: Option<Given<Length>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compression_linearity: Option<f64>,
    #[serde(default = "surface_friction")]
    surface_friction: f64,
    warp: YarnFile,
    weft: YarnFile,
    shear: ShearFile,
    #[serde(skip_serializing_if = "Option::is_none")]
    provenance: Option<Provenance>,
}

fn surface_friction() -> f64 {
    SURFACE_FRICTION
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct YarnFile {
    traction: TractionFile,
    bending: BendingFile,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct TractionFile {
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    friction: Vec<ElementFile<ForcePerWidth, Ratio>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    primed: Option<PrimedFile>,
    #[serde(skip_serializing_if = "Option::is_none")]
    polynomial: Option<PolynomialFile>,
    #[serde(skip_serializing_if = "Option::is_none")]
    buckling: Option<BucklingFile>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct PrimedFile {
    stiffness: Given<ForcePerWidth>,
    toe_ratio: f64,
    toe_strain: Given<Ratio>,
    toe_strain_after: Given<Ratio>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct PolynomialFile {
    quadratic: Given<ForcePerWidth>,
    quartic: Given<ForcePerWidth>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct BucklingFile {
    strain: Given<Ratio>,
    stiffness: Given<ForcePerWidth>,
}

/// Friction element: a load, and a deformation.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(bound = ""))]
#[serde(deny_unknown_fields, bound = "")]
struct ElementFile<L: Dimension, D: Dimension> {
    plateau: Given<L>,
    length: Given<D>,
}

/// Curve of two pieces: the slope of loads over deformations, a load, and a deformation.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(bound = ""))]
#[serde(deny_unknown_fields, bound = "")]
struct PiecewiseFile<S: Dimension, L: Dimension, D: Dimension> {
    slope: Given<S>,
    intercept: Given<L>,
    knot: Given<D>,
}

/// Curve of the moment over the curvature.
type BendingCurveFile = PiecewiseFile<BendingRigidity, MomentPerWidth, Curvature>;

/// Curve of the shear force over the sine of the angle.
type ShearCurveFile = PiecewiseFile<ShearStiffness, ForcePerWidth, Ratio>;

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct BendingFile {
    #[serde(skip_serializing_if = "Option::is_none")]
    rigidity: Option<Given<BendingRigidity>>,
    #[serde(default)]
    rest_curvature: Given<Curvature>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    friction: Vec<ElementFile<MomentPerWidth, Curvature>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    piecewise: Option<BendingCurveFile>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct ShearFile {
    #[serde(skip_serializing_if = "Option::is_none")]
    stiffness: Option<Given<ShearStiffness>>,
    #[serde(default)]
    growth: f64,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    friction: Vec<ElementFile<ForcePerWidth, Ratio>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    piecewise: Option<ShearCurveFile>,
    #[serde(skip_serializing_if = "Option::is_none")]
    locking: Option<LockingFile>,
}

#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct LockingFile {
    onset: f64,
    limit: f64,
}

/// Returns the JSON Schema of fabrics.
#[cfg(feature = "schema")]
#[must_use]
pub fn fabric_schema() -> serde_json::Value {
    drape_input::schema_of::<FabricFile>("Fabric of drape")
}

impl Fabric {
    /// Reads a `fabric.toml`.
    ///
    /// # Errors
    /// Every mistake of the file, each with its line and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        Self::from_document(&Document::read(path)?)
    }

    /// Returns the fabric that a TOML document describes.
    ///
    /// # Errors
    /// Every mistake of the document, each with its line and a remedy.
    pub fn from_document(document: &Document) -> Result<Self, Diagnostics> {
        let (file, faults) = document.decode_with_faults::<FabricFile>()?;
        let mut mistakes = Vec::new();
        let fabric = file.fabric(&mut |key, message, help| {
            if !faults.cover(key) {
                mistakes.push(document.at(key, message).help(help));
            }
        });
        let problems = fabric.problems();
        let problems = problems.iter().filter(|problem| !faults.cover(&problem.key));
        let located = |p: &Problem| document.at(&p.key, p.message.clone()).help(&p.help);
        mistakes.extend(problems.map(located).collect::<Vec<Diagnostic>>());
        mistakes.extend(faults.into_mistakes());
        Diagnostics::check(mistakes)?;
        Ok(fabric)
    }

    /// Returns the fabric as TOML, which [`Fabric::read`] reads back exactly.
    ///
    /// What its provenance says to be assumed is a comment above the number or the law.
    #[must_use]
    pub fn to_toml(&self) -> String {
        let text = toml::to_string_pretty(&FabricFile::from(self))
            .expect("numbers, strings and tables always have a TOML form");
        let assumed = self.provenance.as_ref().map_or(&[][..], |provenance| &provenance.assumed);
        assumed::marked(&text, assumed)
    }
}

type Report<'a> = dyn FnMut(&str, &str, &str) + 'a;

impl FabricFile {
    fn fabric(self, report: &mut Report<'_>) -> Fabric {
        let warp = self.warp.laws("warp", report);
        let weft = self.weft.laws("weft", report);
        let shear = self.shear.law(report);
        Fabric {
            name: self.name,
            source: self.source,
            density: self.density.value(),
            thickness: self.thickness.value(),
            pressed_thickness: self.pressed_thickness.map(Given::value),
            compression_linearity: self.compression_linearity,
            surface_friction: self.surface_friction,
            warp,
            weft,
            shear,
            provenance: self.provenance,
        }
    }
}

impl YarnFile {
    fn laws(self, key: &str, report: &mut Report<'_>) -> YarnLaws {
        let traction_key = format!("{key}.traction");
        let backbone = match (self.traction.primed, self.traction.polynomial) {
            (Some(p), None) => TractionBackbone::Primed(Primed {
                stiffness: p.stiffness.value(),
                toe_ratio: p.toe_ratio,
                toe_strain: p.toe_strain.value(),
                toe_strain_after: p.toe_strain_after.value(),
            }),
            (None, Some(p)) => TractionBackbone::Polynomial(Polynomial {
                quadratic: p.quadratic.value(),
                quartic: p.quartic.value(),
            }),
            _ => {
                report(
                    &traction_key,
                    "the tensile curve must be given once",
                    "give one of the tables `primed` and `polynomial`",
                );
                TractionBackbone::Polynomial(Polynomial { quadratic: 1.0, quartic: 0.0 })
            }
        };
        let buckling = self.traction.buckling.map_or(Buckling::default(), |b| Buckling {
            strain: b.strain.value(),
            stiffness: b.stiffness.value(),
        });
        let friction = friction(&self.traction.friction, &traction_key, report);
        let traction = TractionLaw { backbone, friction, buckling };

        let bending_key = format!("{key}.bending");
        let backbone = match (self.bending.rigidity, self.bending.piecewise) {
            (Some(rigidity), None) => BendingBackbone::Linear { rigidity: rigidity.value() },
            (None, Some(p)) => BendingBackbone::Piecewise(p.into()),
            _ => {
                report(
                    &bending_key,
                    "the bending curve must be given once",
                    "give one of `rigidity` and the table `piecewise`",
                );
                BendingBackbone::Linear { rigidity: 1e-5 }
            }
        };
        let rest_curvature = self.bending.rest_curvature.value();
        let friction = self::friction(&self.bending.friction, &bending_key, report);
        YarnLaws { traction, bending: BendingLaw { backbone, rest_curvature, friction } }
    }
}

impl ShearFile {
    fn law(self, report: &mut Report<'_>) -> ShearLaw {
        let backbone = match (self.stiffness, self.piecewise) {
            (Some(stiffness), None) => ShearBackbone::Linear { stiffness: stiffness.value() },
            (None, Some(p)) => ShearBackbone::Piecewise(p.into()),
            _ => {
                report(
                    "shear",
                    "the shear curve must be given once",
                    "give one of `stiffness` and the table `piecewise`",
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

fn friction<L: Dimension, D: Dimension>(
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
    let element = |index: usize| {
        let element = elements.get(index);
        element.map_or(Dahl::NONE, |e| Dahl::new(e.plateau.value(), e.length.value()))
    };
    BlimanSorine::parallel(element(0), element(1))
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

fn elements<L: Dimension, D: Dimension>(friction: &BlimanSorine) -> Vec<ElementFile<L, D>> {
    friction
        .elements
        .iter()
        .filter(|e| e.plateau != 0.0)
        .map(|e| ElementFile { plateau: Given::bare(e.plateau), length: Given::bare(e.length) })
        .collect()
}

impl From<&Fabric> for FabricFile {
    fn from(fabric: &Fabric) -> Self {
        Self {
            name: fabric.name.clone(),
            source: fabric.source.clone(),
            density: Given::bare(fabric.density),
            thickness: Given::bare(fabric.thickness),
            pressed_thickness: fabric.pressed_thickness.map(Given::bare),
            compression_linearity: fabric.compression_linearity,
            surface_friction: fabric.surface_friction,
            warp: (&fabric.warp).into(),
            weft: (&fabric.weft).into(),
            shear: (&fabric.shear).into(),
            provenance: fabric.provenance.clone(),
        }
    }
}

impl From<&YarnLaws> for YarnFile {
    fn from(laws: &YarnLaws) -> Self {
        let YarnLaws { traction, bending } = laws;
        let (mut primed, mut polynomial) = (None, None);
        match &traction.backbone {
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
        let Buckling { strain, stiffness } = traction.buckling;
        let (mut rigidity, mut piecewise) = (None, None);
        match &bending.backbone {
            BendingBackbone::Linear { rigidity: value } => rigidity = Some(Given::bare(*value)),
            BendingBackbone::Piecewise(p) => piecewise = Some(p.into()),
        }
        Self {
            traction: TractionFile {
                friction: elements(&traction.friction),
                primed,
                polynomial,
                buckling: Some(BucklingFile {
                    strain: Given::bare(strain),
                    stiffness: Given::bare(stiffness),
                }),
            },
            bending: BendingFile {
                rigidity,
                rest_curvature: Given::bare(bending.rest_curvature),
                friction: elements(&bending.friction),
                piecewise,
            },
        }
    }
}

impl From<&ShearLaw> for ShearFile {
    fn from(law: &ShearLaw) -> Self {
        let (mut stiffness, mut piecewise) = (None, None);
        match &law.backbone {
            ShearBackbone::Linear { stiffness: value } => stiffness = Some(Given::bare(*value)),
            ShearBackbone::Piecewise(p) => piecewise = Some(p.into()),
        }
        Self {
            stiffness,
            growth: law.growth,
            friction: elements(&law.friction),
            piecewise,
            locking: law.locking.map(|l| LockingFile { onset: l.onset, limit: l.limit }),
        }
    }
}
