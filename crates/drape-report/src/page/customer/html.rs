//! HTML page of the report to a customer.

use askama::Template;

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
use crate::text::number::{percent, typeset};

/// Style of this page beside that of all pages.
const CUSTOMER_STYLE: &str = include_str!("../../../templates/page/customer.css");

/// Fabrics that stand side by side in a table; more are in tables below.
const ABREAST: usize = 3;

/// Points of a plot that are drawn at most: more would show no more, and make the page large.
const POINTS_MAX: usize = 1200;

/// Size of the table of all numbers that the page carries at most, in bytes: with more, the points of the
/// loops are left out of it.
const TABLE_MAX: usize = 700_000;

/// Labels of the figures of a girth, on narrow screens.
const GIRTH_LABELS: [&str; 5] = ["body", "garment", "ease", "pattern", "ease in the pattern"];

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
    /// The table of all numbers in base64, and whether it has the points of the loops.
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

struct ValueRow<'a> {
    value: &'a ReportedValue,
    unit: &'a str,
    cells: Vec<Cell>,
}

/// Numbers of a fabric.
struct Cell {
    measured: Option<String>,
    law: Option<String>,
    difference: Option<Marked>,
    is_within_scatter: bool,
}

/// Loops of one test and direction, a cell for each fabric.
struct LoopRow<'a> {
    title: String,
    cells: Vec<LoopCell<'a>>,
}

struct LoopCell<'a> {
    head: Head<'a>,
    plots: Vec<LoopView<'a>>,
}

struct LoopView<'a> {
    title: &'a str,
    model: &'a str,
    trust: &'static str,
    class: &'static str,
    /// Misfit in words; empty where there is no measured curve.
    misfit: String,
    figures: Vec<String>,
}

struct DrapeView<'a> {
    head: Head<'a>,
    drape: Option<DrapeTexts<'a>>,
}

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
    /// Returns the report as one self-contained HTML page: no network, no fonts, no other file. It carries
    /// the table of [`CustomerPage::to_csv`] for download.
    ///
    /// # Errors
    /// Those of [`CustomerPage::check`], and a picture that cannot be encoded.
    pub fn to_html(&self) -> Result<String, Error> {
        self.check()?;
        let heads = heads(self);
        let record = self
            .record_titles()
            .into_iter()
            .map(|title| (title, self.fabrics.iter().map(|fabric| fabric.line(title)).collect()));
        let drapes: Result<Vec<DrapeView<'_>>, Error> = heads
            .iter()
            .zip(&self.fabrics)
            .map(|(head, fabric)| {
                let drape = fabric.drape.as_ref().map(drape_texts).transpose()?;
                Ok(DrapeView { head: *head, drape })
            })
            .collect();
        let plots = || self.fabrics.iter().flat_map(|fabric| &fabric.loops);
        let is_thinned =
            plots().flat_map(|own| &own.law.plots).any(|plot| plot.points().count() > POINTS_MAX);
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

/// Returns the fabrics with the numbers of their colours.
fn heads(page: &CustomerPage) -> Vec<Head<'_>> {
    let fabrics = page.fabrics.iter().enumerate();
    fabrics.map(|(index, own)| Head { colour: index % COLOURS + 1, name: &own.name }).collect()
}

/// Returns the table of all numbers in base64, and whether the points of the loops are in it.
fn carried_table(page: &CustomerPage) -> (String, bool) {
    let all = table(page, Detail::All);
    if all.len() <= TABLE_MAX {
        return (encode(all.as_bytes()), true);
    }
    (encode(table(page, Detail::WithoutPoints).as_bytes()), false)
}

/// Returns notes, each with the fabrics that it is about; nothing where it is about all of them.
fn attributed<'a>(notes: &'a [ReportedNote], heads: &[Head<'_>]) -> Vec<(String, &'a str)> {
    let of = |note: &'a ReportedNote| {
        let names = note.fabrics.iter().filter_map(|index| heads.get(*index)).map(|own| own.name);
        let is_of_all = note.fabrics.len() >= heads.len();
        let names = if is_of_all { String::new() } else { names.collect::<Vec<_>>().join(", ") };
        (names, note.text.as_str())
    };
    notes.iter().map(of).collect()
}

