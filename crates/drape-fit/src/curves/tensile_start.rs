//! Initial guesses of a tensile fit, from the curve itself and linear least squares.
//!
//! ```math
//! F = k\left[f_1(\varepsilon) + (1 - r)\,\frac{f_{0.6} - f_1}{1 - 0.6}\right]
//!     + F_c\,u(\varepsilon)
//! ```
//!
//! For a given end of the priming zone and friction length the load is linear in stiffness `$k$`,
//! `$k$` times toe ratio `$r$`, and plateau `$F_c$`, where `$f_r$` is the backbone of unit
//! stiffness and toe ratio `$r$` and `$u$` the unit friction. Ends and lengths are tried on a grid.

mod exponential;

use std::ops::Range;

use drape_fabric::{
    BlimanSorine, Buckling, Dahl, Polynomial, Primed, TOE_RATIO_MIN, TractionBackbone, TractionLaw,
};
use drape_kes::Curve;
use drape_lm::Parameter;

use crate::curves::features::{StraightLine, falling};
use crate::curves::loop_start::LEAST_LENGTH;
use crate::curves::tensile_form::{FittedZeros, TensileForm, Zeros};
use crate::error::Error;
use crate::forward::strip_drive::drive_strip;
use crate::regression::linear::{LinearFit, Solution};
use crate::regression::residuals::NamedParameter;
use crate::regression::selection::CandidateModel;
use crate::settings::model::{Toe, TractionModel};

/// Ends of the priming zone to start from, over the largest strain.
const TOES: [f64; 5] = [0.12, 0.25, 0.45, 0.7, 1.0];
/// Final ends of a moving priming zone to start from, over the virgin end.
const GROWTHS: [f64; 3] = [1.1, 1.4, 1.8];
/// Friction lengths to start from, over the largest strain.
const LENGTHS: [f64; 4] = [0.005, 0.02, 0.07, 0.25];
/// Number of starts that are searched.
const STARTS: usize = 3;
/// Toe ratio of the second of the two backbones whose combinations have any toe ratio.
const DEEP: f64 = 0.6;
/// Part of the load range by which the load of a slack strip has begun to rise.
const SLACK_LOAD: f64 = 0.02;
/// Part of the first loading branch whose slope leads from a pretension to zero load.
const START: f64 = 0.1;
/// Part of the first loading branch above which its slope is read.
const UPPER: f64 = 0.6;

/// Features of a tensile curve before any search.
pub(crate) struct InitialGuess {
    /// Whether the curve has a recovery branch.
    pub(crate) recovers: bool,
    /// Strain and load at which the strip becomes taut.
    pub(crate) zero: Zeros,
    /// Largest strain, from there.
    top_strain: f64,
    /// Largest load, from there.
    top_load: f64,
    /// Slope of the upper part of the first loading branch.
    stiffness: f64,
    /// Strains from where the strip becomes taut; zero while it is slack.
    strains: Vec<f64>,
    load: Vec<f64>,
}

/// Initial guess, with the sum of squares that it leaves.
struct Start {
    residual_sum: f64,
    /// Values of the parameters of the law, in the order of [`InitialGuess::bounds`].
    values: Vec<f64>,
}

/// Linear combination of backbone columns and a friction column.
struct Combination {
    residual_sum: f64,
    coefficients: Vec<f64>,
    /// Length of the friction, zero without friction.
    length: f64,
}

impl InitialGuess {
    /// Returns the features of `curve`. Fails if its load does not rise, or if it has too few
    /// points for the lines through its parts.
    pub(crate) fn new(curve: &Curve) -> Result<Self, Error> {
        /// Number of points that give a line through the start of a loading branch and a line
        /// through its end.
        const POINTS_MIN: usize = 4;

        let points = curve.load().len();
        if points < POINTS_MIN {
            let name = curve.name.clone();
            return Err(Error::TooFewPoints { name, points, needed: POINTS_MIN });
        }
        let (strain, load) = (curve.deformation(), curve.load());
        let branches = curve.branches();
        let loading = branches.first().filter(|branch| branch.rising);
        let loading = loading.ok_or_else(|| falling(curve))?.points.clone();
        let zeros = FittedZeros::from_curve(curve);
        let zero = match zeros {
            FittedZeros::None => Zeros { strain: 0.0, load: 0.0 },
            FittedZeros::Strain => Zeros { strain: unloaded(curve, &loading)?, load: 0.0 },
            FittedZeros::StrainAndLoad => taut(curve, &loading),
        };
        let top_strain = curve.deformation_range().high - zero.strain;
        let top_load = curve.load_range().high - zero.load;
        if !(top_strain > 0.0 && top_load > 0.0) {
            return Err(falling(curve));
        }

        let upper = zero.strain + UPPER * (strain[loading.end - 1] - zero.strain);
        let points = loading.filter(|&i| strain[i] >= upper).map(|i| [strain[i], load[i]]);
        let stiffness = StraightLine::through(points).map(|line| line.slope);
        let stiffness = stiffness.filter(|k| *k > 0.0).ok_or_else(|| falling(curve))?;
        let strains = strain
            .iter()
            .map(|strain| strain - zero.strain)
            .map(|strain| if curve.slack { strain.max(0.0) } else { strain })
            .collect();
        Ok(Self {
            recovers: branches.len() > 1,
            zero,
            top_strain,
            top_load,
            stiffness,
            strains,
            load: load.iter().map(|load| load - zero.load).collect(),
        })
    }

