//! Contact of surfaces: the object that a solver holds.
//!
//! In a step of time the solver calls, on a [`SurfaceContact`]:
//!
//! 1. `set_seam_gaps` while seams are open, and `grow_distances` if surfaces started nearer than
//!    their distances,
//! 2. `begin`: bodies get their positions at the end of the step, friction its normal forces,
//! 3. `set_obstacle_time`, `add_forces`, `potential`, `add_stiffness` at trial positions, and
//!    `limit_step` before the solver takes a trial step,
//! 4. `intersections`, and `commit` if there are none, or `restore` if the step is rejected.
//!
//! This chapter uses all other chapters of [`surface`](super), and owns their buffers. After the
//! first steps it allocates no memory.

mod active_pairs;
mod growth;
mod obstacles;
mod open_seams;
mod pinch;
mod placing;
mod saved;
mod seam_intersections;
mod settings;
mod summary;
mod surface_contact;
#[cfg(test)]
mod thrown_sheet_tests;

pub use pinch::PinchedVertices;
pub use placing::SewnPlacement;
pub use saved::{SavedContact, SurfaceMemory};
pub use seam_intersections::SeamIntersections;
pub use settings::{PinchPolicy, SurfaceSettings};
pub use summary::{PairDistance, SurfaceSummary};
pub use surface_contact::SurfaceContact;
