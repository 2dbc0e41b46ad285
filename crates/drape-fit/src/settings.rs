//! Settings of an identification: the laws to fit, the weights of the points, the intervals, and
//! the evaluation points of KES values.
//!
//! Every function that identifies something takes a [`FitSettings`]. A law that is not set is the
//! one that the sheet asks for, or is selected by Akaike's criterion. The chapter knows the curves
//! of drape-kes, and no law.
//!
//! * `model`: the laws to choose from.
//! * `weighting`: the weights of the points of a curve.

pub(crate) mod model;
pub(crate) mod weighting;

use drape_kes::{BendingPoints, EvaluationPoints, Model, ShearPoints, Sheet};

use model::{LoopModel, Plateau, Toe, TractionModel};
use weighting::Weighting;

/// Laws to identify, how to identify them, and where KES values are read. `None` lets the data
/// select a law.
///
/// `CurveFit::candidates` lists the laws among which one was selected.
///
/// ```
/// use drape_fit::{FrictionOrder, LoopModel, FitSettings};
///
/// // One friction element in bending; everything else is selected by the data.
/// let settings = FitSettings {
///     bending: Some(LoopModel::Linear(FrictionOrder::First)),
///     ..FitSettings::default()
/// };
/// assert_eq!(settings.shear, None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FitSettings {
    /// Elastic load of the traction laws.
    pub traction: Option<TractionModel>,
    /// Whether the priming zone of the traction laws moves.
    pub toe: Option<Toe>,
    /// Bending laws; selected among those with a linear backbone unless set.
    pub bending: Option<LoopModel>,
    /// Shear law; selected among those with a linear backbone unless set.
    pub shear: Option<LoopModel>,
    /// Whether the plateau of the shear friction grows.
    pub plateau: Option<Plateau>,
    /// Weights of the points of a curve.
    pub weighting: Weighting,
    /// Method for the intervals of the parameters.
    pub intervals: Intervals,
    /// Curvatures at which the sheet's B and 2HB were read.
    pub bending_points: BendingPoints,
    /// Angles at which the sheet's G, 2HG and 2HG5 were read.
    pub shear_points: ShearPoints,
}

impl FitSettings {
    /// Returns the settings with the law `model` of a sheet for bending and shear, where no law is
    /// set.
    pub(crate) fn with_default_model(self, model: Option<Model>) -> Self {
        let model = model.map(LoopModel::from);
        Self { bending: self.bending.or(model), shear: self.shear.or(model), ..self }
    }

    /// Returns the evaluation points of the KES values of `sheet`.
    #[must_use]
    pub fn evaluation_points(&self, sheet: &Sheet) -> EvaluationPoints {
        EvaluationPoints {
            maximum_tension: sheet.maximum_tension(),
            bending: self.bending_points,
            shear: self.shear_points,
        }
    }
}

/// Method for the intervals of the parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Intervals {
    /// From the standard errors: valid where the law is nearly linear over them. The default.
    #[default]
    Wald,
    /// From the residuals themselves, [`drape_lm::profile`]: valid for curved laws and at bounds,
    /// at some hundred times the cost.
    Profile,
}
