//! Curves of further specimens of one test: the sheet keeps their mean and their scatter.
//!
//! Specimens of one fabric differ by some 5 to 10 %. The law of the first would be the law of one
//! specimen; the law of the mean is that of the fabric, and the scatter is in its intervals
//! ([`Curve::repeats`]).

use crate::curves::curve::Curve;
use crate::sheets::findings::Findings;
use crate::test::Test;

/// Relative difference of two largest deformations, or loads of a tensile test, up to which two
/// curves are of the same test.
const SAME_LIMIT: f64 = 0.1;
/// Relative difference of two gauges up to which they are the same.
const SAME_GAUGE: f64 = 0.01;

/// Returns the curves with the mean of repeats in the place of the first of them.
pub(crate) fn joined(curves: Vec<Curve>, findings: &mut Findings<'_>) -> Vec<Curve> {
    let mut groups: Vec<Vec<Curve>> = Vec::new();
    for curve in curves {
        match groups.iter_mut().find(|group| is_repeat(&group[0], &curve)) {
            Some(group) => group.push(curve),
            None => groups.push(vec![curve]),
        }
    }
    groups.into_iter().map(|group| mean(group, findings)).collect()
}

/// Returns the mean of a group, and tells of it.
fn mean(group: Vec<Curve>, findings: &mut Findings<'_>) -> Curve {
    let (first, count) = (group[0].clone(), group.len());
    if count == 1 {
        return first;
    }
    // A mean of specimens is one of them: a curve of three repeats weighs three times.
    let specimens = group.into_iter().flat_map(specimens).collect();
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

/// Returns the specimens of a curve: itself, if it is no mean.
fn specimens(curve: Curve) -> Vec<Curve> {
    if curve.repeats().is_empty() { vec![curve] } else { curve.repeats().to_vec() }
}

/// Returns whether another curve is of the same test: in the same way, to the same limit.
///
/// Strips of loop bending are fitted together without a mean.
fn is_repeat(curve: &Curve, other: &Curve) -> bool {
    let near = |a: f64, b: f64, limit: f64| (a - b).abs() <= limit * a.abs().max(b.abs());
    let same_gauge = match (curve.gauge, other.gauge) {
        (Some(a), Some(b)) => near(a, b, SAME_GAUGE),
        (a, b) => a == b,
    };
    curve.test == other.test
        && curve.test != Test::LoopBending
        && curve.direction == other.direction
        && curve.slack == other.slack
        && same_gauge
        && curve.branches().len() == other.branches().len()
        && near(limit(curve), limit(other), SAME_LIMIT)
}

/// Returns the quantity at which a test turns back: the load of a tensile test, the deformation of
/// another.
fn limit(curve: &Curve) -> f64 {
    let range = match curve.test {
        Test::Tensile => curve.load_range(),
        _ => curve.deformation_range(),
    };
    range.high
}

#[cfg(test)]
mod tests {
    use drape_input::Document;

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
        let mut findings = Findings::new(&document);
        let curves = vec![
            strip(Direction::Warp, 490.0, 0.05),
            strip(Direction::Weft, 490.0, 0.09),
            strip(Direction::Warp, 49.0, 0.02),
            strip(Direction::Warp, 495.0, 0.07),
        ];
        let joined = joined(curves, &mut findings);
        assert_eq!(joined.len(), 3);
        assert_eq!(joined[0].repeats().len(), 2);
        assert!((joined[0].deformation()[2] - 0.06).abs() < 1e-12, "{:?}", joined[0]);
        assert!(joined[1..].iter().all(|curve| curve.repeats().is_empty()));
        let told = &findings.readings;
        assert!(
            told[0].starts_with("tensile warp: 2 curves of one test are 2 specimens"),
            "{told:?}"
        );
    }
}
