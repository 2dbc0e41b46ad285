//! Comparison of fabrics, as a page and as text.

use askama::Template;
use drape_input::{percent, signed_percent};
use serde::Serialize;

use super::assets::{PAGE_SCRIPT, PAGE_STYLE};
use super::compared_value::{ComparedNumber, ComparedValue};
use super::shown::{Marked, Shown, ShownValue};
use crate::check;
use crate::error::Error;
use crate::plot::{COLOURS, OverlayPlot, Placement, STYLE, overlay_figure};
use crate::text::table::Table;

/// Comparison of fabrics: their overlaid curves, their measured values and the values of their
/// laws, with the differences from the first fabric.
///
/// ```
/// use drape_report::{ComparePage, ComparedNumber, ComparedValue, FabricName, Units};
///
/// let law = |law: f64| ComparedNumber { law: Some(law), ..ComparedNumber::default() };
/// let mass = ComparedValue {
///     symbol: "W".to_owned(),
///     name: "mass per area".to_owned(),
///     direction: String::new(),
///     units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
///     numbers: vec![law(0.1), law(0.23)],
///     is_comparable: true,
/// };
/// let fabrics = ["thin", "thick"]
///     .map(|name| FabricName { name: name.to_owned(), ..FabricName::default() });
/// let page = ComparePage {
///     fabrics: fabrics.into(),
///     values: vec![mass],
///     ..ComparePage::default()
/// };
/// assert!(page.to_text()?.contains("W  mass per area  mg/cm²  10.00  23.00  +130 %  !"));
/// # Ok::<(), drape_report::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparePage {
    /// Names and sources of the fabrics, two or more.
    pub fabrics: Vec<FabricName>,
    /// Program that made the report, as in "drape 0.1.0".
    pub version: String,
    /// Curves, test by test.
    pub overlays: Vec<OverlayPlot>,
    /// Values in the order of the page. Each value has one number for each fabric.
    pub values: Vec<ComparedValue>,
    /// Notes for the reader: assumed numbers, curves that only one fabric has.
    pub notes: Vec<String>,
    /// Relative difference above which values are marked, as a ratio of the value of the first
    /// fabric.
    pub limit: f64,
}

/// Relative difference of two fabrics above which values are marked, as a ratio.
///
/// A lower limit would mark the scatter of repeated tests. A higher limit would not mark real
/// differences.
const LIMIT: f64 = 0.25;

impl Default for ComparePage {
    /// Returns an empty comparison with the usual `limit`.
    fn default() -> ComparePage {
        ComparePage {
            fabrics: Vec::new(),
            version: String::new(),
            overlays: Vec::new(),
            values: Vec::new(),
            notes: Vec::new(),
            limit: LIMIT,
        }
    }
}

/// Fabric of a comparison.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct FabricName {
    /// Name of the fabric.
    pub name: String,
    /// Source of its data.
    pub source: String,
}

