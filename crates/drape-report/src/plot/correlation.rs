use askama::Template;
use serde::Serialize;

use super::Place;
use super::frame::px;
use crate::check;
use crate::error::ReportError;
use crate::number::typeset;
use crate::symbol::Symbol;

/// Correlations between the estimates of some parameters.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Correlation {
    /// The parameters' symbols; `k_t` is shown as k with the index t.
    pub symbols: Vec<String>,
    /// The symmetric matrix, row by row, each between −1 and 1.
    pub matrix: Vec<Vec<f64>>,
}

impl Correlation {
    /// Refuses a matrix that does not belong to its names, or with numbers beyond −1 … 1.
    pub fn check(&self) -> Result<(), ReportError> {
        let names = self.symbols.len();
        let wrong = |row: usize, length: usize| ReportError::BadMatrix { names, row, length };
        if names == 0 {
            return Err(ReportError::EmptyPlot {
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
                return Err(ReportError::OutOfRange {
                    what: "a correlation",
                    value,
                    range: "between -1 and 1",
                });
            }
        }
        Ok(())
    }

    /// The pairs whose correlation is stronger than a limit, strongest first.
    pub fn above(&self, limit: f64) -> Vec<(&str, &str, f64)> {
        let mut pairs = Vec::new();
        for (i, row) in self.matrix.iter().enumerate() {
            for (j, &r) in row.iter().enumerate().take(i) {
                if r.abs() > limit {
                    pairs.push((self.symbols[j].as_str(), self.symbols[i].as_str(), r));
                }
            }
        }
        pairs.sort_by(|a, b| b.2.abs().total_cmp(&a.2.abs()));
        pairs
    }
}

/// Side of a cell, in px.
const CELL: f64 = 46.0;
/// Room around the matrix, in px.
const ROOM: f64 = 4.0;
/// Correlation above which a cell is dark and its number light.
const DARK: f64 = 0.62;

struct Cell<'a> {
    x: String,
    y: String,
    middle: String,
    baseline: String,
    /// The sign of the correlation, or "name" on the diagonal.
    class: &'static str,
    opacity: String,
    symbol: Symbol<'a>,
    text: String,
    dark: bool,
    tip: String,
}

#[derive(Template)]
#[template(path = "correlation.svg", escape = "html")]
struct CorrelationFigure<'a> {
    style: Option<&'static str>,
    side: String,
    cell: String,
    cells: Vec<Cell<'a>>,
}

/// Draws a correlation matrix as a heat map in an SVG file: names on the diagonal, pairs below it.
pub fn correlation_svg(correlation: &Correlation) -> Result<String, ReportError> {
    correlation.check()?;
    Ok(correlation_figure(correlation, Place::Alone))
}

/// Width and height of the heat map of a matrix, in px.
pub(crate) fn correlation_side(correlation: &Correlation) -> f64 {
    2.0 * ROOM + CELL * correlation.symbols.len() as f64
}

/// Draws a matrix that has been checked.
pub(crate) fn correlation_figure(correlation: &Correlation, place: Place) -> String {
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
                class: match (diagonal, r < 0.0) {
                    (true, _) => "name",
                    (false, true) => "minus",
                    (false, false) => "plus",
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
        style: place.style(),
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
        assert_eq!(correlation.above(0.5), [("a", "c", -0.9), ("a", "b", 0.6)]);
    }
}
