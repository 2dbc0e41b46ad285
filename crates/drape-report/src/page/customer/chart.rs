//! Chart of values over published ranges. A value with a published range has an axis. Another value
//! has only its number.

use drape_input::{figure, significant, typeset};

use super::report::CustomerPage;
use super::values::ReportedValue;
use crate::page::compared_value::ComparedNumber;
use crate::page::shown::ShownValue;
use crate::plot::COLOURS;

/// Part of the axis beyond the range at either side, as a power of the ratio of the ends of the
/// range.
const BEYOND: f64 = 0.3;

/// Smallest ratio of the ends of an axis.
const LEAST_RATIO: f64 = 1.5;

/// An axis with more decades than this has ticks at 1 only, not at 2 and 5.
const FINE_DECADES: f64 = 1.6;

/// Ticks within a decade.
const STEPS: [f64; 3] = [1.0, 2.0, 5.0];

/// Significant digits of the ends of a range.
const DIGITS: i32 = 3;

/// Row of the chart for one value.
pub(super) struct ChartRow<'a> {
    pub(super) value: &'a ReportedValue,
    pub(super) unit: &'a str,
    /// Axis, `None` where no range was published.
    pub(super) axis: Option<Axis>,
    pub(super) lanes: Vec<Lane>,
    /// Number of the source of the range, from 1. 0 without a source.
    pub(super) source: usize,
}

/// Logarithmic axis.
pub(super) struct Axis {
    /// Ticks: position in per cent, and label.
    pub(super) ticks: Vec<(String, String)>,
    /// Published ranges in words. Fabrics with different ranges have several.
    pub(super) usual: String,
}

/// Fabric within a row.
pub(super) struct Lane {
    /// Number of its colour.
    pub(super) colour: usize,
    /// Vertical position of the middle of the lane, in the unit of [`LANE`].
    pub(super) middle: String,
    /// Published range: position of its begin and its length, in per cent.
    pub(super) band: Option<[String; 2]>,
    /// Position of the value, in per cent.
    pub(super) at: Option<String>,
    /// Positions of the ends of the scatter of the value, in per cent.
    pub(super) scatter: Option<[String; 2]>,
    /// Whether the value is a value of a law, not a measured value.
    pub(super) is_of_law: bool,
    /// Value as text.
    pub(super) text: String,
}

/// Height of a lane in the figure.
pub(super) const LANE: f64 = 10.0;

/// Chart with the sources of its ranges. The rows refer to the sources by number, from 1.
pub(super) struct ValueChart<'a> {
    pub(super) rows: Vec<ChartRow<'a>>,
    pub(super) sources: Vec<&'a str>,
}

impl<'a> ValueChart<'a> {
    /// Returns the chart of a `page`.
    pub(super) fn new(page: &'a CustomerPage) -> Self {
        let mut sources: Vec<&str> = Vec::new();
        let values = page.values.iter().chain(&page.others);
        let rows = values.filter_map(|value| {
            let mut row = row(value, page.fabrics.len())?;
            if row.axis.is_some() && !value.source.is_empty() {
                let known = sources.iter().position(|source| *source == value.source);
                row.source = 1 + known.unwrap_or_else(|| {
                    sources.push(&value.source);
                    sources.len() - 1
                });
            }
            Some(row)
        });
        // Rows with an axis stand together, above the rows without one.
        let (mut rows, others): (Vec<_>, Vec<_>) = rows.partition(|row| row.axis.is_some());
        rows.extend(others);
        Self { rows, sources }
    }
}

/// Returns the value of a fabric on the chart: the measured value, else the value of a law that was
/// not assumed.
fn charted(number: &ComparedNumber) -> Option<f64> {
    number.measured.or(number.law.filter(|_| !number.is_assumed))
}

