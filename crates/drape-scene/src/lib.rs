#![doc = include_str!("../README.md")]

mod bonds;
mod clock;
mod collider;
mod error;
mod file;
mod frame;
mod ledger;
mod material;
mod model;
mod output;
mod pace;
mod panel;
mod pin;
mod pin_reader;
mod placement;
mod reader;
mod scene;
mod scheme;
mod settle;
mod simulation;
mod snapshot;
mod stopwatch;
mod summary;
mod surfaces;
mod topology;
mod track;
mod world;
#[cfg(test)]
mod world_check;

pub use clock::Clock;
pub use error::SceneError;
pub use frame::Frame;
pub use material::Material;
pub use model::Model;
pub use output::{Output, Recorder, prepare_folder};
pub use panel::Panel;
pub use pin::{Pin, PinLoad};
pub use scene::Scene;
pub use scheme::Scheme;
pub use settle::Settle;
pub use simulation::{Progress, Simulation, Step};
pub use snapshot::{Body, Snapshot};
pub use summary::{Contacts, Energy, Solver, Status, Strain, Summary};
pub use surfaces::Surfaces;
pub use topology::{Part, Topology};
pub use track::Track;
