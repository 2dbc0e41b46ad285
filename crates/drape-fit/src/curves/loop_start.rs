//! Initial guesses of the fit of a loop, by linear least squares on a grid of friction lengths and
//! of places where the stiffness changes.
//!
//! For given lengths and a given transition the load is linear in stiffnesses, zero and plateaus.
//! `bending` and `shear` build their candidates here.

use drape_kes::Curve;
use drape_lm::Parameter;

use crate::curves::features::{largest, mean_slope, zero};
use crate::curves::loop_form::{Elastic, LoopForm, varying_parts};
use crate::error::Error;
use crate::forward::friction_path::{FrictionPath, UnitFriction};
use crate::regression::linear::{LinearFit, Solution, geometric_grid};
use crate::regression::residuals::NamedParameter;
use crate::regression::selection::CandidateModel;
use crate::settings::model::FrictionOrder;

/// Shortest friction length over the largest deformation. A shorter friction is a step at any
/// sampling.
pub(crate) const LEAST_LENGTH: f64 = 1e-4;
/// Number of friction lengths to start from.
///
/// Neighbours differ by half, well within the convergence of a search.
const LENGTHS: usize = 14;
/// Friction lengths to start from, over the largest deformation, at equal ratios.
///
/// Below the first friction is like a step, beyond the last like stiffness.
const LENGTH_RANGE: [f64; 2] = [0.003, 0.9];
/// Number of starts that are searched.
const STARTS: usize = 2;
/// Largest growth of a plateau, per unit of the deformation: over the KES range, a hundredfold.
const LARGEST_GROWTH: f64 = 700.0;
/// Slow plateau over the fast one, up to the sign, to start from where the linear fit finds no pair
/// of elements.
const SLOW_START: f64 = 0.3;
/// Fast length over the slow one, to start from where the linear fit finds no pair of elements.
const RATIO_START: f64 = 0.2;
/// Largest negative slow plateau over the fast one: beyond, next to nothing is left.
const LARGEST_REDUCTION: f64 = 0.95;
/// Largest positive slow plateau over the fast one.
const LARGEST_ADDITION: f64 = 20.0;
/// Transitions of the stiffness to start from, over the largest deformation.
const TRANSITIONS: [f64; 4] = [0.1, 0.3, 0.6, 1.0];
/// Bounds of the transition, over the largest deformation: below, the change of the stiffness would
/// be friction; beyond, its end would lie outside of the test.
const TRANSITION_RANGE: [f64; 2] = [0.05, 1.5];
/// Initial and final stiffness over each other to start from where the linear fit finds none.
const CHANGE_START: f64 = 0.5;

/// Measured loop, prepared for initial guesses.
pub(crate) struct MeasuredLoop<'a> {
    curve: &'a Curve,
    /// Deformation of the law at each point.
    history: &'a [f64],
    path: FrictionPath,
    /// Name of the stiffness.
    name: &'static str,
    /// Slope of the line through all points.
    slope: f64,
    /// Largest deformation of the law.
    largest: f64,
    lengths: [f64; LENGTHS],
    fit: LinearFit,
}

/// Initial guess, with the sum of squares that it leaves.
struct Start {
    residual_sum: f64,
    /// Stiffness of a line, or initial and final stiffness with their transition.
    elastic: Vec<f64>,
    zero: f64,
    growth: f64,
    friction: Vec<f64>,
}

impl<'a> MeasuredLoop<'a> {
    /// Prepares a loop along the `history` of the law's deformation. `name` is the name of the
    /// stiffness.
    pub(crate) fn new(
        curve: &'a Curve,
        name: &'static str,
        history: &'a [f64],
    ) -> Result<Self, Error> {
        let slope = mean_slope(curve)?;
        let largest = largest(history);
        let path = FrictionPath::new(history);
        let [from, to] = LENGTH_RANGE;
        let lengths = geometric_grid(from * largest, to * largest);

        // Columns: the history, one, then for each length the friction with a constant plateau of
        // one, and its growth by one over the largest deformation.
        let mut columns = vec![history.to_vec(), vec![1.0; history.len()]];
        for length in lengths {
            let UnitFriction { constant, mut growing, .. } = path.unit_friction(length);
            growing.iter_mut().for_each(|load| *load /= largest);
            columns.extend([constant, growing]);
        }
        // Then for each transition the part of the load with an initial stiffness of one.
        for transition in TRANSITIONS {
            columns
                .push(history.iter().map(|q| varying_parts(*q, transition * largest)[0]).collect());
        }
        let fit = LinearFit::new(&columns, curve.load());
        Ok(Self { curve, history, path, name, slope, largest, lengths, fit })
    }

