//! The traction law from a tensile curve.

use drape_fabric::{
    BlimanSorine, Buckling, Polynomial, Primed, TOE_RATIO_MIN, TractionBackbone, TractionLaw,
};
use drape_kes::{Curve, Test};

use crate::Error;
use crate::bending::{LEAST_LENGTH, falling, span};
use crate::curve_fit::{self, Identified, Named, line};
use crate::history::{along, along_slack};
use crate::lm::Parameter;

/// Toe ratios to start from: a deep toe, and a shallow one.
const TOE_RATIO_STARTS: [f64; 2] = [0.55, 0.8];
/// Toes to start from, over the largest strain.
const TOE_STARTS: [f64; 3] = [0.2, 0.5, 1.0];
/// Pre-sliding lengths to start from, over the largest strain.
///
/// Without a toe, whose friction begins small, a search from afar may mistake the length for none.
const PRIMED_LENGTH_STARTS: [f64; 1] = [0.05];
const POLYNOMIAL_LENGTH_STARTS: [f64; 3] = [0.01, 0.05, 0.2];
/// Part of the load range by which a slack strip's load has begun to rise.
const SLACK_LOAD: f64 = 0.02;

/// Misfit with a toe that moves over misfit with one that does not, below which the motion is believed.
///
/// The motion is one more parameter: it lowers the misfit of pure noise by about one part in as many as there
/// are points, some hundred.
const MOVING_TOE: f64 = 0.98;

/// Which elastic load a tensile curve is fitted with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TractionModel {
    /// A priming zone that runs into a line, with friction [Ngo Ngoc & Boivin 2004, eq. 3].
    #[default]
    Primed,
    /// An even polynomial, with friction [Tagawa et al. 2003, fig. 8a].
    Polynomial,
}

/// Identifies the traction law of one direction from a tensile curve, along its whole history.
///
/// Of a strip that hung slack, the strain at which it becomes taut and the zero of the force are fitted too.
/// A curve that never turns back says nothing of friction, nor of how the fabric changes once it has been
/// stretched: the law then has no friction, and a toe that does not move. The toe does not move either where
/// its motion hardly improves the fit, as when the whole curve lies within the toe.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_tensile(
    curve: &Curve,
    model: TractionModel,
) -> Result<Identified<TractionLaw>, Error> {
    curve_fit::expect(curve, Test::Tensile)?;
    let guess = Guess::new(curve)?;
    let (slack, recovers) = (curve.slack, guess.recovers);
    let moves = recovers && model == TractionModel::Primed;
    let form = Form {
        model,
        slack,
        recovers,
        moves,
    };
    let found = form.identify(curve, &guess.starts(&form));
    if !moves {
        return Ok(found);
    }
    let form = Form {
        moves: false,
        ..form
    };
    let still = form.identify(curve, &[guess.start_from(&form, &found.fit.parameters)]);
    let better = found.fit.misfit < MOVING_TOE * still.fit.misfit;
    Ok(if better { found } else { still })
}

/// Which parameters a tensile fit has.
#[derive(Clone, Copy)]
struct Form {
    model: TractionModel,
    /// Whether the zeros of strain and force are fitted.
    slack: bool,
    /// Whether there is a way back, hence friction.
    recovers: bool,
    /// Whether the toe moves once the fabric has been stretched.
    moves: bool,
}

impl Form {
    fn identify(&self, curve: &Curve, starts: &[Vec<Named>]) -> Identified<TractionLaw> {
        let fit = curve_fit::fit(curve, starts, |p, out| {
            let (zeros, law) = self.law(p);
            let strains = curve.deformation().iter();
            match zeros {
                Some([strain, load]) => {
                    along_slack(&law, strains.map(|measured| measured - strain), out);
                    out.iter_mut().for_each(|value| *value += load);
                }
                None => along(&law, strains.copied(), out),
            }
        });
        Identified {
            law: self.law(&fit.values()).1,
            fit,
        }
    }

