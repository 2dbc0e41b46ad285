//! A line with friction along a loop, which bending and shear share.

use drape_fabric::{BlimanSorine, Dahl};
use drape_kes::Curve;
use nalgebra::DMatrix;

use crate::basis::{Basis, ratios};
use crate::bending::{mean_slope, reach, span, zero};
use crate::choice::{Model, Predict};
use crate::search::Named;
use crate::strokes::{Element, Strokes};
use crate::{Error, FrictionOrder, Plateau};
use drape_lm::Parameter;

/// Shortest friction length over the largest deformation: below it a friction is a step at any sampling.
pub(crate) const LEAST_LENGTH: f64 = 1e-4;
/// Friction lengths to start from, over the largest deformation, from the first to the last in even ratios.
///
/// Below the first a friction looks like a step, beyond the last like stiffness. Neighbours differ by half,
/// which is well within reach of a search.
const LENGTHS: usize = 14;
const LENGTH_RANGE: [f64; 2] = [0.003, 0.9];
/// Starts that are searched.
const STARTS: usize = 2;
/// Largest growth of a plateau looked for, per unit of the deformation: over the KES range, a hundredfold.
const LARGEST_GROWTH: f64 = 700.0;
/// Slow plateau over the fast one, for both signs, and length over the slow one, to start from where the
/// linear search finds no pair of elements.
const SLOW_START: f64 = 0.3;
const RATIO_START: f64 = 0.2;
/// Most that the slow element takes from the fast one: beyond, next to nothing is left.
const MOST_TAKEN: f64 = 0.95;
/// Largest slow plateau over the fast one.
const MOST_ADDED: f64 = 20.0;

/// Stiffness, growth and friction of a law that is a line with friction.
#[derive(Clone, Copy)]
pub(crate) struct Line {
    pub stiffness: f64,
    pub growth: f64,
    pub friction: BlimanSorine,
}

/// Which parameters a line with friction has.
#[derive(Clone, Copy)]
pub(crate) struct Form {
    pub order: FrictionOrder,
    pub plateau: Plateau,
}

impl Form {
    fn grows(self) -> bool {
        self.plateau == Plateau::Growing
    }

    /// The law, and the zero of its load, with parameters in the order of [`Loop::starts`].
    pub fn law(self, p: &[f64]) -> (Line, f64) {
        let (growth, rest) = match self.grows() {
            true => (p[2], &p[3..]),
            false => (0.0, &p[2..]),
        };
        let line = Line { stiffness: p[0], growth, friction: friction(rest) };
        (line, p[1])
    }
}

/// The friction with the parameters plateau, length, and for two elements the slow plateau over the fast one
/// and the fast length over the slow one.
pub(crate) fn friction(p: &[f64]) -> BlimanSorine {
    match *p {
        [plateau, length] => BlimanSorine::first_order(plateau, length),
        [plateau, length, slow, ratio] => {
            BlimanSorine::second_order(plateau, -slow * plateau, ratio, length)
        }
        _ => BlimanSorine::none(),
    }
}

/// A measured loop that is to be followed by a line with friction.
pub(crate) struct Loop<'a> {
    curve: &'a Curve,
    path: &'a [f64],
    strokes: Strokes,
    /// What the stiffness is called.
    name: &'static str,
    slope: f64,
    reach: f64,
    lengths: [f64; LENGTHS],
    basis: Basis,
}

/// A line with friction that follows a path.
struct Follow<'a> {
    path: &'a [f64],
    strokes: &'a Strokes,
    form: Form,
}

impl Follow<'_> {
    /// The line, and the loads of its elements along the path.
    fn elements(&self, p: &[f64]) -> (Line, f64, Vec<(Dahl, Element)>) {
        let (line, zero) = self.form.law(p);
        let present = line.friction.elements.into_iter();
        // An absent second element is that of the first order; it has no parameters either.
        let count = if self.form.order == FrictionOrder::First { 1 } else { 2 };
        let with = |dahl: Dahl| (dahl, self.strokes.element(dahl.length));
        (line, zero, present.take(count).map(with).collect())
    }
}