    /// Returns the candidate of `form` on `curve`.
    pub(crate) fn model<'a>(&self, form: TensileForm, curve: &'a Curve) -> CandidateModel<'a> {
        CandidateModel {
            name: form.name(),
            starts: self.starts(&form),
            prediction: None,
            forward: form.forward(curve),
        }
    }

    /// Returns the guesses of `form` on the grid that follow the curve best.
    fn starts(&self, form: &TensileForm) -> Vec<Vec<NamedParameter>> {
        let mut starts = match (form.model, form.toe) {
            (TractionModel::Exponential, _) => self.exponentials(form),
            (TractionModel::Polynomial, _) => self.polynomials(form),
            (TractionModel::Primed, Toe::Still) => self.primed(form, &[1.0]),
            (TractionModel::Primed, Toe::Moving) => self.primed(form, &GROWTHS),
        };
        starts.sort_by(|a, b| a.residual_sum.total_cmp(&b.residual_sum));
        starts.truncate(STARTS);
        if starts.is_empty() {
            starts.push(self.fallback(form));
        }
        starts.iter().map(|start| self.named_parameters(form, start)).collect()
    }

    /// Returns the guess with the best friction length for each end of the priming zone and each of
    /// `growths`.
    fn primed(&self, form: &TensileForm, growths: &[f64]) -> Vec<Start> {
        let top = self.top_strain;
        let start = |toe: f64, growth: f64| {
            let law = |stiffness: f64, toe_ratio: f64, friction: BlimanSorine| TractionLaw {
                backbone: TractionBackbone::Primed(Primed {
                    stiffness,
                    toe_ratio,
                    toe_strain: toe * top,
                    toe_strain_after: growth * toe * top,
                }),
                friction: friction.into(),
                buckling: Buckling::default(),
            };
            let mut columns = vec![
                self.column(&law(1.0, 1.0, BlimanSorine::none())),
                self.column(&law(1.0, DEEP, BlimanSorine::none())),
            ];
            let frictions = self.frictions(form);
            columns
                .extend(frictions.iter().map(|friction| self.column(&law(0.0, DEEP, *friction))));
            let Combination { residual_sum, coefficients: c, length } =
                self.best(&columns, 2, form)?;
            // The load is linear in the toe ratio r: 1 − r belongs to the second backbone, times
            // its part.
            let stiffness = c[0] + c[1];
            let ratio = 1.0 - (1.0 - DEEP) * c[1] / stiffness;
            let mut values = vec![stiffness, ratio.clamp(1.05 * TOE_RATIO_MIN, 0.98), toe * top];
            values.extend((form.toe == Toe::Moving).then_some(growth));
            values.extend(c.get(2).into_iter().flat_map(|plateau| [*plateau, length]));
            (stiffness > 0.0).then_some(Start { residual_sum, values })
        };
        let pairs = TOES.iter().flat_map(|&toe| growths.iter().map(move |&growth| (toe, growth)));
        pairs.filter_map(|(toe, growth)| start(toe, growth)).collect()
    }

    /// Returns the best polynomial over all friction lengths.
    fn polynomials(&self, form: &TensileForm) -> Vec<Start> {
        let law = |quadratic: f64, quartic: f64, friction: BlimanSorine| TractionLaw {
            backbone: TractionBackbone::Polynomial(Polynomial { quadratic, quartic }),
            friction: friction.into(),
            buckling: Buckling::default(),
        };
        let mut columns = vec![
            self.column(&law(1.0, 0.0, BlimanSorine::none())),
            self.column(&law(0.0, 1.0, BlimanSorine::none())),
        ];
        let frictions = self.frictions(form);
        columns.extend(frictions.iter().map(|friction| self.column(&law(0.0, 0.0, *friction))));
        let best = self.best(&columns, 2, form);
        let start = best.map(|best| {
            let Combination { residual_sum, coefficients: c, length } = best;
            let mut values = vec![c[0].max(0.0), c[1].max(0.0)];
            values.extend(c.get(2).into_iter().flat_map(|plateau| [*plateau, length]));
            Start { residual_sum, values }
        });
        start.into_iter().collect()
    }

    /// Returns the loads of a law along the curve.
    fn column(&self, law: &TractionLaw) -> Vec<f64> {
        let mut out = vec![0.0; self.strains.len()];
        drive_strip(law, self.strains.iter().copied(), &mut out);
        out
    }

    /// Returns the frictions of unit plateau on the grid of lengths; none for a `form` without
    /// recovery.
    fn frictions(&self, form: &TensileForm) -> Vec<BlimanSorine> {
        let lengths = if form.strip.recovers { &LENGTHS[..] } else { &[] };
        lengths
            .iter()
            .map(|part| Dahl { plateau: 1.0, length: part * self.top_strain }.into())
            .collect()
    }

    /// Returns the best combination of the backbone columns, which are the first `backbone_columns`
    /// of `columns`, with one of the friction columns.
    fn best(
        &self,
        columns: &[Vec<f64>],
        backbone_columns: usize,
        form: &TensileForm,
    ) -> Option<Combination> {
        let fit = LinearFit::new(columns, &self.load);
        let backbone: Vec<usize> = (0..backbone_columns).collect();
        if !form.strip.recovers {
            let Solution { coefficients, residual_sum } = fit.solve(&backbone)?;
            return Some(Combination { residual_sum, coefficients, length: 0.0 });
        }

        let mut best: Option<Combination> = None;
        for (i, part) in LENGTHS.iter().enumerate() {
            let columns = [&backbone[..], &[backbone_columns + i]].concat();
            let Some(Solution { coefficients, residual_sum }) = fit.solve(&columns) else {
                continue;
            };
            let is_better = best.as_ref().is_none_or(|best| residual_sum < best.residual_sum);
            if coefficients[backbone_columns] > 0.0 && is_better {
                best = Some(Combination {
                    residual_sum,
                    coefficients,
                    length: part * self.top_strain,
                });
            }
        }
        best
    }

    /// Returns the guess of `form` for a curve whose linear fit has no solution.
    fn fallback(&self, form: &TensileForm) -> Start {
        let (strain, load) = (self.top_strain, self.top_load);
        let moves = form.toe == Toe::Moving;
        let mut values = match form.model {
            TractionModel::Exponential => return self.exponential_fallback(form),
            TractionModel::Primed => vec![self.stiffness, 0.7, 0.5 * strain],
            TractionModel::Polynomial => {
                vec![0.5 * load / strain.powi(2), 0.5 * load / strain.powi(4)]
            }
        };
        values.extend((moves && form.model == TractionModel::Primed).then_some(1.2));
        if form.strip.recovers {
            values.extend([0.02 * load, 0.05 * strain]);
        }
        Start { residual_sum: 0.0, values }
    }

    /// Returns the parameters of a fit with the values of a `start`.
    fn named_parameters(&self, form: &TensileForm, start: &Start) -> Vec<NamedParameter> {
        let mut named = self.zeros(form.strip.zeros);
        for (bounds, value) in self.bounds(form).into_iter().zip(&start.values) {
            let parameter = Parameter { start: *value, ..bounds.parameter };
            named.push(NamedParameter { parameter, ..bounds });
        }
        named
    }

    /// Returns names, scales and bounds of the parameters of the law of `form`, in the order in
    /// which [`TensileForm::law`] takes them.
    fn bounds(&self, form: &TensileForm) -> Vec<NamedParameter> {
        if form.model == TractionModel::Exponential {
            return self.exponential_bounds(form);
        }
        let mut named = Vec::new();
        let mut push = |name, parameter| named.push(NamedParameter::new(name, parameter));
        let (strain, load) = (self.top_strain, self.top_load);

        if form.model == TractionModel::Primed {
            let k = self.stiffness;
            push("stiffness", Parameter::new(k).between(1e-2 * k, 1e2 * k));
            push("toe_ratio", Parameter::new(0.7).between(TOE_RATIO_MIN, 1.0));
            push("toe_strain", Parameter::new(0.5 * strain).between(1e-3 * strain, strain));
            if form.toe == Toe::Moving {
                push("toe_growth", Parameter::new(1.2).between(1.0, 2.0));
            }
        } else {
            for (name, power) in [("quadratic", 2), ("quartic", 4)] {
                let size = load / strain.powi(power);
                let term = Parameter::new(0.0).with_scale(0.01 * size).between(0.0, 10.0 * size);
                push(name, term);
            }
        }
        if form.strip.recovers {
            push("plateau", Parameter::new(0.0).with_scale(0.01 * load).between(0.0, load));
            push("length", self.length());
        }
        named
    }

    /// Returns the friction length as a parameter.
    fn length(&self) -> Parameter {
        let strain = self.top_strain;
        Parameter::new(0.05 * strain).between(LEAST_LENGTH * strain, 5.0 * strain)
    }

    /// Returns the zeros that are fitted as parameters.
    fn zeros(&self, zeros: FittedZeros) -> Vec<NamedParameter> {
        let around = |value: f64, half: f64| {
            Parameter::new(value).with_scale(half).between(value - half, value + half)
        };
        let strain =
            NamedParameter::new("free strain", around(self.zero.strain, 0.3 * self.top_strain));
        let load = NamedParameter::new("zero", around(self.zero.load, 0.2 * self.top_load));
        match zeros {
            FittedZeros::None => Vec::new(),
            FittedZeros::Strain => vec![strain],
            FittedZeros::StrainAndLoad => vec![strain, load],
        }
    }
}

