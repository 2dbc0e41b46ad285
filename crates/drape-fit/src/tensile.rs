//! The traction law from a tensile curve.

use drape_fabric::{BlimanSorine, Buckling, Polynomial, Primed, TractionBackbone, TractionLaw};
use drape_kes::{Curve, Test};

use crate::choice::{Model, Predict};
use crate::curve_fit::{self, Identified};
use crate::prediction::{last_cycle, predict};
use crate::pull::{along, along_slack};
use crate::tensile_start::Guess;
use crate::{Error, Settings};

/// Which elastic load a tensile curve is fitted with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TractionModel {
    /// A priming zone that runs into a line, with friction [Ngo Ngoc & Boivin 2004, eq. 3].
    #[default]
    Primed,
    /// An even polynomial, with friction [Tagawa et al. 2003, fig. 8a].
    Polynomial,
}

/// Whether the priming zone becomes longer once the fabric has been stretched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Toe {
    /// It stays as it is.
    ///
    /// Of the two this predicts the next, larger cycle better: on strips of cupro its peak by 4 to 13 % too low,
    /// with a moving toe by 1 to 19 %.
    #[default]
    Still,
    /// Its end moves with the largest elongation [Ngo Ngoc & Boivin 2004, table 1].
    Moving,
}

/// Identifies the traction law of one direction from a tensile curve, along its whole history.
///
/// Of a strip that hung slack, the strain at which it becomes taut and the zero of the force are fitted too.
/// A curve that never turns back says nothing of friction, nor of how the fabric changes once it has been
/// stretched: the law then has no friction, and a toe that does not move.
///
/// Where a last cycle goes further than those before, a law is taken only if it also predicts that cycle better
/// than the laws preferred to it do ([`predict_last_cycle`](crate::predict_last_cycle)): a toe that moves fits
/// any two cycles better, because it makes up for a line that is too straight, and may then miss the third by
/// more.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_tensile(
    curve: &Curve,
    settings: &Settings,
) -> Result<Identified<TractionLaw>, Error> {
    curve_fit::expect(curve, Test::Tensile)?;
    let guess = Guess::new(curve)?;
    let forms = forms(curve.slack, guess.recovers, settings);
    let predicted = predictions(curve, &forms);
    let model = |(form, prediction): (&Form, &Option<f64>)| Model {
        prediction: *prediction,
        ..form.model(curve, &guess)
    };
    let models: Vec<Model<'_>> = forms.iter().zip(&predicted).map(model).collect();
    let weights = settings.weighting.weights(curve, guess.zero.0);
    let fit = curve_fit::fit(curve, &models, (weights, settings.intervals));
    Ok(Identified { law: forms[fit.chosen].law(&fit.values()).1, fit })
}

/// How the forms predict the last cycle, where there is one and several to choose from.
fn predictions(curve: &Curve, forms: &[Form]) -> Vec<Option<f64>> {
    let last = last_cycle(curve).filter(|_| forms.len() > 1);
    // Earlier cycles that give no law are none to choose by.
    let found = last.and_then(|last| predict(curve, last, forms).ok());
    match found {
        Some(found) => found.iter().map(|prediction| Some(prediction.error)).collect(),
        None => vec![None; forms.len()],
    }
}

/// The forms that the settings leave to choose from, in the order in which they are preferred.
pub(crate) fn forms(slack: bool, recovers: bool, settings: &Settings) -> Vec<Form> {
    use {Toe::*, TractionModel::*};
    // A toe that never went back shows no motion.
    let toe = if recovers { settings.toe } else { Some(Still) };
    let forms = [(Primed, Still), (Primed, Moving), (Polynomial, Still)];
    let wanted = forms.into_iter().filter(|(model, form_toe)| {
        settings.traction.is_none_or(|wanted| wanted == *model)
            && (*model == Polynomial || toe.is_none_or(|wanted| wanted == *form_toe))
    });
    let form = |(model, toe)| Form { model, toe, slack, recovers };
    wanted.map(form).collect()
}

/// Which parameters a tensile fit has.
#[derive(Clone, Copy)]
pub(crate) struct Form {
    pub model: TractionModel,
    pub toe: Toe,
    /// Whether the zeros of strain and force are fitted.
    pub slack: bool,
    /// Whether there is a way back, hence friction.
    pub recovers: bool,
}

