//! What a tensile curve says before any search.

use std::ops::Range;

use drape_fabric::{
    BlimanSorine, Buckling, Polynomial, Primed, TOE_RATIO_MIN, TractionBackbone, TractionLaw,
};
use drape_kes::Curve;

use crate::Error;
use crate::basis::Basis;
use crate::bending::{falling, span};
use crate::curve_fit::line;
use crate::line::LEAST_LENGTH;
use crate::pull::along;
use crate::search::Named;
use crate::tensile::Form;
use crate::{Toe, TractionModel};
use drape_lm::Parameter;

/// Toes to start from, over the largest strain.
const TOES: [f64; 5] = [0.12, 0.25, 0.45, 0.7, 1.0];
/// How far a toe that moves may go, over the virgin one, to start from.
const GROWTHS: [f64; 3] = [1.1, 1.4, 1.8];
/// Friction lengths to start from, over the largest strain.
const LENGTHS: [f64; 4] = [0.005, 0.02, 0.07, 0.25];
/// Starts that are searched.
const STARTS: usize = 3;
/// Toe ratio of the second of the two toes whose combinations are all toes of one length.
const DEEP: f64 = 0.6;
/// Part of the load range by which a slack strip's load has begun to rise.
const SLACK_LOAD: f64 = 0.02;

/// What the curve itself says.
pub(crate) struct Guess {
    /// Whether the curve turns back.
    pub recovers: bool,
    /// Strain and load where the strip becomes taut.
    pub zero: (f64, f64),
    /// Largest strain and load, from there.
    top: (f64, f64),
    /// Slope of the upper part of the first pull.
    stiffness: f64,
    /// Strains from where the strip becomes taut; zero while it is slack.
    strains: Vec<f64>,
    load: Vec<f64>,
}

/// A backbone and its friction, with the sum of squares that they leave.
struct Start {
    left: f64,
    backbone: Vec<f64>,
    friction: [f64; 2],
}

impl Guess {
    pub fn new(curve: &Curve) -> Result<Self, Error> {
        let (strain, load) = (curve.deformation(), curve.load());
        let branches = curve.branches();
        let pull = branches.first().filter(|branch| branch.rising);
        let pull = pull.ok_or_else(|| falling(curve))?.points.clone();
        let zero = match curve.slack {
            true => taut(curve, &pull),
            false => (0.0, 0.0),
        };
        let (_, top_strain) = curve.deformation_range();
        let (_, top_load) = curve.load_range();
        let top = (top_strain - zero.0, top_load - zero.1);
        if !(top.0 > 0.0 && top.1 > 0.0) {
            return Err(falling(curve));
        }
        let upper = zero.0 + 0.6 * (strain[pull.end - 1] - zero.0);
        let points = pull.filter(|&i| strain[i] >= upper).map(|i| (strain[i], load[i]));
        let stiffness = line(points).map(|(slope, _)| slope);
        let stiffness = stiffness.filter(|k| *k > 0.0).ok_or_else(|| falling(curve))?;
        let from_zero = |strain: &f64| {
            let strain = strain - zero.0;
            if curve.slack { strain.max(0.0) } else { strain }
        };
        Ok(Self {
            recovers: branches.len() > 1,
            zero,
            top,
            stiffness,
            strains: strain.iter().map(from_zero).collect(),
            load: load.iter().map(|load| load - zero.1).collect(),
        })
    }

    /// Starts whose linear parameters follow the curve best, of a grid of the others.
    pub fn starts(&self, form: &Form) -> Vec<Vec<Named>> {
        let mut starts = match (form.model, form.toe) {
            (TractionModel::Polynomial, _) => self.polynomials(form),
            (TractionModel::Primed, Toe::Still) => self.primed(form, &[1.0]),
            (TractionModel::Primed, Toe::Moving) => self.primed(form, &GROWTHS),
        };
        starts.sort_by(|a, b| a.left.total_cmp(&b.left));
        starts.truncate(STARTS);
        if starts.is_empty() {
            starts.push(self.plain(form));
        }
        starts.iter().map(|start| self.named(form, start)).collect()
    }

    /// For each toe and how far it moves, the best friction length.
    fn primed(&self, form: &Form, growths: &[f64]) -> Vec<Start> {
        let (top, _) = self.top;
        let start = |toe: f64, growth: f64| {
            let law = |stiffness: f64, toe_ratio: f64, friction: BlimanSorine| TractionLaw {
                backbone: TractionBackbone::Primed(Primed {
                    stiffness,
                    toe_ratio,
                    toe_strain: toe * top,
                    toe_strain_after: growth * toe * top,
                }),
                friction,
                buckling: Buckling::default(),
            };
            let column = |law: TractionLaw| self.column(&law);
            let mut columns = vec![
                column(law(1.0, 1.0, BlimanSorine::none())),
                column(law(1.0, DEEP, BlimanSorine::none())),
            ];
            let frictions = self.frictions(form);
            columns.extend(frictions.iter().map(|friction| column(law(0.0, DEEP, *friction))));
            let (left, c, length) = self.best(&columns, 2, form)?;
            // The load is linear in the toe ratio: 1 − r is that of the second toe times its part.
            let stiffness = c[0] + c[1];
            let ratio = 1.0 - (1.0 - DEEP) * c[1] / stiffness;
            let mut backbone = vec![stiffness, ratio.clamp(1.05 * TOE_RATIO_MIN, 0.98), toe * top];
            if form.toe == Toe::Moving {
                backbone.push(growth);
            }
            (stiffness > 0.0).then(|| Start {
                left,
                backbone,
                friction: [c.get(2).copied().unwrap_or(0.0), length],
            })
        };
        let pairs = TOES.iter().flat_map(|&toe| growths.iter().map(move |&growth| (toe, growth)));
        pairs.filter_map(|(toe, growth)| start(toe, growth)).collect()
    }