/// Returns the strain at which a strip that begins under a load carries nothing, by the slope of
/// the start of its first loading branch.
fn unloaded(curve: &Curve, loading: &Range<usize>) -> Result<f64, Error> {
    let (strain, load) = (curve.deformation(), curve.load());
    let last = strain[loading.end - 1];
    let end = strain[loading.start] + START * (last - strain[loading.start]);
    let points = loading.clone().filter(|&i| strain[i] <= end).map(|i| [strain[i], load[i]]);
    let slope = StraightLine::through(points).map(|line| line.slope).filter(|slope| *slope > 0.0);
    let slope = slope.ok_or_else(|| falling(curve))?;
    // A toe is flatter below, so the strip carries nothing further away.
    let below = load[loading.start] / slope;
    Ok(strain[loading.start] - below.min(last - strain[loading.start]))
}

/// Returns strain and load at which a slack strip becomes taut on its first loading branch.
fn taut(curve: &Curve, loading: &Range<usize>) -> Zeros {
    let (strain, load) = (curve.deformation(), curve.load());
    let span = curve.load_range().span();
    let risen = |&i: &usize| load[i] > load[loading.start] + SLACK_LOAD * span;
    let first = loading.clone().find(risen).unwrap_or(loading.start);
    let taut = first.saturating_sub(1);
    let before = &load[loading.start..=taut];
    Zeros { strain: strain[taut], load: before.iter().sum::<f64>() / before.len() as f64 }
}

