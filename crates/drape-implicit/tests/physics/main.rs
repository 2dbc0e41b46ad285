//! The crate against mechanics: exact solutions, conservation laws, and systems made to break it.
#![allow(clippy::unwrap_used)]

mod accuracy;
mod balance;
mod chains;
mod explicit;
mod failures;
mod methods;
mod springs;
mod step_filter;
mod steps;
mod well;
