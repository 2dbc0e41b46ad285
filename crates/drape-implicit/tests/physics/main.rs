//! The crate against mechanics: exact solutions, conservation laws, and systems made to break it.

mod accuracy;
mod chains;
mod failures;
mod methods;
mod springs;
mod steps;
mod well;
