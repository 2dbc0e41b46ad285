//! Report to a customer, as plain data, with its checks.

use serde::Serialize;

use super::drape::ReportedDrape;
use super::garment::ReportedGarment;
use super::values::ReportedValue;
use crate::check;
use crate::error::Error;
use crate::page::law_report::{LawReport, Limits};

/// Report on one fabric or several, side by side: measured values, laws and drape.
///
/// All numbers are in SI. The page shows them in the units of the laboratory. The page depends on
/// this data alone, so equal data gives equal bytes.
///
/// ```
/// use drape_report::{
///     ComparedNumber, ComparedValue, CustomerPage, ReportedFabric, ReportedValue, Units,
/// };
///
/// let measured = ComparedNumber { measured: Some(0.1056), ..ComparedNumber::default() };
/// let mass = ComparedValue {
///     symbol: "W".to_owned(),
///     name: "mass per area".to_owned(),
///     direction: String::new(),
///     units: Units::si("kg/m²").with_kes("mg/cm²", 0.01),
///     numbers: vec![measured],
///     is_comparable: true,
/// };
/// let fabric = ReportedFabric { name: "poplin".to_owned(), ..ReportedFabric::default() };
/// let page = CustomerPage {
///     fabrics: vec![fabric],
///     others: vec![ReportedValue { value: mass, ranges: vec![None], source: String::new() }],
///     ..CustomerPage::default()
/// };
/// assert!(page.to_html()?.contains("no published range"));
/// assert!(page.to_csv()?.contains("poplin,value,W,"));
/// # Ok::<(), drape_report::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct CustomerPage {
    /// Program that made the report, as in "drape 0.1.0".
    pub version: String,
    /// Fabrics in the order of the page.
    pub fabrics: Vec<ReportedFabric>,
    /// Values that laws have. Measured values stand beside the values of the laws.
    pub values: Vec<ReportedValue>,
    /// Values that no law has.
    pub others: Vec<ReportedValue>,
    /// Garments of the fabrics on bodies.
    pub garments: Vec<ReportedGarment>,
    /// Assumptions in place of measurements. Each text appears once.
    pub assumed: Vec<ReportedNote>,
    /// Other notes for the reader. Each text appears once.
    pub notes: Vec<ReportedNote>,
    /// Limits by which the fit of a law is judged.
    pub limits: Limits,
}

/// Fabric of a report.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ReportedFabric {
    /// Name of the fabric.
    pub name: String,
    /// Source of its data.
    pub source: String,
    /// Lines of the head, as title and text. An empty text is not known and stays blank.
    pub record: Vec<[String; 2]>,
    /// Data that the report of the fabric is based on, in a sentence.
    pub basis: String,
    /// Loops in the order of the page.
    pub loops: Vec<ReportedLoop>,
    /// Fabric on a drapemeter.
    pub drape: Option<ReportedDrape>,
}

/// Loops of one test and direction, with the law.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ReportedLoop {
    /// Test, as in "bending".
    pub test: String,
    /// Direction, as in "warp"; may be empty.
    pub direction: String,
    /// Law with its plots, in the units of the page.
    pub law: LawReport,
}

/// Note on some fabrics.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct ReportedNote {
    /// Text.
    pub text: String,
    /// Indices of the fabrics that the note is about, from 0.
    pub fabrics: Vec<usize>,
}

impl ReportedNote {
    /// Returns `notes` on several fabrics, given by index and text. Each text appears once, in the
    /// order of its first appearance.
    #[must_use]
    pub fn shared<'a>(notes: impl IntoIterator<Item = (usize, &'a str)>) -> Vec<ReportedNote> {
        let mut shared: Vec<ReportedNote> = Vec::new();
        for (fabric, text) in notes {
            match shared.iter_mut().find(|note| note.text == text) {
                Some(note) if note.fabrics.contains(&fabric) => {}
                Some(note) => note.fabrics.push(fabric),
                None => shared.push(ReportedNote { text: text.to_owned(), fabrics: vec![fabric] }),
            }
        }
        shared
    }
}

impl CustomerPage {
    /// Refuses a report without `fabrics`, numbers that are not finite and texts that cannot be
    /// shown.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), Error> {
        if self.fabrics.is_empty() {
            return Err(Error::EmptyReport { name: "a report to a customer".to_owned() });
        }

        check::text("a text of the report", &self.version)?;

        for ReportedFabric { name, source, record, basis, loops, drape } in &self.fabrics {
            let texts = [name, source, basis].into_iter().chain(record.as_flattened());
            for text in texts {
                check::text("a text of a fabric", text)?;
            }
            for ReportedLoop { test, direction, law } in loops {
                check::text("the name of a test", test)?;
                check::text("the direction of a test", direction)?;
                law.check()?;
            }
            drape.iter().try_for_each(ReportedDrape::check)?;
        }

        self.garments.iter().try_for_each(ReportedGarment::check)?;
        let notes = self.assumed.iter().chain(&self.notes);
        notes.map(|note| &note.text).try_for_each(|text| check::text("a note", text))?;
        self.values.iter().chain(&self.others).try_for_each(ReportedValue::check)
    }

    /// Returns the names of the `fabrics` as a title.
    pub(super) fn title(&self) -> String {
        let names: Vec<&str> = self.fabrics.iter().map(|fabric| fabric.name.as_str()).collect();
        names.join(", ")
    }

    /// Returns the titles of the lines of the head of all `fabrics`, in the order of their first
    /// appearance.
    pub(super) fn record_titles(&self) -> Vec<&str> {
        let mut titles: Vec<&str> = Vec::new();
        for [title, _] in self.fabrics.iter().flat_map(|fabric| &fabric.record) {
            if !titles.contains(&title.as_str()) {
                titles.push(title);
            }
        }
        titles
    }
}

impl ReportedFabric {
    /// Returns the line of the head with a `title`. The text is empty where it is not known.
    pub(super) fn line(&self, title: &str) -> &str {
        let line = self.record.iter().find(|[key, _]| key == title);
        line.map_or("", |[_, text]| text)
    }
}