    /// For each friction length, the best polynomial.
    fn polynomials(&self, form: &Form) -> Vec<Start> {
        let law = |quadratic: f64, quartic: f64, friction: BlimanSorine| TractionLaw {
            backbone: TractionBackbone::Polynomial(Polynomial { quadratic, quartic }),
            friction,
            buckling: Buckling::default(),
        };
        let mut columns = vec![
            self.column(&law(1.0, 0.0, BlimanSorine::none())),
            self.column(&law(0.0, 1.0, BlimanSorine::none())),
        ];
        let frictions = self.frictions(form);
        columns.extend(frictions.iter().map(|friction| self.column(&law(0.0, 0.0, *friction))));
        let best = self.best(&columns, 2, form);
        let start = best.map(|(left, c, length)| Start {
            left,
            backbone: vec![c[0].max(0.0), c[1].max(0.0)],
            friction: [c.get(2).copied().unwrap_or(0.0), length],
        });
        start.into_iter().collect()
    }

    fn column(&self, law: &TractionLaw) -> Vec<f64> {
        let mut out = vec![0.0; self.strains.len()];
        along(law, self.strains.iter().copied(), &mut out);
        out
    }

    fn frictions(&self, form: &Form) -> Vec<BlimanSorine> {
        let lengths = if form.recovers { &LENGTHS[..] } else { &[] };
        let friction = |part: &f64| BlimanSorine::first_order(1.0, part * self.top.0);
        lengths.iter().map(friction).collect()
    }

    /// The best of the frictions that follow the backbone's columns: what is left, the coefficients and the
    /// length.
    fn best(&self, columns: &[Vec<f64>], own: usize, form: &Form) -> Option<(f64, Vec<f64>, f64)> {
        let basis = Basis::new(columns, &self.load);
        let backbone: Vec<usize> = (0..own).collect();
        if !form.recovers {
            let (c, left) = basis.solve(&backbone)?;
            return Some((left, c, 0.0));
        }
        let with = |(i, part): (usize, &f64)| {
            let (c, left) = basis.solve(&[&backbone[..], &[own + i]].concat())?;
            (c[own] > 0.0).then_some((left, c, part * self.top.0))
        };
        let all = LENGTHS.iter().enumerate().filter_map(with);
        all.min_by(|(a, ..), (b, ..)| a.total_cmp(b))
    }

    /// A start for a curve that the linear search makes nothing of.
    fn plain(&self, form: &Form) -> Start {
        let (strain, load) = self.top;
        let backbone = match form.model {
            TractionModel::Primed => {
                let mut backbone = vec![self.stiffness, 0.7, 0.5 * strain];
                backbone.extend((form.toe == Toe::Moving).then_some(1.2));
                backbone
            }
            TractionModel::Polynomial => {
                vec![0.5 * load / strain.powi(2), 0.5 * load / strain.powi(4)]
            }
        };
        Start { left: 0.0, backbone, friction: [0.02 * load, 0.05 * strain] }
    }

    fn named(&self, form: &Form, start: &Start) -> Vec<Named> {
        let mut named = if form.slack { self.zeros() } else { Vec::new() };
        let (strain, load) = self.top;
        let backbone = &start.backbone;
        match form.model {
            TractionModel::Primed => {
                let k = self.stiffness;
                named.extend([
                    ("stiffness", Parameter::new(backbone[0]).between(1e-2 * k, 1e2 * k)),
                    ("toe_ratio", Parameter::new(backbone[1]).between(TOE_RATIO_MIN, 1.0)),
                    (
                        "toe_strain",
                        Parameter::new(backbone[2]).between(1e-3 * strain, 2.0 * strain),
                    ),
                ]);
                if let Some(growth) = backbone.get(3) {
                    named.push(("toe_growth", Parameter::new(*growth).between(1.0, 2.0)));
                }
            }
            TractionModel::Polynomial => {
                let term = |value: f64, power: i32| {
                    let size = load / strain.powi(power);
                    Parameter::new(value).with_scale(0.01 * size).between(0.0, 10.0 * size)
                };
                named.push(("quadratic", term(backbone[0], 2)));
                named.push(("quartic", term(backbone[1], 4)));
            }
        }
        if form.recovers {
            let [plateau, length] = start.friction;
            let plateau = Parameter::new(plateau).with_scale(0.01 * load).between(0.0, load);
            let length = Parameter::new(length).between(LEAST_LENGTH * strain, 5.0 * strain);
            named.extend([("plateau", plateau), ("length", length)]);
        }
        named
    }

    fn zeros(&self) -> Vec<Named> {
        let ((strain, load), (top_strain, top_load)) = (self.zero, self.top);
        let around = |value: f64, half: f64| {
            Parameter::new(value).with_scale(half).between(value - half, value + half)
        };
        vec![
            ("free strain", around(strain, 0.3 * top_strain)),
            ("zero", around(load, 0.2 * top_load)),
        ]
    }
}

/// Strain and load where a slack strip becomes taut on its first pull.
fn taut(curve: &Curve, pull: &Range<usize>) -> (f64, f64) {
    let (strain, load) = (curve.deformation(), curve.load());
    let risen = |&i: &usize| load[i] > load[pull.start] + SLACK_LOAD * span(curve);
    let first = pull.clone().find(risen).unwrap_or(pull.start);
    let taut = first.saturating_sub(1);
    let before = &load[pull.start..=taut];
    (strain[taut], before.iter().sum::<f64>() / before.len() as f64)
}
