//! Distances of pairs: those of their groups, less where pairs are close at rest, where distances
//! grow and where bodies pinch.

use serde::{Deserialize, Serialize};

use super::parts::ContactDistances;
use super::primitives::Primitives;
use crate::surface::pair::PairKey;

/// Fraction of the minimum separation from bodies of cloth that is thinned.
pub(crate) const THINNED_FRACTION: f64 = 0.1;

/// Contact of a vertex of cloth with bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) enum PinchState {
    /// Usual contact.
    #[default]
    Free,
    /// Contact with a fraction of the minimum separation.
    Thinned,
    /// No contact with the body of this group.
    Released(u32),
}

/// Distances of two primitives of a group that lie close at rest.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RestProximity {
    /// Kind and features of the pair.
    pub(crate) key: PairKey,
    pub(crate) distances: ContactDistances,
}

/// Distances of all pairs of a surface.
#[derive(Debug, Clone)]
pub(crate) struct Separations {
    /// Half distances of each group.
    pub(crate) groups: Vec<ContactDistances>,
    /// Pairs that lie close at rest, sorted by key.
    pub(crate) close_at_rest: Vec<RestProximity>,
    /// State of each free vertex; empty if all are free of pinches.
    pub(crate) pinch: Vec<PinchState>,
    /// Fraction of all distances that is kept, 0 to 1.
    pub(crate) growth_fraction: f64,
}

impl Separations {
    /// Separations of groups alone.
    pub(crate) fn new(groups: Vec<ContactDistances>) -> Separations {
        Separations { groups, close_at_rest: Vec::new(), pinch: Vec::new(), growth_fraction: 1.0 }
    }

    /// Distances of a pair of groups, whatever its distance at rest.
    pub(crate) fn of_groups(&self, groups: [u32; 2]) -> ContactDistances {
        let [a, b] = groups.map(|group| self.groups[group as usize]);
        let (activation_distance, min_separation) =
            (a.activation_distance + b.activation_distance, a.min_separation + b.min_separation);
        ContactDistances {
            activation_distance: self.growth_fraction * activation_distance,
            min_separation: self.growth_fraction * min_separation,
        }
    }

    /// Distances of a pair that lies close at rest; none if it does not.
    pub(crate) fn of_close_pair(&self, key: &PairKey) -> Option<ContactDistances> {
        let place = self.close_at_rest.binary_search_by(|close| close.key.cmp(key)).ok()?;
        let ContactDistances { activation_distance, min_separation } =
            self.close_at_rest[place].distances;
        Some(ContactDistances {
            activation_distance: self.growth_fraction * activation_distance,
            min_separation: self.growth_fraction * min_separation,
        })
    }

    /// Fraction of its minimum separation that a pair keeps; none if it is released.
    pub(crate) fn pinch_fraction(&self, primitives: &Primitives, vertices: &[u32]) -> Option<f64> {
        let free = |vertex: u32| (vertex as usize) < primitives.free;
        let body = vertices.iter().copied().find(|&vertex| !free(vertex));
        let (false, Some(body)) = (self.pinch.is_empty(), body) else { return Some(1.0) };
        let group = primitives.group(body);
        let mut fraction = 1.0;
        for &vertex in vertices.iter().filter(|&&vertex| free(vertex)) {
            match self.pinch[vertex as usize] {
                PinchState::Thinned => fraction = THINNED_FRACTION,
                PinchState::Released(other) if other == group => return None,
                PinchState::Free | PinchState::Released(_) => {}
            }
        }
        Some(fraction)
    }
}
