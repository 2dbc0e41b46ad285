//! The scalar reference: every connector of a cloth one by one through the scalar laws.
//!
//! ```math
//! E = \sum_c W_c \int T_c\,\mathrm{d}s_c,\qquad f = -\frac{\partial E}{\partial x},\qquad
//! K = \frac{\partial^2 E}{\partial x\,\partial x}
//! ```
//!
//! written as in a textbook: a list of connectors, a loop over it, no batches. The reference shares
//! with the kernels which particles a connector joins (`layout::connectors`), the weights of the
//! fits at a rim (`rim::fits`) and the turning angle (`measure`), and nothing else.
//! `tests/connectors/reference.rs` and `consistency.rs` compare the kernels with it over many
//! steps: forces, potential, stiffness and dissipation. `benches/cloth.rs` measures what the
//! kernels save.
//!
//! `connector` holds segments, corners and triples, `triangle` and `stencil` the connectors of a
//! rim, `cloth` all of them. Only tests and benches call the reference.

pub(crate) mod cloth;
pub(crate) mod connector;
pub(crate) mod stencil;
pub(crate) mod triangle;
