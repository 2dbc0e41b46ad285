//! Sewing: seams of a garment are closed by springs, and then their particles share degrees of
//! freedom.
//!
//! A garment begins as flat panels. Without gravity and inertia, closing springs
//! (`world/closing_springs.rs`) draw the two sides of every seam together until the gaps are below a
//! tenth of a millimetre; where they stay open by little, the springs are stiffened. Until then the two
//! sides are two cloths in contact, which keep the less from each other the narrower the gap is that
//! the springs draw them to. Then the particles of each seam pair are merged, and those of the longer
//! side of a gather are tied to places between two others. From there on a map `$S$`
//! (`node_map.rs`) takes the positions `$y$` of the independent particles to `$x = S y$` of all
//! particles, and the solver works on the reduced system (`reduction.rs`, `reduced_system.rs`) with
//!
//! ```math
//! f_y = S^T f(S y), \qquad K_y = S^T K S, \qquad M_y = S^T M S \text{ (lumped)}
//! ```
//!
//! Bending across closed seams is an internal force of the world (`world/internal_forces.rs`). This
//! chapter reads the world and evaluates it, but changes it through
//! [`World`](crate::world::World)'s own methods alone.

pub(crate) mod node_map;
pub(crate) mod reduced_system;
pub(crate) mod reduction;
pub(crate) mod untangling;
