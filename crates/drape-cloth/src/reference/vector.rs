//! Vectors in flat arrays: particle `i` has the numbers `3i`, `3i + 1`, `3i + 2`.

use nalgebra::Vector3;

pub(crate) type Vector = Vector3<f64>;

pub(crate) fn at(flat: &[f64], particle: u32) -> Vector {
    let start = 3 * particle as usize;
    Vector::new(flat[start], flat[start + 1], flat[start + 2])
}

pub(crate) fn add(flat: &mut [f64], particle: u32, vector: Vector) {
    let start = 3 * particle as usize;
    flat[start] += vector.x;
    flat[start + 1] += vector.y;
    flat[start + 2] += vector.z;
}
