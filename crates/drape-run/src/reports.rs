//! Pages of fits, fabrics, instruments and runs: results as the crate `drape-report` shows them.
//!
//! Each module fills in a type of [`report`](drape_report) or [`export`](drape_export), which draws
//! it. The numbers are not computed again here. `quantity` has the name, the symbol and the units
//! of every parameter, `kes_value` has the name and the units of every KES value. Nothing here
//! writes a file.

mod compared;
mod customer;
mod drape_result;
mod fabric;
mod fit;
mod instruments;
mod interval;
mod kes_value;
mod loop_plot;
mod quantity;
mod sheet_value;
mod value_law;
mod version;
mod viewer;

pub use compared::{ComparedFabric, compare_page};
pub use customer::{CustomerSubject, customer_page};
pub use drape_result::{DrapeEvaluation, DrapeResult, DrapeStart, laws_digest};
pub use fabric::show_page;
pub use fit::fit_page;
pub use instruments::{TESTS, TestedLoop, instruments_page};
pub use quantity::DIRECTIONS;
pub use sheet_value::{CheckedValue, sheet_values};
pub use version::VERSION;
pub use viewer::{VIEWER_SIZE_MAX, ViewerPage};
