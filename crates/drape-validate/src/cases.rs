//! Cases: experiments that are simulated and compared with a reference.
//!
//! A case is a function. It writes a scene, simulates the scene at one or several spacings, and
//! compares the result with an exact solution, a closed form or a published measurement. Limits are
//! argued beside each comparison. `suite` lists the cases. Cases use instruments, drapemeters,
//! outlines and references. No case uses the chapter of another case.

pub(crate) mod drapes;
pub(crate) mod dynamics;
pub(crate) mod loops;
pub(crate) mod recovery;
pub(crate) mod statics;

/// Returns the name of `figure` of `subject`, such as a fabric, for a check.
fn figure_name(subject: &str, figure: &str) -> String {
    format!("{subject}: {figure}")
}
