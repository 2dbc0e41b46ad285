//! Scale of an axis: maps values, or their logarithms, to pixels, and chooses the ticks.

use drape_input::{significant, typeset};

use super::svg::px;

/// Room for a tick with its label, in px. With steps of 1, 2 and 5 there are up to 2.5 times as
/// many ticks.
const TICK_ROOM: f64 = 85.0;
/// Smallest numbers of ticks that a short and a long axis should have.
const FEWEST_TICKS: [f64; 2] = [2.0, 4.0];

/// Fraction of the range that stays free at both ends of an axis, so that no point lies on the
/// frame.
const MARGIN: f64 = 0.04;

/// Smallest width of a range over the magnitude of its numbers.
///
/// A narrower range is widened: its ticks would all have the same label.
const LEAST_WIDTH: f64 = 1e-9;

/// Smallest width of a range, so that powers and logarithms of the ticks stay normal numbers.
const LEAST: f64 = 1e-90;

/// Tick of an axis: its position, in px, and its label.
pub(crate) struct Tick {
    pub(crate) at: String,
    pub(crate) label: String,
}

/// Linear or logarithmic scale: a range of values on a range of pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scale {
    /// Whether the range is a range of decimal logarithms.
    logarithmic: bool,
    /// Value at the first pixel.
    low: f64,
    /// Value at the last pixel.
    high: f64,
    /// First pixel.
    from: f64,
    /// Last pixel. It is smaller than `from` where the values increase upwards.
    to: f64,
}

impl Scale {
    /// Returns the scale that maps the range of `values`, with a margin, to the pixels `from` to
    /// `to`.
    pub(crate) fn around(values: impl Iterator<Item = f64>, [from, to]: [f64; 2]) -> Scale {
        let (low, high) = values
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        let (low, high) = if low > high { (0.0, 1.0) } else { (low, high) };
        let size = low.abs().max(high.abs());
        let least = if size == 0.0 { 1.0 } else { (LEAST_WIDTH * size).max(LEAST) };
        let margin =
            if high - low > least { MARGIN * (high - low) } else { (0.1 * size).max(least) };
        Scale { logarithmic: false, low: low - margin, high: high + margin, from, to }
    }

