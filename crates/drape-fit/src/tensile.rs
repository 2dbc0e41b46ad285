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
/// Pre-sliding lengths to start from, over the largest strain.
const LENGTH_STARTS: [f64; 2] = [0.02, 0.15];
/// Part of the load range by which a slack strip's load has begun to rise.
const SLACK_LOAD: f64 = 0.02;

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
/// stretched: the law then has no friction, and a toe that does not move.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_tensile(
    curve: &Curve,
    model: TractionModel,
) -> Result<Identified<TractionLaw>, Error> {
    curve_fit::expect(curve, Test::Tensile)?;
    let guess = Guess::new(curve)?;
    let starts = guess.starts(model);
    let (slack, recovers) = (curve.slack, guess.recovers);
    let split = if slack { 2 } else { 0 };
    let fit = curve_fit::fit(curve, &starts, |p, out| {
        let law = law(model, recovers, &p[split..]);
        let strains = curve.deformation().iter();
        if slack {
            along_slack(&law, strains.map(|strain| strain - p[0]), out);
            out.iter_mut().for_each(|load| *load += p[1]);
        } else {
            along(&law, strains.copied(), out);
        }
    });
    Ok(Identified {
        law: law(model, recovers, &fit.values()[split..]),
        fit,
    })
}

/// The law with the parameters of [`Guess::starts`], the zeros of strain and force left out.
fn law(model: TractionModel, recovers: bool, p: &[f64]) -> TractionLaw {
    let (backbone, rest) = match model {
        TractionModel::Primed => {
            let after = if recovers { p[3] } else { 1.0 };
            let primed = Primed {
                stiffness: p[0],
                toe_ratio: p[1],
                toe_strain: p[2],
                toe_strain_after: p[2] * after,
            };
            (
                TractionBackbone::Primed(primed),
                &p[if recovers { 4 } else { 3 }..],
            )
        }
        TractionModel::Polynomial => {
            let polynomial = Polynomial {
                quadratic: p[0],
                quartic: p[1],
            };
            (TractionBackbone::Polynomial(polynomial), &p[2..])
        }
    };
    let friction = match *rest {
        [plateau, length] => BlimanSorine::first_order(plateau, length),
        _ => BlimanSorine::none(),
    };
    TractionLaw {
        backbone,
        friction,
        buckling: Buckling::default(),
    }
}

/// What the curve itself says before any search.
struct Guess {
    slack: bool,
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
            slack: curve.slack,
            recovers,
            zero,
            top,
            stiffness,
            plateau,
        })
    }

    fn starts(&self, model: TractionModel) -> Vec<Vec<Named>> {
        let backbones: Vec<Vec<Named>> = match model {
            TractionModel::Primed => TOE_RATIO_STARTS
                .map(|toe_ratio| self.primed(toe_ratio))
                .into(),
            TractionModel::Polynomial => vec![self.polynomial()],
        };
        let lengths: &[f64] = if self.recovers {
            &LENGTH_STARTS
        } else {
            &LENGTH_STARTS[..1]
        };
        let mut starts = Vec::new();
        for backbone in &backbones {
            for length in lengths {
                let mut start = self.zeros();
                start.extend(backbone.iter().copied());
                if self.recovers {
                    start.extend(self.friction(*length));
                }
                starts.push(start);
            }
        }
        starts
    }

    fn zeros(&self) -> Vec<Named> {
        if !self.slack {
            return Vec::new();
        }
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

    /// The line through the upper part meets the axis at (1 − r)ε₁.
    fn primed(&self, toe_ratio: f64) -> Vec<Named> {
        let (strain, load) = self.top;
        let meets = (strain - load / self.stiffness).clamp(0.0, strain);
        let toe = (meets / (1.0 - toe_ratio)).clamp(0.05 * strain, 0.9 * strain);
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
        if self.recovers {
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
