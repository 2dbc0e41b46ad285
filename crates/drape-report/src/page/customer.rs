//! Report of a laboratory to its customer.
//!
//! `report` has the report as plain data, `values` one value with its published range, `drape` a
//! fabric on a drapemeter, and `garment` the girths of a garment on its body. `chart` draws values
//! over published ranges. `html` and `csv` write the report.

mod chart;
mod csv;
mod drape;
mod garment;
mod html;
mod report;
mod values;

pub use drape::ReportedDrape;
pub use garment::{ReportedGarment, ReportedGirth};
pub use report::{CustomerPage, ReportedFabric, ReportedLoop, ReportedNote};
pub use values::ReportedValue;