    /// Returns the candidate of `form`, with its `name` in reports.
    pub(crate) fn model(&self, form: LoopForm, name: String) -> CandidateModel<'_> {
        CandidateModel {
            name,
            starts: self.starts(form),
            prediction: None,
            forward: form.forward(self.history, &self.path),
        }
    }

    /// Returns the best initial guesses of `form`.
    fn starts(&self, form: LoopForm) -> Vec<Vec<NamedParameter>> {
        let mut starts = match form.elastic {
            Elastic::Line => self.single(form),
            Elastic::Varying => self.varying(form),
        };
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

        starts.sort_by(|a, b| a.residual_sum.total_cmp(&b.residual_sum));
        starts.truncate(STARTS);
        if starts.is_empty() {
            starts.push(self.fallback(form));
        }
        starts.iter().map(|start| self.named_parameters(form, start)).collect()
    }

    /// Returns guesses of `form` with one friction element, at the local minima over its length.
    fn single(&self, form: LoopForm) -> Vec<Start> {
        let mut starts: Vec<Option<Start>> = Vec::with_capacity(LENGTHS);
        for (i, &length) in self.lengths.iter().enumerate() {
            let mut columns = vec![0, 1, 2 + 2 * i];
            columns.extend(form.has_growth().then_some(3 + 2 * i));
            let start = self.fit.solve(&columns).and_then(|solution| {
                let Solution { coefficients: c, residual_sum } = solution;
                let growth = c.get(3).map_or(0.0, |added| added / c[2] / self.largest);
                (c[2] > 0.0).then(|| Start {
                    residual_sum,
                    elastic: vec![c[0]],
                    zero: c[1],
                    growth,
                    friction: vec![c[2], length],
                })
            });
            starts.push(start);
        }

        // The neighbours of a minimum would lead to one end.
        let sums: Vec<f64> = starts
            .iter()
            .map(|start| start.as_ref().map_or(f64::INFINITY, |start| start.residual_sum))
            .collect();
        let mut minima = Vec::new();
        for (i, start) in starts.into_iter().enumerate() {
            let is_minimum =
                (i == 0 || sums[i] < sums[i - 1]) && (i + 1 == LENGTHS || sums[i] <= sums[i + 1]);
            minima.extend(start.filter(|_| is_minimum));
        }
        minima
    }

    /// Returns guesses of `form` with a stiffness that changes and one friction element, with the
    /// best length for each transition.
    fn varying(&self, form: LoopForm) -> Vec<Start> {
        let mut best = Vec::new();
        for (index, transition) in TRANSITIONS.into_iter().enumerate() {
            let mut starts = Vec::new();
            for (i, &length) in self.lengths.iter().enumerate() {
                let mut columns = vec![0, 1, 2 + 2 * i, 2 + 2 * LENGTHS + index];
                columns.extend(form.has_growth().then_some(3 + 2 * i));
                let Some(solution) = self.fit.solve(&columns) else { continue };
                let Solution { coefficients: c, residual_sum } = solution;
                // The load is k_f q + (k_i − k_f) s(q) with the part s of the initial stiffness.
                let (last, initial) = (c[0], c[0] + c[3]);
                let growth = c.get(4).map_or(0.0, |added| added / c[2] / self.largest);
                if last > 0.0 && initial > 0.0 && c[2] > 0.0 {
                    starts.push(Start {
                        residual_sum,
                        elastic: vec![initial, last, transition * self.largest],
                        zero: c[1],
                        growth,
                        friction: vec![c[2], length],
                    });
                }
            }
            best.extend(
                starts.into_iter().min_by(|a, b| a.residual_sum.total_cmp(&b.residual_sum)),
            );
        }
        best
    }

    /// Returns guesses of `form` with two friction elements, for each pair of lengths.
    fn pairs(&self, form: LoopForm) -> Vec<Start> {
        (0..LENGTHS)
            .flat_map(|slow| (0..slow).map(move |fast| (fast, slow)))
            .filter_map(|(fast, slow)| self.pair(form, fast, slow))
            .collect()
    }

    /// Returns the guess of `form` with the lengths of the indices `fast` and `slow`; `None` if the
    /// best pair of elements is not admitted.
    fn pair(&self, form: LoopForm, fast: usize, slow: usize) -> Option<Start> {
        let mut columns = vec![0, 1, 2 + 2 * fast, 2 + 2 * slow];
        if form.has_growth() {
            columns.extend([3 + 2 * fast, 3 + 2 * slow]);
        }
        let Solution { coefficients: c, residual_sum } = self.fit.solve(&columns)?;
        let part = c[3] / c[2];
        let is_admitted = match form.order {
            FrictionOrder::Second => part < 0.0 && part > -LARGEST_REDUCTION,
            _ => part > 0.0 && part < LARGEST_ADDITION,
        };

        // Both elements have one growth, which is their mean.
        let growth = match c.get(4..6) {
            Some(added) => (added[0] + added[1]) / (c[2] + c[3]) / self.largest,
            None => 0.0,
        };
        (c[2] > 0.0 && is_admitted).then(|| Start {
            residual_sum,
            elastic: vec![c[0]],
            zero: c[1],
            growth,
            friction: vec![c[2], self.lengths[slow], part, self.lengths[fast] / self.lengths[slow]],
        })
    }

    /// Returns the guess of `form` for a curve whose linear fit has no solution.
    fn fallback(&self, form: LoopForm) -> Start {
        let mut friction = vec![0.05 * self.curve.load_range().span(), 0.05 * self.largest];
        match form.order {
            FrictionOrder::First => {}
            FrictionOrder::TwoElements => friction.extend([SLOW_START, RATIO_START]),
            FrictionOrder::Second => friction.extend([-SLOW_START, RATIO_START]),
        }
        let elastic = match form.elastic {
            Elastic::Line => vec![self.slope],
            Elastic::Varying => vec![self.slope, CHANGE_START * self.slope, 0.5 * self.largest],
        };
        Start { residual_sum: 0.0, elastic, zero: 0.0, growth: 0.0, friction }
    }

    /// Returns the parameters of `form` with the values of `start`.
    fn named_parameters(&self, form: LoopForm, start: &Start) -> Vec<NamedParameter> {
        let (slope, load) = (self.slope, self.curve.load_range().span());
        let largest = self.largest;
        let stiffness = |value: f64| Parameter::new(value).between(1e-3 * slope, 10.0 * slope);
        let mut named = match *start.elastic {
            [initial, last, transition] => {
                let [least, most] = TRANSITION_RANGE.map(|part| part * largest);
                vec![
                    NamedParameter::new("initial_stiffness", stiffness(initial)),
                    NamedParameter::new("final_stiffness", stiffness(last)),
                    NamedParameter::new(
                        "transition",
                        Parameter::new(transition).between(least, most),
                    ),
                ]
            }
            _ => vec![NamedParameter::new(self.name, stiffness(start.elastic[0]))],
        };

        let zero = Parameter { start: start.zero, ..zero(self.curve) };
        named.push(NamedParameter::new("zero", zero));
        if form.has_growth() {
            let growth = Parameter::new(start.growth.max(0.0))
                .with_scale(1.0 / largest)
                .between(0.0, LARGEST_GROWTH);
            named.push(NamedParameter::new("growth", growth));
        }

        let plateau =
            Parameter::new(start.friction[0]).with_scale(0.01 * load).between(0.0, 2.0 * load);
        let length =
            Parameter::new(start.friction[1]).between(LEAST_LENGTH * largest, 5.0 * largest);
        named.push(NamedParameter::new("plateau", plateau));
        named.push(NamedParameter::new("length", length));
        if let [_, _, slow, ratio] = *start.friction {
            let (least, most) = match form.order {
                FrictionOrder::Second => (-LARGEST_REDUCTION, 0.0),
                _ => (0.0, LARGEST_ADDITION),
            };
            let slow = Parameter::new(slow).between(least, most);
            named.push(NamedParameter::new("slow", slow));
            named.push(NamedParameter::new("ratio", Parameter::new(ratio).between(0.01, 0.95)));
        }
        named
    }
}

