//! Bending connector of a seam along one yarn.

use drape_fabric::{BendingLaw, Memory};

use crate::measure::bending::{BendingMeasure, BendingResponse};
use crate::measure::vector::{
    Vector, WeightedNode, add, cross, dot, scale, subtract, vector_at, weighted_sum,
};

/// Bending connector of a seam along one yarn.
#[derive(Debug, Clone)]
pub(crate) struct SeamConnector {
    pub(crate) law: BendingLaw,
    /// Particles in rising order with their weights in the second difference.
    pub(crate) nodes: Vec<WeightedNode>,
    /// Length over which the angle is measured, in m.
    pub(crate) length: f64,
    /// Area times relative stiffness, in m².
    pub(crate) area: f64,
    /// Triangles whose mean normal is the normal of the connector.
    pub(crate) faces: Vec<Face>,
}

/// Triangle beside a seam.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Face {
    /// Corners, anticlockwise on the right side of its panel.
    pub(crate) corners: [u32; 3],
    /// −1 if the triangle's wrong side is on the right side of the seam, 1 otherwise.
    pub(crate) sign: f64,
}

impl SeamConnector {
    /// Returns the unit normal of the seam at `positions`: the mean of the normals of its `faces`.
    pub(crate) fn normal(&self, positions: &[f64]) -> Vector {
        let mut sum = [0.0; 3];
        for &Face { corners, sign } in &self.faces {
            let [a, b, c] = corners.map(|node| vector_at(positions, node));
            let across = cross(subtract(b, a), subtract(c, a));
            let length = dot(across, across).sqrt();
            if length > 0.0 {
                sum = add(sum, scale(across, sign / length));
            }
        }
        let length = dot(sum, sum).sqrt();
        if length > 0.0 { scale(sum, 1.0 / length) } else { [0.0, 1.0, 0.0] }
    }

    fn measure(&self, positions: &[f64], normal: Vector) -> BendingMeasure {
        let second_difference = weighted_sum(positions, &self.nodes);
        BendingMeasure { second_difference, normal, length: self.length }
    }

    /// Returns the curvature at `positions` about `normal`, in 1/m.
    pub(crate) fn curvature(&self, positions: &[f64], normal: Vector) -> f64 {
        self.measure(positions, normal).curvature()
    }

    /// Returns energy per area and derivatives at `positions`. With a rest angle the curvature,
    /// like the friction, is counted about `normal`.
    pub(crate) fn respond(
        &self,
        memory: &Memory,
        normal: Vector,
        positions: &[f64],
        definite: bool,
    ) -> BendingResponse {
        let measure = self.measure(positions, normal);
        if self.law.rest_curvature == 0.0 {
            measure.respond(&self.law, memory, definite)
        } else {
            measure.respond_about_normal(&self.law, memory, definite)
        }
    }
}
