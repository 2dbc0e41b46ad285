//! Vectors in three dimensions, and vectors in flat arrays of three numbers per particle.

/// Vector in three dimensions.
pub(crate) type Vector = [f64; 3];

#[inline(always)]
pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn scale(a: Vector, by: f64) -> Vector {
    [a[0] * by, a[1] * by, a[2] * by]
}

#[inline(always)]
pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn subtract(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// Returns the vector of `particle` in the array `flat`.
pub(crate) fn vector_at(flat: &[f64], particle: u32) -> Vector {
    let start = 3 * particle as usize;
    [flat[start], flat[start + 1], flat[start + 2]]
}

/// Adds `vector` to the vector of `particle` in the array `flat`.
pub(crate) fn add_at(flat: &mut [f64], particle: u32, vector: Vector) {
    let start = 3 * particle as usize;
    for (sum, part) in flat[start..start + 3].iter_mut().zip(vector) {
        *sum += part;
    }
}

/// Particle with its weight in a second difference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WeightedNode {
    pub(crate) node: u32,
    /// Weight, in 1/m².
    pub(crate) weight: f64,
}

/// Returns the weighted sum of the vectors of `nodes` in `flat`, such as a second difference.
pub(crate) fn weighted_sum(flat: &[f64], nodes: &[WeightedNode]) -> Vector {
    nodes.iter().fold([0.0; 3], |sum, &WeightedNode { node, weight }| {
        add(sum, scale(vector_at(flat, node), weight))
    })
}
