use askama::Template;

use crate::base64::encode;
use crate::check;
use crate::error::ReportError;
use crate::fit_html::{PAGE_SCRIPT, PAGE_STYLE};
use crate::picture::Picture;
use crate::plot::{GraphPlot, Place, graph_figure};

/// Simulations held against what is known: figures, plots and pictures, case by case.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ValidationPage {
    /// What made the report, as in "drape 0.1.0".
    pub version: String,
    /// The cases in the order of the report.
    pub cases: Vec<ValidationCase>,
    /// What all of this does not show.
    pub notes: Vec<String>,
}

/// One case of a validation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ValidationCase {
    /// The name by which it is asked for.
    pub name: String,
    /// What it shows.
    pub title: String,
    /// How long it took, in s.
    pub seconds: f64,
    /// Why it could not be run, if so.
    pub failure: Option<String>,
    /// Its figures.
    pub rows: Vec<ValidationRow>,
    /// Its plots.
    pub plots: Vec<GraphPlot>,
    /// Its pictures, each with what it shows.
    pub pictures: Vec<(String, Picture)>,
}

/// A figure beside what it should be, in words and digits.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ValidationRow {
    /// What was measured.
    pub what: String,
    /// The figure of the simulation, its reference, how far it is off, and the limit; empty for none.
    pub cells: [String; 4],
    /// Whether it is within its limit; none where it has no limit.
    pub passes: Option<bool>,
}

impl ValidationCase {
    /// Whether it could be run, and every figure is within its limit.
    pub fn passes(&self) -> bool {
        self.failure.is_none() && self.rows.iter().all(|row| row.passes != Some(false))
    }

    fn check(&self) -> Result<(), ReportError> {
        check::number(|| format!("the time of {}", self.name), self.seconds)?;
        let captions = self.pictures.iter().map(|(caption, _)| caption);
        let cells = self.rows.iter().flat_map(|row| std::iter::once(&row.what).chain(&row.cells));
        let head = [&self.name, &self.title].into_iter().chain(&self.failure);
        for text in head.chain(captions).chain(cells) {
            check::text("a text of a case", text)?;
        }
        self.plots.iter().try_for_each(GraphPlot::check)
    }
}

#[derive(Template)]
#[template(path = "validation.html")]
struct View<'a> {
    page: &'a ValidationPage,
    styles: [&'static str; 2],
    script: &'static str,
    judgement: String,
    cases: Vec<CaseView<'a>>,
}

struct CaseView<'a> {
    case: &'a ValidationCase,
    seconds: String,
    plots: Vec<(&'a str, String)>,
    /// Caption, width, height, and the PNG file as text.
    pictures: Vec<(&'a str, [u32; 2], String)>,
}

impl ValidationPage {
    /// The report as one HTML page that needs nothing else: no network, no fonts, no other file.
    ///
    /// # Errors
    /// A report without cases, numbers that are none, texts that cannot be shown.
    pub fn to_html(&self) -> Result<String, ReportError> {
        if self.cases.is_empty() {
            return Err(ReportError::EmptyReport { name: "the validation".to_owned() });
        }
        for text in std::iter::once(&self.version).chain(&self.notes) {
            check::text("a text of the report", text)?;
        }
        self.cases.iter().try_for_each(ValidationCase::check)?;
        let cases = self.cases.iter().map(|case| {
            let pictures = case.pictures.iter().map(|(caption, picture)| {
                let size = [picture.width(), picture.height()];
                Ok((caption.as_str(), size, encode(&picture.png()?)))
            });
            let plots = case.plots.iter();
            Ok(CaseView {
                case,
                seconds: format!("{:.1}", case.seconds),
                plots: plots.map(|p| (p.title.as_str(), graph_figure(p, Place::InPage))).collect(),
                pictures: pictures.collect::<Result<_, ReportError>>()?,
            })
        });
        let cases: Result<Vec<CaseView<'_>>, ReportError> = cases.collect();
        let view = View {
            page: self,
            styles: [crate::plot::STYLE, PAGE_STYLE],
            script: PAGE_SCRIPT,
            judgement: self.judgement(),
            cases: cases?,
        };
        Ok(view.render().expect("writing to a string does not fail"))
    }

    /// The report in one sentence.
    fn judgement(&self) -> String {
        let figures: usize = self.cases.iter().map(|case| case.rows.len()).sum();
        let good = self.cases.iter().filter(|case| case.passes()).count();
        let all = self.cases.len();
        format!("{good} of {all} cases are within their limits; {figures} figures")
    }
}
