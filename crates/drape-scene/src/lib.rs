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
mod wearing;

// From specs to values
mod check;
mod error;
mod read;
mod spec;

pub use check::body::mesh_remedy::{is_repaired, mesh_remedy, repaired_file};
pub use check::checker::MESH_LIMIT;
pub use error::{Error, Refused};
pub use figure::cloth_section::ClothPlaces;
pub use figure::ease::{Figures, GarmentGirth, GirthPair, MeasuredGarment, NoGirth};
pub use figure::landmark::{FoundBy, Landmark};
pub use needs::Needs;
pub use read::Sources;
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
pub use scene::solver::{Integrator, Method, SolverSettings};
pub use scene::{
    Environment, MeshSource, MovingBody, Output, Scene, Schedule, Source, SourcePart, Start, View,
};
pub use spacings::Spacing;
pub use spec::body::{
    BoxSpec, ColliderSpec, CylinderSpec, MeshMotion, MeshSpec, PlaneSpec, SphereSpec,
};
pub use spec::contact::{ContactSpec, InflateSpec, Pinch};
pub use spec::file_or::FileOr;
pub use spec::garment::{GarmentPanelSpec, GarmentSpec, SeamSpec, SewSpec};
pub use spec::motion::MotionSpec;
pub use spec::panel::{FoldSpec, NoiseSpec, PanelSpec, RippleSpec, StackSpec};
pub use spec::pin::{Axis, PinSpec};
pub use spec::run::{
    GradingSpec, MotionPhaseSpec, OutputSpec, RefineSpec, SettleSpec, SolverSpec, TimeSpec,
};
pub use spec::schema::scene_schema;
pub use spec::text::SaveError;
pub use spec::{AirSpec, FabricSpec, LengthUnit, SceneSpec};
pub use surfaces::StartSurfaces;
pub use tangle::{Overlap, Tangle};
pub use wearing::GarmentPlacement;
pub use wearing::solids::GarmentPlace;
