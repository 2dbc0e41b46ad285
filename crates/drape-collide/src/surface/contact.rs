//! Contact of surfaces: the object that a solver holds.
//!
//! In a step of time the solver calls, on a [`SurfaceContact`]:
//!
//! 1. `set_seam_gaps`, while seams are open, and `grow_distances`, if surfaces started nearer than
//!    their distances,
//! 2. `begin`: bodies get their positions at the end of the step, friction its normal forces,
//! 3. `set_obstacle_time`, `add_forces`, `potential`, `add_stiffness` at trial positions, and
//!    `limit_step` before each of them is taken,
//! 4. `intersections`, and `commit` if there are none; `restore` if the step is rejected.
//!
//! It uses all other chapters of [`surface`](super), and owns their buffers: after the first steps
//! nothing is allocated.

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
mod thrown_sheet;

pub use pinch::PinchedVertices;
pub use placing::SewnPlacement;
pub use saved::{SavedContact, SurfaceMemory};
pub use seam_intersections::SeamIntersections;
pub use settings::{PinchPolicy, SurfaceSettings};
pub use summary::{PairDistance, SurfaceSummary};
pub use surface_contact::SurfaceContact;
