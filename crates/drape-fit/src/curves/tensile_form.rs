//! Parameters of a tensile fit, and the law and forward model that follow from them.

use drape_fabric::{
    BlimanSorine, Buckling, Dahl, ExponentialToe, Polynomial, Primed, ProportionalFriction,
    STEEPNESS_MIN, TractionBackbone, TractionFriction, TractionLaw,
};
use drape_kes::Curve;

use crate::forward::strip_drive::{drive_slack_strip, drive_strip};
use crate::regression::residuals::ForwardModel;
use crate::settings::FitSettings;
use crate::settings::model::{Toe, TractionModel};

/// Largest strain over which a yarn may buckle for the sake of its friction without tension.
///
/// The load rises in compression only if the plateau is at most the stiffness at rest times this
/// strain: with more, a cloth would carry compression over strains at which it was never measured.
const LARGEST_BUCKLING: f64 = 0.05;

/// Zeros of a tensile curve that are fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FittedZeros {
    /// None: the curve begins at zero strain without load.
    None,
    /// The strain at which the strip carries nothing, below the start of a test that begins under a
    /// pretension.
    Strain,
    /// The strain at which a slack strip becomes taut, and the zero of the force.
    StrainAndLoad,
}

impl FittedZeros {
    /// Returns the zeros that are fitted to `curve`.
    pub(crate) fn from_curve(curve: &Curve) -> Self {
        if curve.slack {
            Self::StrainAndLoad
        } else if curve.has_pretension() {
            Self::Strain
        } else {
            Self::None
        }
    }
}

/// Properties of a tensile curve that decide which parameters it has.
#[derive(Clone, Copy)]
pub(crate) struct StripKind {
    /// Zeros that are fitted.
    pub(crate) zeros: FittedZeros,
    /// Whether the curve has a recovery branch, hence friction.
    pub(crate) recovers: bool,
}

/// Terms of a law with an exponential toe that may be left out.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Terms {
    /// The toe, and friction in proportion to the elastic load.
    ToeOnly,
    /// The toe beside a line.
    ToeAndLine,
    /// The toe beside a line, and friction with a constant part.
    All,
}

/// Parameters that a tensile fit has.
#[derive(Clone, Copy)]
pub(crate) struct TensileForm {
    pub(crate) model: TractionModel,
    pub(crate) toe: Toe,
    /// Terms of a [`TractionModel::Exponential`]. Other models have all of their terms.
    pub(crate) terms: Terms,
    pub(crate) strip: StripKind,
}

/// Zeros of a strip.
#[derive(Clone, Copy)]
pub(crate) struct Zeros {
    /// Strain of the curve at which the strip becomes taut.
    pub(crate) strain: f64,
    pub(crate) load: f64,
}

/// Law with the zeros of its strip.
struct StripLaw {
    zeros: Zeros,
    law: TractionLaw,
}

impl TensileForm {
    /// Returns the forms that `settings` admit for a `strip`, in the order of preference: forms of
    /// few parameters first.
    pub(crate) fn admitted(strip: StripKind, settings: &FitSettings) -> Vec<Self> {
        use {Terms::*, Toe::*, TractionModel::*};
        // Without recovery the motion of the toe cannot be seen, nor a friction.
        let toe = if strip.recovers { settings.toe } else { Some(Still) };
        let forms = [
            (Exponential, Still, ToeOnly),
            (Primed, Still, All),
            (Exponential, Still, ToeAndLine),
            (Exponential, Still, All),
            (Exponential, Moving, ToeOnly),
            (Primed, Moving, All),
            (Exponential, Moving, All),
            (Polynomial, Still, All),
        ];

        let wanted = forms.into_iter().filter(|(model, form_toe, terms)| {
            settings.traction.is_none_or(|wanted| wanted == *model)
                && (*model == Polynomial || toe.is_none_or(|wanted| wanted == *form_toe))
                && (strip.recovers || *model != Exponential || *terms != All)
        });
        wanted.map(|(model, toe, terms)| Self { model, toe, terms, strip }).collect()
    }

    /// Returns the name in reports, such as `"primed: a priming zone"`.
    pub(crate) fn name(self) -> String {
        let parts = match (self.model, self.toe, self.terms) {
            (TractionModel::Exponential, Toe::Still, Terms::ToeOnly) => "a toe",
            (TractionModel::Exponential, Toe::Still, Terms::ToeAndLine) => "a toe and a line",
            (TractionModel::Exponential, Toe::Still, Terms::All) => {
                "a toe and a line, friction with a constant part"
            }
            (TractionModel::Exponential, Toe::Moving, Terms::All) => {
                "a toe that moves and a line, friction with a constant part"
            }
            (TractionModel::Exponential, Toe::Moving, _) => "a toe that moves",
            (TractionModel::Primed, Toe::Still, _) => "a priming zone",
            (TractionModel::Primed, Toe::Moving, _) => "a priming zone that moves",
            (TractionModel::Polynomial, ..) => "even powers",
        };
        format!("{}: {parts}", self.model.name())
    }

