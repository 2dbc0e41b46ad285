//! Vectors of three coordinates.

/// Vector of three coordinates, in any unit.
pub type Vector = [f64; 3];

/// Returns the sum of `a` and `b`.
#[must_use]
pub fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Returns `a` less `b`.
#[must_use]
pub fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Returns the scalar product of `a` and `b`.
#[must_use]
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Returns the vector product of `a` and `b`.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Returns the length of `a`.
#[must_use]
pub fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// Returns the normal vector of the triangle with the given `corners`. The length of this vector is
/// twice the area of the triangle.
#[must_use]
pub fn area_vector([a, b, c]: [Vector; 3]) -> Vector {
    cross(difference(b, a), difference(c, a))
}
