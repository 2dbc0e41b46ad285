//! Linear algebra: symmetric sparse matrices of 3x3 blocks, and linear systems with them.
//!
//! Each Newton step of the [nonlinear solver](crate::nonlinear) solves `$A\,p = -\varphi$` with the
//! *system matrix* `$A = M/(\beta\,\mathrm{dt})^2 + K$`, mass over the squared step plus stiffness.
//! [`SystemMatrix`](system_matrix::SystemMatrix) is the entry. It solves by conjugate gradients,
//! preconditioned with an incomplete Cholesky factor `$U^T D\,U \approx A$` \[Saad03\] and, for
//! large sheets, a [coarse level](coarse_level), or by faer's sparse Cholesky factorisation. Rows are
//! eliminated eight at a time in the order of a [level schedule](level_schedule), which gives the
//! factor of the particles' own order.
//!
//! Threads share the packing of the matrix, its products and the updates of vectors, in
//! [chunks](level_schedule::chunk) of rows that the layout fixes. The incomplete factor and its
//! triangular solves run on one, the coarse level beside them on another.
//!
//! The chapter knows matrices and vectors only: nothing of forces, steps or time.
//!
//! SIMD idiom: arrays of eight numbers with plain loops ([`lanes`]), which the compiler turns into
//! vector instructions, dispatched once for each chunk to the widest ones of the machine by
//! `pulp::Arch`. The number of lanes is fixed and no operation is fused, so every machine computes
//! the same bits. Explicit vector types (`wide`) would fix one instruction set at compile time;
//! `pulp`'s own vector types have as many lanes as the machine, so that sums would depend on it.

pub(crate) mod block;
pub(crate) mod block_matrix;
pub(crate) mod cholesky;
pub(crate) mod coarse_level;
pub(crate) mod conjugate_gradient;
pub(crate) mod incomplete_cholesky;
pub(crate) mod lane_block;
pub(crate) mod lanes;
pub(crate) mod level_schedule;
pub(crate) mod packed_matrix;
pub(crate) mod preconditioner;
pub(crate) mod sparsity;
pub(crate) mod system_matrix;
pub(crate) mod vector;
