//! Report of a laboratory to its customer.
//!
//! `report` has it as plain data, `values` a value with what others have of it, `drape` a fabric on a
//! drapemeter, `garment` girths of a garment on its body; `chart` draws values over the ranges that were published; `html` and `csv` write it all.

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
