//! Error of a plot or a report that cannot be made.

/// Reason why a plot or a report cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A report has no content.
    #[error("the report of {name} has neither curves nor values; give it what was fitted")]
    EmptyReport {
        /// The name of the sheet or fabric.
        name: String,
    },

    /// A plot has no points.
    #[error("{plot}: {what} has no points to draw")]
    EmptyPlot {
        /// The title of the plot.
        plot: String,
        /// The empty part, in words.
        what: String,
    },

    /// A number of a report is not finite, or too large.
    #[error("{what} is {value}; a report needs numbers of at most 1e90")]
    NotFinite {
        /// The quantity, in words.
        what: String,
        /// Value of the quantity.
        value: f64,
    },

    /// A number is out of its range.
    #[error("{what} is {value}, but it must be {range}")]
    OutOfRange {
        /// The quantity, in words.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The range, in words.
        range: &'static str,
    },

    /// A correlation matrix does not fit its names.
    #[error(
        "{names} names need a {names} x {names} correlation matrix, but row {row} has {length}"
    )]
    BadMatrix {
        /// Number of names.
        names: usize,
        /// Number of the row, from 0. Where the number of rows is wrong, the number of rows.
        row: usize,
        /// Length of the row.
        length: usize,
    },

    /// A text holds a character that neither a page nor a terminal can show.
    #[error("{what} holds the control character {character:?}; remove it")]
    ControlCharacter {
        /// The text, in words.
        what: String,
        /// The character.
        character: char,
    },

    /// A picture cannot be drawn or encoded.
    #[error(transparent)]
    Picture(#[from] drape_render::Error),
}
