//! Arguments of `drape report`.

use std::path::PathBuf;

use clap::Args;
use drape::kes::TestRecord;

use super::tested::TestedFabric;
use crate::commands::test::drapes::DrapeArguments;
use crate::failure::Failure;

#[derive(Args)]
pub(crate) struct ReportArguments {
    /// Fabrics: sheets or their folders, which are fitted; workbooks and other tables, of which a
    /// sheet is drafted; or fabric.toml, of which there are only laws. Two or more stand side by
    /// side.
    #[arg(required = true, value_name = "FABRIC")]
    pub(crate) fabrics: Vec<PathBuf>,
    /// The page to write, or - for stdout.
    #[arg(short, long, value_name = "REPORT.html", default_value = "report.html")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) record: RecordArguments,
    /// The fabric to take of tables that hold several [default: all of them].
    #[arg(long, value_name = "NAME")]
    pub(crate) fabric: Option<String>,
    /// Writes all numbers of the page as CSV too, with the points of the loops.
    #[arg(long, value_name = "FILE.csv")]
    pub(crate) csv: Option<PathBuf>,
    /// Folder, or file, with drapes that drape test --drape --report FOLDER has written; may be
    /// given several times. With --drape the folder into which those that are missing are written.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) drapes: Vec<PathBuf>,
    /// Folder of a run of a garment: girth and ease at bust, waist and hip are reported; may be
    /// given several times.
    #[arg(long = "garment", value_name = "RUN")]
    pub(crate) garments: Vec<PathBuf>,
    /// Drapes the fabrics of which no drape is at hand; minutes to hours, the expected time is said
    /// first.
    #[arg(long)]
    pub(crate) drape: bool,
    #[command(flatten)]
    pub(crate) meter: DrapeArguments,
    /// Spacing of the particles on the drapemeter [default: what the fabric requires, at most 5].
    #[arg(long, value_name = "MM", requires = "drape")]
    pub(crate) spacing: Option<f64>,
    /// Prints the numbers of the page as JSON, in SI.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Lines of the head that replace lines of the sheets.
#[derive(Args)]
pub(crate) struct RecordArguments {
    /// Customer, in place of the sheet's; what is not known stays blank.
    #[arg(long, value_name = "TEXT")]
    customer: Option<String>,
    /// Article, in place of the sheet's; once for each fabric, in their order.
    #[arg(long, value_name = "TEXT")]
    article: Vec<String>,
    /// Laboratory, in place of the sheet's.
    #[arg(long, value_name = "TEXT")]
    laboratory: Option<String>,
    /// Date of the tests, as 2026-03-14, 2026-03 or 2026, in place of the sheet's; once, or once
    /// for each fabric.
    #[arg(long, value_name = "DATE")]
    date: Vec<String>,
    /// Specimens, a number or a text, in place of the sheet's; once, or once for each fabric.
    #[arg(long, value_name = "TEXT")]
    specimens: Vec<String>,
}

impl RecordArguments {
    /// Returns the records of `fabrics`. Options of the command line replace lines of a sheet.
    pub(super) fn records(&self, fabrics: &[TestedFabric]) -> Result<Vec<TestRecord>, Failure> {
        let count = fabrics.len();
        let several = [
            ("article", &self.article, count),
            ("date", &self.date, 1),
            ("specimens", &self.specimens, 1),
        ];
        for (option, texts, count_alone) in several {
            if !(texts.is_empty() || texts.len() == count || texts.len() == count_alone) {
                let once = if count_alone == 1 { "once, or " } else { "" };
                return Err(Failure::Usage(format!(
                    "--{option} is given {} times for {count} fabrics; give it {once}once for each, in their order",
                    texts.len()
                )));
            }
        }

        let records = fabrics.iter().enumerate().map(|(index, tested)| {
            let mut record = tested.record();
            // A text that is given once holds for all fabrics.
            let [article, date, specimens] = [&self.article, &self.date, &self.specimens]
                .map(|texts| texts.get(index).or(texts.first()));
            let lines = [
                ("customer", self.customer.as_ref()),
                ("article", article),
                ("laboratory", self.laboratory.as_ref()),
                ("date", date),
                ("specimens", specimens),
            ];
            for (key, text) in lines {
                let Some(text) = text else { continue };
                record.set(key, text).map_err(|mistake| Failure::Usage(format!("--{mistake}")))?;
            }
            Ok(record)
        });
        records.collect()
    }
}