impl Predict for Follow<'_> {
    fn loads(&self, p: &[f64], out: &mut [f64]) {
        let (line, zero, elements) = self.elements(p);
        for (load, q) in out.iter_mut().zip(self.path) {
            *load = zero + line.stiffness * q;
        }
        for (Dahl { plateau, .. }, element) in &elements {
            let columns = element.constant.iter().zip(&element.grown);
            for (load, (constant, grown)) in out.iter_mut().zip(columns) {
                *load += plateau * (constant + line.growth * grown);
            }
        }
    }

    /// With the fast plateau `$P$`, the slow one `$wP$`, the lengths `$\eta x$` and `$x$`, and unit loads
    /// `$u = c + \gamma g$` the friction is `$P[u(\eta x) + w\,u(x)]$`.
    fn slopes(&self, p: &[f64], out: &mut DMatrix<f64>) -> bool {
        let (line, _, elements) = self.elements(p);
        let first = if self.form.grows() { 3 } else { 2 };
        let (plateau, length) = (p[first], p[first + 1]);
        let (slow, ratio) = match elements.len() {
            2 => (p[first + 2], p[first + 3]),
            _ => (0.0, 1.0),
        };
        for (i, q) in self.path.iter().enumerate() {
            let unit = |e: usize| {
                let element = &elements[e].1;
                let load = element.constant[i] + line.growth * element.grown[i];
                let slope = element.constant_slope[i] + line.growth * element.grown_slope[i];
                [load, slope, element.grown[i]]
            };
            let fast = unit(0);
            let [slow_load, slow_slope, slow_grown] =
                if elements.len() == 2 { unit(1) } else { [0.0; 3] };
            out[(i, 0)] = *q;
            out[(i, 1)] = 1.0;
            if self.form.grows() {
                out[(i, 2)] = plateau * (fast[2] + slow * slow_grown);
            }
            out[(i, first)] = fast[0] + slow * slow_load;
            out[(i, first + 1)] = plateau * (ratio * fast[1] + slow * slow_slope);
            if elements.len() == 2 {
                out[(i, first + 2)] = plateau * slow_load;
                out[(i, first + 3)] = plateau * length * fast[1];
            }
        }
        true
    }
}

/// What the linear search found for given lengths.
struct Start {
    left: f64,
    stiffness: f64,
    zero: f64,
    growth: f64,
    friction: Vec<f64>,
}

impl<'a> Loop<'a> {
    /// A loop along a path.
    pub fn new(curve: &'a Curve, (name, path): (&'static str, &'a [f64])) -> Result<Self, Error> {
        let slope = mean_slope(curve)?;
        let reach = reach(path);
        let strokes = Strokes::new(path);
        let [from, to] = LENGTH_RANGE;
        let lengths = ratios(from * reach, to * reach);
        // Columns: the path, one, then for each length the friction with a constant plateau of one and what a
        // growth of one per reach adds to it.
        let mut columns = vec![path.to_vec(), vec![1.0; path.len()]];
        for length in lengths {
            let Element { constant, mut grown, .. } = strokes.element(length);
            grown.iter_mut().for_each(|load| *load /= reach);
            columns.extend([constant, grown]);
        }
        let basis = Basis::new(&columns, curve.load());
        Ok(Self { curve, path, strokes, name, slope, reach, lengths, basis })
    }

