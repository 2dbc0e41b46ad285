#![doc = include_str!("../README.md")]

mod error;
mod file;
mod frame;
mod material;
mod output;
mod placement;
mod scene;
mod simulation;
mod summary;
mod world;

pub use error::SceneError;
pub use frame::Frame;
pub use material::Material;
pub use output::{Output, prepare_folder};
pub use scene::{Clock, Panel, Scene};
pub use simulation::{Progress, Simulation, Step};
pub use summary::{Contacts, Energy, Solver, Status, Strain, Summary};
