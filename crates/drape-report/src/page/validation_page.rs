//! Page of a validation: measured figures with their references, plots and pictures.

use askama::Template;
use drape_render::Picture;

use super::assets::{PAGE_SCRIPT, PAGE_STYLE};
use crate::check;
use crate::error::Error;
use crate::plot::{GraphPlot, Placement, STYLE, graph_figure};
use crate::text::base64::encode;

/// Page of a validation: figures, plots and pictures, case by case.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ValidationPage {
    /// Program that made the report, as in "drape 0.1.0".
    pub version: String,
    /// Cases in the order of the page.
    pub cases: Vec<ValidationCase>,
    /// Notes on the limits of the cases.
    pub notes: Vec<String>,
}

/// Case of a validation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ValidationCase {
    /// Name, by which a program runs the case.
    pub name: String,
    /// Title.
    pub title: String,
    /// Run time, in s.
    pub seconds: f64,
    /// Reason why the case could not be run.
    pub failure: Option<String>,
    /// Figures, one per row.
    pub rows: Vec<ValidationRow>,
    /// Plots.
    pub plots: Vec<GraphPlot>,
    /// Pictures with their captions.
    pub pictures: Vec<CaptionedPicture>,
}

/// Picture with its caption.
#[derive(Debug, Clone, PartialEq)]
pub struct CaptionedPicture {
    /// Caption.
    pub caption: String,
    /// Picture.
    pub picture: Picture,
}

/// Measured figure with its reference, as text. Empty texts stand for missing numbers.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ValidationRow {
    /// Name of the figure.
    pub what: String,
    /// Figure of the simulation.
    pub measured: String,
    /// Reference.
    pub reference: String,
    /// Deviation from the reference.
    pub error: String,
    /// Limit.
    pub limit: String,
    /// Whether the figure is within its limit. `None` if it has no limit.
    pub passes: Option<bool>,
}

impl ValidationRow {
    /// Returns the texts `measured`, `reference`, `error` and `limit`.
    #[must_use]
    pub fn cells(&self) -> [&str; 4] {
        [&self.measured, &self.reference, &self.error, &self.limit]
    }
}

impl ValidationCase {
    /// Returns whether the case was run and no figure is beyond its limit.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.failure.is_none() && self.rows.iter().all(|row| row.passes != Some(false))
    }

    /// Refuses numbers that are not finite and texts that cannot be shown, as [`Error`].
    fn check(&self) -> Result<(), Error> {
        check::number(|| format!("the time of {}", self.name), self.seconds)?;
        let captions = self.pictures.iter().map(|picture| picture.caption.as_str());
        let rows = self.rows.iter();
        let cells = rows.flat_map(|row| std::iter::once(row.what.as_str()).chain(row.cells()));
        let head = [&self.name, &self.title].into_iter().chain(&self.failure);
        for text in head.map(String::as_str).chain(captions).chain(cells) {
            check::text("a text of a case", text)?;
        }
        self.plots.iter().try_for_each(GraphPlot::check)
    }
}

/// What the HTML template shows.
#[derive(Template)]
#[template(path = "page/validation.html")]
struct View<'a> {
    page: &'a ValidationPage,
    styles: [&'static str; 2],
    script: &'static str,
    judgement: String,
    cases: Vec<CaseView<'a>>,
}

/// Section of a case.
struct CaseView<'a> {
    case: &'a ValidationCase,
    seconds: String,
    plots: Vec<(&'a str, String)>,
    pictures: Vec<PictureView<'a>>,
}

/// Picture in the page.
struct PictureView<'a> {
    caption: &'a str,
    width: u32,
    height: u32,
    /// PNG file in base64.
    data: String,
}

impl ValidationPage {
    /// Returns the report as one self-contained HTML page: no network, no fonts, no other file.
    ///
    /// # Errors
    /// A report without cases, numbers that are not finite, texts that cannot be shown.
    pub fn to_html(&self) -> Result<String, Error> {
        if self.cases.is_empty() {
            return Err(Error::EmptyReport { name: "the validation".to_owned() });
        }
        for text in std::iter::once(&self.version).chain(&self.notes) {
            check::text("a text of the report", text)?;
        }

        self.cases.iter().try_for_each(ValidationCase::check)?;
        let cases = self.cases.iter().map(|case| {
            let pictures = case.pictures.iter().map(|CaptionedPicture { caption, picture }| {
                let (width, height) = (picture.width(), picture.height());
                let data = encode(&picture.png().map_err(Error::Picture)?);
                Ok(PictureView { caption, width, height, data })
            });
            let plots = case.plots.iter();
            Ok(CaseView {
                case,
                seconds: format!("{:.1}", case.seconds),
                plots: plots
                    .map(|plot| (plot.title.as_str(), graph_figure(plot, Placement::InPage)))
                    .collect(),
                pictures: pictures.collect::<Result<_, Error>>()?,
            })
        });

        let cases: Result<Vec<CaseView<'_>>, Error> = cases.collect();
        let view = View {
            page: self,
            styles: [STYLE, PAGE_STYLE],
            script: PAGE_SCRIPT,
            judgement: self.judgement(),
            cases: cases?,
        };
        Ok(view.render().expect("writing to a string does not fail"))
    }

    /// Returns the judgement of all `cases` in one sentence.
    fn judgement(&self) -> String {
        let figures: usize = self.cases.iter().map(|case| case.rows.len()).sum();
        let good = self.cases.iter().filter(|case| case.passes()).count();
        let all = self.cases.len();
        format!("{good} of {all} cases are within their limits; {figures} figures")
    }
}