    /// Returns whether a line lies beside an exponential toe: `terms` are more than the toe.
    pub(crate) fn has_line(self) -> bool {
        self.terms != Terms::ToeOnly
    }

    /// Returns whether the friction beside an exponential toe has a constant part.
    pub(crate) fn has_plateau(self) -> bool {
        self.terms == Terms::All
    }

    /// Returns the loads of the form along `curve`.
    pub(crate) fn forward<'a>(self, curve: &'a Curve) -> Box<dyn ForwardModel + 'a> {
        Box::new(move |p: &[f64], out: &mut [f64]| {
            let StripLaw { zeros, law } = self.strip_law(p);
            let strains = curve.deformation().iter().map(|measured| measured - zeros.strain);
            if self.strip.zeros == FittedZeros::StrainAndLoad {
                drive_slack_strip(&law, strains, out);
                out.iter_mut().for_each(|value| *value += zeros.load);
            } else {
                drive_strip(&law, strains, out);
            }
        })
    }

    /// Returns the law with the parameters `p` of `InitialGuess::starts`.
    pub(crate) fn law(self, p: &[f64]) -> TractionLaw {
        self.strip_law(p).law
    }

    /// Returns the law and the zeros with the parameters `p`.
    fn strip_law(self, p: &[f64]) -> StripLaw {
        let mut p = Parameters(p);
        let zeros = match self.strip.zeros {
            FittedZeros::None => Zeros { strain: 0.0, load: 0.0 },
            FittedZeros::Strain => Zeros { strain: p.next(), load: 0.0 },
            FittedZeros::StrainAndLoad => Zeros { strain: p.next(), load: p.next() },
        };

        let law = match self.model {
            TractionModel::Exponential => self.exponential(&mut p),
            TractionModel::Primed => {
                let (stiffness, toe_ratio, toe_strain) = (p.next(), p.next(), p.next());
                let toe_strain_after = toe_strain * p.next_if(self.toe == Toe::Moving, 1.0);
                let primed = Primed { stiffness, toe_ratio, toe_strain, toe_strain_after };
                self.with_plateau(TractionBackbone::Primed(primed), &mut p)
            }
            TractionModel::Polynomial => {
                let polynomial = Polynomial { quadratic: p.next(), quartic: p.next() };
                self.with_plateau(TractionBackbone::Polynomial(polynomial), &mut p)
            }
        };
        StripLaw { zeros, law }
    }

    /// Returns the law with an exponential toe, and the next parameters of `p`.
    fn exponential(self, p: &mut Parameters<'_>) -> TractionLaw {
        let (stiffness, steepness, toe_strain) = (p.next(), p.next(), p.next());
        let toe = ExponentialToe {
            stiffness,
            steepness: steepness.max(STEEPNESS_MIN),
            toe_strain,
            toe_strain_after: toe_strain * p.next_if(self.toe == Toe::Moving, 1.0),
            base_stiffness: p.next_if(self.has_line(), 0.0),
        };

        let friction = if self.strip.recovers {
            let (ratio, length) = (p.next(), p.next());
            let most = LARGEST_BUCKLING * toe.rest_stiffness();
            let plateau = p.next_if(self.has_plateau(), 0.0).min(most);
            ProportionalFriction { ratio, plateau, length }
        } else {
            ProportionalFriction { ratio: 0.0, plateau: 0.0, length: toe_strain }
        };
        let strain = friction.buckling_strain(&toe);
        TractionLaw {
            backbone: TractionBackbone::Exponential(toe),
            friction: TractionFriction::Proportional(friction),
            buckling: Buckling { strain, ..Buckling::default() },
        }
    }

    /// Returns the law with a `backbone` of the papers and a friction with a plateau.
    fn with_plateau(self, backbone: TractionBackbone, p: &mut Parameters<'_>) -> TractionLaw {
        let friction = if self.strip.recovers {
            Dahl { plateau: p.next(), length: p.next() }.into()
        } else {
            BlimanSorine::none()
        };
        TractionLaw { backbone, friction: friction.into(), buckling: Buckling::default() }
    }
}

/// Parameters that are taken one after the other.
struct Parameters<'a>(&'a [f64]);

impl Parameters<'_> {
    /// Returns the next parameter.
    fn next(&mut self) -> f64 {
        let (first, rest) = self.0.split_first().expect("as many parameters as the starts have");
        self.0 = rest;
        *first
    }

    /// Returns the next parameter if it `is_fitted`, and its value in the law otherwise.
    fn next_if(&mut self, is_fitted: bool, otherwise: f64) -> f64 {
        if is_fitted { self.next() } else { otherwise }
    }
}
