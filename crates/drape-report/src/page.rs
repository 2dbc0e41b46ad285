//! Pages: the reports of a fit, of a comparison, to a customer, of a validation and of a study.
//!
//! A report is plain data in SI: [`FitPage`] with a [`LawReport`] for each law, [`ComparePage`],
//! [`CustomerPage`], [`ValidationPage`], [`StudyPage`]. A report checks its numbers and texts, and
//! becomes one self-contained HTML page or a text for the terminal. Serialised, the data is the
//! report for programs. `shown` rounds quantities and writes them in both units, `assets` holds the
//! style and the script, and the templates are in `templates/page`. The chapter takes figures from
//! `plot`.

mod assets;
mod compare_page;
mod compared_value;
mod customer;
mod fit_html;
mod fit_page;
mod fit_text;
mod law_report;
mod law_value;
mod shown;
mod study_page;
mod validation_page;

pub use compare_page::{ComparePage, FabricName};
pub use compared_value::{Compared, ComparedNumber, ComparedValue, Difference};
pub use customer::{
    CustomerPage, ReportedDrape, ReportedFabric, ReportedGarment, ReportedGirth, ReportedLoop,
    ReportedNote, ReportedValue,
};
pub use fit_page::{FitPage, KesValue, Quantity};
pub use law_report::{Evidence, LawReport, Limits, ModelScore, Statistics, Trust, Verdict};
pub use law_value::LawValue;
pub use study_page::{EffectTable, MeasureEffects, StudyPage};
pub use validation_page::{CaptionedPicture, ValidationCase, ValidationPage, ValidationRow};
