//! Query of the broad phase: boxes of primitives, and the test of a pair.

use super::sweep::Sweep;
use super::tree::Bounds;
use crate::surface::geometry::{ContactDistances, Primitives, Separations};
use crate::surface::pair::{Pair, PairKind, closest, distance};
use crate::vector::{Vector, add, at, at_or_zero, subtract};

/// Squared sine of the angle below which two edges count as parallel: 1.8° \[Li20, eq. 24\].
const PARALLEL: f64 = 1e-3;

/// Distance below which two primitives are a pair.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Limit<'a> {
    /// Activation distance plus a margin, somewhere on trajectories.
    Margin {
        /// Margin, in m.
        margin: f64,
        /// Trajectories.
        sweep: Sweep<'a>,
    },
    /// Twice the activation distance, within a group.
    Rest,
}

/// Search for pairs of a surface at some positions.
pub(crate) struct Query<'a> {
    pub(crate) primitives: &'a Primitives,
    pub(crate) separations: &'a Separations,
    pub(crate) positions: &'a [f64],
    pub(crate) limit: Limit<'a>,
    /// Displacement that is taken off those of all vertices, in m: it changes no distance.
    pub(crate) mean_displacement: Vector,
}

impl Query<'_> {
    /// Returns the box of a primitive; those of two that are near enough overlap.
    pub(crate) fn bounds<const N: usize>(&self, vertices: [u32; N]) -> Bounds {
        let group = self.primitives.group(vertices[0]);
        let distances = self.separations.groups[group as usize];
        let points = vertices.map(|vertex| at(self.positions, vertex as usize));
        // Each of the two boxes is widened by half of the limit.
        match self.limit {
            Limit::Rest => Bounds::around(points, 2.0 * distances.activation_distance),
            Limit::Margin { margin, sweep } => {
                let around = distances.activation_distance + 0.5 * margin;
                let Some(displacements) = sweep.displacements() else {
                    return Bounds::around(points, around);
                };
                let displacement = |vertex: u32| {
                    subtract(at_or_zero(displacements, vertex as usize), self.mean_displacement)
                };
                let ends = points.into_iter().zip(vertices);
                let ends = ends.map(|(point, vertex)| add(point, displacement(vertex)));
                Bounds::around(points.into_iter().chain(ends), around)
            }
        }
    }

    /// Returns the pair of two primitives that share no vertex, if they are near enough.
    pub(crate) fn pair(
        &self,
        kind: PairKind,
        features: [u32; 2],
        vertices: [u32; 4],
    ) -> Option<Pair> {
        let (primitives, separations) = (self.primitives, self.separations);
        let other = vertices[kind.first_vertices()];
        let groups = [vertices[0], other].map(|vertex| primitives.group(vertex));
        let mut distances = separations.of_groups(groups);
        let same_group = groups[0] == groups[1];
        let points = vertices.map(|vertex| at(self.positions, vertex as usize));
        let distance = distance(&closest(kind, points));
        let approach = match self.limit {
            Limit::Margin { sweep, .. } => sweep.largest_approach(kind, vertices),
            Limit::Rest if same_group => 0.0,
            Limit::Rest => return None,
        };
        let is_near = |distances: ContactDistances| match self.limit {
            Limit::Margin { margin, .. } => {
                distance < distances.activation_distance + margin + approach
            }
            Limit::Rest => distance < 2.0 * distances.activation_distance,
        };
        if !is_near(distances) {
            return None;
        }
        if same_group
            && !separations.close_at_rest.is_empty()
            && let Some(close) = separations.of_close_pair(&(kind, features))
        {
            distances = close;
        }
        // The sides of a seam repel each other as strongly as others do, within a shorter range.
        let mut strengthening = 1.0;
        if !separations.seam_gaps.is_empty()
            && let Some(open) = self.of_open_seam(kind, vertices)
        {
            let range = distances.range();
            distances = distances.least(open);
            strengthening = range / distances.range();
        }
        if !is_near(distances) {
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

    /// Returns the distances of the sides of an open seam for two primitives that it joins.
    fn of_open_seam(&self, kind: PairKind, vertices: [u32; 4]) -> Option<ContactDistances> {
        let seams = &self.primitives.seams;
        let classes = vertices.map(|vertex| seams.class(vertex));
        let (one, other) = classes.split_at(kind.first_vertices());
        self.separations.of_open_seam(seams, [one, other])
    }
}
