//! Scenes in motion: energies, lengths of steps, rest, and explicit steps as a cross-check.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "studies print their figures")]

mod adaptive;
mod bodies;
mod energy;
mod explicit;
mod folds;
mod rest;
mod robust;
mod shapes;
mod sheet;
mod surfaces;
