//! Distances of pairs: those of their groups, less where pairs are close at rest, where distances
//! grow, where bodies pinch and at seams that close.

use serde::{Deserialize, Serialize};

use super::parts::ContactDistances;
use super::primitives::Primitives;
use super::seam_exemptions::SeamExemptions;
use crate::surface::pair::PairKey;

/// Fraction of the minimum separation from bodies of cloth that is thinned.
pub(crate) const THINNED_FRACTION: f64 = 0.1;

/// Activation distance of the sides of an open seam over its gap: sides that lie as far from each
/// other as they are to be do not repel each other.
const OPEN_ACTIVATION: f64 = 0.5;

/// Minimum separation of the sides of an open seam over its gap.
const OPEN_SEPARATION: f64 = 0.1;

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
    /// Gap of the open seam at the vertices of each class, in m: 0 where they are one point,
    /// infinite without a seam; empty if all seams are closed.
    pub(crate) seam_gaps: Vec<f64>,
}

impl Separations {
    /// Separations of groups alone.
    pub(crate) fn new(groups: Vec<ContactDistances>) -> Separations {
        Separations {
            groups,
            close_at_rest: Vec::new(),
            pinch: Vec::new(),
            growth_fraction: 1.0,
            seam_gaps: Vec::new(),
        }
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

    /// Returns whether two primitives, given by their vertices and by the classes of these, are
    /// exempt from contact: they share a vertex, or a closed seam joins them.
    #[inline]
    pub(crate) fn exempt(
        &self,
        seams: &SeamExemptions,
        vertices: [&[u32]; 2],
        classes: [&[u32]; 2],
    ) -> bool {
        seams.join(classes[0], classes[1])
            && (self.seam_gaps.is_empty()
                || share_vertex(vertices)
                || self.seam_gap(seams, classes) == 0.0)
    }

    /// Returns the narrowest gap of the open seams that join two primitives, given by the classes of
    /// their vertices, in m; infinite if none does.
    fn seam_gap(&self, seams: &SeamExemptions, [one, other]: [&[u32]; 2]) -> f64 {
        let gaps = seams.joints(one, other).map(|class| self.seam_gaps[class as usize]);
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// Returns the largest distances that the sides of an open seam keep from each other, for two
    /// primitives given by the classes of their vertices; none if no open seam joins them.
    pub(crate) fn of_open_seam(
        &self,
        seams: &SeamExemptions,
        classes: [&[u32]; 2],
    ) -> Option<ContactDistances> {
        let gap = self.seam_gap(seams, classes);
        (gap < f64::INFINITY).then_some(ContactDistances {
            activation_distance: OPEN_ACTIVATION * gap,
            min_separation: OPEN_SEPARATION * gap,
        })
    }

    /// Returns the widest gap of an open seam whose sides do not repel each other at a distance,
    /// both in m.
    pub(crate) fn widest_seam_gap(distance: f64) -> f64 {
        distance / OPEN_ACTIVATION
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

/// Returns whether two primitives, given by their vertices, share one.
#[inline]
pub(crate) fn share_vertex([one, other]: [&[u32]; 2]) -> bool {
    one.iter().any(|vertex| other.contains(vertex))
}
