//! Curves that cannot be what they say, and slips that are safe to repair.

use std::ops::RangeInclusive;

use crate::section::Findings;
use crate::{Branch, Curve, Test};

/// Part of the load's range by which unloading may lie above loading on average.
///
/// Noise of a few per cent averages out over the points of two branches; a curve whose branches are
/// exchanged, or whose columns are, misses by its whole loop width, 5 % and more.
const GAIN_ALLOWED: f64 = 0.02;

/// Part of its range by which a deformation may miss zero at the start of a tensile test.
const ZERO_ALLOWED: f64 = 0.005;

/// Part of its range below which a load counts as none.
const NO_LOAD: f64 = 0.02;

/// Where the sheet speaks of a curve, for the findings.
pub(crate) struct Keys {
    pub(crate) file: String,
    pub(crate) deformation: String,
    pub(crate) load: String,
}

/// Factors from the numbers as written to SI.
pub(crate) struct Factors {
    pub(crate) deformation: f64,
    pub(crate) load: f64,
}

/// Largest deformation and load that a test reaches on a fabric, in SI, from the most limp to the
/// stiffest, with room to spare on both sides.
fn usual(test: Test) -> Option<(RangeInclusive<f64>, RangeInclusive<f64>)> {
    match test {
        Test::Tensile => Some((2e-3..=1.0, 0.2..=1e5)),
        Test::Shear => Some((5e-3..=0.9, 0.02..=2e3)),
        Test::Bending => Some((5.0..=5e3, 1e-7..=1.0)),
        Test::LoopBending => None,
    }
}

/// The curve, repaired where that is safe, or nothing after reporting what is wrong with it.
pub(crate) fn examine(
    curve: Curve,
    factors: &Factors,
    keys: &Keys,
    findings: &mut Findings<'_>,
) -> Option<Curve> {
    let curve = without_duplicates(curve, keys, findings)?;
    if let Some(meant) = wrong_size(&curve, factors) {
        findings.error(&meant.key(keys), meant.message, meant.help);
        return None;
    }
    if curve.test == Test::LoopBending {
        return Some(curve);
    }
    let curve = upright(curve, keys, findings)?;
    if let Some((place, excess)) = gain(&curve) {
        let message = format!(
            "unloading lies above loading, by {:.0} % of the load's range at a deformation of {place:.4e}",
            100.0 * excess
        );
        let help = "a fabric gives back less than it was given: are the columns exchanged, or the \
                    points not in the order of measurement?";
        findings.error(&keys.file, message, help);
        return None;
    }
    from_zero(curve, keys, findings)
}

/// Leaves out points that repeat the one before.
fn without_duplicates(curve: Curve, keys: &Keys, findings: &mut Findings<'_>) -> Option<Curve> {
    let points = curve.deformation().iter().zip(curve.load());
    let mut kept: Vec<(f64, f64)> = points.map(|(&q, &f)| (q, f)).collect();
    let all = kept.len();
    kept.dedup();
    if kept.len() == all {
        return Some(curve);
    }
    let message = format!("{} of {all} points repeat the one before", all - kept.len());
    findings.warn(&keys.file, message, "they were left out");
    Some(curve.with_points(kept))
}

/// What a curve of impossible size was probably meant to be.
struct Meant {
    of_load: bool,
    message: String,
    help: String,
}

impl Meant {
    fn key(&self, keys: &Keys) -> String {
        if self.of_load { keys.load.clone() } else { keys.deformation.clone() }
    }
}

fn wrong_size(curve: &Curve, factors: &Factors) -> Option<Meant> {
    let (usual_deformation, usual_load) = usual(curve.test)?;
    let size = |values: &[f64]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let (deformation, load) = (size(curve.deformation()), size(curve.load()));
    let (good_deformation, good_load) =
        (usual_deformation.contains(&deformation), usual_load.contains(&load));
    if good_deformation && good_load {
        return None;
    }
    let (of_load, name, found, range) = if good_deformation {
        (true, "load", load, &usual_load)
    } else {
        (false, "deformation", deformation, &usual_deformation)
    };
    let message = format!(
        "the {name} reaches {found:.3e} in SI; a {} test of a fabric reaches {:.0e} to {:.0e}",
        curve.test.name(),
        range.start(),
        range.end()
    );
    let exchanged = (
        load / factors.load * factors.deformation,
        deformation / factors.deformation * factors.load,
    );
    let mut help = Vec::new();
    if usual_deformation.contains(&exchanged.0) && usual_load.contains(&exchanged.1) {
        help.push("exchange the columns of deformation and load".to_owned());
    }
    if !of_load && good_load {
        let written = deformation / factors.deformation;
        for (unit, factor) in deformation_units(curve.test) {
            if *factor != factors.deformation && usual_deformation.contains(&(written * factor)) {
                help.push(format!("write unit = \"{unit}\""));
            }
        }
    }
    let help = match help.as_slice() {
        [] => "check the column and its unit".to_owned(),
        readings => format!("did you mean to {}?", readings.join(", or to ")),
    };
    Some(Meant { of_load, message, help })
}

