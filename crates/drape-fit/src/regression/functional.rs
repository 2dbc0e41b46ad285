//! Areas and means of a curve that a fit meets beside the points.
//!
//! The residuals of a law that misses a curve systematically add up: with a misfit of 0.9 % of the
//! range a law may miss the work under a hollow curve by 5 %. Users read the KES values of a law
//! first, so a fit of such a law gives each KES value the weight of all points together.

use drape_kes::{Branch, Curve, Test};

/// Part of the first loading branch over which the load at its end is averaged.
///
/// It holds enough points for the noise of a load to average out, and so few that the law cannot
/// turn within it.
const TOP: f64 = 0.02;

/// Part of the largest deformation on each side of a point of evaluation whose loads are averaged.
const WINDOW: f64 = 0.04;

/// Linear functional of the loads of a curve, such as the work under a branch.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Functional {
    terms: Vec<Term>,
    /// Value of the functional for the measured loads; greater than 0.
    measured: f64,
}

/// Point of a functional with its coefficient.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Term {
    point: usize,
    coefficient: f64,
}

impl Functional {
    /// Returns a functional of the `loads` of a curve; `None` if its value is not positive.
    fn new(terms: Vec<Term>, loads: &[f64]) -> Option<Self> {
        let unknown = Self { terms, measured: 1.0 };
        let measured = unknown.value(loads);
        (measured > 0.0).then_some(Self { measured, ..unknown })
    }

    /// Returns the value of the functional for other `loads` at the points of the curve.
    fn value(&self, loads: &[f64]) -> f64 {
        self.terms.iter().map(|term| term.coefficient * loads[term.point]).sum()
    }

    /// Returns the relative deviation of the value for `loads` from the measured value.
    pub(crate) fn deviation(&self, loads: &[f64]) -> f64 {
        self.value(loads) / self.measured - 1.0
    }

    /// Returns the derivative of [`Functional::deviation`] by a parameter, where `slope` is the
    /// derivative of the load at a point.
    pub(crate) fn slope(&self, slope: impl Fn(usize) -> f64) -> f64 {
        let terms = self.terms.iter();
        terms.map(|term| term.coefficient * slope(term.point)).sum::<f64>() / self.measured
    }

    /// Calls `add` with each point of the functional and its relative coefficient.
    pub(crate) fn for_each(&self, mut add: impl FnMut(usize, f64)) {
        for term in &self.terms {
            add(term.point, term.coefficient / self.measured);
        }
    }
}

/// Returns the functionals of a loop that a law should meet: the slope of the middle line between
/// the two deformations `slope`, and the width at each of `widths`. Both are means of the two
/// sides.
///
/// Loads are averaged over windows about these deformations, on all branches that pass them. A loop
/// that does not pass a deformation in both directions has no such functional.
pub(crate) fn loop_functionals(curve: &Curve, slope: [f64; 2], widths: &[f64]) -> Vec<Functional> {
    let largest = curve.deformation().iter().fold(0.0_f64, |largest, q| largest.max(q.abs()));
    let half = WINDOW * largest;
    let mut functionals = Vec::new();
    let [from, to] = slope;
    let mut terms = Vec::new();
    for side in [1.0, -1.0] {
        if let (Some(outer), Some(inner)) = (
            middle_load(curve, side * to, half, side),
            middle_load(curve, side * from, half, -side),
        ) {
            terms.extend(outer);
            terms.extend(inner);
        }
    }

    functionals.extend(Functional::new(terms, curve.load()));

    for width in widths {
        let mut terms = Vec::new();
        for q in [*width, -width] {
            let rising = mean_load(curve, Window { center: q, half, rising: true }, 1.0);
            let falling = mean_load(curve, Window { center: q, half, rising: false }, -1.0);
            if let (Some(rising), Some(falling)) = (rising, falling) {
                terms.extend(rising);
                terms.extend(falling);
            }
        }
        functionals.extend(Functional::new(terms, curve.load()));
    }
    functionals
}

/// Returns the load of the middle line of a loop at the deformation `q`, times `sign`, averaged
/// over a window of half the width `half`.
fn middle_load(curve: &Curve, q: f64, half: f64, sign: f64) -> Option<Vec<Term>> {
    let mut terms = mean_load(curve, Window { center: q, half, rising: true }, 0.5 * sign)?;
    terms.extend(mean_load(curve, Window { center: q, half, rising: false }, 0.5 * sign)?);
    Some(terms)
}

/// Window of deformations about a `center`, with the half width `half`, on branches of one
/// direction.
#[derive(Clone, Copy)]
struct Window {
    center: f64,
    half: f64,
    rising: bool,
}