    /// The model of one form.
    pub fn model(&self, form: Form, words: String) -> Model<'_> {
        let follow = Follow { path: self.path, strokes: &self.strokes, form };
        Model {
            name: words,
            starts: self.starts(form),
            prediction: None,
            predict: Box::new(follow),
        }
    }

    fn starts(&self, form: Form) -> Vec<Vec<Named>> {
        let mut starts = self.single(form);
        if form.order != FrictionOrder::First {
            let singles = std::mem::take(&mut starts);
            starts = self.pairs(form);
            if starts.is_empty() {
                let sign = if form.order == FrictionOrder::Second { -1.0 } else { 1.0 };
                starts = singles;
                for start in &mut starts {
                    start.friction.extend([sign * SLOW_START, RATIO_START]);
                }
            }
        }
        starts.sort_by(|a, b| a.left.total_cmp(&b.left));
        starts.truncate(STARTS);
        if starts.is_empty() {
            starts.push(self.plain(form));
        }
        starts.iter().map(|start| self.named(form, start)).collect()
    }

    /// One friction element of each length.
    fn single(&self, form: Form) -> Vec<Start> {
        let start = |i: usize| {
            let mut columns = vec![0, 1, 2 + 2 * i];
            columns.extend(form.grows().then_some(3 + 2 * i));
            let (c, left) = self.basis.solve(&columns)?;
            let growth = c.get(3).map_or(0.0, |added| added / c[2] / self.reach);
            (c[2] > 0.0).then(|| Start {
                left,
                stiffness: c[0],
                zero: c[1],
                growth,
                friction: vec![c[2], self.lengths[i]],
            })
        };
        let all: Vec<Option<Start>> = (0..LENGTHS).map(start).collect();
        // Only the valleys: neighbours lead to the same end.
        let left = |i: usize| all[i].as_ref().map_or(f64::INFINITY, |start| start.left);
        let valley: Vec<bool> = (0..LENGTHS)
            .map(|i| {
                (i == 0 || left(i) < left(i - 1)) && (i + 1 == LENGTHS || left(i) <= left(i + 1))
            })
            .collect();
        let kept = all.into_iter().zip(valley);
        kept.filter_map(|(start, valley)| start.filter(|_| valley)).collect()
    }

    /// Two friction elements, of each pair of lengths.
    fn pairs(&self, form: Form) -> Vec<Start> {
        let start = |fast: usize, slow: usize| {
            let mut columns = vec![0, 1, 2 + 2 * fast, 2 + 2 * slow];
            if form.grows() {
                columns.extend([3 + 2 * fast, 3 + 2 * slow]);
            }
            let (c, left) = self.basis.solve(&columns)?;
            let part = c[3] / c[2];
            let fits = match form.order {
                FrictionOrder::Second => part < 0.0 && part > -MOST_TAKEN,
                _ => part > 0.0 && part < MOST_ADDED,
            };
            // Both elements grow alike: their mean.
            let growth = match c.get(4..6) {
                Some(added) => (added[0] + added[1]) / (c[2] + c[3]) / self.reach,
                None => 0.0,
            };
            (c[2] > 0.0 && fits).then(|| Start {
                left,
                stiffness: c[0],
                zero: c[1],
                growth,
                friction: vec![
                    c[2],
                    self.lengths[slow],
                    part,
                    self.lengths[fast] / self.lengths[slow],
                ],
            })
        };
        (0..LENGTHS)
            .flat_map(|slow| (0..slow).map(move |fast| (fast, slow)))
            .filter_map(|(fast, slow)| start(fast, slow))
            .collect()
    }

    /// A start for a curve that the linear search makes nothing of.
    fn plain(&self, form: Form) -> Start {
        let mut friction = vec![0.05 * span(self.curve), 0.05 * self.reach];
        match form.order {
            FrictionOrder::First => {}
            FrictionOrder::Parallel => friction.extend([SLOW_START, RATIO_START]),
            FrictionOrder::Second => friction.extend([-SLOW_START, RATIO_START]),
        }
        Start { left: 0.0, stiffness: self.slope, zero: 0.0, growth: 0.0, friction }
    }

    fn named(&self, form: Form, start: &Start) -> Vec<Named> {
        let (slope, load, reach) = (self.slope, span(self.curve), self.reach);
        let mut named = vec![
            (self.name, Parameter::new(start.stiffness).between(1e-3 * slope, 10.0 * slope)),
            ("zero", Parameter { start: start.zero, ..zero(self.curve) }),
        ];
        if form.grows() {
            let growth = Parameter::new(start.growth.max(0.0))
                .with_scale(1.0 / reach)
                .between(0.0, LARGEST_GROWTH);
            named.push(("growth", growth));
        }
        let plateau =
            Parameter::new(start.friction[0]).with_scale(0.01 * load).between(0.0, 2.0 * load);
        let length = Parameter::new(start.friction[1]).between(LEAST_LENGTH * reach, 5.0 * reach);
        named.extend([("plateau", plateau), ("length", length)]);
        if let [_, _, slow, ratio] = *start.friction {
            let (least, most) = match form.order {
                FrictionOrder::Second => (-MOST_TAKEN, 0.0),
                _ => (0.0, MOST_ADDED),
            };
            named.push(("slow", Parameter::new(slow).between(least, most)));
            named.push(("ratio", Parameter::new(ratio).between(0.01, 0.95)));
        }
        named
    }
}
