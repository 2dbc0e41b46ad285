//! Checks of a curve: mistakes that are safe to repair, and curves that no fabric has.
//!
//! The last stage of `curve_file`. A repair is a warning. Every other mistake is an error that
//! names the reading that was probably meant.

use std::ops::RangeInclusive;

use crate::curves::branch::Branch;
use crate::curves::curve::{Curve, Point};
use crate::sheets::file::forms::Zero;
use crate::sheets::findings::Findings;
use crate::test::Test;
use drape_input::{Quantity, Unit, parse_unit};

/// Part of the load range by which unloading may lie above loading on average.
///
/// Noise of a few per cent averages out over the points of two branches. A curve with exchanged
/// branches or columns misses by its whole loop width, 5 % and more.
const GAIN_ALLOWED: f64 = 0.02;
/// Number of deformations at which two branches are compared.
const GAIN_POINTS: u32 = 32;

/// Part of the range of strains by which the first strain of a tensile test may miss zero.
const ZERO_ALLOWED: f64 = 0.005;

/// Part of the range of loads below which a load counts as no load.
const NO_LOAD: f64 = 0.02;

/// Key paths of a curve in the sheet, for the findings.
pub(crate) struct CurveKeyPaths {
    pub(crate) file: String,
    pub(crate) deformation: String,
    pub(crate) load: String,
    pub(crate) zero_strain: String,
    /// Whether the sheet declares the signs. Declared signs are kept.
    pub(crate) sign_is_declared: bool,
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
    /// Converts `number` of this axis to SI.
    fn convert(self, number: f64) -> f64 {
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

/// Returns the usual sizes of `test`, from the most limp to the stiffest fabric, with a margin on
/// both sides.
impl UsualSize {
    /// Returns the sizes from the most limp to the stiffest fabric, with a margin on both sides.
    fn for_test(test: Test) -> Option<Self> {
        let (deformation, load) = match test {
            Test::Tensile => (2e-3..=1.0, 0.2..=1e5),
            Test::Shear => (5e-3..=0.9, 0.02..=2e3),
            Test::Bending => (5.0..=5e3, 1e-7..=1.0),
            Test::LoopBending => return None,
        };
        Some(Self { deformation, load })
    }
}

/// Checks `curve` and repairs it where a repair is safe. Returns `None` after reporting a mistake.
pub(crate) fn examine(
    curve: Curve,
    written: &AxesAsWritten,
    keys: &CurveKeyPaths,
    findings: &mut Findings<'_>,
) -> Option<Curve> {
    let curve = remove_duplicates(curve, keys, findings);
    if let Some(mistake) = impossible_size(&curve, written) {
        findings.error(mistake.key(keys), mistake.message, mistake.help);
        return None;
    }

    if curve.test == Test::LoopBending {
        return Some(curve);
    }
    let curve = with_usual_signs(curve, keys, findings).prepared().into_owned();

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
        Some(zero) => begin_at_given_zero(&curve, zero, keys, findings),
        None => begin_at_zero(curve, keys, findings),
    }
}

/// Removes points of `curve` that repeat the point before.
fn remove_duplicates(curve: Curve, keys: &CurveKeyPaths, findings: &mut Findings<'_>) -> Curve {
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
struct ImpossibleSize {
    axis: Axis,
    message: String,
    help: String,
}

impl ImpossibleSize {
    /// Returns the key path of the axis among the paths `keys`.
    fn key<'a>(&self, keys: &'a CurveKeyPaths) -> &'a str {
        match self.axis {
            Axis::Deformation => &keys.deformation,
            Axis::Load => &keys.load,
        }
    }
}

/// Returns the axis of `curve` whose size no fabric has, with a suggestion that follows from the
/// numbers `written`.
fn impossible_size(curve: &Curve, written: &AxesAsWritten) -> Option<ImpossibleSize> {
    let usual = UsualSize::for_test(curve.test)?;
    let deformation = largest_magnitude(curve.deformation());
    let load = largest_magnitude(curve.load());
    let good_deformation = usual.deformation.contains(&deformation);
    let good_load = usual.load.contains(&load);
    if good_deformation && good_load {
        return None;
    }

    let (axis, name, size, range) = if good_deformation {
        (Axis::Load, "load", load, &usual.load)
    } else {
        (Axis::Deformation, "deformation", deformation, &usual.deformation)
    };
    let message = format!(
        "the {name} reaches {size:.3e} in SI; a {} test of a fabric reaches {:.0e} to {:.0e}",
        curve.test.name(),
        range.start(),
        range.end()
    );

    // Exchanged columns and another unit are the usual mistakes.
    let AxesAsWritten { deformation: q, load: f, .. } = written;
    let mut suggestions = Vec::new();
    let are_exchanged = usual.deformation.contains(&q.convert(f.largest).abs())
        && usual.load.contains(&f.convert(q.largest).abs());
    if are_exchanged {
        suggestions.push("exchange the columns of deformation and load".to_owned());
    }
    if axis == Axis::Deformation && good_load {
        for unit in deformation_units(curve.test) {
            let differs = (unit.quantity, unit.factor) != (q.unit.quantity, q.unit.factor);
            if differs && usual.deformation.contains(&(q.largest * unit.factor)) {
                suggestions.push(format!("write unit = \"{}\"", unit.spelling));
            }
        }
    }
    let help = match suggestions.as_slice() {
        [] => "check the column and its unit".to_owned(),
        suggestions => format!("did you mean to {}?", suggestions.join(", or to ")),
    };
    Some(ImpossibleSize { axis, message, help })
}

