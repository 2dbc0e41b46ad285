//! Cases: experiments that are simulated and compared with a reference.
//!
//! A case is a function without arguments: it writes a scene, simulates it at one or several
//! spacings, and returns findings against an exact solution, a closed form or a published
//! measurement. Limits are argued beside each comparison. `suite` lists the cases; they use
//! instruments, drapemeters, outlines and references, and not each other's chapters.

pub(crate) mod drapes;
pub(crate) mod dynamics;
pub(crate) mod loops;
pub(crate) mod recovery;
pub(crate) mod statics;
