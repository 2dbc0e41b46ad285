//! Arithmetic of three numbers and of 3×3 blocks stored row by row.

pub(crate) type Vector = [f64; 3];
pub(crate) type Block = [f64; 9];

pub(crate) const IDENTITY: Block = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

pub(crate) fn at(flat: &[f64], index: usize) -> Vector {
    [flat[3 * index], flat[3 * index + 1], flat[3 * index + 2]]
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

pub(crate) fn outer(a: Vector) -> Block {
    let mut block = [0.0; 9];
    for row in 0..3 {
        for column in 0..3 {
            block[3 * row + column] = a[row] * a[column];
        }
    }
    block
}

/// Projection onto the plane across a unit vector, `$I - n n^T$`.
pub(crate) fn across(normal: Vector) -> Block {
    combine(&IDENTITY, 1.0, &outer(normal), -1.0)
}

pub(crate) fn combine(a: &Block, factor_a: f64, b: &Block, factor_b: f64) -> Block {
    std::array::from_fn(|k| a[k] * factor_a + b[k] * factor_b)
}

pub(crate) fn times(block: &Block, a: Vector) -> Vector {
    std::array::from_fn(|row| dot(at(block, row), a))
}

/// `$B^T a$`: for a rotation, the way back.
pub(crate) fn transposed_times(block: &Block, a: Vector) -> Vector {
    std::array::from_fn(|column| {
        block[column] * a[0] + block[3 + column] * a[1] + block[6 + column] * a[2]
    })
}

/// `$R B R^T$`: a symmetric block seen from the frame that `R` turns into.
pub(crate) fn turned(rotation: &Block, block: &Block) -> Block {
    let mut half = [0.0; 9];
    for row in 0..3 {
        for column in 0..3 {
            half[3 * row + column] =
                (0..3).map(|k| rotation[3 * row + k] * block[3 * k + column]).sum();
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
