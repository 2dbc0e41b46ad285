//! Contact of triangle surfaces with each other and with bodies. The surfaces never intersect.
//!
//! A pair is a vertex with a triangle, or two edges. If its distance `$d$` is below the activation
//! distance, the pair has the energy `$k A\, m\, b(d - \xi)$` of a barrier that is infinite at the
//! minimum separation `$\xi$` \[Li20, Li21\], and friction. A step filter limits each step of the
//! solver such that `$d > \xi$` throughout, and an exact test confirms it.
//!
//! In their order in a step:
//! - [`geometry`]: the surface at rest, with edges, areas and exempt pairs,
//! - [`broad_phase`]: candidate pairs, by a tree of boxes over positions or trajectories,
//! - [`distance`], [`barrier`], [`friction`]: energies, forces and stiffness of a pair,
//! - [`step_filter`]: continuous collision detection (CCD) of a step,
//! - [`exact`]: intersections by exact predicates,
//! - [`contact`]: the object that a solver holds, which uses all of them.
//!
//! Bodies come from [`body`](crate::body) as triangles. The chapter [`particle`](crate::particle)
//! is not used.

mod barrier;
mod broad_phase;
mod contact;
mod contact_surface;
mod detector;
mod distance;
mod exact;
mod friction;
mod geometry;
mod pair;
mod placement;
mod step_filter;
mod tracked_pairs;

pub use barrier::{Gap, GaussNewton, Gradient, Hessian};
pub use broad_phase::{CandidatePairs, Sweep};
pub use contact::{
    OpenStep, PairDistance, PinchPolicy, PinchedVertices, SavedContact, SeamIntersections,
    SewnPlacement, SurfaceContact, SurfaceEnergy, SurfaceInspection, SurfaceMemory, SurfacePairs,
    SurfaceSettings, SurfaceSetup, SurfaceStart, SurfaceState, SurfaceSummary,
};
pub use contact_surface::Surface;
pub use detector::Detector;
pub(crate) use distance::{ClosestPoints, height};
pub use exact::segment_meets_triangle;
pub use exact::{Intersection, intersections};
pub use friction::FrictionEnergy;
pub(crate) use geometry::classes;
pub use geometry::{ContactDistances, PlainMesh, SurfaceParts, equivalence_classes};
pub(crate) use pair::closest;
pub use pair::{Pair, PairKind};
pub use step_filter::{CcdFilter, FractionLimit, StepFraction, SurfaceTrial, Truncation};
