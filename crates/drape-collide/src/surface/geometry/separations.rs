//! Distances of pairs: the sums of their groups' half distances, or less where pairs are close at
//! rest, where distances grow, where bodies pinch cloth, and at seams that close.

use serde::{Deserialize, Serialize};

use super::parts::ContactDistances;
use super::primitives::Primitives;
use super::seam_exemptions::SeamExemptions;
use crate::surface::pair::PairKey;

/// Fraction of the minimum separation from bodies that thinned cloth keeps.
pub(crate) const THINNED_FRACTION: f64 = 0.1;

/// Activation distance between the sides of an open seam, over its gap. Sides at the distance of
/// the gap do not repel each other.
const OPEN_ACTIVATION: f64 = 0.5;

/// Minimum separation of the sides of an open seam, over its gap.
const OPEN_SEPARATION: f64 = 0.1;

/// Contact of a vertex of cloth with bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) enum PinchState {
    /// Contact with the whole minimum separation.
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
    /// Pinch state of each free vertex, empty if no vertex is pinched.
    pub(crate) pinch: Vec<PinchState>,
    /// Fraction of all distances that is kept, 0 to 1.
    pub(crate) growth_fraction: f64,
    /// Gap of the open seam at the vertices of each class, in m. It is 0 where they are one point
    /// and infinite without a seam. The list is empty if all seams are closed.
    pub(crate) seam_gaps: Vec<f64>,
}

impl Separations {
    /// Returns the separations of `groups`, without any smaller distances.
    pub(crate) fn new(groups: Vec<ContactDistances>) -> Separations {
        Separations {
            groups,
            close_at_rest: Vec::new(),
            pinch: Vec::new(),
            growth_fraction: 1.0,
            seam_gaps: Vec::new(),
        }
    }

    /// Returns the distances between two `groups`, whatever the distance of a pair at rest.
    pub(crate) fn between_groups(&self, groups: [u32; 2]) -> ContactDistances {
        let [a, b] = groups.map(|group| self.groups[group as usize]);
        let (activation_distance, min_separation) =
            (a.activation_distance + b.activation_distance, a.min_separation + b.min_separation);
        ContactDistances {
            activation_distance: self.growth_fraction * activation_distance,
            min_separation: self.growth_fraction * min_separation,
        }
    }

    /// Returns the distances of the pair `key` if it lies close at rest.
    pub(crate) fn close_pair_distances(&self, key: &PairKey) -> Option<ContactDistances> {
        let index = self.close_at_rest.binary_search_by(|close| close.key.cmp(key)).ok()?;
        let ContactDistances { activation_distance, min_separation } =
            self.close_at_rest[index].distances;
        Some(ContactDistances {
            activation_distance: self.growth_fraction * activation_distance,
            min_separation: self.growth_fraction * min_separation,
        })
    }

    /// Returns whether two primitives are exempt from contact: they share a vertex, or a closed
    /// seam joins them. `vertices` and `classes` hold the vertices of both and the classes of
    /// these.
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

    /// Returns the narrowest gap of the open seams that join two primitives with `classes` of
    /// vertices, in m. It is infinite if no open seam joins them.
    fn seam_gap(&self, seams: &SeamExemptions, [first, second]: [&[u32]; 2]) -> f64 {
        let gaps = seams.joints(first, second).map(|class| self.seam_gaps[class as usize]);
        gaps.fold(f64::INFINITY, f64::min)
    }

    /// Returns the largest distances that the sides of an open seam keep, for two primitives with
    /// `classes` of vertices, or `None` if no open seam joins them.
    pub(crate) fn at_open_seam(
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

    /// Returns the widest gap of an open seam whose sides, `distance` apart, do not repel each
    /// other. Both are in m.
    pub(crate) fn widest_seam_gap(distance: f64) -> f64 {
        distance / OPEN_ACTIVATION
    }

    /// Returns the fraction of its minimum separation that the pair of `vertices` keeps, or `None`
    /// if the cloth is released from the body.
    pub(crate) fn pinch_fraction(&self, primitives: &Primitives, vertices: &[u32]) -> Option<f64> {
        let first_body = vertices.iter().find(|&&vertex| vertex as usize >= primitives.free);
        let (false, Some(&body)) = (self.pinch.is_empty(), first_body) else { return Some(1.0) };
        let group = primitives.group(body);
        let mut fraction = 1.0;
        for &vertex in vertices.iter().filter(|&&vertex| (vertex as usize) < primitives.free) {
            match self.pinch[vertex as usize] {
                PinchState::Thinned => fraction = THINNED_FRACTION,
                PinchState::Released(released) if released == group => return None,
                PinchState::Free | PinchState::Released(_) => {}
            }
        }
        Some(fraction)
    }
}

/// Returns whether two primitives with the given vertices, `first` and `second`, share one.
#[inline]
pub(crate) fn share_vertex([first, second]: [&[u32]; 2]) -> bool {
    first.iter().any(|vertex| second.contains(vertex))
}
