//! HTML page of the report to a customer.

use askama::Template;
use drape_input::{percent, typeset};

use super::chart::{LANE, ValueChart};
use super::csv::{Detail, table};
use super::drape::ReportedDrape;
use super::report::{CustomerPage, ReportedLoop, ReportedNote};
use super::values::ReportedValue;
use crate::error::Error;
use crate::page::assets::{PAGE_SCRIPT, PAGE_STYLE};
use crate::page::law_report::Limits;
use crate::page::shown::{Marked, ShownValue};
use crate::plot::{COLOURS, LoopPlot, Placement, STYLE, loop_figure, shadow_figure};
use crate::text::base64::encode;

/// Style of this page, in addition to the style of all pages.
const CUSTOMER_STYLE: &str = include_str!("../../../templates/page/customer.css");

/// Number of fabrics that stand side by side in a table. Further fabrics have tables below.
const ABREAST: usize = 3;

/// Largest number of drawn points of a plot. Further points could not be seen, and would make the
/// page large.
const POINTS_MAX: usize = 1200;

/// Largest size of the table of all numbers in the page, in bytes. A larger table is stored without
/// the points of the loops.
const TABLE_MAX: usize = 700_000;

/// Labels of the figures of a girth, on narrow screens.
const GIRTH_LABELS: [&str; 5] = ["body", "garment", "ease", "pattern", "ease in the pattern"];

/// What the HTML template shows.
#[derive(Template)]
#[template(path = "page/customer.html")]
struct View<'a> {
    page: &'a CustomerPage,
    styles: [String; 2],
    script: &'static str,
    heads: Vec<Head<'a>>,
    record: Vec<(&'a str, Vec<&'a str>)>,
    tables: Vec<ValueTable<'a>>,
    others: Vec<ValueTable<'a>>,
    chart: ValueChart<'a>,
    lanes: String,
    loops: Vec<LoopRow<'a>>,
    drapes: Vec<DrapeView<'a>>,
    has_drapes: bool,
    assumed: Vec<(String, &'a str)>,
    notes: Vec<(String, &'a str)>,
    /// The table of all numbers in base64, and whether the table has the points of the loops.
    csv: (String, bool),
    is_thinned: bool,
    limits: [String; 2],
}

/// Fabric with the number of its colour.
#[derive(Clone, Copy)]
struct Head<'a> {
    colour: usize,
    name: &'a str,
}

/// Values of fabrics that stand side by side.
struct ValueTable<'a> {
    heads: Vec<Head<'a>>,
    rows: Vec<ValueRow<'a>>,
}

/// Row of a table of values.
struct ValueRow<'a> {
    value: &'a ReportedValue,
    unit: &'a str,
    cells: Vec<Cell>,
}

/// Numbers of one fabric.
struct Cell {
    measured: Option<String>,
    law: Option<String>,
    difference: Option<Marked>,
    is_within_scatter: bool,
}

/// Loops of one test and direction, with a cell for each fabric.
struct LoopRow<'a> {
    title: String,
    cells: Vec<LoopCell<'a>>,
}

/// Loops of one fabric.
struct LoopCell<'a> {
    head: Head<'a>,
    plots: Vec<LoopView<'a>>,
}

/// Figures of one law.
struct LoopView<'a> {
    title: &'a str,
    model: &'a str,
    trust: &'static str,
    class: &'static str,
    /// Misfit in words. Empty where there is no measured curve.
    misfit: String,
    figures: Vec<String>,
}

/// Drape of one fabric, if the fabric has one.
struct DrapeView<'a> {
    head: Head<'a>,
    drape: Option<DrapeTexts<'a>>,
}

/// Texts and figures of a drape.
struct DrapeTexts<'a> {
    drape: &'a ReportedDrape,
    coefficient: String,
    interval: String,
    nodes: String,
    shadow: String,
    /// Width, height and PNG file in base64 of the picture.
    picture: Option<(u32, u32, String)>,
}

