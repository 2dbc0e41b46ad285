//! Checks of a curve: slips that are safe to repair, and curves that cannot be right.
//!
//! The last stage of `curve_file`. A repair is a warning; anything else is an error with the
//! reading that was probably meant.

use std::ops::RangeInclusive;

use crate::curves::branch::Branch;
use crate::curves::curve::{Curve, Extent, Point};
use crate::sheets::axis::Zero;
use crate::sheets::findings::Findings;
use crate::test::Test;
use drape_input::{Quantity, Unit, parse_unit};

/// Part of the load range by which unloading may lie above loading on average.
///
/// Noise of a few per cent averages out over the points of two branches; a curve whose branches or
/// columns are exchanged misses by its whole loop width, 5 % and more.
const GAIN_ALLOWED: f64 = 0.02;
/// Number of deformations at which two branches are compared.
const GAIN_POINTS: u32 = 32;

/// Part of its range by which a deformation may miss zero at the start of a tensile test.
const ZERO_ALLOWED: f64 = 0.005;

/// Part of its range below which a load counts as none.
const NO_LOAD: f64 = 0.02;

/// Key paths of a curve in the sheet, for the findings.
pub(crate) struct Keys {
    pub(crate) file: String,
    pub(crate) deformation: String,
    pub(crate) load: String,
    pub(crate) zero_strain: String,
    /// Whether the sheet says which way the signs are: they are then left as they are.
    pub(crate) turned: bool,
}

/// Numbers of an axis as written, and their conversion to SI.
#[derive(Clone, Copy)]
pub(crate) struct AsWritten {
    /// Largest absolute number.
    pub(crate) largest: f64,
    /// First number.
    pub(crate) first: f64,
    pub(crate) unit: Unit,
    /// Gauge of a length, or width of a whole load, in metres.
    pub(crate) size: Option<f64>,
    /// Zero of a length.
    pub(crate) zero: Option<Zero>,
}

impl AsWritten {
    /// Converts a number of this axis to SI.
    fn to_si(self, number: f64) -> f64 {
        let si = number * self.unit.factor;
        match (self.unit.quantity, self.size) {
            (Quantity::Length, Some(gauge)) => match self.zero {
                Some(Zero::Extension) => si / gauge,
                Some(Zero::Position) => (si - self.first * self.unit.factor) / gauge,
                _ => si / gauge - 1.0,
            },
            (Quantity::Force | Quantity::Moment, Some(width)) => si / width,
            _ => si,
        }
    }
}

/// Both axes of a curve as written.
pub(crate) struct AxesAsWritten {
    pub(crate) deformation: AsWritten,
    pub(crate) load: AsWritten,
    /// Strain of the file that counts as zero, a ratio, where the sheet has one.
    pub(crate) zero_strain: Option<f64>,
}

/// Largest deformation and load of a test on a fabric, in SI.
struct UsualSize {
    deformation: RangeInclusive<f64>,
    load: RangeInclusive<f64>,
}

impl UsualSize {
    /// Returns the sizes from the most limp to the stiffest fabric, with a margin on both sides.
    fn of(test: Test) -> Option<Self> {
        let (deformation, load) = match test {
            Test::Tensile => (2e-3..=1.0, 0.2..=1e5),
            Test::Shear => (5e-3..=0.9, 0.02..=2e3),
            Test::Bending => (5.0..=5e3, 1e-7..=1.0),
            Test::LoopBending => return None,
        };
        Some(Self { deformation, load })
    }
}

/// Checks a curve and repairs it where that is safe; `None` after reporting what is wrong with it.
pub(crate) fn examine(
    curve: Curve,
    written: &AxesAsWritten,
    keys: &Keys,
    findings: &mut Findings<'_>,
) -> Option<Curve> {
    let curve = without_duplicates(curve, keys, findings);
    if let Some(wrong) = wrong_size(&curve, written) {
        findings.error(wrong.key(keys), wrong.message, wrong.help);
        return None;
    }
    if curve.test == Test::LoopBending {
        return Some(curve);
    }
    let curve = upright(curve, keys, findings).prepared().into_owned();
    if let Some(EnergyGain { deformation, excess }) = energy_gain(&curve) {
        let message = format!(
            "unloading lies above loading, by {:.0} % of the load's range at a deformation of {deformation:.4e}",
            100.0 * excess
        );
        let help = "a fabric gives back less than it was given: are the columns exchanged, or the \
                    points not in the order of measurement?";
        findings.error(&keys.file, message, help);
        return None;
    }
    match written.zero_strain {
        Some(zero) => from_given_zero(&curve, zero, keys, findings),
        None => from_zero(curve, keys, findings),
    }
}

