#![doc = include_str!("../README.md")]

mod bonds;
mod clock;
mod collider;
mod contact;
mod course;
mod error;
mod file;
mod fitting;
mod frame;
mod garment;
#[cfg(test)]
mod guards_check;
mod inflation;
mod ledger;
mod material;
mod measures;
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
mod sewing;
mod shapes;
mod simulation;
mod snapshot;
mod stitches;
mod stopwatch;
mod summary;
mod surfaces;
mod tangle;
mod topology;
mod track;
mod weld;
#[cfg(test)]
mod weld_check;
mod world;
#[cfg(test)]
mod world_check;

pub use clock::Clock;
pub use course::Course;
pub use error::SceneError;
pub use frame::Frame;
pub use garment::Seam;
pub use material::Material;
pub use model::Model;
pub use output::{Output, Recorder, prepare_folder};
pub use panel::Panel;
pub use pin::{Pin, PinLoad};
pub use scene::Scene;
pub use scheme::Scheme;
pub use settle::Settle;
pub use sewing::Sewing;
pub use shapes::Shapes;
pub use simulation::{Progress, Simulation, Step};
pub use snapshot::{Body, Snapshot};
pub use summary::{Contacts, Energy, Solver, Status, Strain, Summary};
pub use surfaces::Surfaces;
pub use tangle::{Overlap, Tangle};
pub use topology::{Part, Topology};
pub use track::Track;
