//! Query of the broad phase: boxes of primitives, and the test of a pair.

use super::sweep::Sweep;
use super::tree::Bounds;
use crate::surface::geometry::{ContactDistances, Primitives, Separations};
use crate::surface::pair::{Pair, PairKind, closest, distance};
use crate::vector::{Vector, add, at, at_or_zero, subtract};

/// Squared sine of the angle below which two edges count as parallel: 1.8° \[Li20, eq. 24\].
const PARALLEL: f64 = 1e-3;

/// Distance below which two primitives become a pair.
#[derive(Debug, Clone, Copy)]
pub(crate) enum PairLimit<'a> {
    /// Two primitives become a pair if their distance is at most the activation distance plus a
    /// margin at any point of their trajectories.
    Margin {
        /// Margin, in m.
        margin: f64,
        /// Trajectories.
        sweep: Sweep<'a>,
    },
    /// Twice the activation distance, within a group.
    Rest {
        /// Displacement of the boxes of each group, in m, by which boxes of two groups are apart.
        offsets: &'a [Vector],
    },
}

/// Search for pairs of a surface at given positions.
pub(crate) struct PairQuery<'a> {
    pub(crate) primitives: &'a Primitives,
    pub(crate) separations: &'a Separations,
    pub(crate) positions: &'a [f64],
    pub(crate) limit: PairLimit<'a>,
    /// Displacement that is subtracted from the displacements of all vertices, in m. It changes no
    /// distance.
    pub(crate) mean_displacement: Vector,
}

impl PairQuery<'_> {
    /// Returns the box of the primitive with `vertices`. Boxes of two primitives that are near
    /// enough overlap.
    pub(crate) fn bounds<const N: usize>(&self, vertices: [u32; N]) -> Bounds {
        let group = self.primitives.group(vertices[0]);
        let distances = self.separations.groups[group as usize];
        let points = vertices.map(|vertex| at(self.positions, vertex as usize));
        // Each of the two boxes is widened by half of the limit.
        match self.limit {
            PairLimit::Rest { offsets } => {
                let points = points.map(|point| add(point, offsets[group as usize]));
                Bounds::around(points, 2.0 * distances.activation_distance)
            }
            PairLimit::Margin { margin, sweep } => {
                let around = distances.activation_distance + 0.5 * margin;
                let Some(displacements) = sweep.displacements() else {
                    return Bounds::around(points, around);
                };
                let ends = points.into_iter().zip(vertices).map(|(point, vertex)| {
                    let displacement = at_or_zero(displacements, vertex as usize);
                    add(point, subtract(displacement, self.mean_displacement))
                });
                Bounds::around(points.into_iter().chain(ends), around)
            }
        }
    }

    /// Returns the [`Pair`] of two primitives that share no vertex, or `None` if they are too far
    /// apart or have no contact.
    pub(crate) fn pair(
        &self,
        kind: PairKind,
        features: [u32; 2],
        vertices: [u32; 4],
    ) -> Option<Pair> {
        let (primitives, separations) = (self.primitives, self.separations);
        let second = vertices[kind.first_vertex_count()];
        let groups = [vertices[0], second].map(|vertex| primitives.group(vertex));
        let mut distances = separations.between_groups(groups);
        let same_group = groups[0] == groups[1];
        let points = vertices.map(|vertex| at(self.positions, vertex as usize));
        let distance = distance(&closest(kind, points));
        let approach = match self.limit {
            PairLimit::Margin { sweep, .. } => sweep.largest_approach(kind, vertices),
            PairLimit::Rest { .. } if same_group => 0.0,
            PairLimit::Rest { .. } => return None,
        };

        // Most pairs are too far apart even for the distances of their groups.
        if !self.is_near(distance, approach, distances) {
            return None;
        }
        if same_group
            && !separations.close_at_rest.is_empty()
            && let Some(close) = separations.close_pair_distances(&(kind, features))
        {
            distances = close;
        }

        // The sides of a seam repel each other as strongly as other cloth, within a shorter range.
        let mut strengthening = 1.0;
        if !separations.seam_gaps.is_empty()
            && let Some(open) = self.at_open_seam(kind, vertices)
        {
            let range = distances.range();
            distances = distances.least(open);
            strengthening = range / distances.range();
        }
        if !self.is_near(distance, approach, distances) {
            return None;
        }
        distances.min_separation *= separations.pinch_fraction(primitives, &vertices)?;
        let [a, b] = features.map(|feature| feature as usize);

        let (area, parallel) = match kind {
            PairKind::VertexFace => (primitives.vertex_face_area(a, b), 0.0),
            PairKind::EdgeEdge => {
                let lengths = primitives.edge_length_squared(a) * primitives.edge_length_squared(b);
                (primitives.edge_edge_area(a, b), PARALLEL * lengths)
            }
        };
        Some(Pair {
            kind,
            features,
            vertices,
            activation_distance: distances.activation_distance,
            min_separation: distances.min_separation,
            area: strengthening * area,
            parallel,
            distance: distance - approach,
        })
    }

    /// Returns whether two primitives at `distance` that come nearer by up to `approach`, both in
    /// m, are a pair with contact `distances`.
    fn is_near(&self, distance: f64, approach: f64, distances: ContactDistances) -> bool {
        match self.limit {
            PairLimit::Margin { margin, .. } => {
                distance < distances.activation_distance + margin + approach
            }
            PairLimit::Rest { .. } => distance < 2.0 * distances.activation_distance,
        }
    }

    /// Returns the distances of the two sides of an open seam that joins the primitives with
    /// `vertices`, if any does.
    fn at_open_seam(&self, kind: PairKind, vertices: [u32; 4]) -> Option<ContactDistances> {
        let seams = &self.primitives.seams;
        let classes = vertices.map(|vertex| seams.class(vertex));
        let (first, second) = classes.split_at(kind.first_vertex_count());
        self.separations.at_open_seam(seams, [first, second])
    }
}