#[cfg(test)]
mod tests {
    use drape_kes::{Direction, Test};

    use super::*;
    use crate::settings::model::Plateau;

    #[test]
    fn a_guess_follows_a_loop_of_two_elements_with_lengths_of_the_grid() {
        // In 1/m, from 0 to 250, back to -250 and to 250 again.
        let history: Vec<f64> = (0..=200)
            .map(|k| match k {
                0..=40 => 6.25 * f64::from(k),
                41..=120 => 250.0 - 6.25 * f64::from(k - 40),
                _ => -250.0 + 6.25 * f64::from(k - 120),
            })
            .collect();
        let [fast, slow] = [3, 10];
        let lengths: [f64; LENGTHS] =
            geometric_grid(LENGTH_RANGE[0] * 250.0, LENGTH_RANGE[1] * 250.0);
        let path = FrictionPath::new(&history);
        for (part, order) in [(0.4, FrictionOrder::TwoElements), (-0.3, FrictionOrder::Second)] {
            for growth in [0.0, 0.002] {
                let [one, other] = [fast, slow].map(|i| {
                    let UnitFriction { constant, growing, .. } = path.unit_friction(lengths[i]);
                    let unit = constant.iter().zip(&growing).map(|(c, g)| c + growth * g);
                    unit.collect::<Vec<f64>>()
                });
                let load = (0..history.len())
                    .map(|i| 1e-5 * history[i] + 2e-4 + 3e-4 * (one[i] + part * other[i]))
                    .collect();
                let curve = Curve::new(Test::Bending, Direction::Warp, history.clone(), load);
                let curve = curve.expect("a loop");
                let measured = MeasuredLoop::new(&curve, "rigidity", &history).expect("it bends");
                let plateau = if growth > 0.0 { Plateau::Growing } else { Plateau::Constant };
                let starts = measured.pairs(LoopForm { elastic: Elastic::Line, order, plateau });
                let best = starts
                    .into_iter()
                    .min_by(|a, b| a.residual_sum.total_cmp(&b.residual_sum))
                    .expect("a guess");
                let start = [&best.elastic[..], &[best.zero], &best.friction].concat();
                let ratio = lengths[fast] / lengths[slow];
                let exact = [1e-5, 2e-4, 3e-4, lengths[slow], part, ratio];
                for (start, exact) in start.iter().zip(exact) {
                    assert!((start / exact - 1.0).abs() < 1e-6, "{start} is not {exact}");
                }
                assert!((best.growth - growth).abs() < 1e-6 * 0.002, "{}", best.growth);
            }
        }
    }
}
