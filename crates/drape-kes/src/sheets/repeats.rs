//! Repeats of one test on further specimens: the sheet keeps the mean of the curves and their
//! scatter.
//!
//! Specimens of one fabric differ by some 5 to 10 %. The law of the first curve would be the law of
//! one specimen. The law of the mean curve is the law of the fabric, and the intervals contain the
//! scatter ([`Curve::repeats`]).

use crate::curves::curve::Curve;
use crate::sheets::findings::Findings;
use crate::test::Test;

/// Replaces each group of repeats in `curves` by its mean, in the place of the first repeat.
pub(crate) fn with_means(curves: Vec<Curve>, findings: &mut Findings<'_>) -> Vec<Curve> {
    let mut groups: Vec<Vec<Curve>> = Vec::new();
    for curve in curves {
        match groups.iter_mut().find(|group| is_repeat(&group[0], &curve)) {
            Some(group) => group.push(curve),
            None => groups.push(vec![curve]),
        }
    }
    groups.into_iter().map(|group| group_mean(group, findings)).collect()
}

/// Returns the mean of `group`, and adds a reading about the group.
fn group_mean(group: Vec<Curve>, findings: &mut Findings<'_>) -> Curve {
    let (first, count) = (group[0].clone(), group.len());
    if count == 1 {
        return first;
    }
    // A curve that is a mean itself weighs as many times as it has specimens.
    let specimens = group.into_iter().flat_map(specimens_of).collect();
    match Curve::mean(specimens) {
        Ok(mean) => {
            findings.readings.push(format!(
                "{} {}: {count} curves of one test are {} specimens; their mean is fitted, and their \
                 scatter is in the intervals",
                first.test.name(),
                first.direction.name(),
                mean.repeats().len()
            ));
            mean
        }
        Err(_) => first,
    }
}

/// Returns the specimens of `curve`: the curve itself, if the curve is not a mean.
fn specimens_of(curve: Curve) -> Vec<Curve> {
    if curve.repeats().is_empty() { vec![curve] } else { curve.repeats().to_vec() }
}

/// Returns whether `second` repeats the test of `curve`, with equal settings and to an equal limit.
///
/// Strips of loop bending are fitted together without a mean.
fn is_repeat(curve: &Curve, second: &Curve) -> bool {
    /// Relative difference of the limits of two curves up to which the curves are repeats: largest
    /// deformations, or largest loads of a tensile test.
    const SAME_LIMIT: f64 = 0.1;
    /// Relative difference of two gauges up to which the gauges count as equal.
    const SAME_GAUGE: f64 = 0.01;

    let same_gauge = match (curve.gauge, second.gauge) {
        (Some(a), Some(b)) => are_near(a, b, SAME_GAUGE),
        (a, b) => a == b,
    };
    curve.test == second.test
        && curve.test != Test::LoopBending
        && curve.direction == second.direction
        && curve.slack == second.slack
        && same_gauge
        && curve.branches().len() == second.branches().len()
        && are_near(limit(curve), limit(second), SAME_LIMIT)
}

/// Returns whether `a` and `b` differ by at most `tolerance` times the larger magnitude.
fn are_near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * a.abs().max(b.abs())
}

/// Returns the quantity at which `curve` turns back: the load of a tensile test, else the
/// deformation.
fn limit(curve: &Curve) -> f64 {
    let range = match curve.test {
        Test::Tensile => curve.load_range(),
        _ => curve.deformation_range(),
    };
    range.high
}

#[cfg(test)]
mod tests {
    use drape_input::{Document, Faults};

    use super::*;
    use crate::test::Direction;

    fn strip(direction: Direction, load: f64, strain: f64) -> Curve {
        let strain = vec![0.0, 0.5 * strain, strain, 0.5 * strain];
        let load = vec![0.0, 0.3 * load, load, 0.1 * load];
        Curve::new(Test::Tensile, direction, strain, load).expect("a curve")
    }

    #[test]
    fn curves_to_the_same_load_are_specimens_and_others_are_not() {
        let document = Document::new("sheet.toml", "");
        let mut findings = Findings::new(&document, Faults::default());
        let curves = vec![
            strip(Direction::Warp, 490.0, 0.05),
            strip(Direction::Weft, 490.0, 0.09),
            strip(Direction::Warp, 49.0, 0.02),
            strip(Direction::Warp, 495.0, 0.07),
        ];
        let with_means = with_means(curves, &mut findings);
        assert_eq!(with_means.len(), 3);
        assert_eq!(with_means[0].repeats().len(), 2);
        assert!((with_means[0].deformation()[2] - 0.06).abs() < 1e-12, "{:?}", with_means[0]);
        assert!(with_means[1..].iter().all(|curve| curve.repeats().is_empty()));
        let readings = &findings.readings;
        assert!(
            readings[0].starts_with("tensile warp: 2 curves of one test are 2 specimens"),
            "{readings:?}"
        );
    }
}
