#![doc = include_str!("../README.md")]

// Values
mod contact_stiffness;
mod figure;
mod grading;
mod needs;
mod scene;
mod spacings;
mod surfaces;
mod tangle;

// From TOML to values
mod check;
mod error;
mod file;
mod read;

pub use check::checker::MESH_LIMIT;
pub use error::{Error, Refused};
pub use figure::cloth_section::ClothPlaces;
pub use figure::ease::{Figures, GarmentGirth, GirthPair, MeasuredGarment, NoGirth};
pub use figure::landmark::{FoundBy, Landmark};
#[cfg(feature = "schema")]
pub use file::schema::scene_schema;
pub use needs::Needs;
pub use scene::clock::Clock;
pub use scene::contact::{ContactSettings, DistanceGrowth, Inflation};
pub use scene::garment::{Garment, Sewing};
pub use scene::material::{FabricReader, FabricRequest, Material, is_fabric, read_fabric};
pub use scene::model::Model;
pub use scene::motion::{BodyMotion, MotionKey, MotionResolution, RigidMotion, ShapeMotion};
pub use scene::panel::{Panel, PanelEdge};
pub use scene::pin::{HeldParticle, HoldUntil, Pin};
pub use scene::relaxation::Relaxation;
pub use scene::seam::{Seam, SeamConstraint, SeamPairs, SeamWeight};
pub use scene::solver::{Integrator, LinearSolver, Method, SolverSettings};
pub use scene::{
    Environment, MeshSource, MovingBody, Output, Scene, Schedule, Source, SourcePart, Start, View,
};
pub use spacings::{Spacing, coarser_spacings, spacings};
pub use surfaces::StartSurfaces;
pub use tangle::{Overlap, Tangle};
