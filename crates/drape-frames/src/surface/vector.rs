//! Vectors of three coordinates.

/// Vector, in the unit of its context.
pub type Vector = [f64; 3];

/// Returns the sum of two vectors.
#[must_use]
pub fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Returns the first vector less the second.
#[must_use]
pub fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Returns the scalar product.
#[must_use]
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the vector product.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Returns the length.
#[must_use]
pub fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// Returns the vector across a triangle whose length is twice its area.
///
/// # Panics
/// If there is no position of a corner.
#[must_use]
pub fn area_vector(positions: &[Vector], corners: &[u32; 3]) -> Vector {
    let [a, b, c] = corners.map(|corner| positions[corner as usize]);
    cross(difference(b, a), difference(c, a))
}