/// Returns tables of values, each of a few fabrics; rows without a number are left out.
fn value_tables<'a>(
    page: &CustomerPage,
    values: &'a [ReportedValue],
    heads: &[Head<'a>],
) -> Vec<ValueTable<'a>> {
    let indices: Vec<usize> = (0..heads.len()).collect();
    let tables = indices.chunks(ABREAST).map(|of| {
        let rows = values.iter().map(|value| value_row(value, of, &page.limits));
        let has_number = |row: &ValueRow<'_>| {
            row.cells.iter().any(|cell| cell.measured.is_some() || cell.law.is_some())
        };
        ValueTable {
            heads: of.iter().map(|index| heads[*index]).collect(),
            rows: rows.filter(has_number).collect(),
        }
    });
    tables.filter(|table| !table.rows.is_empty()).collect()
}

fn value_row<'a>(value: &'a ReportedValue, fabrics: &[usize], limits: &Limits) -> ValueRow<'a> {
    let units = &value.value.units;
    let cell = |&fabric: &usize| {
        let number = value.number(fabric);
        let difference = value.difference(fabric);
        let is_within_scatter =
            difference.and_then(|own| own.is_within_scatter).unwrap_or_default();
        let measured = number
            .measured
            .map(|own| ShownValue::with_error(own, number.deviation, units).first().print());
        let law = number.law.map(|law| ShownValue::new(law, units).first().print());
        Cell {
            measured,
            law: law.map(|law| if number.is_assumed { format!("({law})") } else { law }),
            difference: difference.map(|own| Marked {
                text: typeset(&in_tenths(own.ratio)),
                apart: own.ratio.abs() > limits.difference && !is_within_scatter,
            }),
            is_within_scatter,
        }
    };
    ValueRow { value, unit: units.first().0, cells: fabrics.iter().map(cell).collect() }
}

/// Returns a difference in tenths of a per cent, finer than any instrument repeats.
fn in_tenths(ratio: f64) -> String {
    let percent = 100.0 * ratio;
    if percent.abs() < 0.05 { "0.0 %".to_owned() } else { format!("{percent:+.1} %") }
}

/// Returns the loops row by row: of each test and direction those of all fabrics.
fn loop_rows<'a>(page: &'a CustomerPage, heads: &[Head<'a>]) -> Vec<LoopRow<'a>> {
    let mut keys: Vec<[&str; 2]> = Vec::new();
    for own in page.fabrics.iter().flat_map(|fabric| &fabric.loops) {
        let key = [own.test.as_str(), own.direction.as_str()];
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    let row = |key: [&'a str; 2]| {
        let cells = heads.iter().zip(&page.fabrics).map(|(head, fabric)| {
            let of_key = fabric.loops.iter().filter(|own| [&own.test, &own.direction] == key);
            LoopCell {
                head: *head,
                plots: of_key.map(|own| loop_view(own, &page.limits)).collect(),
            }
        });
        let title = key.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>();
        LoopRow { title: title.join(", "), cells: cells.collect() }
    };
    keys.into_iter().map(row).collect()
}

fn loop_view<'a>(own: &'a ReportedLoop, limits: &Limits) -> LoopView<'a> {
    let trust = own.law.verdict(limits).trust;
    let misfit = own.law.statistics.as_ref().map(|statistics| percent(statistics.misfit));
    let figure = |plot: &LoopPlot| loop_figure(&thinned(plot), Placement::InPage);
    LoopView {
        title: &own.law.title,
        model: &own.law.model,
        trust: trust.name(),
        class: trust.class(),
        misfit: misfit.map_or_else(String::new, |misfit| format!("misfit {misfit} of the range")),
        figures: own.law.plots.iter().map(figure).collect(),
    }
}

/// Returns a plot with every few points of its branches, where it has too many; the last point of a
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

fn drape_texts(drape: &ReportedDrape) -> Result<DrapeTexts<'_>, Error> {
    let in_percent = |ratio: f64| typeset(&format!("{:.1}", 100.0 * ratio));
    let [low, high] = drape.interval.map(in_percent);
    let picture = drape
        .picture
        .as_ref()
        .map(|picture| Ok((picture.width(), picture.height(), encode(&picture.png()?))));
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
        picture: picture.transpose()?,
    })
}
