//! Evaluation of a cloth: forces, potential, stiffness and commit on all threads.
//!
//! ```text
//!   Workspace ── parallel: strips, then rims, on the threads of a pool
//!        └────── dispatch: the widest vector instructions of the machine
//!                   └───── kernel, rim: one strip or rim
//! ```
//!
//! The cloth is cut into the same strips for any number of threads. Each strip writes its part of
//! the output, and partial sums are added in the order of the strips:
//!
//! ```math
//! E = \sum_{\text{strips}} E_s + \sum_{\text{rims}} E_r
//! ```
//!
//! The numbers therefore depend neither on the threads nor on the vector instructions. `workspace`
//! holds the buffers; a solver calls it. `one_off` does the same for a single call. Threads and
//! vector instructions appear only in this chapter. A workspace allocates memory only when it is
//! made.

pub(crate) mod dispatch;
pub(crate) mod one_off;
pub(crate) mod parallel;
pub(crate) mod workspace;