/// Leaves out points that repeat the one before.
fn without_duplicates(curve: Curve, keys: &Keys, findings: &mut Findings<'_>) -> Curve {
    let mut kept: Vec<Point> = curve.points().collect();
    let all = kept.len();
    kept.dedup();
    if kept.len() == all {
        return curve;
    }
    let message = format!("{} of {all} points repeat the one before", all - kept.len());
    findings.warn(&keys.file, message, "they were left out");
    curve.with_points(kept)
}

/// Axis of a curve.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Axis {
    Deformation,
    Load,
}

/// Axis of an impossible size, with what was probably meant.
struct WrongSize {
    axis: Axis,
    message: String,
    help: String,
}

impl WrongSize {
    fn key<'a>(&self, keys: &'a Keys) -> &'a str {
        match self.axis {
            Axis::Deformation => &keys.deformation,
            Axis::Load => &keys.load,
        }
    }
}

fn wrong_size(curve: &Curve, written: &AxesAsWritten) -> Option<WrongSize> {
    let usual = UsualSize::of(curve.test)?;
    let size = |values: &[f64]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let (deformation, load) = (size(curve.deformation()), size(curve.load()));
    let good_deformation = usual.deformation.contains(&deformation);
    let good_load = usual.load.contains(&load);
    if good_deformation && good_load {
        return None;
    }
    let (axis, name, found, range) = if good_deformation {
        (Axis::Load, "load", load, &usual.load)
    } else {
        (Axis::Deformation, "deformation", deformation, &usual.deformation)
    };
    let message = format!(
        "the {name} reaches {found:.3e} in SI; a {} test of a fabric reaches {:.0e} to {:.0e}",
        curve.test.name(),
        range.start(),
        range.end()
    );
    let AxesAsWritten { deformation: q, load: f, .. } = written;
    let mut help = Vec::new();
    let exchanged = usual.deformation.contains(&q.to_si(f.largest).abs())
        && usual.load.contains(&f.to_si(q.largest).abs());
    if exchanged {
        help.push("exchange the columns of deformation and load".to_owned());
    }
    if axis == Axis::Deformation && good_load {
        for unit in deformation_units(curve.test) {
            let other = (unit.quantity, unit.factor) != (q.unit.quantity, q.unit.factor);
            if other && usual.deformation.contains(&(q.largest * unit.factor)) {
                help.push(format!("write unit = \"{}\"", unit.spelling));
            }
        }
    }
    let help = match help.as_slice() {
        [] => "check the column and its unit".to_owned(),
        readings => format!("did you mean to {}?", readings.join(", or to ")),
    };
    Some(WrongSize { axis, message, help })
}

/// Returns the units that are mistaken for each other.
fn deformation_units(test: Test) -> impl Iterator<Item = Unit> {
    let (quantity, spellings): (Quantity, &[&str]) = match test {
        Test::Tensile => (Quantity::Ratio, &["%", "1"]),
        Test::Shear => (Quantity::Angle, &["deg", "rad"]),
        Test::Bending => (Quantity::Curvature, &["1/cm", "1/m", "1/mm"]),
        Test::LoopBending => (Quantity::Length, &[]),
    };
    spellings.iter().filter_map(move |spelling| parse_unit(spelling, &[quantity]).ok())
}

/// Signs that are to be turned.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Turn {
    deformation: bool,
    load: bool,
}

impl Turn {
    /// Returns the signs that are wrong beyond doubt: none where the curve as it is given may be right.
    ///
    /// A strip is stretched and pulled, so both columns of a tensile test reach further above zero
    /// than below. A loop may lie anywhere, but its load rises with its deformation.
    fn of(curve: &Curve) -> Self {
        if curve.test == Test::Tensile {
            // The zeros of a slack strip may be anywhere.
            let below = |range: Extent| !curve.slack && -range.low > range.high;
            return Self {
                deformation: below(curve.deformation_range()),
                load: below(curve.load_range()) && !curve.slack,
            };
        }
        let (q, f) = (curve.deformation(), curve.load());
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let (middle, level) = (mean(q), mean(f));
        let covariance: f64 = q.iter().zip(f).map(|(q, f)| (q - middle) * (f - level)).sum();
        Self { deformation: false, load: covariance < 0.0 }
    }
}

