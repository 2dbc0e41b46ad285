use serde::Serialize;

use crate::check;
use crate::error::ReportError;

/// What an axis shows, and in which unit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Axis {
    /// The quantity, as in "strain".
    pub label: String,
    /// The unit of the axis, as in "%"; empty for a bare number.
    pub unit: String,
    /// One unit of the axis in SI: 0.01 for %, 0.980665 for gf/cm.
    pub in_si: f64,
}

impl Axis {
    /// An axis with a label and a unit that is `in_si` SI units.
    pub fn new(label: &str, unit: &str, in_si: f64) -> Axis {
        Axis { label: label.to_owned(), unit: unit.to_owned(), in_si }
    }

    /// The label with its unit.
    pub(crate) fn title(&self) -> String {
        if self.unit.is_empty() {
            self.label.clone()
        } else {
            format!("{}, {}", self.label, self.unit)
        }
    }

    pub(crate) fn check(&self, owner: &str) -> Result<(), ReportError> {
        check::text(&format!("{owner}: the label of an axis"), &self.label)?;
        check::text(&format!("{owner}: the unit of an axis"), &self.unit)?;
        check::unit(self.in_si)
    }
}

/// Room for a mark of an axis with its label, in px; with 1-2-5 steps there are up to 2.5 times as many.
const TICK_ROOM: f64 = 85.0;
/// Fewest marks that a short and a long axis should have.
const FEWEST_TICKS: [f64; 2] = [2.0, 4.0];

/// Part of the range that stays free at both ends of an axis, so that no point sits on the frame.
const MARGIN: f64 = 0.04;

/// Least width of a range relative to its numbers.
///
/// A narrower one is widened: its marks would all carry the same label.
const LEAST_WIDTH: f64 = 1e-9;

/// Least width of a range: the logarithms and powers of the marks stay ordinary numbers.
const LEAST: f64 = 1e-90;

/// A range of shown values, or of their logarithms, laid on a stretch of pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Map {
    /// Whether the range is of decimal logarithms.
    logarithmic: bool,
    /// Value at the first pixel.
    low: f64,
    /// Value at the last pixel.
    high: f64,
    /// First pixel.
    from: f64,
    /// Last pixel; before the first one where the values rise upwards.
    to: f64,
}

impl Map {
    /// Lays the range of some values, with a margin, on the pixels between two bounds.
    pub(crate) fn around(values: impl Iterator<Item = f64>, [from, to]: [f64; 2]) -> Map {
        let (low, high) = values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low > high { (0.0, 1.0) } else { (low, high) };
        let size = low.abs().max(high.abs());
        let least = if size == 0.0 { 1.0 } else { (LEAST_WIDTH * size).max(LEAST) };
        let margin =
            if high - low > least { MARGIN * (high - low) } else { (0.1 * size).max(least) };
        Map { logarithmic: false, low: low - margin, high: high + margin, from, to }
    }

