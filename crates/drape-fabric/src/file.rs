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
#[cfg(feature = "schema")]
use crate::laws::traction::TOE_RATIO_MIN;
use crate::laws::traction::{Buckling, Polynomial, Primed, TractionBackbone, TractionLaw};

/// Fabric of drape: the laws of a weave, in SI.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct FabricFile {
    /// Name of the fabric.
    name: String,
    /// Source: who measured it, when, and where.
    #[serde(default)]
    source: String,
    /// Mass per area, in kg/m².
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.005, 5.0)))]
    density: Given<MassPerArea>,
    /// Thickness under 49 Pa, in m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 0.02)))]
    thickness: Given<Length>,
    /// Thickness under 4.9 kPa, in m; 0.7 of the thickness if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-6, 0.02)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pressed_thickness: Option<Given<Length>>,
    /// Linearity of the compression curve, LC; a straight line, 1, if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.02, 1.0)))]
    #[serde(skip_serializing_if = "Option::is_none")]
    compression_linearity: Option<f64>,
    /// Coefficient of friction of its surface, MIU.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 5.0)))]
    #[serde(default = "surface_friction")]
    surface_friction: f64,
    /// Laws of the warp.
    warp: YarnFile,
    /// Laws of the weft.
    weft: YarnFile,
    /// Law of shear between warp and weft.
    shear: ShearFile,
    /// Provenance of fitted numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    provenance: Option<Provenance>,
}

fn surface_friction() -> f64 {
    SURFACE_FRICTION
}

/// Laws of a yarn direction.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct YarnFile {
    /// Law of traction.
    traction: TractionFile,
    /// Law of bending.
    bending: BendingFile,
}

/// Law of traction.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = drape_input::one_of("primed", "polynomial")))]
#[serde(deny_unknown_fields)]
struct TractionFile {
    /// Friction elements, one or two.
    #[cfg_attr(feature = "schema", schemars(extend("maxItems" = 2)))]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    friction: Vec<ElementFile<ForcePerWidth, Ratio>>,
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

/// Backbone of traction with a priming zone and a line.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct PrimedFile {
    /// Slope of the line, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1.0, 1e7)))]
    stiffness: Given<ForcePerWidth>,
    /// Load at the end of the priming zone over that of the line.
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
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1e-5, 0.1)))]
    strain: Given<Ratio>,
    /// Slope beyond, in N/m.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(0.0, 1e6)))]
    stiffness: Given<ForcePerWidth>,
}

/// Friction element: a load, and a deformation.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(bound = ""))]
#[serde(deny_unknown_fields, bound = "")]
struct ElementFile<L: Dimension, D: Dimension> {
    /// Load that friction tends to.
    plateau: Given<L>,
    /// Deformation within which it comes to 63 % of it.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    length: Given<D>,
}

/// Curve of two pieces: the slope of loads over deformations, a load, and a deformation.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(bound = ""))]
#[serde(deny_unknown_fields, bound = "")]
struct PiecewiseFile<S: Dimension, L: Dimension, D: Dimension> {
    /// Slope of the second piece, a straight line.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    slope: Given<S>,
    /// Load at which that line meets deformation 0.
    intercept: Given<L>,
    /// Deformation at which it begins.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    knot: Given<D>,
}

/// Curve of the moment over the curvature.
type BendingCurveFile = PiecewiseFile<BendingRigidity, MomentPerWidth, Curvature>;

/// Curve of the shear force over the sine of the angle.
type ShearCurveFile = PiecewiseFile<ShearStiffness, ForcePerWidth, Ratio>;

/// Law of bending.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = drape_input::one_of("rigidity", "piecewise")))]
#[serde(deny_unknown_fields)]
struct BendingFile {
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
    /// Backbone of two pieces.
    #[serde(skip_serializing_if = "Option::is_none")]
    piecewise: Option<BendingCurveFile>,
}

/// Law of shear.
#[derive(Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(transform = drape_input::one_of("stiffness", "piecewise")))]
#[serde(deny_unknown_fields)]
struct ShearFile {
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
    /// Backbone of two pieces.
    #[serde(skip_serializing_if = "Option::is_none")]
    piecewise: Option<ShearCurveFile>,
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

/// Returns the JSON Schema of fabrics.
#[cfg(feature = "schema")]
#[must_use]
pub fn fabric_schema() -> serde_json::Value {
    let about = "Fabric of drape: the laws of a weave. Bare numbers are in SI.";
    drape_input::schema_of::<FabricFile>("Fabric of drape", about, serde_json::Map::new())
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
