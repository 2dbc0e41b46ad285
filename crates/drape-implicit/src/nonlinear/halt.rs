//! Reasons why an attempt at a sub-step ends without a solution.

use crate::error::{Error, Quantity};
use crate::report::Stop;

/// Reason why an attempt at a sub-step ends without a solution.
#[derive(Clone, Debug)]
pub(crate) enum Halt {
    /// The iteration stopped. A shorter step may succeed.
    Stop(Stop),
    /// A quantity is not finite. A shorter step may succeed.
    NotFinite {
        quantity: Quantity,
        /// First particle with such a quantity.
        particle: usize,
    },
    /// An error that no shorter step avoids.
    Fatal(Error),
}
