//! Linear algebra: symmetric sparse matrices of 3x3 blocks, and linear systems with them.
//!
//! Each Newton step of the [nonlinear solver](crate::nonlinear) solves `$A\,p = -\varphi$` with the
//! *system matrix* `$A = M/(\beta\,\mathrm{dt})^2 + K$`, mass over the squared step plus stiffness.
//! [`SystemMatrix`](system_matrix::SystemMatrix) is the entry point. One solver is conjugate
//! gradients, preconditioned with an incomplete Cholesky factor `$U^T D\,U \approx A$` \[Saad03\]
//! and, for large sheets, a [coarse level](coarse_level). The other solver is faer's sparse
//! Cholesky factorisation. Rows are eliminated eight at a time in the order of a [level
//! schedule](level_schedule). The resulting factor equals the factor in the order of the particles'
//! numbers.
//!
//! Threads share the packing of the matrix, matrix-vector products and vector updates, in
//! [chunks](level_schedule::chunk) of rows that the layout fixes. The incomplete factorisation and
//! the triangular solves of the [parts](level_schedule::part) run side by side, and the coarse
//! level runs beside them.
//!
//! The chapter deals only with matrices and vectors: it uses no forces, steps or times.
//!
//! SIMD idiom: arrays of eight numbers with plain loops ([`lanes`]), which the compiler turns into
//! vector instructions. `pulp::Arch` dispatches each chunk to the widest instructions of the
//! machine. The number of lanes is fixed and no operation is fused, so every machine computes the
//! same bits. Explicit vector types (`wide`) would fix one instruction set at compile time. The
//! vector types of `pulp` have the machine's number of lanes, so sums would depend on the machine.

pub(crate) mod block;
pub(crate) mod block_matrix;
#[cfg_attr(not(feature = "cholesky"), path = "linear/cholesky/stand_in.rs")]
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