/// Returns the row of a `value` for `count` fabrics, `None` if no fabric has the value.
fn row(value: &ReportedValue, count: usize) -> Option<ChartRow<'_>> {
    let units = &value.value.units;
    let (unit, in_si) = units.first();
    let numbers: Vec<ComparedNumber> = (0..count).map(|fabric| value.number(fabric)).collect();
    if numbers.iter().all(|number| charted(number).is_none()) {
        return None;
    }
    let ranges: Vec<Option<[f64; 2]>> = (0..count).map(|fabric| value.range(fabric)).collect();

    // All fabrics of a row share one axis.
    let ends = ends(&ranges, &numbers);
    let lanes = numbers.iter().enumerate().map(|(fabric, number)| {
        let lane = lane(number, ranges[fabric], ends);
        Lane {
            colour: fabric % COLOURS + 1,
            middle: format!("{:.1}", LANE * (fabric as f64 + 0.5)),
            text: charted(number).map_or_else(String::new, |value| {
                ShownValue::with_error(value, number.deviation, units).first().print()
            }),
            ..lane
        }
    });
    Some(ChartRow {
        value,
        unit,
        axis: ends.map(|ends| axis(ends, &ranges, in_si)),
        lanes: lanes.collect(),
        source: 0,
    })
}

/// Returns the lane of a `number` and its published `range` on an axis with `ends`, in SI. Colour,
/// height and text of the lane stay empty.
fn lane(number: &ComparedNumber, range: Option<[f64; 2]>, ends: Option<[f64; 2]>) -> Lane {
    let position = |value: f64| ends.map(|ends| position(ends, value));
    let value = charted(number);
    let band = range.and_then(|[from, to]| {
        let [from, to] = [position(from)?, position(to)?];
        Some([from, to - from].map(percent))
    });
    // A logarithmic axis has no place for a scatter that reaches zero.
    let deviation = number.deviation.zip(value).filter(|(deviation, value)| deviation < value);
    let scatter = deviation.and_then(|(deviation, value)| {
        let [from, to] = [value - deviation, value + deviation];
        Some([position(from)?, position(to)?].map(percent))
    });
    Lane {
        colour: 0,
        middle: String::new(),
        band,
        at: value.and_then(position).map(percent),
        scatter,
        is_of_law: number.measured.is_none(),
        text: String::new(),
    }
}

/// Returns the ends of the axis of a row, in SI. Returns `None` if `ranges` has no range or a
/// number is not positive.
fn ends(ranges: &[Option<[f64; 2]>], numbers: &[ComparedNumber]) -> Option<[f64; 2]> {
    let [low, high] = ranges.iter().flatten().copied().reduce(union)?;
    let ratio = (high / low).max(LEAST_RATIO).powf(BEYOND);
    let around = [low / ratio, high * ratio];
    let values = numbers.iter().filter_map(charted);
    // A value beyond the axis stretches it, with a little room.
    let all = values.map(|value| [value / LEAST_RATIO, value * LEAST_RATIO]);
    let [low, high] = all.fold(around, |ends, [from, to]| {
        let is_beyond = from * LEAST_RATIO < around[0] || to / LEAST_RATIO > around[1];
        if is_beyond { union(ends, [from, to]) } else { ends }
    });
    (low > 0.0).then_some([low, high])
}

/// Returns the interval that covers both intervals.
fn union([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a.min(c), b.max(d)]
}

/// Returns the position of a `value` on an axis from `low` to `high`, in per cent.
fn position([low, high]: [f64; 2], value: f64) -> f64 {
    let part = (value / low).ln() / (high / low).ln();
    if part.is_finite() { 100.0 * part.clamp(0.0, 1.0) } else { 0.0 }
}

/// Returns a `position` as text with one decimal.
fn percent(position: f64) -> String {
    format!("{position:.1}")
}

