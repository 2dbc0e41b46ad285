//! Vectors of three coordinates.

pub(crate) type Vector = [f64; 3];

pub(crate) fn sum(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// Returns the vector across a triangle whose length is twice its area.
pub(crate) fn area_vector(positions: &[Vector], corners: &[u32; 3]) -> Vector {
    let [a, b, c] = corners.map(|corner| positions[corner as usize]);
    cross(difference(b, a), difference(c, a))
}
