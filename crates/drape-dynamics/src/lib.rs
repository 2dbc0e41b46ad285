#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

// Physics
mod sewing;
mod world;

// Time
mod simulation;
mod stepping;

// Results
mod error;
mod measure;
mod record;

pub use error::Error;
pub use record::snapshot::{Body, ShownFabric, Snapshot};
pub use record::step_hashes::StepHashes;
pub use record::summary::{
    Contacts, GridRecord, Phase, PhaseName, Solver, Status, Strain, Summary,
};
pub use simulation::body_prescription::BodyTarget;
pub use simulation::pin_prescription::PinTarget;
pub use simulation::plan::PlannedPhase;
pub use simulation::prescription::Displacement;
pub use simulation::run::Progress;
pub use simulation::saved::SavedSimulation;
pub use simulation::{Simulation, Step};
pub use stepping::{ReferenceScheme, Scheme};
pub use world::{Energy, PinLoad};