    /// The same with the logarithms of positive values.
    pub(crate) fn around_logarithms(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Map {
        Map { logarithmic: true, ..Map::around(values.map(f64::log10), pixels) }
    }

    /// The same range laid on other pixels.
    pub(crate) fn on(self, [from, to]: [f64; 2]) -> Map {
        Map { from, to, ..self }
    }

    /// Its first and its last pixel.
    pub(crate) fn ends(&self) -> [f64; 2] {
        [self.from, self.to]
    }

    /// The width of the range.
    pub(crate) fn width(&self) -> f64 {
        self.high - self.low
    }

    /// The range widened evenly to both sides.
    pub(crate) fn widened(self, width: f64) -> Map {
        let more = 0.5 * (width - self.width());
        Map { low: self.low - more, high: self.high + more, ..self }
    }

    /// The pixel of a value.
    pub(crate) fn pixel(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.log10() } else { value };
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Whether a value lies on the axis.
    pub(crate) fn holds(&self, value: f64) -> bool {
        !self.logarithmic && (self.low..=self.high).contains(&value)
    }

    /// Whether the pixels lead back to logarithms.
    pub(crate) fn logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// The value at pixel 0 and the value per pixel: what a reader of the plot needs to go back.
    pub(crate) fn inverse(&self) -> [f64; 2] {
        let per_pixel = (self.high - self.low) / (self.to - self.from);
        [self.low - self.from * per_pixel, per_pixel]
    }

    /// Round values along the axis with their labels.
    pub(crate) fn ticks(&self) -> Vec<(f64, String)> {
        if self.logarithmic {
            return self.decades();
        }
        let [least, most] = FEWEST_TICKS;
        let fewest = ((self.to - self.from).abs() / TICK_ROOM).clamp(least, most);
        let rough = (self.high - self.low) / fewest;
        let power = 10f64.powf(rough.log10().floor());
        let step = [5.0, 2.0, 1.0]
            .map(|round| round * power)
            .into_iter()
            .find(|step| *step <= rough)
            .unwrap_or(power);
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        let largest = step * first.abs().max(last.abs()) as f64;
        let values = (first..=last).map(|k| k as f64 * step);
        values.map(|value| (self.pixel(value), label(value, step, largest))).collect()
    }

    /// Powers of ten along a logarithmic axis, with their doubles and fivefold where there are few.
    fn decades(&self) -> Vec<(f64, String)> {
        let factors: &[f64] = if self.width() > DECADES { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let powers = self.low.floor() as i32..=self.high.ceil() as i32;
        let values = powers.flat_map(|k| factors.iter().map(move |f| f * 10f64.powi(k)));
        let on = |value: &f64| (self.low..=self.high).contains(&value.log10());
        let label = |value: f64| {
            let text = crate::number::typeset(&crate::number::significant(value, 1));
            text.strip_prefix("1 × ").map_or(text.replace(" × ", "×"), str::to_owned)
        };
        values.filter(on).map(|value| (self.pixel(value), label(value))).collect()
    }
}

/// Powers of ten up to which an axis has marks between them.
const DECADES: f64 = 2.5;

/// Axes whose largest label is outside of this range are labelled with a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-3..1e5;

/// The label of a mark, with as many digits as the step between marks needs.
fn label(value: f64, step: f64, largest: f64) -> String {
    let power = |number: f64| number.log10().floor() as i32;
    let exponent = if PLAIN.contains(&largest) { 0 } else { power(largest) };
    let decimals = usize::try_from(exponent - power(step)).unwrap_or(0);
    if value == 0.0 {
        return "0".to_owned();
    }
    let mantissa = format!("{:.decimals$}", value / 10f64.powi(exponent));
    let text = match exponent {
        0 => mantissa,
        _ => format!("{mantissa}e{exponent}"),
    };
    crate::number::typeset(&text).replace(" × ", "×")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64) -> Vec<String> {
        let map = Map { logarithmic: false, low, high, from: 0.0, to: 340.0 };
        map.ticks().into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round_and_cover_the_axis() {
        assert_eq!(labels(0.0, 4.1), ["0", "1", "2", "3", "4"]);
        assert_eq!(labels(-0.23, 0.31), ["−0.2", "−0.1", "0", "0.1", "0.2", "0.3"]);
        assert_eq!(labels(98.0, 508.0), ["100", "200", "300", "400", "500"]);
        assert_eq!(labels(0.0, 8.5e-6)[1], "2×10⁻⁶");
        assert_eq!(labels(0.0, 1.3e6)[1..3], ["0.2×10⁶", "0.4×10⁶"]);
    }

    #[test]
    fn between_four_and_ten_ticks_stand_on_any_axis() {
        for k in 0..400 {
            let width = 10f64.powf(f64::from(k) / 50.0 - 4.0);
            let count = labels(-0.37 * width, 0.63 * width).len();
            assert!((4..=10).contains(&count), "{count} ticks on {width}");
        }
    }

    #[test]
    fn a_pixel_leads_back_to_its_value() {
        let map = Map::around([-2.5, 7.5].into_iter(), [300.0, 20.0]);
        let [at_zero, per_pixel] = map.inverse();
        for value in [-2.5, 0.0, 3.3, 7.5] {
            let back = at_zero + per_pixel * map.pixel(value);
            assert!((back - value).abs() < 1e-12, "{value} came back as {back}");
        }
    }

    #[test]
    fn logarithms_have_round_marks_and_even_steps() {
        let labels = |values: [f64; 2]| -> Vec<String> {
            let map = Map::around_logarithms(values.into_iter(), [0.0, 340.0]);
            map.ticks().into_iter().map(|(_, label)| label).collect()
        };
        assert_eq!(labels([2e-3, 0.06]), ["0.002", "0.005", "0.01", "0.02", "0.05"]);
        assert_eq!(labels([1e-4, 11.0]), ["10⁻⁴", "0.001", "0.01", "0.1", "1", "10"]);
        let map = Map::around_logarithms([1.0, 1000.0].into_iter(), [0.0, 340.0]);
        let steps = [1.0, 10.0, 100.0].map(|value| map.pixel(10.0 * value) - map.pixel(value));
        assert!(steps.iter().all(|step| (step - steps[0]).abs() < 1e-9), "{steps:?}");
        assert!(!map.holds(0.0));
    }

    #[test]
    fn a_range_without_width_is_widened() {
        for value in [0.0, 5.0, -1e-30, 1e-310, 1e90] {
            let map = Map::around([value, value].into_iter(), [0.0, 100.0]);
            let pixel = map.pixel(value);
            assert!((pixel - 50.0).abs() < 1e-6, "{value} is drawn at {pixel}");
        }
    }
}
