//! Laws that a curve can be fitted with.

use drape_kes::Model;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Friction elements of a bending or shear law.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FrictionOrder {
    /// One element, whose load approaches one plateau.
    #[default]
    First,
    /// Two positive elements of different length in parallel: nested loops that grow with their
    /// amplitude.
    TwoElements,
    /// Fast element less a slow one: stiction, and a drop to the plateau \[BS95\].
    Second,
}

impl FrictionOrder {
    /// All orders, in the order of preference.
    pub const ALL: [Self; 3] = [Self::First, Self::TwoElements, Self::Second];
}

/// Whether the plateau of a shear friction grows with the angle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Plateau {
    /// Same plateau at all angles \[NB04, eq. 5\].
    Constant,
    /// Plateau that grows with the sine of the angle, because KES loops widen (2HG5 > 2HG).
    #[default]
    Growing,
}

/// Law that a bending or a shear loop is fitted with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopModel {
    /// Linear backbone with friction, fitted to the whole history \[NB04, eqs. 4–5\].
    Linear(FrictionOrder),
    /// Stiffness that changes along the test, with one friction element, fitted to the whole
    /// history.
    Varying,
    /// Parabola that continues as a straight line, without friction, fitted to the first loading
    /// branch \[BHW94, §5.1\].
    Piecewise,
}

impl Default for LoopModel {
    /// Returns [`LoopModel::Linear`] with one friction element.
    fn default() -> Self {
        Self::Linear(FrictionOrder::First)
    }
}

impl LoopModel {
    /// Returns the law by which sheets, commands and reports name the model.
    #[must_use]
    pub fn law(self) -> Model {
        match self {
            Self::Linear(FrictionOrder::First) => Model::FirstOrder,
            Self::Linear(FrictionOrder::TwoElements) => Model::TwoElements,
            Self::Linear(FrictionOrder::Second) => Model::SecondOrder,
            Self::Varying => Model::Varying,
            Self::Piecewise => Model::Piecewise,
        }
    }

    /// Returns name and description in reports, such as
    /// `"first-order: a line with one friction element"`.
    pub(crate) fn title(self) -> String {
        let law = self.law();
        format!("{}: {}", law.name(), law.description())
    }
}

impl From<Model> for LoopModel {
    /// Returns the model that a `law` of a sheet names.
    fn from(law: Model) -> Self {
        match law {
            Model::FirstOrder => Self::Linear(FrictionOrder::First),
            Model::TwoElements => Self::Linear(FrictionOrder::TwoElements),
            Model::SecondOrder => Self::Linear(FrictionOrder::Second),
            Model::Varying => Self::Varying,
            Model::Piecewise => Self::Piecewise,
        }
    }
}

impl Serialize for LoopModel {
    /// Writes the name of [`LoopModel::law`].
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.law().name())
    }
}

impl<'de> Deserialize<'de> for LoopModel {
    /// Reads the name of a law, as [`Model::named`] does.
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        let names = Model::ALL.map(Model::name).join(", ");
        let unknown = || D::Error::custom(format!("\"{word}\" is no law; the laws are: {names}"));
        Model::named(&word).map(Self::from).ok_or_else(unknown)
    }
}

/// Traction law that a tensile curve is fitted with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TractionModel {
    /// Exponential toe that continues as its tangent, with friction that grows with the tension.
    #[default]
    Exponential,
    /// Priming zone that continues as a straight line, with friction \[NB04, eq. 3\].
    Primed,
    /// Even polynomial, with friction \[THK03, fig. 8a\].
    Polynomial,
}

impl TractionModel {
    /// All models, in the order of preference.
    pub const ALL: [Self; 3] = [Self::Exponential, Self::Primed, Self::Polynomial];

    /// Returns the name in commands, reports and `fabric.toml`, such as `"exponential"`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exponential => "exponential",
            Self::Primed => "primed",
            Self::Polynomial => "polynomial",
        }
    }

    /// Returns what the law is, in a few words for help texts.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::Exponential => {
                "an exponential toe that runs into its tangent, with friction that grows with the \
                 tension"
            }
            Self::Primed => "a priming zone that runs into a line (Ngo Ngoc & Boivin 2004)",
            Self::Polynomial => "an even polynomial (Tagawa et al. 2003)",
        }
    }

    /// Returns the model with the name `word`.
    #[must_use]
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|model| model.name() == word)
    }
}

/// Whether the toe, or the priming zone, becomes longer once the fabric has been stretched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Toe {
    /// Toe of constant length.
    ///
    /// Of the two this predicts the next, larger cycle better: on strips of cupro its peak by 4 to
    /// 13 % too low, with a moving toe by 1 to 19 %.
    #[default]
    Still,
    /// Toe whose end moves with the largest elongation \[NB04, table 1\].
    Moving,
}
