//! One law from one kind of test: tensile, bending, shear, loop bending.
//!
//! All fits have the same stages: features of the curve, initial guesses by linear least squares on
//! a grid of the nonlinear parameters, candidate laws with a forward model each, and the
//! regression. The laws are
//!
//! ```math
//! F(q) = F_0 + k\,q + F_r(q) \quad\text{(bending, shear)}, \qquad
//! F(\varepsilon) = F_0 + F_e(\varepsilon - \varepsilon_0) + F_r \quad\text{(tension)}
//! ```
//!
//! with friction `$F_r$` and the unknown zeros `$F_0$`, `$\varepsilon_0$` of the instrument
//! \[NB04, eqs. 3–5\]. The chapter turns curves of drape-kes into laws of drape-fabric; it knows no
//! KES values and no sheet.
//!
//! * `features`: features of a curve before any fit.
//! * `loop_form`, `loop_start`, `loop_fit`, `piecewise`: the models of bending and shear loops, and
//!   their fits.
//! * `bending`, `shear`, `loop_bending`: laws from these fits.
//! * `value_estimate`: KES values of a fitted law with their intervals; `remark`: remarks on a fit.
//! * `tensile_form`, `tensile_start`, `prediction`, `tensile`: the tensile fit.

pub(crate) mod bending;
pub(crate) mod features;
pub(crate) mod loop_bending;
pub(crate) mod loop_fit;
pub(crate) mod loop_form;
pub(crate) mod loop_start;
pub(crate) mod piecewise;
pub(crate) mod prediction;
pub(crate) mod remark;
pub(crate) mod shear;
pub(crate) mod tensile;
pub(crate) mod tensile_form;
pub(crate) mod tensile_start;
pub(crate) mod value_estimate;
