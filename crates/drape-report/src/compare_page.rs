use askama::Template;
use serde::Serialize;

use crate::check;
use crate::error::ReportError;
use crate::fit_html::{PAGE_SCRIPT, PAGE_STYLE};
use crate::number::percent;
use crate::parameter::Units;
use crate::plot::{OverlayPlot, Place, overlay_figure};
use crate::shown::Shown;
use crate::table::Table;

/// Two fabrics beside each other: their curves overlaid, their values with the ratio.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparePage {
    /// The two fabrics.
    pub fabrics: [FabricName; 2],
    /// What made the report, as in "drape 0.1.0".
    pub version: String,
    /// The curves, test by test.
    pub overlays: Vec<OverlayPlot>,
    /// The values.
    pub values: Vec<ComparedValue>,
    /// What a reader must know: assumed numbers, curves that only one fabric has.
    pub notes: Vec<String>,
    /// Values further apart than this are marked, as a ratio of the first.
    pub limit: f64,
}

/// Difference between two fabrics that is marked, as a ratio.
///
/// Lower, and the scatter of repeated tests is marked; higher, and real differences are not.
const LIMIT: f64 = 0.25;

impl Default for ComparePage {
    /// Nothing to compare yet, with the usual limit.
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

/// A fabric of a comparison.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct FabricName {
    /// Its name.
    pub name: String,
    /// Where it comes from.
    pub source: String,
}

/// A value of both fabrics, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparedValue {
    /// The symbol, as in "B".
    pub symbol: String,
    /// What it is, as in "bending rigidity".
    pub name: String,
    /// The direction, as in "warp"; may be empty.
    pub direction: String,
    /// Its units.
    pub units: Units,
    /// The value of each fabric, where it has one.
    pub values: [Option<f64>; 2],
}

impl ComparedValue {
    /// The second fabric's value over the first's; none where either is missing or the first is zero.
    pub fn ratio(&self) -> Option<f64> {
        let [first, second] = self.values;
        let first = first.filter(|first| *first != 0.0)?;
        Some(second? / first).filter(|ratio| ratio.is_finite())
    }
}

#[derive(Template)]
#[template(path = "compare.html")]
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
    /// Each fabric's value in the first unit, and in SI where that is another.
    cells: [Option<(Shown, Option<Shown>)>; 2],
    unit: &'a str,
    si_unit: Option<&'a str>,
    ratio: Option<(String, bool)>,
}

impl ComparePage {
    /// Refuses an empty comparison, numbers that are none and texts that cannot be shown.
    pub fn check(&self) -> Result<(), ReportError> {
        let [a, b] = &self.fabrics;
        if self.overlays.is_empty() && self.values.is_empty() {
            return Err(ReportError::EmptyReport { name: format!("{} and {}", a.name, b.name) });
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

    /// The comparison as one HTML page that needs nothing else.
    pub fn to_html(&self) -> Result<String, ReportError> {
        self.check()?;
        let overlays = self.overlays.iter();
        let view = View {
            page: self,
            styles: [crate::plot::STYLE, PAGE_STYLE],
            script: PAGE_SCRIPT,
            overlays: overlays
                .map(|plot| (plot.title.as_str(), overlay_figure(plot, Place::InPage)))
                .collect(),
            rows: self.values.iter().map(|value| self.row(value)).collect(),
            limit: percent(self.limit),
        };
        Ok(view.render().expect("writing to a string does not fail"))
    }

    /// The table of values as text for a terminal.
    pub fn to_text(&self) -> Result<String, ReportError> {
        self.check()?;
        let [a, b] = [&self.fabrics[0].name, &self.fabrics[1].name];
        let mut lines = vec![format!("{a} and {b}"), String::new()];
        let head = ["", "", "", "unit", a, b, "ratio", "", "SI", "", "unit"];
        let mut table = Table::new(&head, &[4, 5, 6, 8, 9]);
        for row in self.values.iter().map(|value| self.row(value)) {
            let first = |cell: &Option<(Shown, Option<Shown>)>| {
                let cell = cell.as_ref();
                cell.map_or_else(String::new, |(first, _)| first.number())
            };
            let si = |cell: &Option<(Shown, Option<Shown>)>| {
                let si = cell.as_ref().and_then(|(_, si)| si.as_ref());
                si.map_or_else(String::new, Shown::number)
            };
            let (ratio, apart) = row.ratio.clone().unwrap_or_default();
            table.row(vec![
                row.value.symbol.clone(),
                row.value.direction.clone(),
                row.value.name.clone(),
                row.unit.to_owned(),
                first(&row.cells[0]),
                first(&row.cells[1]),
                ratio,
                if apart { "!" } else { "" }.to_owned(),
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

    fn row<'a>(&self, value: &'a ComparedValue) -> Row<'a> {
        let kes = value.units.kes.as_ref();
        let cell = |number: f64| match Shown::both(number, &value.units) {
            (Some(kes), si) => (kes, Some(si)),
            (None, si) => (si, None),
        };
        Row {
            value,
            cells: value.values.map(|number| number.map(cell)),
            unit: kes.map_or(&value.units.si, |unit| &unit.name),
            si_unit: kes.map(|_| value.units.si.as_str()),
            ratio: value.ratio().map(|ratio| {
                let text = crate::number::significant(ratio, 3);
                (text, (ratio - 1.0).abs() > self.limit)
            }),
        }
    }
}