impl CustomerPage {
    /// Returns the report as one self-contained HTML page: no network, no fonts, no other file. The
    /// page contains the table of [`CustomerPage::to_csv`] for download.
    ///
    /// # Errors
    /// Errors of [`CustomerPage::check`], and a picture that cannot be encoded.
    pub fn to_html(&self) -> Result<String, Error> {
        self.check()?;
        let heads = heads(self);
        let record = self
            .record_titles()
            .into_iter()
            .map(|title| (title, self.fabrics.iter().map(|fabric| fabric.line(title)).collect()));

        // A picture of a drape may fail to be encoded.
        let drapes: Result<Vec<DrapeView<'_>>, Error> = heads
            .iter()
            .zip(&self.fabrics)
            .map(|(head, fabric)| {
                let drape = fabric.drape.as_ref().map(drape_texts).transpose()?;
                Ok(DrapeView { head: *head, drape })
            })
            .collect();

        // The page says whether a figure was drawn with fewer points.
        let loops = self.fabrics.iter().flat_map(|fabric| &fabric.loops);
        let is_thinned = loops
            .flat_map(|reported| &reported.law.plots)
            .any(|plot| plot.points().count() > POINTS_MAX);
        let view = View {
            page: self,
            styles: [STYLE.to_owned(), format!("{PAGE_STYLE}{CUSTOMER_STYLE}")],
            script: PAGE_SCRIPT,
            record: record.collect(),
            tables: value_tables(self, &self.values, &heads),
            others: value_tables(self, &self.others, &heads),
            chart: ValueChart::new(self),
            lanes: format!("{}", LANE * self.fabrics.len() as f64),
            loops: loop_rows(self, &heads),
            has_drapes: self.fabrics.iter().any(|fabric| fabric.drape.is_some()),
            drapes: drapes?,
            assumed: attributed(&self.assumed, &heads),
            notes: attributed(&self.notes, &heads),
            csv: carried_table(self),
            is_thinned,
            limits: [self.limits.misfit, self.limits.difference].map(percent),
            heads,
        };
        Ok(view.render().expect("writing to a string does not fail"))
    }
}

/// Returns the fabrics of a `page` with the numbers of their colours.
fn heads(page: &CustomerPage) -> Vec<Head<'_>> {
    let fabrics = page.fabrics.iter().enumerate();
    fabrics
        .map(|(index, fabric)| Head { colour: index % COLOURS + 1, name: &fabric.name })
        .collect()
}

/// Returns the table of all numbers of a `page` in base64, and whether the table has the points of
/// the loops.
fn carried_table(page: &CustomerPage) -> (String, bool) {
    let all = table(page, Detail::All);
    if all.len() <= TABLE_MAX {
        return (encode(all.as_bytes()), true);
    }
    (encode(table(page, Detail::WithoutPoints).as_bytes()), false)
}

/// Returns the text of each of `notes` with the names of its fabrics. The names are empty where the
/// note is about all fabrics.
fn attributed<'a>(notes: &'a [ReportedNote], heads: &[Head<'_>]) -> Vec<(String, &'a str)> {
    let attributed = notes.iter().map(|note| {
        let names = note.fabrics.iter().filter_map(|index| heads.get(*index)).map(|head| head.name);
        let is_of_all = note.fabrics.len() >= heads.len();
        let names = if is_of_all { String::new() } else { names.collect::<Vec<_>>().join(", ") };
        (names, note.text.as_str())
    });
    attributed.collect()
}

/// Returns tables of `values`, each of at most [`ABREAST`] fabrics. Rows without a number are left
/// out.
fn value_tables<'a>(
    page: &CustomerPage,
    values: &'a [ReportedValue],
    heads: &[Head<'a>],
) -> Vec<ValueTable<'a>> {
    let indices: Vec<usize> = (0..heads.len()).collect();
    let tables = indices.chunks(ABREAST).map(|fabrics| {
        let rows = values.iter().map(|value| value_row(value, fabrics, &page.limits));
        let rows = rows.filter(|row| {
            row.cells.iter().any(|cell| cell.measured.is_some() || cell.law.is_some())
        });
        ValueTable {
            heads: fabrics.iter().map(|index| heads[*index]).collect(),
            rows: rows.collect(),
        }
    });
    tables.filter(|table| !table.rows.is_empty()).collect()
}

