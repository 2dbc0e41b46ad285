//! Arithmetic of vectors in space and of 3×3 matrices.

/// Vector in space.
pub(crate) type Vector = [f64; 3];

/// 3×3 matrix, row by row.
pub(crate) type Matrix = [f64; 9];

const IDENTITY: Matrix = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Returns vector `index` of the coordinates `flat`, three per vector.
pub(crate) fn at(flat: &[f64], index: usize) -> Vector {
    [flat[3 * index], flat[3 * index + 1], flat[3 * index + 2]]
}

/// Returns vector `index` of `flat`, or zero beyond the end of `flat`.
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

/// Returns the point halfway between `a` and `b`.
pub(crate) fn midpoint(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]))
}

/// Returns the smallest and the largest coordinates of `points`.
pub(crate) fn bounds<'a>(points: impl Iterator<Item = &'a Vector> + Clone) -> [Vector; 2] {
    [
        std::array::from_fn(|axis| points.clone().map(|p| p[axis]).fold(f64::INFINITY, f64::min)),
        std::array::from_fn(|axis| {
            points.clone().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max)
        }),
    ]
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

/// Returns the projection onto the plane with the unit `normal`, `$I - n n^T$`.
pub(crate) fn projection(normal: Vector) -> Matrix {
    combine(&IDENTITY, 1.0, &outer(normal), -1.0)
}

/// Returns the linear combination of the matrices `a` and `b`.
pub(crate) fn combine(a: &Matrix, factor_a: f64, b: &Matrix, factor_b: f64) -> Matrix {
    std::array::from_fn(|k| a[k] * factor_a + b[k] * factor_b)
}

pub(crate) fn times(matrix: &Matrix, a: Vector) -> Vector {
    std::array::from_fn(|row| dot(at(matrix, row), a))
}

/// Returns `$B^T a$` for a matrix `$B$`. For a rotation this is the inverse rotation of `a`.
pub(crate) fn transposed_times(matrix: &Matrix, a: Vector) -> Vector {
    std::array::from_fn(|column| {
        matrix[column] * a[0] + matrix[3 + column] * a[1] + matrix[6 + column] * a[2]
    })
}

/// Returns `$R B R^T$`: `matrix` in axes that `rotation` has turned.
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
