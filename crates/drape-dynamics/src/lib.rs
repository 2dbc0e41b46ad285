#![doc = include_str!("../README.md")]

mod attachments;
mod bonds;
mod error;
mod frame;
mod girth;
#[cfg(test)]
mod guards_check;
mod ledger;
mod measures;
mod output;
mod pace;
mod pin_load;
mod scheme;
mod simulation;
mod snapshot;
mod stitches;
mod stopwatch;
mod stretch;
mod summary;
mod surfaces;
mod topology;
mod weld;
#[cfg(test)]
mod weld_check;
mod world;
#[cfg(test)]
mod world_check;
mod worn;

pub use error::Error;
pub use frame::Frame;
pub use output::{Output, Recorder, prepare_folder};
pub use pin_load::PinLoad;
pub use scheme::Scheme;
pub use simulation::{Progress, Simulation, Step};
pub use snapshot::{Body, Snapshot};
pub use summary::{Contacts, Energy, Phase, PhaseName, Solver, Status, Strain, Summary};
pub use topology::{Part, Topology};
