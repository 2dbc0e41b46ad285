//! Area of a triangle in the plane.

/// Returns twice the area of the triangle `a`, `b`, `c`, in m², negative if it runs clockwise.
pub(crate) fn twice_area([a, b, c]: [[f64; 2]; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
