//! The friction elements of a law, prepared for a batch.

use drape_hysteresis::{BlimanSorine, PreparedDahl};

/// Prepared elements of a [`BlimanSorine`] friction. An element without a plateau is absent and
/// costs nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PreparedFriction(pub(crate) [Option<PreparedDahl>; 2]);

impl PreparedFriction {
    /// Prepares the elements of `friction`.
    #[must_use]
    pub fn new(friction: &BlimanSorine) -> Self {
        Self(
            friction
                .elements
                .map(|element| (element.plateau != 0.0).then(|| PreparedDahl::new(element))),
        )
    }
}
