//! State of a strip along its history.

use drape_fabric::Memory;

/// Memory of a strip, with the end of the toe that follows from it.
#[derive(Clone, Copy)]
pub(crate) struct StripState {
    pub(crate) memory: Memory,
    pub(crate) toe: f64,
}

/// State after a step, with the load there.
pub(crate) struct StripStep {
    pub(crate) load: f64,
    pub(crate) state: StripState,
}