/// Reverses the sign of the load, or of both columns, where it is the wrong one.
fn upright(curve: Curve, keys: &Keys, findings: &mut Findings<'_>) -> Curve {
    let Turn { deformation: turn_q, load: turn_f } = Turn::of(&curve);
    if keys.turned || !(turn_q || turn_f) {
        return curve;
    }
    let (columns, key) = match (turn_q, turn_f) {
        (true, true) => ("deformation and load have", &keys.file),
        (true, false) => ("the deformation has", &keys.deformation),
        _ => ("the load has", &keys.load),
    };
    let help =
        "it was turned; reversed = true on the axis says the same, reversed = false keeps it";
    findings.warn(key, format!("{columns} the opposite sign"), help);
    let sign = |turn: bool| if turn { -1.0 } else { 1.0 };
    let points = curve.points().map(|point| Point {
        deformation: sign(turn_q) * point.deformation,
        load: sign(turn_f) * point.load,
    });
    let points = points.collect();
    curve.with_points(points)
}

/// Largest excess of unloading over loading, over the load range.
struct EnergyGain {
    deformation: f64,
    excess: f64,
}

/// Returns the first pair of neighbouring branches that gains energy.
fn energy_gain(curve: &Curve) -> Option<EnergyGain> {
    let span = curve.load_range().span();
    let all: Vec<Point> = curve.points().collect();
    let gain_of = |pair: &[Branch]| -> Option<EnergyGain> {
        let (rising, falling) =
            if pair[0].rising { (&pair[0], &pair[1]) } else { (&pair[1], &pair[0]) };
        let sorted = |branch: &Branch| -> Vec<Point> {
            let mut points = all[branch.points.clone()].to_vec();
            points.sort_by(|a, b| a.deformation.total_cmp(&b.deformation));
            points
        };
        let (rising, falling) = (sorted(rising), sorted(falling));
        let from = rising[0].deformation.max(falling[0].deformation);
        let to = rising[rising.len() - 1].deformation.min(falling[falling.len() - 1].deformation);
        let gain = |step: u32| {
            let deformation = from + (to - from) * (f64::from(step) + 0.5) / f64::from(GAIN_POINTS);
            let excess = load_at(&falling, deformation) - load_at(&rising, deformation);
            EnergyGain { deformation, excess: excess / span }
        };
        let gains: Vec<EnergyGain> = (0..GAIN_POINTS).map(gain).collect();
        let mean = gains.iter().map(|gain| gain.excess).sum::<f64>() / gains.len() as f64;
        let worst = gains.into_iter().max_by(|a, b| a.excess.total_cmp(&b.excess));
        worst.filter(|_| to > from && mean > GAIN_ALLOWED)
    };
    curve.branches().windows(2).find_map(gain_of)
}

/// Returns the load at a deformation, interpolated between sorted points.
fn load_at(points: &[Point], deformation: f64) -> f64 {
    let after = points.partition_point(|point| point.deformation < deformation);
    let after = after.clamp(1, points.len() - 1);
    let (a, b) = (points[after - 1], points[after]);
    if b.deformation > a.deformation {
        let run = b.deformation - a.deformation;
        a.load + (b.load - a.load) * (deformation - a.deformation) / run
    } else {
        0.5 * (a.load + b.load)
    }
}

/// Shifts a tensile test to begin at zero strain, where it begins without load.
fn from_zero(curve: Curve, keys: &Keys, findings: &mut Findings<'_>) -> Option<Curve> {
    if curve.test != Test::Tensile || curve.slack {
        return Some(curve);
    }
    let (start, load) = (curve.deformation()[0], curve.load()[0]);
    if start.abs() <= ZERO_ALLOWED * curve.deformation_range().span() {
        return Some(curve);
    }
    if load.abs() > NO_LOAD * curve.load_range().span() {
        let message = format!("starts at a strain of {start:.4e} with a load of {load:.4e} N/m");
        let help = "measure from zero, or set slack = true so that both zeros are fitted";
        findings.error(&keys.deformation, message, help);
        return None;
    }
    let message = format!("starts at a strain of {start:.4e} without load");
    findings.warn(&keys.deformation, message, "the start was taken as zero");
    Some(curve.counted_from(start))
}

/// Shifts a tensile test to begin at a given zero of strain, and leaves out the slack before it.
fn from_given_zero(
    curve: &Curve,
    zero: f64,
    keys: &Keys,
    findings: &mut Findings<'_>,
) -> Option<Curve> {
    let shifted = curve.counted_from(zero).taut();
    if shifted.is_none() {
        let range = curve.deformation_range();
        let message = format!(
            "{:.3} % is not within the strains of the curve, {:.3} to {:.3} %",
            100.0 * zero,
            100.0 * range.low,
            100.0 * range.high
        );
        let help = "write the strain at which the strip is taut, such as \"0.8 %\"";
        findings.error(&keys.zero_strain, message, help);
    }
    shifted
}
