//! Page of a study: its failed runs, and the effects of its axes on each measure.

use askama::Template;

use super::assets::{PAGE_SCRIPT, PAGE_STYLE};
use crate::check;
use crate::error::Error;
use crate::plot::{GraphPlot, Placement, STYLE, graph_figure};

/// Page of a study: a section for each measure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StudyPage {
    /// Program that made the report, as in "drape 0.1.0".
    pub version: String,
    /// Title.
    pub title: String,
    /// Sentences on the study as a whole.
    pub facts: Vec<String>,
    /// Runs that failed, each with its values and its message.
    pub failures: Vec<[String; 2]>,
    /// Measures in the order of the page.
    pub measures: Vec<MeasureEffects>,
}

/// Effects of the axes of a study on a measure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MeasureEffects {
    /// Name of the measure.
    pub name: String,
    /// Plots over each axis, side by side.
    pub plots: Vec<GraphPlot>,
    /// Means over levels, and over pairs of levels.
    pub tables: Vec<EffectTable>,
}

/// Table of means.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct EffectTable {
    /// Caption.
    pub caption: String,
    /// Heads of the columns. The first column has the levels.
    pub heads: Vec<String>,
    /// Cells of each row.
    pub rows: Vec<Vec<String>>,
}

/// What the HTML template shows.
#[derive(Template)]
#[template(path = "page/study.html")]
struct View<'a> {
    page: &'a StudyPage,
    styles: [&'static str; 2],
    script: &'static str,
    measures: Vec<MeasureView<'a>>,
}

/// Section of a measure.
struct MeasureView<'a> {
    name: &'a str,
    figures: Vec<String>,
    tables: &'a [EffectTable],
}

impl StudyPage {
    /// Returns the report as one self-contained HTML page, an HTML text: no network, no fonts, no
    /// other file.
    ///
    /// # Errors
    /// Numbers that are not finite, texts that cannot be shown.
    pub fn to_html(&self) -> Result<String, Error> {
        let Self { version, title, facts, failures, measures } = self;
        let tables = measures.iter().flat_map(|measure| &measure.tables);
        let cells = tables.flat_map(|table| {
            let cells = table.heads.iter().chain(table.rows.iter().flatten());
            cells.chain([&table.caption])
        });
        let names = measures.iter().map(|measure| &measure.name);
        let failures = failures.iter().flatten();
        for text in
            [version, title].into_iter().chain(facts).chain(failures).chain(names).chain(cells)
        {
            check::text("a text of the report", text)?;
        }

        let mut views = Vec::new();
        for MeasureEffects { name, plots, tables } in measures {
            plots.iter().try_for_each(GraphPlot::check)?;
            let figures = plots.iter().map(|plot| graph_figure(plot, Placement::InPage)).collect();
            views.push(MeasureView { name, figures, tables });
        }
        let styles = [STYLE, PAGE_STYLE];
        let view = View { page: self, styles, script: PAGE_SCRIPT, measures: views };
        Ok(view.render().expect("writing to a string does not fail"))
    }
}
