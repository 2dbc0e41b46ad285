//! The friction elements of a law, prepared for a batch.

use drape_hysteresis::{BlimanSorine, Dahl, PreparedDahl};

/// Elements of a [`BlimanSorine`] friction, prepared; those that are absent cost nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PreparedFriction(pub(crate) [Option<PreparedDahl>; 2]);

impl PreparedFriction {
    /// Prepares a friction.
    #[must_use]
    pub fn new(friction: &BlimanSorine) -> Self {
        let prepare = |element: Dahl| (element.plateau != 0.0).then(|| PreparedDahl::new(element));
        Self(friction.elements.map(prepare))
    }
}
