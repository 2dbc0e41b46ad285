//! Kernels: energy, forces and stiffness of a strip of a panel, and its commit.
//!
//! Connectors of a panel's grid and the particles that they join:
//!
//! ```text
//!   warp v ▲                                 segment  A─B, A─D         traction
//!          │    D───────C                    corner   ∠BAD … of a cell   shear (four per cell)
//!          │    │       │                    triple   P─A─B             bending
//!          │ P──A───────B
//!          └──────────────▶ weft u
//! ```
//!
//! **Stencil.** All energy except bending is a function of the edges `$e$` as vectors. Bending is a
//! function of a difference of two edges. With the edge gradient `$P_e = \partial E/\partial e$`
//! and the moment `$M_c$` over `$h^2$` at the middle `$c$` of a triple, the force on a particle
//! `$i$` is
//!
//! ```math
//! f_i = \sum_{\text{directions}} P_{i \to i+1} - P_{i-1 \to i}
//!   - \left(M_{i-1} - 2M_i + M_{i+1}\right)
//! ```
//!
//! The force therefore reads two points to each side along its yarns, and the cells around it:
//!
//! ```text
//!           o                    i  the particle
//!        o  o  o                 o  particles with which it has a block of the stiffness
//!     o  o  i  o  o
//!        o  o  o
//!           o
//! ```
//!
//! **Strip and margin.** A strip is a run of rows that fits in the cache
//! ([`Strip`](crate::layout::strip::Strip)). Its buffers hold two more rows at each side, the
//! margin. The edges and loads of the margin are computed a second time, which makes strips
//! independent: any number of threads writes the same bits. All loops run over batches of 32
//! connectors, like the batch laws of `drape_fabric`. They are inlined into `evaluate::dispatch`,
//! which selects the vector instructions.
//!
//! **Reference.** [`ReferenceCloth`](crate::ReferenceCloth) is the same cloth connector by
//! connector, through the scalar laws. `tests/connectors/reference.rs` and `consistency.rs` compare
//! the kernels with it, and `consistency.rs` compares both with finite differences.
//!
//! `buffers` measures the edges of a strip, `bending` and `crease` the triples. `forces`, `energy`
//! and `stiffness` sum up. `memories` is what a commit writes. A kernel reads `layout` and a trial,
//! and writes its part of the output. Only `energy::commit` and `energy::start` write memories.

pub(crate) mod bending;
pub(crate) mod buffers;
pub(crate) mod crease;
pub(crate) mod energy;
pub(crate) mod forces;
pub(crate) mod memories;
pub(crate) mod stiffness;