#[cfg(test)]
mod tests {
    use drape_kes::{Direction, Test};

    use super::*;
    use crate::curves::tensile_form::{StripKind, Terms};

    #[test]
    fn a_guess_follows_a_curve_whose_toe_and_friction_are_of_the_grid() {
        let top = 0.04;
        // The recovery ends before the strip is slack. Friction of a guess has the toe ratio DEEP.
        let strain: Vec<f64> =
            (0..=80).map(|k| 0.02 * top * f64::from(if k <= 50 { k } else { 100 - k })).collect();
        for (toe, growth) in [(TOES[2], 1.0), (TOES[1], GROWTHS[1])] {
            let law = TractionLaw {
                backbone: TractionBackbone::Primed(Primed {
                    stiffness: 20_000.0,
                    toe_ratio: DEEP,
                    toe_strain: toe * top,
                    toe_strain_after: growth * toe * top,
                }),
                friction: BlimanSorine::first_order(12.0, LENGTHS[2] * top)
                    .expect("a friction")
                    .into(),
                buckling: Buckling::default(),
            };
            let mut load = vec![0.0; strain.len()];
            drive_strip(&law, strain.iter().copied(), &mut load);
            let curve = Curve::new(Test::Tensile, Direction::Warp, strain.clone(), load);
            let guess = InitialGuess::new(&curve.expect("a curve")).expect("it rises");
            let strip = StripKind { zeros: FittedZeros::None, recovers: true };
            let moves = growth > 1.0;
            let toe_form = if moves { Toe::Moving } else { Toe::Still };
            let (model, terms) = (TractionModel::Primed, Terms::All);
            let form = TensileForm { model, toe: toe_form, terms, strip };
            let growths = if moves { &GROWTHS[..] } else { &[1.0] };
            let starts = guess.primed(&form, growths);
            let best = starts.iter().min_by(|a, b| a.residual_sum.total_cmp(&b.residual_sum));
            let best = best.expect("a guess");
            let found = &best.values;
            let mut exact = vec![20_000.0, DEEP, toe * top];
            exact.extend(moves.then_some(growth));
            exact.extend([12.0, LENGTHS[2] * top]);
            assert_eq!(found.len(), exact.len());
            for (found, exact) in found.iter().zip(exact) {
                assert!((found / exact - 1.0).abs() < 1e-6, "{found} is not {exact}");
            }
        }
    }
}