/// Returns the row of a `value` with a cell for each of `fabrics`. Differences above `limits` are
/// marked.
fn value_row<'a>(value: &'a ReportedValue, fabrics: &[usize], limits: &Limits) -> ValueRow<'a> {
    let units = &value.value.units;
    let cells = fabrics.iter().map(|&fabric| {
        let number = value.number(fabric);
        let difference = value.difference(fabric);
        let is_within_scatter =
            difference.and_then(|difference| difference.is_within_scatter).unwrap_or_default();
        let measured = number.measured.map(|measured| {
            ShownValue::with_error(measured, number.deviation, units).first().print()
        });
        let law = number.law.map(|law| ShownValue::new(law, units).first().print());

        Cell {
            measured,
            law: law.map(|law| if number.is_assumed { format!("({law})") } else { law }),
            difference: difference.map(|difference| Marked {
                text: typeset(&in_tenths(difference.ratio)),
                apart: difference.ratio.abs() > limits.difference && !is_within_scatter,
            }),
            is_within_scatter,
        }
    });
    ValueRow { value, unit: units.first().0, cells: cells.collect() }
}

/// Returns a difference, given as a `ratio`, in per cent with one decimal, finer than any
/// instrument repeats.
fn in_tenths(ratio: f64) -> String {
    let percent = 100.0 * ratio;
    if percent.abs() < 0.05 { "0.0 %".to_owned() } else { format!("{percent:+.1} %") }
}

/// Returns the rows of loops. A row has the loops of all fabrics of one test and direction.
fn loop_rows<'a>(page: &'a CustomerPage, heads: &[Head<'a>]) -> Vec<LoopRow<'a>> {
    let mut keys: Vec<[&str; 2]> = Vec::new();
    for reported in page.fabrics.iter().flat_map(|fabric| &fabric.loops) {
        let key = [reported.test.as_str(), reported.direction.as_str()];
        if !keys.contains(&key) {
            keys.push(key);
        }
    }

    let rows = keys.into_iter().map(|key| {
        let cells = heads.iter().zip(&page.fabrics).map(|(head, fabric)| {
            let of_key =
                fabric.loops.iter().filter(|reported| [&reported.test, &reported.direction] == key);
            LoopCell {
                head: *head,
                plots: of_key.map(|reported| loop_view(reported, &page.limits)).collect(),
            }
        });
        let title = key.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>();
        LoopRow { title: title.join(", "), cells: cells.collect() }
    });
    rows.collect()
}

/// Returns the figures of a `reported` loop, whose fit is judged by `limits`.
fn loop_view<'a>(reported: &'a ReportedLoop, limits: &Limits) -> LoopView<'a> {
    let trust = reported.law.verdict(limits).trust;
    let misfit = reported.law.statistics.as_ref().map(|statistics| percent(statistics.misfit));
    let figures =
        reported.law.plots.iter().map(|plot| loop_figure(&thinned(plot), Placement::InPage));
    LoopView {
        title: &reported.law.title,
        model: &reported.law.model,
        trust: trust.name(),
        class: trust.class(),
        misfit: misfit.map_or_else(String::new, |misfit| format!("misfit {misfit} of the range")),
        figures: figures.collect(),
    }
}

/// Returns a `plot` with at most about [`POINTS_MAX`] points, evenly chosen. The last point of each
/// branch stays.
fn thinned(plot: &LoopPlot) -> LoopPlot {
    let mut plot = plot.clone();
    let every = plot.points().count().div_ceil(POINTS_MAX);
    for branch in plot.branches.iter_mut().filter(|_| every > 1) {
        let last = branch.points.len().saturating_sub(1);
        let mut index = 0;
        branch.points.retain(|_| {
            index += 1;
            (index - 1) % every == 0 || index - 1 == last
        });
    }
    plot
}

/// Returns the texts and figures of a `drape`.
fn drape_texts(drape: &ReportedDrape) -> Result<DrapeTexts<'_>, Error> {
    let in_percent = |ratio: f64| typeset(&format!("{:.1}", 100.0 * ratio));
    let [low, high] = drape.interval.map(in_percent);
    let picture = match &drape.picture {
        Some(picture) => Some((picture.width(), picture.height(), encode(&picture.png()?))),
        None => None,
    };
    Ok(DrapeTexts {
        drape,
        coefficient: format!(
            "{} ± {} %",
            in_percent(drape.coefficient),
            in_percent(drape.deviation)
        ),
        interval: format!("{low} to {high} %"),
        nodes: drape.nodes_in_words(),
        shadow: shadow_figure(&drape.shadow, Placement::InPage),
        picture,
    })
}
