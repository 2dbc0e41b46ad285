//! Arithmetic of vectors of three numbers.

pub(crate) type Vector = [f64; 3];

/// Returns the vector `index` of the `flat` coordinates.
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

/// Returns the unit vector in the direction of `a`. The zero vector stays unchanged.
pub(crate) fn unit(a: Vector) -> Vector {
    let length = norm(a);
    if length > 0.0 { scale(a, 1.0 / length) } else { a }
}

/// Returns two unit vectors perpendicular to a `direction` and to each other. The first vector is
/// horizontal.
pub(crate) fn perpendiculars(direction: Vector) -> [Vector; 2] {
    let up = if direction[1].abs() > 0.999 {
        [0.0, 0.0, -direction[1].signum()]
    } else {
        [0.0, 1.0, 0.0]
    };
    let right = unit(cross(direction, up));
    [right, cross(right, direction)]
}

/// Sphere around the bounding box of points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    /// Centre of the box.
    pub(crate) center: Vector,
    /// Half of the diagonal of the box.
    pub(crate) radius: f64,
}

impl Bounds {
    /// Returns the bounds of `points`.
    pub(crate) fn of(points: impl Iterator<Item = Vector>) -> Bounds {
        let (low, high) = points.fold(([f64::MAX; 3], [f64::MIN; 3]), |(low, high), p| {
            (std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k])))
        });
        let center = scale(add(low, high), 0.5);
        Bounds { center, radius: norm(subtract(high, center)) }
    }
}
