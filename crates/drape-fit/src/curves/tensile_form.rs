//! Parameters of a tensile fit, and the law and forward model that follow from them.

use drape_fabric::{BlimanSorine, Buckling, Polynomial, Primed, TractionBackbone, TractionLaw};
use drape_kes::Curve;

use crate::forward::strip_drive::{drive_slack_strip, drive_strip};
use crate::regression::residuals::ForwardModel;
use crate::settings::Settings;
use crate::settings::model::{Toe, TractionModel};

/// Properties of a tensile curve that decide which parameters it has.
#[derive(Clone, Copy)]
pub(crate) struct StripKind {
    /// Whether the strip hangs slack: the zeros of strain and force are then fitted.
    pub(crate) slack: bool,
    /// Whether the curve has a recovery branch, hence friction.
    pub(crate) recovers: bool,
}

/// Parameters that a tensile fit has.
#[derive(Clone, Copy)]
pub(crate) struct TensileForm {
    pub(crate) model: TractionModel,
    pub(crate) toe: Toe,
    pub(crate) strip: StripKind,
}

/// Zeros of a slack strip.
#[derive(Clone, Copy)]
pub(crate) struct Zeros {
    /// Clamp strain at which the strip becomes taut.
    pub(crate) strain: f64,
    pub(crate) load: f64,
}

/// Law with the zeros of its strip.
struct StripLaw {
    zeros: Option<Zeros>,
    law: TractionLaw,
}

impl TensileForm {
    /// Returns the forms that the settings admit, in the order of preference.
    pub(crate) fn admitted(strip: StripKind, settings: &Settings) -> Vec<Self> {
        use {Toe::*, TractionModel::*};
        // Without recovery the motion of the toe cannot be seen.
        let toe = if strip.recovers { settings.toe } else { Some(Still) };
        let forms = [(Primed, Still), (Primed, Moving), (Polynomial, Still)];
        let wanted = forms.into_iter().filter(|(model, form_toe)| {
            settings.traction.is_none_or(|wanted| wanted == *model)
                && (*model == Polynomial || toe.is_none_or(|wanted| wanted == *form_toe))
        });
        wanted.map(|(model, toe)| Self { model, toe, strip }).collect()
    }

    /// Returns the name used in reports.
    pub(crate) fn name(self) -> &'static str {
        match (self.model, self.toe) {
            (TractionModel::Primed, Toe::Still) => "priming zone",
            (TractionModel::Primed, Toe::Moving) => "priming zone that moves",
            (TractionModel::Polynomial, _) => "even polynomial",
        }
    }

    /// Returns the loads of the form along a curve.
    pub(crate) fn forward<'a>(self, curve: &'a Curve) -> Box<dyn ForwardModel + 'a> {
        Box::new(move |p: &[f64], out: &mut [f64]| {
            let StripLaw { zeros, law } = self.strip_law(p);
            let strains = curve.deformation().iter();
            match zeros {
                Some(zeros) => {
                    drive_slack_strip(&law, strains.map(|measured| measured - zeros.strain), out);
                    out.iter_mut().for_each(|value| *value += zeros.load);
                }
                None => drive_strip(&law, strains.copied(), out),
            }
        })
    }

    /// Returns the law with the parameters of `InitialGuess::starts`.
    pub(crate) fn law(self, p: &[f64]) -> TractionLaw {
        self.strip_law(p).law
    }

    fn strip_law(self, p: &[f64]) -> StripLaw {
        let mut p = p.iter().copied();
        let mut next = || p.next().expect("as many parameters as the starts have");
        let zeros = self.strip.slack.then(|| Zeros { strain: next(), load: next() });
        let backbone = match self.model {
            TractionModel::Primed => {
                let (stiffness, toe_ratio, toe_strain) = (next(), next(), next());
                let growth = if self.toe == Toe::Moving { next() } else { 1.0 };
                let toe_strain_after = growth * toe_strain;
                TractionBackbone::Primed(Primed {
                    stiffness,
                    toe_ratio,
                    toe_strain,
                    toe_strain_after,
                })
            }
            TractionModel::Polynomial => {
                TractionBackbone::Polynomial(Polynomial { quadratic: next(), quartic: next() })
            }
        };
        let friction = match self.strip.recovers {
            true => BlimanSorine::first_order(next(), next()),
            false => BlimanSorine::none(),
        };
        StripLaw { zeros, law: TractionLaw { backbone, friction, buckling: Buckling::default() } }
    }
}
