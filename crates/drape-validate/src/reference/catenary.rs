//! Catenary: the shape of an inextensible limp line between two supports. The case `catenary` calls
//! it.

use super::root;

/// Returns the sag over the span of an inextensible line between two supports at equal height. The
/// line is `length_over_span` spans long.
///
/// ```math
/// L = 2a\sinh\frac{D}{2a},\qquad f = a\left(\cosh\frac{D}{2a} - 1\right)
/// ```
#[must_use]
pub fn catenary_sag(length_over_span: f64) -> f64 {
    let x = half_angle(length_over_span);
    (x.cosh() - 1.0) / (2.0 * x)
}

/// Returns the shape of the line of [`catenary_sag`]: distance across and height above the
/// supports, both over the span, at the ends of `parts` equal parts of the span.
#[must_use]
pub fn catenary_shape(length_over_span: f64, parts: usize) -> Vec<[f64; 2]> {
    let x = half_angle(length_over_span);
    (0..=parts)
        .map(|k| {
            let across = k as f64 / parts as f64;
            [across, ((x * (2.0 * across - 1.0)).cosh() - x.cosh()) / (2.0 * x)]
        })
        .collect()
}

/// Returns `$x = D/2a$` of the line that is `length_over_span` spans long. The length over the span
/// is `$\sinh(x)/x$`, which rises from one.
fn half_angle(length_over_span: f64) -> f64 {
    root(|x| x.sinh() / x - length_over_span, 1e-9, 50.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_taut_line_sags_as_a_parabola() {
        // L/D = 1 + (8/3)(f/D)² to the second order.
        let excess: f64 = 1e-6;
        let sag = catenary_sag(1.0 + excess);
        assert!((sag / (3.0 * excess / 8.0).sqrt() - 1.0).abs() < 1e-6, "{sag}");
    }

    #[test]
    fn the_shape_has_the_length_and_the_sag() {
        let shape = catenary_shape(1.5, 2000);
        let lengths = shape.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]));
        let (length, lowest) = (lengths.sum::<f64>(), shape[1000][1]);
        assert!((length - 1.5).abs() < 1e-6 && (lowest + catenary_sag(1.5)).abs() < 1e-12);
        assert_eq!([shape[0][1].abs() < 1e-12, shape[2000][1].abs() < 1e-12], [true, true]);
    }

    #[test]
    fn a_long_line_hangs_nearly_straight_down() {
        // Two vertical halves: the sag is half of the length, less the curve at the bottom.
        let sag = catenary_sag(100.0);
        assert!((sag / 50.0 - 1.0).abs() < 0.03, "{sag}");
    }
}
