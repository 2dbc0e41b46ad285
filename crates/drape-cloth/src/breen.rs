//! Interacting particles of Breen, House & Wozny: an alternative cloth model with the particles of
//! a [`Cloth`](crate::Cloth), without friction and without memory.
//!
//! ```math
//! U = \sum_{\text{yarns}} U_{stretch} + \sum_{\text{near pairs}} U_{repel}
//!   + \sum_{\text{triples}} U_{bend} + \sum_{\text{particles}} U_{trellis}
//! ```
//!
//! \[BHW94, eq. 3.1\]. `particles` is the cloth, `well` the energy of two particles, `hinge` the
//! energy of an angle. `close_pairs` finds particles that are near each other in space. The
//! simulation evaluates this model in place of a `Workspace`. The model is scalar, because its
//! cloths are small, and the pairs change as the cloth moves.

pub(crate) mod close_pairs;
pub(crate) mod hinge;
pub(crate) mod particles;
pub(crate) mod well;