    /// The zeros of strain and load, and the law, with the parameters of [`Guess::starts`].
    fn law(&self, p: &[f64]) -> (Option<[f64; 2]>, TractionLaw) {
        let mut p = p.iter().copied();
        let mut next = || p.next().expect("as many parameters as the starts have");
        let zeros = self.slack.then(|| [next(), next()]);
        let backbone = match self.model {
            TractionModel::Primed => {
                let (stiffness, toe_ratio, toe_strain) = (next(), next(), next());
                let growth = if self.moves { next() } else { 1.0 };
                let toe_strain_after = growth * toe_strain;
                TractionBackbone::Primed(Primed {
                    stiffness,
                    toe_ratio,
                    toe_strain,
                    toe_strain_after,
                })
            }
            TractionModel::Polynomial => TractionBackbone::Polynomial(Polynomial {
                quadratic: next(),
                quartic: next(),
            }),
        };
        let friction = match self.recovers {
            true => BlimanSorine::first_order(next(), next()),
            false => BlimanSorine::none(),
        };
        (
            zeros,
            TractionLaw {
                backbone,
                friction,
                buckling: Buckling::default(),
            },
        )
    }
}

/// What the curve itself says before any search.
struct Guess {
    /// Whether the curve turns back.
    recovers: bool,
    /// Strain and load where the strip becomes taut.
    zero: (f64, f64),
    /// Largest strain and load, from there.
    top: (f64, f64),
    /// Slope of the upper part of the first pull.
    stiffness: f64,
    /// Half the width of the widest loop.
    plateau: f64,
}

impl Guess {
    fn new(curve: &Curve) -> Result<Self, Error> {
        let (strain, load) = (curve.deformation(), curve.load());
        let load_span = span(curve);
        let branches = curve.branches();
        let pull = branches.first().filter(|branch| branch.rising);
        let pull = pull.ok_or_else(|| falling(curve))?.points.clone();
        let zero = if curve.slack {
            let risen = |&i: &usize| load[i] > load[pull.start] + SLACK_LOAD * load_span;
            let taut = pull
                .clone()
                .find(risen)
                .unwrap_or(pull.start)
                .saturating_sub(1);
            let before = &load[pull.start..=taut];
            (
                strain[taut],
                before.iter().sum::<f64>() / before.len() as f64,
            )
        } else {
            (0.0, 0.0)
        };
        let (_, top_strain) = curve.deformation_range();
        let (_, top_load) = curve.load_range();
        let top = (top_strain - zero.0, top_load - zero.1);
        if !(top.0 > 0.0 && top.1 > 0.0) {
            return Err(falling(curve));
        }
        let pull_top = strain[pull.end - 1];
        let upper = zero.0 + 0.6 * (pull_top - zero.0);
        let points = pull
            .filter(|&i| strain[i] >= upper)
            .map(|i| (strain[i], load[i]));
        let stiffness = line(points).map(|(slope, _)| slope);
        let stiffness = stiffness
            .filter(|k| *k > 0.0)
            .ok_or_else(|| falling(curve))?;
        let width = curve.loop_width(zero.0 + 0.6 * top.0).unwrap_or(0.0);
        let plateau = if width > 0.0 {
            0.5 * width
        } else {
            0.02 * load_span
        };
        let recovers = branches.len() > 1;
        Ok(Self {
            recovers,
            zero,
            top,
            stiffness,
            plateau,
        })
    }

    fn starts(&self, form: &Form) -> Vec<Vec<Named>> {
        let (backbones, lengths): (Vec<Vec<Named>>, &[f64]) = match form.model {
            TractionModel::Primed => {
                let backbones = TOE_RATIO_STARTS
                    .iter()
                    .flat_map(|&ratio| TOE_STARTS.map(|toe| self.primed(ratio, toe, form.moves)));
                (backbones.collect(), &PRIMED_LENGTH_STARTS)
            }
            TractionModel::Polynomial => (vec![self.polynomial()], &POLYNOMIAL_LENGTH_STARTS),
        };
        let frictions: Vec<Vec<Named>> = match form.recovers {
            true => lengths
                .iter()
                .map(|&length| self.friction(length))
                .collect(),
            false => vec![Vec::new()],
        };
        let zeros = if form.slack { self.zeros() } else { Vec::new() };
        let mut starts = Vec::new();
        for backbone in &backbones {
            for friction in &frictions {
                starts.push([&zeros, backbone, friction].map(Clone::clone).concat());
            }
        }
        starts
    }

