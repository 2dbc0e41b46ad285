//! Comparison of two fabrics, as a page and as text.

use askama::Template;
use serde::Serialize;

use super::assets::{PAGE_SCRIPT, PAGE_STYLE};
use super::shown::{Marked, Shown, ShownValue};
use crate::check;
use crate::error::Error;
use crate::parameter::Units;
use crate::plot::{OverlayPlot, Placement, STYLE, overlay_figure};
use crate::text::number::{percent, significant};
use crate::text::table::Table;

/// Comparison of two fabrics: their curves overlaid, their values with the ratio.
///
/// ```
/// use drape_report::{ComparePage, ComparedValue, Units};
///
/// let mass = ComparedValue {
///     symbol: "W".to_owned(),
///     name: "mass per area".to_owned(),
///     direction: String::new(),
///     units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
///     values: [Some(0.1), Some(0.23)],
/// };
/// assert_eq!(mass.ratio(), Some(2.3));
/// let page = ComparePage { values: vec![mass], ..ComparePage::default() };
/// assert!(page.to_text()?.contains("W  mass per area"));
/// # Ok::<(), drape_report::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparePage {
    /// Names and sources of the two fabrics.
    pub fabrics: [FabricName; 2],
    /// Program that made the report, as in "drape 0.1.0".
    pub version: String,
    /// Curves, test by test.
    pub overlays: Vec<OverlayPlot>,
    /// Values in order.
    pub values: Vec<ComparedValue>,
    /// Notes for the reader: assumed numbers, curves that only one fabric has.
    pub notes: Vec<String>,
    /// Relative difference above which values are marked, as a ratio of the first.
    pub limit: f64,
}

/// Relative difference of two fabrics above which values are marked, as a ratio.
///
/// With a lower limit the scatter of repeated tests would be marked, with a higher one real
/// differences would not.
const LIMIT: f64 = 0.25;

impl Default for ComparePage {
    /// Returns an empty comparison with the usual limit.
    fn default() -> ComparePage {
        ComparePage {
            fabrics: Default::default(),
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

/// Value of both fabrics, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparedValue {
    /// Symbol, as in "B".
    pub symbol: String,
    /// Name, as in "bending rigidity".
    pub name: String,
    /// Direction, as in "warp"; may be empty.
    pub direction: String,
    /// Units.
    pub units: Units,
    /// Value of each fabric, where it has one.
    pub values: [Option<f64>; 2],
}

impl ComparedValue {
    /// Returns the second value over the first; `None` where one is missing or the first is zero.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        let [first, second] = self.values;
        let first = first.filter(|first| *first != 0.0)?;
        Some(second? / first).filter(|ratio| ratio.is_finite())
    }
}

#[derive(Template)]
#[template(path = "page/compare.html")]
struct View<'a> {
    page: &'a ComparePage,
    styles: [&'static str; 2],
    script: &'static str,
    overlays: Vec<(&'a str, String)>,
    rows: Vec<Row<'a>>,
    limit: String,
}

struct Row<'a> {
    value: &'a ComparedValue,
    cells: [Option<ShownValue>; 2],
    unit: &'a str,
    si_unit: Option<&'a str>,
    ratio: Option<Marked>,
}

impl ComparePage {
    /// Refuses an empty comparison, numbers that are not finite and texts that cannot be shown.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        let [a, b] = &self.fabrics;
        if self.overlays.is_empty() && self.values.is_empty() {
            return Err(Error::EmptyReport { name: format!("{} and {}", a.name, b.name) });
        }
        check::number(|| "the limit of a comparison".to_owned(), self.limit)?;
        let texts = [&a.name, &a.source, &b.name, &b.source, &self.version];
        for text in texts.into_iter().chain(&self.notes) {
            check::text("a text of the comparison", text)?;
        }
        for overlay in &self.overlays {
            overlay.check()?;
        }
        for value in &self.values {
            for text in [&value.symbol, &value.name, &value.direction] {
                check::text("a text of a compared value", text)?;
            }
            value.units.check()?;
            for number in value.values.iter().flatten() {
                check::number(|| format!("{} {}", value.symbol, value.direction), *number)?;
            }
        }
        Ok(())
    }

    /// Returns the comparison as one self-contained HTML page.
    ///
    /// # Errors
    /// Those of [`ComparePage::check`].
    pub fn to_html(&self) -> Result<String, Error> {
        self.check()?;
        let overlays = self.overlays.iter();
        let view = View {
            page: self,
            styles: [STYLE, PAGE_STYLE],
            script: PAGE_SCRIPT,
            overlays: overlays
                .map(|plot| (plot.title.as_str(), overlay_figure(plot, Placement::InPage)))
                .collect(),
            rows: self.values.iter().map(|value| self.row(value)).collect(),
            limit: percent(self.limit),
        };
        Ok(view.render().expect("writing to a string does not fail"))
    }

    /// Returns the table of values as text for a terminal.
    ///
    /// # Errors
    /// Those of [`ComparePage::check`].
    pub fn to_text(&self) -> Result<String, Error> {
        self.check()?;
        let [a, b] = [&self.fabrics[0].name, &self.fabrics[1].name];
        let mut lines = vec![format!("{a} and {b}"), String::new()];
        let head = ["", "", "", "unit", a, b, "ratio", "", "SI", "", "unit"];
        let mut table = Table::new(&head, &[4, 5, 6, 8, 9]);
        for row in self.values.iter().map(|value| self.row(value)) {
            let first = |cell: &Option<ShownValue>| {
                cell.as_ref().map_or_else(String::new, |value| value.first().number())
            };
            let si = |cell: &Option<ShownValue>| {
                let si = cell.as_ref().and_then(ShownValue::second);
                si.map_or_else(String::new, Shown::number)
            };
            let ratio = row.ratio.as_ref();
            table.row(vec![
                row.value.symbol.clone(),
                row.value.direction.clone(),
                row.value.name.clone(),
                row.unit.to_owned(),
                first(&row.cells[0]),
                first(&row.cells[1]),
                ratio.map_or_else(String::new, |ratio| ratio.text.clone()),
                if ratio.is_some_and(|ratio| ratio.apart) { "!" } else { "" }.to_owned(),
                si(&row.cells[0]),
                si(&row.cells[1]),
                row.si_unit.unwrap_or_default().to_owned(),
            ]);
        }
        lines.extend(table.lines(0));
        if !self.notes.is_empty() {
            lines.push(String::new());
            lines.extend(self.notes.iter().map(|note| format!("- {note}")));
        }
        lines.push(String::new());
        Ok(lines.join("\n"))
    }

    /// Returns the row of a value.
    fn row<'a>(&self, value: &'a ComparedValue) -> Row<'a> {
        let kes = value.units.kes.as_ref();
        Row {
            value,
            cells: value.values.map(|number| Some(ShownValue::new(number?, &value.units))),
            unit: kes.map_or(&value.units.si, |unit| &unit.name),
            si_unit: kes.map(|_| value.units.si.as_str()),
            ratio: value.ratio().map(|ratio| {
                let text = significant(ratio, 3);
                Marked { text, apart: (ratio - 1.0).abs() > self.limit }
            }),
        }
    }
}
