//! Values and curves that cannot be right.
//!
//! * `plausible`: values; `suspect`: curves, which are repaired where the repair is safe;
//!   `equal_load`: the load of the tensile test, at which values are compared.

pub(crate) mod equal_load;
pub(crate) mod plausible;
pub(crate) mod suspect;