/// What the HTML template shows.
#[derive(Template)]
#[template(path = "page/compare.html")]
struct View<'a> {
    page: &'a ComparePage,
    /// Names with the numbers of their colours.
    names: Vec<(usize, &'a str)>,
    styles: [&'static str; 2],
    script: &'static str,
    overlays: Vec<(&'a str, String)>,
    rows: Vec<Row<'a>>,
    has_measured: bool,
    has_scatter: bool,
    has_assumed: bool,
    limit: String,
}

/// Row of the table of values.
struct Row<'a> {
    value: &'a ComparedValue,
    cells: Vec<Cell>,
    unit: &'a str,
    si_unit: Option<&'a str>,
}

/// Numbers of one fabric, and their difference from the numbers of the first fabric.
struct Cell {
    measured: Option<ShownValue>,
    law: Option<ShownValue>,
    is_assumed: bool,
    difference: Option<Marked>,
    is_within_scatter: bool,
}

impl ComparePage {
    /// Refuses an empty comparison, numbers that are not finite and texts that cannot be shown, as
    /// [`Error`].
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        if self.overlays.is_empty() && self.values.is_empty() {
            return Err(Error::EmptyReport { name: self.title() });
        }
        check::number(|| "the limit of a comparison".to_owned(), self.limit)?;
        let names = self.fabrics.iter().flat_map(|fabric| [&fabric.name, &fabric.source]);
        for text in names.chain([&self.version]).chain(&self.notes) {
            check::text("a text of the comparison", text)?;
        }
        for overlay in &self.overlays {
            overlay.check()?;
        }
        for value in &self.values {
            value.check()?;
        }
        Ok(())
    }

    /// Returns the names of the `fabrics` as a title.
    fn title(&self) -> String {
        let names: Vec<&str> = self.fabrics.iter().map(|fabric| fabric.name.as_str()).collect();
        match names.split_last() {
            Some((last, others)) if !others.is_empty() => {
                format!("{} and {last}", others.join(", "))
            }
            _ => names.concat(),
        }
    }

    /// Returns the comparison as one self-contained HTML page.
    ///
    /// # Errors
    /// Errors of [`ComparePage::check`].
    pub fn to_html(&self) -> Result<String, Error> {
        self.check()?;
        let overlays = self.overlays.iter();
        let names = self.fabrics.iter().enumerate();
        let rows: Vec<Row<'_>> = self.values.iter().map(|value| self.row(value)).collect();

        // A column appears only if some fabric has a number for the column.
        let view = View {
            page: self,
            names: names.map(|(index, f)| (index % COLOURS + 1, f.name.as_str())).collect(),
            styles: [STYLE, PAGE_STYLE],
            script: PAGE_SCRIPT,
            overlays: overlays
                .map(|plot| (plot.title.as_str(), overlay_figure(plot, Placement::InPage)))
                .collect(),
            has_measured: self.numbers().any(|number| number.measured.is_some()),
            has_scatter: rows.iter().flat_map(|row| &row.cells).any(|cell| cell.is_within_scatter),
            has_assumed: self.numbers().any(|number| number.is_assumed),
            rows,
            limit: percent(self.limit),
        };
        Ok(view.render().expect("writing to a string does not fail"))
    }

    /// Returns the table of values as text for a terminal, in the units of the laboratory.
    ///
    /// # Errors
    /// Errors of [`ComparePage::check`].
    pub fn to_text(&self) -> Result<String, Error> {
        self.check()?;
        let mut lines = vec![self.title(), String::new()];
        let numbered = self.fabrics.iter().enumerate();
        lines.extend(numbered.map(|(index, fabric)| format!("{}  {}", index + 1, fabric.name)));
        lines.push(String::new());

        // The table of values.
        lines.extend(self.table().lines(0));
        lines.push(String::new());
        lines.push(format!(
            "differences from 1, of measured values where both have one, else of laws; !: more than {}",
            percent(self.limit)
        ));

        // The legend explains only signs that the table has.
        let rows = self.values.iter().map(|value| self.row(value));
        if rows.flat_map(|row| row.cells).any(|cell| cell.is_within_scatter) {
            lines.push("≈: within twice the standard deviation of the difference".to_owned());
        }
        if self.numbers().any(|number| number.is_assumed) {
            lines.push("in brackets: assumed, not measured".to_owned());
        }

        if !self.notes.is_empty() {
            lines.push(String::new());
            lines.extend(self.notes.iter().map(|note| format!("- {note}")));
        }

        lines.push(String::new());
        Ok(lines.join("\n"))
    }

    /// Returns the [`Table`] of the text: two columns for each fabric, and two further columns for
    /// the difference from the first fabric.
    fn table(&self) -> Table {
        // Columns of numbers are aligned at the right.
        let mut head: Vec<String> = ["", "", "", "unit"].map(str::to_owned).into();
        let mut right = Vec::new();
        for number in 1..=self.fabrics.len() {
            right.extend([head.len(), head.len() + 1]);
            head.extend([format!("{number} measured"), format!("{number} law")]);
            if number > 1 {
                right.push(head.len());
                head.extend([format!("{number} to 1"), String::new()]);
            }
        }
        let head: Vec<&str> = head.iter().map(String::as_str).collect();
        let mut table = Table::new(&head, &right);

        // Each value becomes a row of texts.
        for row in self.values.iter().map(|value| self.row(value)) {
            let value = row.value;
            let mut cells = vec![
                value.symbol.clone(),
                value.direction.clone(),
                value.name.clone(),
                row.unit.to_owned(),
            ];
            for (index, cell) in row.cells.iter().enumerate() {
                let law = Cell::text(cell.law.as_ref());
                let law = if cell.is_assumed { format!("({law})") } else { law };
                cells.extend([Cell::text(cell.measured.as_ref()), law]);
                if index > 0 {
                    let difference = cell.difference.as_ref();
                    let text =
                        difference.map_or_else(String::new, |difference| difference.text.clone());
                    cells.extend([text, cell.mark().to_owned()]);
                }
            }
            table.row(cells);
        }
        table
    }

    /// Returns the numbers of all values and fabrics.
    fn numbers(&self) -> impl Iterator<Item = &ComparedNumber> {
        self.values.iter().flat_map(|value| &value.numbers)
    }

    /// Returns the row of a `value`.
    fn row<'a>(&self, value: &'a ComparedValue) -> Row<'a> {
        Row {
            value,
            cells: (0..self.fabrics.len()).map(|index| self.cell(value, index)).collect(),
            unit: value.units.first().0,
            si_unit: value.units.second(),
        }
    }

    /// Returns the numbers of a `value` for the fabric `index`, and their difference from the
    /// numbers of the first fabric.
    fn cell(&self, value: &ComparedValue, index: usize) -> Cell {
        let ComparedNumber { measured, deviation, law, is_assumed } =
            value.numbers.get(index).copied().unwrap_or_default();
        let difference = value.difference(index);
        let within = difference.and_then(|difference| difference.is_within_scatter);
        let is_within_scatter = within == Some(true);
        Cell {
            measured: measured
                .map(|measured| ShownValue::with_error(measured, deviation, &value.units)),
            law: law.map(|law| ShownValue::new(law, &value.units)),
            is_assumed,
            difference: difference.map(|difference| {
                let relative = difference.ratio - 1.0;
                let apart = relative.abs() > self.limit && !is_within_scatter;
                Marked { text: signed_percent(relative), apart }
            }),
            is_within_scatter,
        }
    }
}

impl Cell {
    /// Returns the sign that follows the `difference` in a text.
    fn mark(&self) -> &'static str {
        match &self.difference {
            Some(_) if self.is_within_scatter => "≈",
            Some(difference) if difference.apart => "!",
            _ => "",
        }
    }

    /// Returns a number as text in the units of the laboratory, empty for `None`.
    fn text(value: Option<&ShownValue>) -> String {
        value.map_or_else(String::new, |value| value.first().number())
    }

    /// Returns the text that a page shows for a `value`, in both units.
    fn pair(value: &Option<ShownValue>) -> Option<(String, Option<String>)> {
        let value = value.as_ref()?;
        Some((value.first().print(), value.second().map(Shown::print)))
    }

    /// Returns the numbers that a page shows: the measured number, if `has_measured` says that
    /// there is a column for it, and the number of the law, in brackets where it was assumed.
    fn shown(&self, has_measured: &bool) -> Vec<Option<(String, Option<String>)>> {
        let measured = has_measured.then(|| Self::pair(&self.measured));
        let mut law = Self::pair(&self.law);
        if let Some((first, _)) = law.as_mut().filter(|_| self.is_assumed) {
            *first = format!("({first})");
        }
        measured.into_iter().chain([law]).collect()
    }
}
