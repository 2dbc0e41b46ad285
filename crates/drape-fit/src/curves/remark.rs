//! Remarks on a fit in sentences: on its curve, its law and its parameters.

use drape_kes::{Curve, Test};

use crate::regression::candidate::Candidate;
use crate::regression::curve_fit::CurveFit;
use crate::regression::estimate::{Estimate, Undetermined};
use crate::settings::FitSettings;

/// Number of parts of a branch whose residuals are compared.
const PARTS: usize = 5;
/// Relative difference between the two sides of a loop that is reported.
///
/// The two faces of a fabric differ by a few per cent as a rule.
const SIDES_DIFFER: f64 = 0.1;
/// Offset of a loop over its range of loads that is reported.
const OFFSET: f64 = 0.03;

/// Returns the remarks on the `fit` of `curve`, one sentence each, without a full stop.
pub(crate) fn remarks(curve: &Curve, fit: &CurveFit, settings: &FitSettings) -> Vec<String> {
    let mut remarks = curve.remarks();
    if fit.misfit > Candidate::FOLLOWS {
        remarks.push(departure(fit));
    }
    remarks.extend(fit.parameters.iter().filter_map(at_bound));
    if matches!(curve.test, Test::Bending | Test::Shear) {
        remarks.extend(sides(curve, settings));
        remarks.extend(offset(curve, fit));
    }
    remarks
}

/// Returns the place where a law that does not follow its curve departs most from it, for the
/// `fit`.
fn departure(fit: &CurveFit) -> String {
    let (least, most) = fit
        .measured
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), f| (low.min(*f), high.max(*f)));
    let span = most - least;
    let branch_count = fit.branches.last().map_or(1, |last| last + 1);

    let mut worst = BranchPart { branch: 0, from: 0.0, to: 0.0, departure: 0.0 };
    for branch in 0..branch_count {
        let points: Vec<usize> =
            (0..fit.branches.len()).filter(|&i| fit.branches[i] == branch).collect();
        for part in points.chunks(points.len().div_ceil(PARTS).max(1)) {
            let mean = part.iter().map(|&i| fit.load[i] - fit.measured[i]).sum::<f64>()
                / part.len() as f64;
            if mean.abs() > worst.departure.abs() {
                let (from, to) = (fit.deformation[part[0]], fit.deformation[part[part.len() - 1]]);
                worst = BranchPart { branch, from, to, departure: mean };
            }
        }
    }

    let BranchPart { branch, from, to, departure } = worst;
    let side = if departure > 0.0 { "above" } else { "below" };
    format!(
        "no law of the set follows this curve to {:.0} %; the law departs most on branch {}, between {} \
         and {}, where it lies {side} by {:.1} % of the range",
        100.0 * Candidate::FOLLOWS,
        branch + 1,
        fit.test.describe(from),
        fit.test.describe(to),
        100.0 * departure.abs() / span
    )
}

/// Part of a branch with the mean distance of the law from it.
struct BranchPart {
    branch: usize,
    /// Deformation at its first point.
    from: f64,
    /// Deformation at its last point.
    to: f64,
    /// Mean load of the law less the mean measured load.
    departure: f64,
}

/// Returns the meaning of an `estimate` at its bound; `None` for an estimate within its bounds.
fn at_bound(estimate: &Estimate) -> Option<String> {
    let Err(Undetermined::AtBound(bound)) = &estimate.interval else { return None };
    let is_zero = *bound == 0.0;
    Some(match (estimate.name, is_zero) {
        ("toe_end", _) => {
            "the toe does not end within the test; beyond its largest strain the law continues as its \
             tangent"
                .into()
        }
        ("steepness", _) if *bound < 1.0 => "the toe is a straight line".into(),
        ("steepness", _) => "the toe is flat up to a corner at its end".into(),
        ("friction_ratio", false) => {
            "the friction is as large against the elastic load as the law allows; the recovery falls \
             to nearly nothing within some friction lengths"
                .into()
        }
        ("base_stiffness", true) => "the curve has no straight part beside its toe".into(),
        ("friction_plateau" | "plateau", true) => {
            "the curve shows no friction without tension".into()
        }
        ("toe_ratio", _) => "the priming zone is as hollow as the law allows".into(),
        ("toe_growth", _) if *bound == 1.0 => "the toe does not move with the strain".into(),
        ("toe_growth", _) => "the toe moves as far with the strain as the law allows".into(),
        ("final_stiffness", _) => "the stiffness falls to nearly nothing towards the end of the test".into(),
        ("initial_stiffness", _) => "the curve begins with nearly no stiffness".into(),
        ("length" | "friction_length", _) => {
            "the friction length lies at its bound: the friction is like a step, or like a stiffness, \
             at this sampling"
                .into()
        }
        ("growth", true) => "the loop does not widen with the angle".into(),
        ("transition", _) => {
            "the stiffness changes at the very start of the test, or beyond its end".into()
        }
        (name, _) => format!("{name} lies at its bound, {bound:.4}"),
    })
}

