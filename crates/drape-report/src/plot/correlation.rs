//! Heat map of the correlations between parameters.

use askama::Template;
use drape_input::typeset;
use serde::Serialize;

use super::style::Placement;
use super::svg::px;
use crate::check;
use crate::error::Error;
use crate::text::symbol::Symbol;

/// Correlations between the estimates of some parameters.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Correlation {
    /// Symbols of the parameters. `k_t` is shown as k with the index t.
    pub symbols: Vec<String>,
    /// Symmetric matrix, row by row, with entries between −1 and 1.
    pub matrix: Vec<Vec<f64>>,
}

impl Correlation {
    /// Refuses a matrix that does not fit its `symbols`, or with entries beyond −1 and 1.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        let names = self.symbols.len();
        let wrong = |row: usize, length: usize| Error::BadMatrix { names, row, length };
        if names == 0 {
            return Err(Error::EmptyPlot {
                plot: "correlations".to_owned(),
                what: "the matrix".to_owned(),
            });
        }

        if self.matrix.len() != names {
            return Err(wrong(self.matrix.len(), 0));
        }
        for symbol in &self.symbols {
            check::text("the symbol of a parameter", symbol)?;
        }

        for (row, entries) in self.matrix.iter().enumerate() {
            if entries.len() != names {
                return Err(wrong(row, entries.len()));
            }
            // Rounding may carry a perfect correlation a little beyond one.
            let beyond = |r: &&f64| !(r.abs() <= 1.0 + 1e-9);
            if let Some(&value) = entries.iter().find(beyond) {
                return Err(Error::OutOfRange {
                    what: "a correlation",
                    value,
                    range: "between -1 and 1",
                });
            }
        }
        Ok(())
    }

    /// Returns the pairs whose correlation is stronger than `limit`, the strongest first.
    #[must_use]
    pub fn above(&self, limit: f64) -> Vec<CorrelatedPair<'_>> {
        let mut pairs = Vec::new();
        for (i, row) in self.matrix.iter().enumerate() {
            for (j, &r) in row.iter().enumerate().take(i) {
                if r.abs() > limit {
                    let symbols = [j, i].map(|k| self.symbols[k].as_str());
                    pairs.push(CorrelatedPair { symbols, correlation: r });
                }
            }
        }
        pairs.sort_by(|a, b| b.correlation.abs().total_cmp(&a.correlation.abs()));
        pairs
    }
}

/// Two parameters with their correlation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorrelatedPair<'a> {
    /// Symbols of both parameters.
    pub symbols: [&'a str; 2],
    /// Correlation between both parameters, between −1 and 1.
    pub correlation: f64,
}

/// Side of a cell, in px.
const CELL: f64 = 46.0;
/// Room around the matrix, in px.
const ROOM: f64 = 4.0;
/// Correlation above which a cell is dark and its number light.
const DARK: f64 = 0.62;

/// Drawn cell of the matrix.
struct Cell<'a> {
    x: String,
    y: String,
    middle: String,
    baseline: String,
    /// Sign of the correlation, or "name" on the diagonal.
    class: &'static str,
    opacity: String,
    symbol: Symbol<'a>,
    text: String,
    dark: bool,
    tip: String,
}

/// What the SVG template shows.
#[derive(Template)]
#[template(path = "plot/correlation.svg", escape = "html")]
struct CorrelationFigure<'a> {
    style: Option<&'static str>,
    side: String,
    cell: String,
    cells: Vec<Cell<'a>>,
}

/// Draws a `correlation` matrix as a heat map in an SVG file: names on the diagonal, pairs below
/// it.
///
/// # Errors
/// Errors of [`Correlation::check`].
pub fn correlation_svg(correlation: &Correlation) -> Result<String, Error> {
    correlation.check()?;
    Ok(correlation_figure(correlation, Placement::Standalone))
}

/// Returns the side of the heat map of a `correlation` matrix, in px.
pub(crate) fn correlation_side(correlation: &Correlation) -> f64 {
    2.0 * ROOM + CELL * correlation.symbols.len() as f64
}

/// Draws a `correlation` matrix that has been checked.
pub(crate) fn correlation_figure(correlation: &Correlation, placement: Placement) -> String {
    let symbols = &correlation.symbols;
    let mut cells = Vec::new();
    for (i, row) in correlation.matrix.iter().enumerate() {
        for (j, &r) in row.iter().enumerate().take(i + 1) {
            let (x, y) = (ROOM + CELL * j as f64, ROOM + CELL * i as f64);
            let diagonal = i == j;
            let text = typeset(&format!("{:.2}", r + 0.0));

            cells.push(Cell {
                x: px(x),
                y: px(y),
                middle: px(x + 0.5 * CELL),
                baseline: px(y + 0.5 * CELL + 4.5),
                class: if diagonal {
                    "name"
                } else if r < 0.0 {
                    "minus"
                } else {
                    "plus"
                },
                opacity: px(r.abs().min(1.0)),
                symbol: Symbol::new(if diagonal { &symbols[i] } else { "" }),
                text: if diagonal { String::new() } else { text.clone() },
                dark: r.abs() > DARK,
                tip: format!("{} and {}: {text}", symbols[j], symbols[i]),
            });
        }
    }

    let figure = CorrelationFigure {
        style: placement.style(),
        side: px(correlation_side(correlation)),
        cell: px(CELL),
        cells,
    };
    figure.render().expect("writing to a string does not fail")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strongest_correlations_come_first_and_each_pair_once() {
        let correlation = Correlation {
            symbols: ["a", "b", "c"].map(str::to_owned).to_vec(),
            matrix: vec![vec![1.0, 0.6, -0.9], vec![0.6, 1.0, 0.2], vec![-0.9, 0.2, 1.0]],
        };
        let pairs = correlation.above(0.5);
        let found: Vec<_> = pairs.iter().map(|pair| (pair.symbols, pair.correlation)).collect();
        assert_eq!(found, [(["a", "c"], -0.9), (["a", "b"], 0.6)]);
    }
}