/// Returns the mean load within `window`, times `factor`, on the last branch that passes the whole
/// window; `None` if there is no such branch.
fn mean_load(curve: &Curve, window: Window, factor: f64) -> Option<Vec<Term>> {
    let Window { center, half, rising } = window;
    let deformation = curve.deformation();
    let branches = curve.branches();
    let branch = branches.iter().rev().find(|branch| {
        let ends = [deformation[branch.points.start], deformation[branch.points.end - 1]];
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        branch.rising == rising && low <= center - half && high >= center + half
    })?;
    let points: Vec<usize> =
        branch.points.clone().filter(|&i| (deformation[i] - center).abs() <= half).collect();
    let coefficient = factor / points.len() as f64;
    let terms = points.into_iter().map(|point| Term { point, coefficient }).collect::<Vec<_>>();
    (!terms.is_empty()).then_some(terms)
}

/// Returns the functionals of the first cycle of the tensile `curve` that a law should meet: the
/// work up to the largest load, the largest load, and the work recovered down to zero load.
///
/// A strip that hung slack has no functionals, because its zeros are fitted.
pub(crate) fn tensile_functionals(curve: &Curve) -> Vec<Functional> {
    if curve.test != Test::Tensile || curve.slack {
        return Vec::new();
    }
    let branches = curve.branches();
    let Some(loading) = branches.first().filter(|branch| branch.rising) else {
        return Vec::new();
    };
    let mut functionals: Vec<Functional> = Vec::new();
    functionals.extend(area(curve, loading, loading.points.end));
    functionals.extend(top(curve, loading));
    if let Some(recovery) = branches.get(1) {
        let load = &curve.load()[recovery.points.clone()];
        let slack = load.iter().position(|&load| load <= 0.0).map_or(load.len(), |at| at + 1);
        functionals.extend(area(curve, recovery, recovery.points.start + slack));
    }
    functionals
}

/// Returns the area under the points of `branch` before the point `end`, by trapezoids, positive
/// for either direction.
fn area(curve: &Curve, branch: &Branch, end: usize) -> Option<Functional> {
    let first = branch.points.start;
    let strain = &curve.deformation()[first..end];
    if strain.len() < 2 {
        return None;
    }
    let sign = if branch.rising { 0.5 } else { -0.5 };
    let mut terms: Vec<Term> = (first..end).map(|point| Term { point, coefficient: 0.0 }).collect();
    for (i, pair) in strain.windows(2).enumerate() {
        let half = sign * (pair[1] - pair[0]);
        terms[i].coefficient += half;
        terms[i + 1].coefficient += half;
    }
    Functional::new(terms, curve.load())
}

/// Returns the mean load at the end of the branch `loading`.
fn top(curve: &Curve, loading: &Branch) -> Option<Functional> {
    let count = ((TOP * loading.points.len() as f64) as usize).max(1);
    let first = loading.points.end - count;
    let coefficient = 1.0 / count as f64;
    let terms = (first..loading.points.end).map(|point| Term { point, coefficient }).collect();
    Functional::new(terms, curve.load())
}

#[cfg(test)]
mod tests {
    use drape_kes::Direction;

    use super::*;

    /// A line to 4 % and 100 N/m, and a steeper line back that meets zero load at 2 %.
    fn curve() -> Curve {
        let up = (0..=40).map(|i| (0.001 * f64::from(i), 2.5 * f64::from(i)));
        let down = (0..40).rev().map(|i| (0.001 * f64::from(i), 5.0 * f64::from(i) - 100.0));
        let (strain, load) = up.chain(down.map(|(q, f)| (q, f.max(0.0)))).unzip();
        Curve::new(Test::Tensile, Direction::Warp, strain, load).expect("a curve")
    }

    #[test]
    fn the_functionals_are_the_areas_and_the_load_at_the_top() {
        let curve = curve();
        let functionals = tensile_functionals(&curve);
        // ½·0.04·100, the last load, ½·0.02·100.
        let exact = [2.0, 100.0, 1.0];
        assert_eq!(functionals.len(), exact.len());
        for (functional, exact) in functionals.iter().zip(exact) {
            let measured = functional.measured;
            assert!((measured / exact - 1.0).abs() < 1e-12, "{measured} is not {exact}");
            let tenth: Vec<f64> = curve.load().iter().map(|load| 1.1 * load).collect();
            assert!((functional.deviation(&tenth) - 0.1).abs() < 1e-12);
            // The derivative by a factor of all loads.
            let slope = functional.slope(|point| curve.load()[point]);
            assert!((slope - 1.0).abs() < 1e-12, "{slope}");
        }
    }

    #[test]
    fn a_strip_that_hung_slack_has_none() {
        let mut curve = curve();
        curve.slack = true;
        assert!(tensile_functionals(&curve).is_empty());
    }
}