/// Returns the difference of the two sides of a loop, if it is large.
fn sides(curve: &Curve, settings: &FitSettings) -> Option<String> {
    let (name, slope) = match curve.test {
        Test::Bending => ("B", settings.bending_points.slope),
        _ => ("G", settings.shear_points.slope),
    };
    let [positive, negative] = curve.side_slopes(slope)?;
    let mean = 0.5 * (positive + negative);
    let part = (positive - negative).abs() / mean;
    (part > SIDES_DIFFER).then(|| {
        format!(
            "the two sides of the fabric differ: {name} is {:+.0} % of the mean to the one side and \
             {:+.0} % to the other; the law has the mean",
100.0 * (positive / mean - 1.0),
100.0 * (negative / mean - 1.0)
        )
    })
}

/// Returns the offset of a loop `curve`, if it is large.
fn offset(curve: &Curve, fit: &CurveFit) -> Option<String> {
    let zero = fit.parameters.iter().find(|estimate| estimate.name == "zero")?.value;
    let part = zero / curve.load_range().span();
    (part.abs() > OFFSET).then(|| {
        format!(
            "the loop is offset by {:+.1} % of its range of loads: the zero of the instrument, or a \
             fabric that is not straight at rest; the law has no offset",
            100.0 * part
        )
    })
}

#[cfg(test)]
mod tests {
    use drape_kes::Direction;

    use super::*;
    use crate::curves::bending::identify_bending;
    use crate::curves::tensile::identify_tensile;

    fn loop_of(moment: impl Fn(f64) -> f64) -> Curve {
        let up = (0..=100).map(|i| 2.5 * f64::from(i));
        let down = (1..=200).map(|i| 250.0 - 2.5 * f64::from(i));
        let back = (1..=100).map(|i| -250.0 + 2.5 * f64::from(i));
        let curvature: Vec<f64> = up.chain(down).chain(back).collect();
        let rises = |i: usize| !(101..=300).contains(&i);
        let load = curvature.iter().enumerate().map(|(i, &k)| {
            let friction = 6e-4 * (1.0 - (-k.abs().max(5.0) / 4.0).exp());
            moment(k) + if rises(i) { friction } else { -friction }
        });
        let load = load.collect();
        Curve::new(Test::Bending, Direction::Warp, curvature, load).expect("a loop")
    }

    #[test]
    fn sides_that_differ_and_an_offset_are_told() {
        let remarks = |curve: Curve| {
            let found = identify_bending(&curve, &FitSettings::default()).expect("it bends");
            found.fit.remarks.join("; ")
        };
        assert_eq!(remarks(loop_of(|k| 1e-5 * k)), "");
        let uneven = remarks(loop_of(|k| if k > 0.0 { 1.2e-5 * k } else { 0.8e-5 * k }));
        assert!(uneven.contains("the two sides of the fabric differ: B is +20 %"), "{uneven}");
        let offset = remarks(loop_of(|k| 1e-5 * k + 4e-4));
        assert!(offset.contains("the loop is offset by +6.5 %"), "{offset}");
    }

    #[test]
    fn a_law_that_does_not_follow_says_where_it_departs() {
        // A curve that falls in its middle, as of a yarn that slips.
        let strain: Vec<f64> = (0..=200).map(|i| 2.5e-4 * f64::from(i)).collect();
        let load = strain.iter().map(|e| {
            let slip = if *e > 0.025 { 120.0 * (1.0 - (-(e - 0.025) / 5e-4).exp()) } else { 0.0 };
            12_000.0 * e - slip
        });
        let load = load.collect();
        let curve = Curve::new(Test::Tensile, Direction::Warp, strain, load).expect("a curve");
        let fit = identify_tensile(&curve, &FitSettings::default()).expect("it rises").fit;
        assert!(fit.misfit > Candidate::FOLLOWS, "{}", fit.misfit);
        let remark = fit.remarks.join("; ");
        assert!(remark.contains("no law of the set follows this curve to 2 %"), "{remark}");
        assert!(remark.contains("on branch 1, between 1."), "{remark}");
    }
}