/// Returns the largest magnitude among `values`.
fn largest_magnitude(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

/// Returns the units of the deformation of `test` that are mistaken for each other.
fn deformation_units(test: Test) -> impl Iterator<Item = Unit> {
    let (quantity, spellings): (Quantity, &[&str]) = match test {
        Test::Tensile => (Quantity::Ratio, &["%", "1"]),
        Test::Shear => (Quantity::Angle, &["deg", "rad"]),
        Test::Bending => (Quantity::Curvature, &["1/cm", "1/m", "1/mm"]),
        Test::LoopBending => (Quantity::Length, &[]),
    };
    spellings.iter().filter_map(move |spelling| parse_unit(spelling, &[quantity]).ok())
}

/// Signs that are to be reversed.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Turn {
    deformation: bool,
    load: bool,
}

impl Turn {
    /// Returns the signs of `curve` that are certainly wrong.
    ///
    /// A strip is stretched and pulled, so both columns of a tensile test reach further above zero
    /// than below. A loop may lie anywhere, but its load rises with its deformation.
    fn certain(curve: &Curve) -> Self {
        if curve.test == Test::Tensile {
            // The zeros of a slack strip may be anywhere.
            let [deformation, load] = [curve.deformation_range(), curve.load_range()]
                .map(|range| !curve.slack && -range.low > range.high);
            return Self { deformation, load };
        }
        let (q, f) = (curve.deformation(), curve.load());
        let [middle, level] = [q, f].map(|values| values.iter().sum::<f64>() / values.len() as f64);
        let covariance: f64 = q.iter().zip(f).map(|(q, f)| (q - middle) * (f - level)).sum();
        Self { deformation: false, load: covariance < 0.0 }
    }
}

/// Reverses the sign of the load of `curve`, or of both columns, where the sign is wrong.
fn with_usual_signs(curve: Curve, keys: &CurveKeyPaths, findings: &mut Findings<'_>) -> Curve {
    let turn = Turn::certain(&curve);
    if keys.sign_is_declared || !(turn.deformation || turn.load) {
        return curve;
    }
    let (columns, key) = if turn.deformation && turn.load {
        ("deformation and load have", &keys.file)
    } else if turn.deformation {
        ("the deformation has", &keys.deformation)
    } else {
        ("the load has", &keys.load)
    };
    let help =
        "it was turned; reversed = true on the axis says the same, reversed = false keeps it";
    findings.warn(key, format!("{columns} the opposite sign"), help);
    let [deformation_sign, load_sign] =
        [turn.deformation, turn.load].map(|is_turned| if is_turned { -1.0 } else { 1.0 });
    let points = curve.points().map(|point| Point {
        deformation: deformation_sign * point.deformation,
        load: load_sign * point.load,
    });
    let points = points.collect();
    curve.with_points(points)
}

/// Largest excess of unloading over loading, and its deformation in SI.
struct EnergyGain {
    deformation: f64,
    /// Excess over the load range, a ratio.
    excess: f64,
}

/// Returns the largest excess in the first pair of neighbouring branches of `curve` that gains
/// energy.
fn energy_gain(curve: &Curve) -> Option<EnergyGain> {
    let span = curve.load_range().span();
    let points: Vec<Point> = curve.points().collect();
    curve.branches().windows(2).find_map(|pair| gain_of_pair(pair, &points, span))
}

/// Returns the largest excess of two neighbouring branches of `points`, over the `span` of the
/// loads. Returns `None` if the pair gains no energy.
fn gain_of_pair(pair: &[Branch], points: &[Point], span: f64) -> Option<EnergyGain> {
    let [first, second] = [&pair[0], &pair[1]].map(|branch| {
        let mut sorted = points[branch.points.clone()].to_vec();
        sorted.sort_by(|a, b| a.deformation.total_cmp(&b.deformation));
        sorted
    });
    let (rising, falling) = if pair[0].rising { (first, second) } else { (second, first) };

    // The branches are compared where both were measured.
    let from = rising[0].deformation.max(falling[0].deformation);
    let to = rising[rising.len() - 1].deformation.min(falling[falling.len() - 1].deformation);
    let mut gains = Vec::with_capacity(GAIN_POINTS as usize);
    for step in 0..GAIN_POINTS {
        let deformation = from + (to - from) * (f64::from(step) + 0.5) / f64::from(GAIN_POINTS);
        let excess = load_at(&falling, deformation) - load_at(&rising, deformation);
        gains.push(EnergyGain { deformation, excess: excess / span });
    }

    // Noise may exceed the limit at one deformation, but not on average.
    let mean = gains.iter().map(|gain| gain.excess).sum::<f64>() / gains.len() as f64;
    let worst = gains.into_iter().max_by(|a, b| a.excess.total_cmp(&b.excess));
    worst.filter(|_| to > from && mean > GAIN_ALLOWED)
}

/// Returns the load at `deformation`, interpolated between `points` sorted by deformation.
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

/// Shifts a tensile `curve` to begin at zero strain, if the curve begins without load. Returns
/// `None` after reporting a curve that begins with a load.
fn begin_at_zero(curve: Curve, keys: &CurveKeyPaths, findings: &mut Findings<'_>) -> Option<Curve> {
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

/// Shifts a tensile `curve` to begin at the strain `zero`, and removes the slack before it. Returns
/// `None` after reporting a `zero` outside the strains.
fn begin_at_given_zero(
    curve: &Curve,
    zero: f64,
    keys: &CurveKeyPaths,
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
