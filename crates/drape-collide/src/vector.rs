//! Arithmetic of vectors in space and of 3×3 matrices.

/// Vector in space.
pub(crate) type Vector = [f64; 3];

/// 3×3 matrix, row by row.
pub(crate) type Matrix = [f64; 9];

const IDENTITY: Matrix = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Returns the vector of a vertex in a flat list of coordinates.
pub(crate) fn at(flat: &[f64], index: usize) -> Vector {
    [flat[3 * index], flat[3 * index + 1], flat[3 * index + 2]]
}

/// Returns a vector of a flat list; zero beyond its end.
pub(crate) fn at_or_zero(flat: &[f64], index: usize) -> Vector {
    if 3 * index < flat.len() { at(flat, index) } else { [0.0; 3] }
}

pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(crate) fn subtract(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn scale(a: Vector, factor: f64) -> Vector {
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// Returns the outer product `$a a^T$`.
pub(crate) fn outer(a: Vector) -> Matrix {
    let mut product = [0.0; 9];
    for row in 0..3 {
        for column in 0..3 {
            product[3 * row + column] = a[row] * a[column];
        }
    }
    product
}

/// Returns the projection onto the plane with a unit normal, `$I - n n^T$`.
pub(crate) fn projection(normal: Vector) -> Matrix {
    combine(&IDENTITY, 1.0, &outer(normal), -1.0)
}

/// Returns a linear combination of two matrices.
pub(crate) fn combine(a: &Matrix, factor_a: f64, b: &Matrix, factor_b: f64) -> Matrix {
    std::array::from_fn(|k| a[k] * factor_a + b[k] * factor_b)
}

pub(crate) fn times(matrix: &Matrix, a: Vector) -> Vector {
    std::array::from_fn(|row| dot(at(matrix, row), a))
}

/// Returns `$B^T a$`, for a rotation its inverse applied.
pub(crate) fn transposed_times(matrix: &Matrix, a: Vector) -> Vector {
    std::array::from_fn(|column| {
        matrix[column] * a[0] + matrix[3 + column] * a[1] + matrix[6 + column] * a[2]
    })
}

/// Returns `$R B R^T$`, the matrix of the same map in axes rotated by `$R$`.
pub(crate) fn rotated(rotation: &Matrix, matrix: &Matrix) -> Matrix {
    let mut half = [0.0; 9];
    for row in 0..3 {
        for column in 0..3 {
            half[3 * row + column] =
                (0..3).map(|k| rotation[3 * row + k] * matrix[3 * k + column]).sum();
        }
    }
    let mut result = [0.0; 9];
    for row in 0..3 {
        for column in 0..3 {
            result[3 * row + column] =
                (0..3).map(|k| half[3 * row + k] * rotation[3 * column + k]).sum();
        }
    }
    result
}