    /// A start at the parameters that a fit of another form has found.
    fn start_from(&self, form: &Form, found: &[(&'static str, f64)]) -> Vec<Named> {
        let mut start = self.starts(form).swap_remove(0);
        for (name, parameter) in &mut start {
            if let Some((_, value)) = found.iter().find(|(other, _)| other == name) {
                parameter.start = *value;
            }
        }
        start
    }

    fn zeros(&self) -> Vec<Named> {
        let ((strain, load), (top_strain, top_load)) = (self.zero, self.top);
        let around = |value: f64, half: f64| {
            Parameter::new(value)
                .with_scale(half)
                .between(value - half, value + half)
        };
        vec![
            ("free strain", around(strain, 0.3 * top_strain)),
            ("zero", around(load, 0.2 * top_load)),
        ]
    }

    /// With a given toe ratio, and a toe that is a given part of the largest strain.
    fn primed(&self, toe_ratio: f64, toe: f64, moves: bool) -> Vec<Named> {
        let (strain, _) = self.top;
        let toe = toe * strain;
        let k = self.stiffness;
        let mut start = vec![
            ("stiffness", Parameter::new(k).between(1e-2 * k, 1e2 * k)),
            (
                "toe_ratio",
                Parameter::new(toe_ratio).between(TOE_RATIO_MIN, 1.0),
            ),
            (
                "toe_strain",
                Parameter::new(toe).between(1e-3 * strain, 2.0 * strain),
            ),
        ];
        if moves {
            start.push(("toe_growth", Parameter::new(1.2).between(1.0, 2.0)));
        }
        start
    }

    /// Half of the largest load from each term.
    fn polynomial(&self) -> Vec<Named> {
        let (strain, load) = self.top;
        let term = |power: i32| {
            let start = 0.5 * load / strain.powi(power);
            Parameter::new(start)
                .with_scale(0.01 * start)
                .between(0.0, 20.0 * start)
        };
        vec![("quadratic", term(2)), ("quartic", term(4))]
    }

    fn friction(&self, length: f64) -> Vec<Named> {
        let (strain, load) = self.top;
        let plateau = Parameter::new(self.plateau)
            .with_scale(0.01 * load)
            .between(0.0, load);
        let length = Parameter::new(length * strain).between(LEAST_LENGTH * strain, 5.0 * strain);
        vec![("plateau", plateau), ("length", length)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_kes::Direction;

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
            let found = identify_tensile(&curve, TractionModel::Primed).unwrap();
            let truth = [free_strain, zero, 6e3, toe_ratio, toe, growth, 4.0, 0.002];
            for ((name, value), exact) in found.fit.parameters.iter().zip(truth) {
                let error = (value / exact - 1.0).abs();
                assert!(
                    error < 1e-6,
                    "{name} is {value:e}, exactly {exact:e}; {:?}",
                    found.fit
                );
            }
        }
    }

    #[test]
    fn a_pull_into_compression_is_refused() {
        let strain = vec![-0.03, -0.02, -0.01];
        let load = vec![-3.0, -2.0, -1.0];
        let curve = Curve::new(Test::Tensile, Direction::Weft, strain, load).unwrap();
        let result = identify_tensile(&curve, TractionModel::Primed);
        assert!(matches!(result, Err(Error::Falling { .. })), "{result:?}");
    }

    #[test]
    fn a_pull_without_a_way_back_gives_no_friction_and_a_toe_that_does_not_move() {
        let strain: Vec<f64> = (0..=50).map(|i| 0.001 * f64::from(i)).collect();
        let load = strain.iter().map(|e| 4e3 * e + 5e4 * e * e).collect();
        let curve = Curve::new(Test::Tensile, Direction::Weft, strain, load).unwrap();
        let law = identify_tensile(&curve, TractionModel::Primed).unwrap().law;
        assert_eq!(law.friction, BlimanSorine::none());
        let TractionBackbone::Primed(primed) = law.backbone else {
            panic!("primed was asked for")
        };
        assert_eq!(primed.toe_strain, primed.toe_strain_after);
    }
}
