//! Tangents of the yarns and normals of the surface at the particles. Bending is measured about the
//! normals.

use crate::measure::vector::{Vector, cross, dot};

/// Tangent of a yarn at a particle, as a weighted sum of three positions on the yarn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct YarnTangent {
    particles: [u32; 3],
    weights: [f64; 3],
}

impl YarnTangent {
    /// Returns a vector along the yarn at `positions`, in the direction of the rising material
    /// coordinate.
    pub(crate) fn at(&self, positions: &[f64]) -> Vector {
        let [a, b, c] = self.particles.map(|particle| 3 * particle as usize);
        let [wa, wb, wc] = self.weights;
        [0, 1, 2].map(|k| wa * positions[a + k] + wb * positions[b + k] + wc * positions[c + k])
    }
}

/// Returns the tangents along warp and weft at each of `particle_count` particles of a panel whose
/// first particle is `first`. `yarns` holds the yarns of both directions.
///
/// The tangents are central differences. At the ends of a yarn they are one-sided differences of
/// second order, so that the normals of a cylinder are right at its edges too.
pub(crate) fn yarn_tangents(
    yarns: &[Vec<Vec<u32>>; 2],
    first: u32,
    particle_count: usize,
) -> Vec<[YarnTangent; 2]> {
    let none = YarnTangent { particles: [0; 3], weights: [0.0; 3] };
    let mut tangents = vec![[none; 2]; particle_count];
    for (direction, yarns) in yarns.iter().enumerate() {
        for yarn in yarns {
            let last = yarn.len() - 1;
            for (index, &particle) in yarn.iter().enumerate() {
                let (nodes, weights) = match (index, last) {
                    (_, 1) => ([0, 0, 1], [-1.0, 0.0, 1.0]),
                    (0, _) => ([0, 1, 2], [-3.0, 4.0, -1.0]),
                    (i, _) if i == last => ([last - 2, last - 1, last], [1.0, -4.0, 3.0]),
                    (i, _) => ([i - 1, i, i + 1], [-1.0, 0.0, 1.0]),
                };
                let particles = nodes.map(|node| first + yarn[node]);
                tangents[particle as usize][direction] = YarnTangent { particles, weights };
            }
        }
    }
    tangents
}

/// Returns the unit normal `$u \times v$` of a surface with the tangents `v` along the warp and `u`
/// along the weft.
pub(crate) fn surface_normal([v, u]: [Vector; 2]) -> Vector {
    let across = cross(u, v);
    let length = dot(across, across).sqrt();
    if length > 0.0 { across.map(|c| c / length) } else { [0.0, 1.0, 0.0] }
}