/// Returns the axis from `low` to `high`, in SI, with its ticks. The text of the axis states the
/// `ranges` of usual fabrics. `in_si` is the unit of the labels, in SI.
fn axis([low, high]: [f64; 2], ranges: &[Option<[f64; 2]>], in_si: f64) -> Axis {
    let [from, to] = [low, high].map(|end| end / in_si);
    let decades = (to / from).log10();
    let steps = if decades <= FINE_DECADES { &STEPS[..] } else { &STEPS[..1] };
    let powers = from.log10().floor() as i32..=to.log10().ceil() as i32;
    let ticks = powers.flat_map(|power| steps.iter().map(move |step| step * 10f64.powi(power)));
    let ticks = ticks.filter(|tick| (from..=to).contains(tick));
    let ticks = ticks.map(|tick| (percent(position([from, to], tick)), short(tick)));

    // Fabrics of the same kind have the same range, which is written once.
    let mut usual: Vec<String> = Vec::new();
    for [from, to] in ranges.iter().flatten().map(|ends| ends.map(|end| end / in_si)) {
        let [from, to] = [from, to].map(|end| typeset(&significant(end, DIGITS)));
        let words = format!("{from} to {to}");
        if !usual.contains(&words) {
            usual.push(words);
        }
    }
    Axis { ticks: ticks.collect(), usual: usual.join("; ") }
}

/// Returns a `tick` as a short text.
fn short(tick: f64) -> String {
    if (1e-3..1e5).contains(&tick) {
        return figure(tick);
    }
    typeset(&significant(tick, 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ComparedValue, ReportedFabric, Units};

    fn value(measured: f64, range: Option<[f64; 2]>) -> ReportedValue {
        let number = ComparedNumber {
            measured: Some(measured),
            deviation: Some(0.1 * measured),
            ..ComparedNumber::default()
        };
        let value = ComparedValue {
            symbol: "W".to_owned(),
            name: "mass per area".to_owned(),
            direction: String::new(),
            units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
            numbers: vec![number],
            is_comparable: true,
        };
        ReportedValue { value, ranges: vec![range], source: "a survey".to_owned() }
    }

    fn page(others: Vec<ReportedValue>) -> CustomerPage {
        CustomerPage { fabrics: vec![ReportedFabric::default()], others, ..CustomerPage::default() }
    }

    #[test]
    fn a_value_in_the_middle_of_its_range_is_in_the_middle_of_the_axis() {
        let page = page(vec![value(0.2, Some([0.04, 1.0])), value(0.2, None)]);
        let ValueChart { rows, sources } = ValueChart::new(&page);
        assert_eq!(sources, ["a survey"]);
        assert_eq!((rows[0].source, rows[1].source), (1, 0));
        assert_eq!(rows[0].lanes[0].at.as_deref(), Some("50.0"));
        assert_eq!(rows[0].lanes[0].text, "20.0 ± 2.0");
        // A part of 1/1.6 is the range: 0.3 of its logarithm is to either side, 18.75 of 100.
        let [from, length] = rows[0].lanes[0].band.as_ref().expect("there is a range");
        assert!(from.starts_with("18.") && length == "62.5", "{from} {length}");
        let axis = rows[0].axis.as_ref().expect("there is a range");
        assert_eq!(axis.usual, "4.00 to 100");
        let labels: Vec<&str> = axis.ticks.iter().map(|(_, label)| label.as_str()).collect();
        assert_eq!(labels, ["10", "100"]);
        assert!(rows[1].axis.is_none() && rows[1].lanes[0].band.is_none());
    }

    #[test]
    fn a_value_far_from_its_range_stretches_the_axis() {
        let page = page(vec![value(80.0, Some([0.04, 1.0]))]);
        let rows = ValueChart::new(&page).rows;
        let at: f64 = rows[0].lanes[0].at.as_deref().expect("it is there").parse().expect("number");
        assert!((90.0..100.0).contains(&at), "{at}");
        let [from, length] = rows[0].lanes[0].band.clone().expect("it is there");
        let [from, length]: [f64; 2] = [from, length].map(|end| end.parse().expect("a number"));
        assert!(from + length < at);
    }

    #[test]
    fn ticks_are_short() {
        assert_eq!([0.02, 0.5, 1.0, 20.0, 1e-4].map(short), ["0.02", "0.5", "1", "20", "1 × 10⁻⁴"]);
    }
}
