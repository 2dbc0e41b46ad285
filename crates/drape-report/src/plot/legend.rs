//! Legend of a plot: the entries above its frame.

use super::axis::{LEFT, RIGHT, WIDTH};
use super::svg::px;

/// Height of a row of the legend, in px.
const ROW: f64 = 24.0;

/// Mean width of a letter of a label, in px, for lower-case words in common sans-serif faces at 13
/// px.
///
/// The room around the sign makes up for wider words.
const LETTER: f64 = 5.9;

/// Width of the sign before a label with the room around it, in px.
const SIGN: f64 = 46.0;

/// Sign of a series in the legend.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sign {
    Points,
    Line,
    Area,
}

/// Entry of a legend before it is placed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LegendItem {
    pub(crate) sign: Sign,
    /// Class of the series, which gives the sign its look.
    pub(crate) class: String,
    pub(crate) label: String,
}

/// Placed entry of a legend.
pub(crate) struct LegendEntry {
    pub(crate) sign: Sign,
    pub(crate) class: String,
    pub(crate) label: String,
    pub(crate) x: String,
    pub(crate) y: String,
    /// Start of the text.
    pub(crate) text: String,
}

/// Legend with its placed entries.
pub(crate) struct Legend {
    pub(crate) entries: Vec<LegendEntry>,
    /// Height, in px.
    pub(crate) height: f64,
}

impl Legend {
    /// Places `items` side by side, in as many rows as they need.
    pub(crate) fn new(items: Vec<LegendItem>) -> Legend {
        let (mut x, mut row) = (LEFT, 0.0);
        let entries = items
            .into_iter()
            .map(|LegendItem { sign, class, label }| {
                let width = SIGN + LETTER * label.chars().count() as f64;
                if x > LEFT && x + width > WIDTH - RIGHT {
                    (x, row) = (LEFT, row + 1.0);
                }
                let start = x;
                x += width;
                LegendEntry {
                    sign,
                    class,
                    label,
                    x: px(start),
                    y: px(ROW * (row + 0.5)),
                    text: px(start + 30.0),
                }
            })
            .collect();
        Legend { entries, height: ROW * (row + 1.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_legend_continues_in_the_next_row() {
        let item = LegendItem {
            sign: Sign::Line,
            class: "fit".to_owned(),
            label: "a long name of thirty letters".to_owned(),
        };
        let Legend { entries, height } = Legend::new(vec![item; 4]);
        assert_eq!(height, 2.0 * ROW);
        assert_eq!(entries[0].x, entries[2].x);
    }
}