/// Units that are mistaken for each other, with their factors to SI.
fn deformation_units(test: Test) -> &'static [(&'static str, f64)] {
    match test {
        Test::Tensile => &[("%", 0.01), ("1", 1.0)],
        Test::Shear => &[("deg", std::f64::consts::PI / 180.0), ("rad", 1.0)],
        Test::Bending => &[("1/cm", 100.0), ("1/m", 1.0), ("1/mm", 1000.0)],
        Test::LoopBending => &[],
    }
}

/// Turns a curve whose load, or whose both columns, have the opposite sign.
fn upright(curve: Curve, keys: &Keys, findings: &mut Findings<'_>) -> Option<Curve> {
    let (q, f) = (curve.deformation(), curve.load());
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (middle, level) = (mean(q), mean(f));
    let together: f64 = q.iter().zip(f).map(|(q, f)| (q - middle) * (f - level)).sum();
    let falls = together < 0.0;
    // The zero of a slack strip lies anywhere.
    let backwards = curve.test == Test::Tensile && !curve.slack && {
        let (low, high) = curve.deformation_range();
        -low > high
    };
    let (turn_q, turn_f) = (backwards, falls != backwards);
    if !(turn_q || turn_f) {
        return Some(curve);
    }
    let (what, key) = match (turn_q, turn_f) {
        (true, true) => ("deformation and load have", &keys.file),
        (true, false) => ("the deformation has", &keys.deformation),
        _ => ("the load has", &keys.load),
    };
    findings.warn(key, format!("{what} the opposite sign"), "it was turned");
    let sign = |turn: bool| if turn { -1.0 } else { 1.0 };
    let points = q.iter().zip(f).map(|(q, f)| (sign(turn_q) * q, sign(turn_f) * f));
    let points = points.collect();
    Some(curve.with_points(points))
}

/// Where, and by which part of the load's range, two neighbouring branches gain energy.
fn gain(curve: &Curve) -> Option<(f64, f64)> {
    let (low, high) = curve.load_range();
    let branches = curve.branches();
    let excess = |pair: &[Branch]| -> Option<(f64, f64)> {
        let (rising, falling) =
            if pair[0].rising { (&pair[0], &pair[1]) } else { (&pair[1], &pair[0]) };
        let points = |branch: &Branch| -> Vec<(f64, f64)> {
            let q = &curve.deformation()[branch.points.clone()];
            let mut points: Vec<_> = q
                .iter()
                .copied()
                .zip(curve.load()[branch.points.clone()].iter().copied())
                .collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points
        };
        let (rising, falling) = (points(rising), points(falling));
        let from = rising[0].0.max(falling[0].0);
        let to = rising[rising.len() - 1].0.min(falling[falling.len() - 1].0);
        let steps = 32;
        let above = |step: usize| {
            let at = from + (to - from) * (step as f64 + 0.5) / f64::from(steps);
            (at, (between(&falling, at) - between(&rising, at)) / (high - low))
        };
        let all: Vec<(f64, f64)> = (0..steps as usize).map(above).collect();
        let mean = all.iter().map(|(_, excess)| excess).sum::<f64>() / all.len() as f64;
        let worst = all.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        worst.filter(|_| to > from && mean > GAIN_ALLOWED)
    };
    branches.windows(2).find_map(excess)
}

/// The load at a deformation between sorted points.
fn between(points: &[(f64, f64)], at: f64) -> f64 {
    let after = points.partition_point(|(q, _)| *q < at).clamp(1, points.len() - 1);
    let ((q0, f0), (q1, f1)) = (points[after - 1], points[after]);
    if q1 > q0 { f0 + (f1 - f0) * (at - q0) / (q1 - q0) } else { 0.5 * (f0 + f1) }
}

/// A tensile test begins at no strain; a small offset without load is taken out.
fn from_zero(curve: Curve, keys: &Keys, findings: &mut Findings<'_>) -> Option<Curve> {
    if curve.test != Test::Tensile || curve.slack {
        return Some(curve);
    }
    let (start, load) = (curve.deformation()[0], curve.load()[0]);
    let span = |(low, high): (f64, f64)| high - low;
    if start.abs() <= ZERO_ALLOWED * span(curve.deformation_range()) {
        return Some(curve);
    }
    if load.abs() > NO_LOAD * span(curve.load_range()) {
        let message = format!("starts at a strain of {start:.4e} with a load of {load:.4e} N/m");
        let help = "measure from zero, or set slack = true so that both zeros are fitted";
        findings.error(&keys.deformation, message, help);
        return None;
    }
    let message = format!("starts at a strain of {start:.4e} without load");
    findings.warn(&keys.deformation, message, "the start was taken as zero");
    let points = curve.deformation().iter().zip(curve.load()).map(|(q, f)| (q - start, *f));
    let points = points.collect();
    Some(curve.with_points(points))
}
