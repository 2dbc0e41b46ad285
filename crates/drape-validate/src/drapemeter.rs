//! Drapemeters: a disc of fabric on a smaller disc, let down, and its shadow.
//!
//! `protocol` says how a specimen is let down; `meter` simulates that and reads the shadow; `study`
//! is the result over several starts. `prediction` varies what a KES sheet leaves open,
//! `sensitivity` one parameter after another. `drape test --drape` and the cases of drapes call
//! this chapter.
//!
//! The drape coefficient is the area of the shadow beyond the disc over that of the flat specimen
//! beyond it, `$D = (A - \pi r^2)/(\pi R^2 - \pi r^2)$` \[Cus68\].

mod meter;
mod prediction;
mod protocol;
mod sensitivity;
mod study;

pub use meter::{Drapemeter, spacing_bound};
pub use prediction::{Prediction, UnmeasuredParameter};
pub use protocol::{Protocol, Shake};
pub use sensitivity::{FACTORS, Factor};
pub use study::{Drape, Sampling, Study};
