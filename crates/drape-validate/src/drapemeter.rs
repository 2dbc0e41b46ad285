//! Drapemeters: a disc of fabric hangs over a smaller disc, and its shadow is measured.
//!
//! `protocol` describes how a specimen is lowered. `meter` simulates the test and reads the shadow.
//! `study` has the results over several starts. `prediction` varies the parameters that a KES sheet
//! leaves open. `sensitivity` varies one parameter after another. Tests of fabrics and the
//! cases of drapes call this chapter.
//!
//! The drape coefficient is the area of the shadow beyond the disc over the area of the flat
//! specimen beyond the disc, `$D = (A - \pi r^2)/(\pi R^2 - \pi r^2)$` \[Cus68\].

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
