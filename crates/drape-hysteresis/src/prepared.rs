//! Dahl element prepared for SIMD loops.
//!
//! A [`PreparedDahl`] returns the results of a [`Dahl`] element over a straight path without
//! branches. The batch laws of a fabric call it once per lane.

use crate::dahl::Dahl;
use crate::exponential::exp_m1;

/// Straight path from the remembered deformation to a trial, for [`PreparedDahl`].
///
/// The weight of the plateau starts at `weight` and changes by `weight_slope` per unit of length.
/// Where the path passes a knot of the weight, a [`PassedKnot`] adds the contribution of the change
/// of slope at the knot. Contributions add because the equation is linear in the weight. The
/// results equal the results of a [`Dahl`] element over the pieces between the knots, each a
/// [`Slip`](crate::Slip).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Direction `$\sigma = \pm 1$`.
    pub sign: f64,
    /// Length of the path, at least 0, in the unit of the deformation.
    pub length: f64,
    /// Weight of the plateau at the start.
    pub weight: f64,
    /// Derivative of the weight with respect to the length of the path, at the start.
    pub weight_slope: f64,
}

/// Knot of the weight that a [`Stroke`] has passed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassedKnot {
    /// Change of the weight's slope along the path at the knot.
    pub slope_change: f64,
    /// Length of the path beyond the knot, or 0 if the path does not pass the knot.
    pub length: f64,
}

/// [`Dahl`] element with precomputed constants, for many evaluations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PreparedDahl {
    plateau: f64,
    length: f64,
    /// Reciprocal of `length`.
    inverse_length: f64,
}

/// Decay of the load over a length.
#[derive(Debug, Clone, Copy)]
struct Decay {
    /// Fraction of the load at the start that is lost.
    lost: f64,
    /// Length by which the load lags behind a linearly growing plateau.
    lag: f64,
}

impl PreparedDahl {
    /// Prepares `element`.
    #[must_use]
    pub fn new(element: Dahl) -> Self {
        Self {
            plateau: element.plateau,
            length: element.length,
            inverse_length: 1.0 / element.length,
        }
    }

    /// Returns the decay of the load over `length`.
    #[inline(always)]
    fn decay(&self, length: f64) -> Decay {
        let lost = -exp_m1(-length * self.inverse_length);
        Decay { lost, lag: length - self.length * lost }
    }

    /// Returns the load at the end of `stroke`, which began with `load`, in the unit of the load.
    #[inline(always)]
    #[must_use]
    pub fn load(&self, load: f64, stroke: Stroke) -> f64 {
        let Decay { lost, lag } = self.decay(stroke.length);
        let gained = stroke.weight * lost + stroke.weight_slope * lag;
        load * (1.0 - lost) + stroke.sign * self.plateau * gained
    }

    /// Returns the contribution of `knot` to the load at the end of a stroke in the direction
    /// `sign`, in the unit of the load.
    #[inline(always)]
    #[must_use]
    pub fn knot_load(&self, sign: f64, knot: PassedKnot) -> f64 {
        sign * self.plateau * knot.slope_change * self.decay(knot.length).lag
    }

    /// Returns the derivative of the load with respect to the deformation at the end of a stroke in
    /// the direction `sign`, in load per deformation. At this end the load is `load` and the weight
    /// is `weight`.
    #[inline(always)]
    #[must_use]
    pub fn tangent(&self, load: f64, sign: f64, weight: f64) -> f64 {
        (self.plateau * weight - sign * load) * self.inverse_length
    }

    /// Returns the work over `stroke`, which began with `load`, in load times deformation.
    #[inline(always)]
    #[must_use]
    pub fn work(&self, load: f64, stroke: Stroke) -> f64 {
        let Stroke { length, .. } = stroke;
        let Decay { lost, lag } = self.decay(length);
        let gained =
            stroke.weight * lag + stroke.weight_slope * (0.5 * length * length - self.length * lag);
        stroke.sign * load * self.length * lost + self.plateau * gained
    }

    /// Returns the contribution of `knot` to the work over a stroke, in load times deformation.
    #[inline(always)]
    #[must_use]
    pub fn knot_work(&self, knot: PassedKnot) -> f64 {
        let Decay { lag, .. } = self.decay(knot.length);
        self.plateau * knot.slope_change * (0.5 * knot.length * knot.length - self.length * lag)
    }

    /// Returns the energy that the element gives back when it is unloaded from `load`, like
    /// [`Dahl::stored`]. The plateau must not be 0.
    #[inline(always)]
    #[must_use]
    pub fn stored(&self, load: f64) -> f64 {
        0.5 * load * load * self.length / self.plateau
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Response, Slip};

    const ELEMENT: Dahl = Dahl { plateau: 0.7, length: 0.03 };

    /// Weight with a knot at 0.01, as in a yarn whose priming zone ends there.
    fn weight(at: f64) -> f64 {
        if at < 0.01 { 0.4 + 60.0 * at } else { 1.0 }
    }

    #[test]
    fn a_stroke_past_a_knot_equals_its_pieces_one_after_the_other() {
        let prepared = PreparedDahl::new(ELEMENT);
        for load in [-0.7, 0.0, 0.3] {
            for (from, to) in [(0.002_f64, 0.03), (0.03, 0.002), (0.0, 0.011), (0.2, -0.002)] {
                let sign = (to - from).signum();
                let start = if from < 0.01 { 60.0 * sign } else { 0.0 };
                let stroke = Stroke {
                    sign,
                    length: (to - from).abs(),
                    weight: weight(from),
                    weight_slope: start,
                };
                let knot = PassedKnot { slope_change: -60.0, length: (to - 0.01_f64).abs() };
                let slips = [
                    Slip::weighted(0.01 - from, weight(from), 1.0),
                    Slip::weighted(to - 0.01, 1.0, weight(to)),
                ];
                let middle = ELEMENT.advance(load, slips[0]);
                let Response { load: end, tangent: slope } = ELEMENT.respond(middle, slips[1]);
                let work = ELEMENT.work(load, slips[0]) + ELEMENT.work(middle, slips[1]);
                let found = prepared.load(load, stroke) + prepared.knot_load(sign, knot);
                assert!((found - end).abs() < 1e-15, "{from} to {to}: {found} {end}");
                let tangent = prepared.tangent(found, sign, weight(to));
                assert!((tangent - slope).abs() < 1e-13, "{tangent} {slope}");
                let found = prepared.work(load, stroke) + prepared.knot_work(knot);
                assert!((found - work).abs() < 1e-15, "{found} {work}");
            }
        }
    }

    #[test]
    fn a_stroke_stores_its_work_less_what_it_dissipates() {
        // From rest the load is F_c(1 − e), with e = exp(−u/x), and the loss ∫F²/F_c du is
        // F_c(u − 2x(1 − e) + x(1 − e²)/2).
        let prepared = PreparedDahl::new(ELEMENT);
        let Dahl { plateau, length } = ELEMENT;
        for u in [0.002_f64, 0.03, 0.2] {
            let e = (-u / length).exp();
            let lost = plateau * (u - 2.0 * length * (1.0 - e) + 0.5 * length * (1.0 - e * e));
            for sign in [1.0, -1.0] {
                let stroke = Stroke { sign, length: u, weight: 1.0, weight_slope: 0.0 };
                let stored = prepared.stored(prepared.load(0.0, stroke));
                let kept = prepared.work(0.0, stroke) - lost;
                assert!((stored - kept).abs() < 1e-15, "{stored} of {kept} over {u}");
            }
        }
    }
}
