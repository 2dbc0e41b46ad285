//! The frame of a plot: axes, grid, labels.

use super::axis::Map;

/// Width of a plot, in px of its own.
pub(crate) const WIDTH: f64 = 720.0;
/// Room for the labels left of a frame, in px.
pub(crate) const LEFT: f64 = 68.0;
/// Room right of a frame, in px.
pub(crate) const RIGHT: f64 = 14.0;
/// Room for the labels below a frame, in px.
pub(crate) const BOTTOM: f64 = 46.0;
/// Height of a row of the key, in px.
pub(crate) const KEY: f64 = 24.0;

/// Mean width of a letter of a label, in px: that of lower-case words in common sans-serif faces at 13 px.
///
/// The room around the sign takes up what wider words need.
const LETTER: f64 = 5.9;
/// Width of the sign before an entry of the key with the room around it, in px.
const KEY_SIGN: f64 = 46.0;

/// A mark of an axis.
pub(crate) struct Tick {
    pub(crate) at: String,
    pub(crate) label: String,
}

/// A rectangle with axes.
pub(crate) struct Frame {
    pub(crate) left: String,
    pub(crate) right: String,
    pub(crate) top: String,
    pub(crate) bottom: String,
    pub(crate) width: String,
    pub(crate) height: String,
    pub(crate) x_ticks: Vec<Tick>,
    pub(crate) y_ticks: Vec<Tick>,
    /// Where zero lies inside the frame, across and along.
    pub(crate) zero: [Option<String>; 2],
    pub(crate) y_middle: String,
    pub(crate) y_title: String,
    /// Value, or its decimal logarithm, at pixel 0 and per pixel, for both axes.
    pub(crate) inverse: String,
    /// The axes whose pixels lead back to logarithms, by their letters; empty for none.
    pub(crate) logarithmic: String,
}

impl Frame {
    /// The frame between two pixel heights, for a map of each axis.
    pub(crate) fn new(x: &Map, y: &Map, [top, bottom]: [f64; 2], y_title: String) -> Frame {
        let right = WIDTH - RIGHT;
        let ticks = |map: &Map| {
            let ticks = map.ticks().into_iter();
            ticks.map(|(at, label)| Tick { at: px(at), label }).collect()
        };
        let zero = |map: &Map| map.holds(0.0).then(|| px(map.pixel(0.0)));
        let inverse: Vec<String> = [x.inverse(), y.inverse()]
            .as_flattened()
            .iter()
            .map(|number| format!("{number:.9e}"))
            .collect();
        Frame {
            left: px(LEFT),
            right: px(right),
            top: px(top),
            bottom: px(bottom),
            width: px(right - LEFT),
            height: px(bottom - top),
            x_ticks: ticks(x),
            y_ticks: ticks(y),
            zero: [zero(x), zero(y)],
            y_middle: px(0.5 * (top + bottom)),
            y_title,
            inverse: inverse.join(" "),
            logarithmic: [("x", x), ("y", y)]
                .iter()
                .filter_map(|(letter, map)| map.logarithmic().then_some(*letter))
                .collect(),
        }
    }

    /// The pixels across a frame.
    pub(crate) fn across() -> [f64; 2] {
        [LEFT, WIDTH - RIGHT]
    }
}

/// An entry of the key above a plot.
pub(crate) struct KeyEntry {
    /// The class of the series, which gives the sign its look.
    pub(crate) class: String,
    pub(crate) label: String,
    pub(crate) x: String,
    pub(crate) y: String,
    /// Where the text begins.
    pub(crate) text: String,
    /// The sign: points, a line or an area.
    pub(crate) sign: Sign,
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sign {
    Points,
    Line,
    Area,
}

/// Sets the entries of a key side by side, in as many rows as they need; gives the height that they take.
pub(crate) fn key(entries: Vec<(Sign, String, String)>) -> (Vec<KeyEntry>, f64) {
    let (mut x, mut row) = (LEFT, 0.0);
    let placed = entries
        .into_iter()
        .map(|(sign, class, label)| {
            let width = KEY_SIGN + LETTER * label.chars().count() as f64;
            if x > LEFT && x + width > WIDTH - RIGHT {
                (x, row) = (LEFT, row + 1.0);
            }
            let at = x;
            x += width;
            KeyEntry {
                class,
                label,
                x: px(at),
                y: px(KEY * (row + 0.5)),
                text: px(at + 30.0),
                sign,
            }
        })
        .collect();
    (placed, KEY * (row + 1.0))
}

/// A length in px: two decimals, which is finer than any printer at the usual size of a figure.
pub(crate) fn px(length: f64) -> String {
    let text = format!("{length:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}

/// A line through pixels, as the data of a path.
pub(crate) fn line(pixels: impl Iterator<Item = [f64; 2]>) -> String {
    let mut data = String::new();
    for (index, [x, y]) in pixels.enumerate() {
        data.push(if index == 0 { 'M' } else { 'L' });
        data.push_str(&format!("{} {}", px(x), px(y)));
    }
    data
}

/// Dots at pixels, as the data of a path: lines without length, which a round end makes visible.
pub(crate) fn dots(pixels: impl Iterator<Item = [f64; 2]>) -> String {
    pixels.map(|[x, y]| format!("M{} {}h0", px(x), px(y))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_short_and_never_minus_zero() {
        assert_eq!([px(12.0), px(-0.001), px(3.456), px(0.1)], ["12", "0", "3.46", "0.1"]);
    }

    #[test]
    fn a_long_key_goes_on_in_the_next_row() {
        let entry = || (Sign::Line, "fit".to_owned(), "a long name of thirty letters".to_owned());
        let (entries, height) = key(vec![entry(), entry(), entry(), entry()]);
        assert_eq!(height, 2.0 * KEY);
        assert_eq!(entries[0].x, entries[2].x);
    }
}