    /// Returns the logarithmic scale of positive `values` on `pixels`.
    pub(crate) fn around_logarithms(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Scale {
        Scale { logarithmic: true, ..Scale::around(values.map(f64::log10), pixels) }
    }

    /// Returns the scale of the positions 1 to `count`, with half a position free at either end.
    pub(crate) fn places(count: usize, [from, to]: [f64; 2]) -> Scale {
        Scale { logarithmic: false, low: 0.5, high: count as f64 + 0.5, from, to }
    }

    /// Returns the scale of this range on the pixels `from` to `to`.
    pub(crate) fn on(self, [from, to]: [f64; 2]) -> Scale {
        Scale { from, to, ..self }
    }

    /// Returns the pixels `from` and `to`.
    pub(crate) fn ends(&self) -> [f64; 2] {
        [self.from, self.to]
    }

    /// Returns the width of the range, `high` minus `low`.
    pub(crate) fn width(&self) -> f64 {
        self.high - self.low
    }

    /// Returns the scale with its range widened evenly on both sides to a `width`.
    pub(crate) fn widened(self, width: f64) -> Scale {
        let margin = 0.5 * (width - self.width());
        Scale { low: self.low - margin, high: self.high + margin, ..self }
    }

    /// Returns the pixel of a `value`.
    pub(crate) fn pixel(&self, value: f64) -> f64 {
        let value = if self.logarithmic { value.log10() } else { value };
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Returns whether a `value` lies on a linear scale.
    pub(crate) fn holds(&self, value: f64) -> bool {
        !self.logarithmic && (self.low..=self.high).contains(&value)
    }

    /// Returns whether the scale is `logarithmic`.
    pub(crate) fn logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// Returns the value at pixel 0 and the value per pixel. The script of a page computes values
    /// from them, as `pixel 0 + pixel × value per pixel`.
    pub(crate) fn inverse(&self) -> [f64; 2] {
        let per_pixel = (self.high - self.low) / (self.to - self.from);
        [self.low - self.from * per_pixel, per_pixel]
    }

    /// Returns a [`Tick`] at each round value.
    pub(crate) fn ticks(&self) -> Vec<Tick> {
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
        values.map(|value| self.tick(value, label(value, step, largest))).collect()
    }

    /// Returns the tick of a `value` with its `label`.
    fn tick(&self, value: f64, label: String) -> Tick {
        Tick { at: px(self.pixel(value)), label }
    }

    /// Returns the [`Tick`]s of a logarithmic scale at powers of ten. An axis with few powers also
    /// has ticks at 2 and 5 times each power.
    fn decades(&self) -> Vec<Tick> {
        let factors: &[f64] = if self.width() > DECADES { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let powers = self.low.floor() as i32..=self.high.ceil() as i32;
        let values = powers.flat_map(|k| factors.iter().map(move |f| f * 10f64.powi(k)));
        let on = |value: &f64| (self.low..=self.high).contains(&value.log10());
        let label = |value: f64| {
            let text = typeset(&significant(value, 1));
            text.strip_prefix("1 × ").map_or(text.replace(" × ", "×"), str::to_owned)
        };
        values.filter(on).map(|value| self.tick(value, label(value))).collect()
    }
}

/// Largest number of decades of a logarithmic axis that has ticks between its powers of ten.
const DECADES: f64 = 2.5;

/// Labels of an axis whose largest label is outside this range have a power of ten.
const PLAIN: std::ops::Range<f64> = 1e-3..1e5;

/// Returns the label of a tick at `value`, with as many digits as the `step` between ticks needs.
/// The `largest` label decides on the power of ten.
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
    typeset(&text).replace(" × ", "×")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64) -> Vec<String> {
        let scale = Scale { logarithmic: false, low, high, from: 0.0, to: 340.0 };
        scale.ticks().into_iter().map(|tick| tick.label).collect()
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
        let scale = Scale::around([-2.5, 7.5].into_iter(), [300.0, 20.0]);
        let [at_zero, per_pixel] = scale.inverse();
        for value in [-2.5, 0.0, 3.3, 7.5] {
            let back = at_zero + per_pixel * scale.pixel(value);
            assert!((back - value).abs() < 1e-12, "{value} came back as {back}");
        }
    }

    #[test]
    fn logarithms_have_round_ticks_and_even_steps() {
        let labels = |values: [f64; 2]| -> Vec<String> {
            let scale = Scale::around_logarithms(values.into_iter(), [0.0, 340.0]);
            scale.ticks().into_iter().map(|tick| tick.label).collect()
        };
        assert_eq!(labels([2e-3, 0.06]), ["0.002", "0.005", "0.01", "0.02", "0.05"]);
        assert_eq!(labels([1e-4, 11.0]), ["10⁻⁴", "0.001", "0.01", "0.1", "1", "10"]);
        let scale = Scale::around_logarithms([1.0, 1000.0].into_iter(), [0.0, 340.0]);
        let steps = [1.0, 10.0, 100.0].map(|value| scale.pixel(10.0 * value) - scale.pixel(value));
        assert!(steps.iter().all(|step| (step - steps[0]).abs() < 1e-9), "{steps:?}");
        assert!(!scale.holds(0.0));
    }

    #[test]
    fn a_range_without_width_is_widened() {
        for value in [0.0, 5.0, -1e-30, 1e-310, 1e90] {
            let scale = Scale::around([value, value].into_iter(), [0.0, 100.0]);
            let pixel = scale.pixel(value);
            assert!((pixel - 50.0).abs() < 1e-6, "{value} is drawn at {pixel}");
        }
    }
}
