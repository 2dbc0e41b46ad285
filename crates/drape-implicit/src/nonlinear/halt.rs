//! Reasons why an attempt at a sub-step ends without a solution.

use crate::error::{Error, Quantity};
use crate::report::Stop;

/// Reason why an attempt at a sub-step ends without a solution.
#[derive(Clone, Debug)]
pub(crate) enum Halt {
    /// The iteration stopped; a shorter step may help.
    Stop(Stop),
    /// A quantity is not finite; a shorter step may help.
    NotFinite {
        quantity: Quantity,
        /// First particle concerned.
        particle: usize,
    },
    /// No shorter step helps.
    Fatal(Error),
}