impl Form {
    fn words(self) -> &'static str {
        match (self.model, self.toe) {
            (TractionModel::Primed, Toe::Still) => "priming zone",
            (TractionModel::Primed, Toe::Moving) => "priming zone that moves",
            (TractionModel::Polynomial, _) => "even polynomial",
        }
    }

    pub fn model<'a>(self, curve: &'a Curve, guess: &Guess) -> Model<'a> {
        Model {
            name: self.words().into(),
            starts: guess.starts(&self),
            prediction: None,
            predict: self.along(curve),
        }
    }

    /// The loads of the form along a curve.
    pub fn along<'a>(self, curve: &'a Curve) -> Box<dyn Predict + 'a> {
        Box::new(move |p: &[f64], out: &mut [f64]| {
            let (zeros, law) = self.law(p);
            let strains = curve.deformation().iter();
            match zeros {
                Some([strain, load]) => {
                    along_slack(&law, strains.map(|measured| measured - strain), out);
                    out.iter_mut().for_each(|value| *value += load);
                }
                None => along(&law, strains.copied(), out),
            }
        })
    }

    /// The zeros of strain and load, and the law, with the parameters of [`Guess::starts`].
    fn law(&self, p: &[f64]) -> (Option<[f64; 2]>, TractionLaw) {
        let mut p = p.iter().copied();
        let mut next = || p.next().expect("as many parameters as the starts have");
        let zeros = self.slack.then(|| [next(), next()]);
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
        let friction = match self.recovers {
            true => BlimanSorine::first_order(next(), next()),
            false => BlimanSorine::none(),
        };
        (zeros, TractionLaw { backbone, friction, buckling: Buckling::default() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_kes::Direction;

    fn primed() -> Settings {
        Settings { traction: Some(TractionModel::Primed), ..Settings::default() }
    }

    /// Three growing cycles of a strip that hangs slack by 2 % between them.
    fn clamps(top: f64) -> Vec<f64> {
        let turns = [-0.02, 0.6 * top, -0.02, 0.8 * top, -0.02, top, -0.02];
        let steps = 60;
        let branch = |ends: &[f64]| {
            let (from, to) = (ends[0], ends[1]);
            (0..steps).map(move |i| from + (to - from) * f64::from(i) / f64::from(steps))
        };
        turns.windows(2).flat_map(branch).collect()
    }

    #[test]
    fn a_slack_strip_gives_its_law_and_both_of_its_zeros() {
        for (toe_ratio, toe, growth) in [(0.55, 0.02, 1.3), (0.7, 0.012, 1.6), (0.8, 0.025, 1.15)] {
            let (top, free_strain, zero) = (0.04, 0.003, 0.4);
            let exact = TractionLaw {
                backbone: TractionBackbone::Primed(Primed {
                    stiffness: 6e3,
                    toe_ratio,
                    toe_strain: toe,
                    toe_strain_after: growth * toe,
                }),
                friction: BlimanSorine::first_order(4.0, 0.002),
                buckling: Buckling::default(),
            };
            let taut = clamps(top);
            let mut load = vec![0.0; taut.len()];
            along_slack(&exact, taut.iter().copied(), &mut load);
            let load = load.iter().map(|load| load + zero).collect();
            let strain = taut.iter().map(|strain| strain + free_strain).collect();
            let mut curve = Curve::new(Test::Tensile, Direction::Warp, strain, load).unwrap();
            curve.slack = true;
            let found = identify_tensile(&curve, &primed()).unwrap();
            let truth = [free_strain, zero, 6e3, toe_ratio, toe, growth, 4.0, 0.002];
            for (estimate, exact) in found.fit.parameters.iter().zip(truth) {
                let (name, value) = (estimate.name, estimate.value);
                let error = (value / exact - 1.0).abs();
                assert!(error < 1e-6, "{name} is {value:e}, exactly {exact:e}; {:?}", found.fit);
            }
        }
    }

    #[test]
    fn a_pull_into_compression_is_refused() {
        let strain = vec![-0.03, -0.02, -0.01];
        let load = vec![-3.0, -2.0, -1.0];
        let curve = Curve::new(Test::Tensile, Direction::Weft, strain, load).unwrap();
        let result = identify_tensile(&curve, &primed());
        assert!(matches!(result, Err(Error::Falling { .. })), "{result:?}");
    }

    #[test]
    fn a_pull_without_a_way_back_gives_no_friction_and_a_toe_that_does_not_move() {
        let strain: Vec<f64> = (0..=50).map(|i| 0.001 * f64::from(i)).collect();
        let load = strain.iter().map(|e| 4e3 * e + 5e4 * e * e).collect();
        let curve = Curve::new(Test::Tensile, Direction::Weft, strain, load).unwrap();
        let law = identify_tensile(&curve, &primed()).unwrap().law;
        assert_eq!(law.friction, BlimanSorine::none());
        let TractionBackbone::Primed(primed) = law.backbone else { panic!("primed was asked for") };
        assert_eq!(primed.toe_strain, primed.toe_strain_after);
    }
}
