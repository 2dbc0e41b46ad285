//! Laws from KES values alone, and KES values from laws.
//!
//! B, 2HB, G, 2HG, 2HG5, EM, LT, WT and RT of a sheet replace curves that were not measured. A
//! simulated KES test of a law returns these values \[Kaw80\]:
//!
//! ```math
//! LT = \frac{WT}{\tfrac12 F_m\,EM}, \qquad RT = \frac{WT'}{WT}, \qquad
//! 2HB = F_\uparrow(\kappa_1) - F_\downarrow(\kappa_1)
//! ```
//!
//! `fabric` uses the chapter if a sheet has no curve. `fabric_values` and `compare_values` are for
//! reports. The chapter uses laws, the minimiser and `forward::friction_path`. Only `comparison`
//! uses measured curves.
//!
//! * `assumed`: defaults for values that a sheet does not have.
//! * `matched`: a law with its deviation, or with notes on what was assumed.
//! * `bending`, `traction`, `shear`: laws from values; `completion`: missing tensile values.
//! * `of_law`: the values of one law; `simulated`: the values of a fabric; `comparison`: the values
//!   of sheet, curve and law side by side.

pub(crate) mod assumed;
pub(crate) mod bending;
pub(crate) mod comparison;
pub(crate) mod completion;
pub(crate) mod matched;
pub(crate) mod of_law;
pub(crate) mod shear;
pub(crate) mod simulated;
pub(crate) mod traction;
