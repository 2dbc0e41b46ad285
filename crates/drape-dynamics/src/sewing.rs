//! Sewing: seams of a garment are closed by springs, and then their particles share degrees of
//! freedom.
//!
//! A garment begins as flat panels. Without gravity and inertia, closing springs
//! (`world/closing_springs.rs`) draw the two sides of every seam together until the gaps are below
//! a tenth of a millimetre. If a narrow gap remains, the springs are stiffened. Until then the two
//! sides are two cloths in contact, which keep a smaller distance from each other the narrower the
//! prescribed gap is. Then the particles of each seam pair are merged, and the particles of the
//! longer side of a gather are tied to points between two other particles. From then on a map `$S$`
//! (`node_map.rs`) takes the positions `$y$` of the independent particles to the positions `$x = S
//! y$` of all particles, and the solver works on the reduced system (`reduction.rs`,
//! `reduced_system.rs`) with
//!
//! ```math
//! f_y = S^T f(S y), \qquad K_y = S^T K S, \qquad M_y = S^T M S \text{ (lumped)}
//! ```
//!
//! Bending across closed seams is an internal force of the world (`world/internal_forces.rs`). This
//! chapter reads the world and evaluates it, but changes it only through methods of
//! [`World`](crate::world::World).

pub(crate) mod node_map;
pub(crate) mod reduced_system;
pub(crate) mod reduction;
pub(crate) mod untangling;
