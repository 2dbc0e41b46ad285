#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

// Numbers and errors.
mod error;
mod vector;

// Division of loops among threads.
mod threads;

// Bodies, and the files of their meshes.
mod body;
mod mesh_io;
mod mesh_repair;
pub mod section;

// Contact: the barrier, of particles with bodies, and of surfaces with each other and with bodies.
mod barrier;
mod particle;
mod surface;

// Distance and time of impact of meshes that a caller moves.
mod proximity;

pub use body::{Body, Mesh, NearestSurface, Pose, Shape, SignedDistance};
pub use error::Error;
pub use mesh_io::{
    MESH_BYTES_MAX, PointCache, Triangulation, parse_mesh, read_mesh, read_mesh_within,
};
pub use mesh_repair::{
    EdgeLengths, FaultPlaces, Hole, MeshInspection, RepairNote, RepairSettings, RepairedMesh,
    repair,
};
pub use particle::{NearestParticle, ParticleContact, ParticleSettings, ParticleSummary};
pub use proximity::{
    Impact, MeshDistance, MeshMotion, Primitive, PrimitivePair, ProximityMesh, earliest_impact,
    earliest_self_impact, mesh_distance,
};
pub use surface::{
    CandidatePairs, CcdFilter, ContactDistances, Detector, FractionLimit, FrictionEnergy, Gap,
    GaussNewton, Gradient, Hessian, Intersection, OpenStep, Pair, PairDistance, PairKind,
    PinchPolicy, PinchedVertices, PlainMesh, SavedContact, SeamIntersections, SewnPlacement,
    StepFraction, Surface, SurfaceContact, SurfaceEnergy, SurfaceInspection, SurfaceMemory,
    SurfacePairs, SurfaceParts, SurfaceSettings, SurfaceSetup, SurfaceStart, SurfaceState,
    SurfaceSummary, SurfaceTrial, Sweep, Truncation, equivalence_classes, intersections,
    segment_meets_triangle,
};
