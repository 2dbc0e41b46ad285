//! Measured curves, and the KES values that are read from them.
//!
//! A curve is one history of deformation and load per width. The branches of a curve lie between
//! reversals. The values of a loop are read where a rising and a falling branch pass an evaluation
//! point \[Kaw80\]:
//!
//! ```math
//! 2HB = F_\uparrow(\kappa_1) - F_\downarrow(\kappa_1), \qquad
//! B = \frac{\bar F(\kappa_2) - \bar F(\kappa_0)}{\kappa_2 - \kappa_0}, \qquad
//! \bar F = \tfrac12(F_\uparrow + F_\downarrow)
//! ```
//!
//! and likewise 2HG, 2HG5 and G. EM, WT, LT and RT are areas of the tensile curve. `sheets` reads
//! curves from files, and drape-fit fits laws to curves. This chapter reads no file and fits no
//! law.
//!
//! * `branch`: reversals and branches of a history.
//! * `curve`: the curve itself; `prepared`: a curve without noise and break, for a fit, with its
//!   `preparation`; `steady`: removes the noise of a path; `mean`: the mean of repeats.
//! * `loop_values`, `tensile_values`: values of one test, in SI.
//! * `evaluation`: all values of a curve, in laboratory units.

pub(crate) mod branch;
pub(crate) mod curve;
pub(crate) mod evaluation;
pub(crate) mod extent;
pub(crate) mod loop_values;
pub(crate) mod mean;
pub(crate) mod preparation;
pub(crate) mod prepared;
pub(crate) mod steady;
pub(crate) mod tensile_values;
