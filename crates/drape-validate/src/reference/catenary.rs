use super::integrate::root;

/// Sag of an inextensible line of a length between two supports at the same height, over the span.
///
/// ```math
/// L = 2a\sinh\frac{D}{2a},\qquad f = a\left(\cosh\frac{D}{2a} - 1\right)
/// ```
pub fn catenary_sag(length_over_span: f64) -> f64 {
    // In x = D/2a the length is sinh(x)/x, which rises from one.
    let x = root(|x| x.sinh() / x - length_over_span, 1e-9, 50.0);
    (x.cosh() - 1.0) / (2.0 * x)
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
    fn a_long_line_hangs_nearly_straight_down() {
        // Two vertical halves: the sag is half of the length, less the curve at the bottom.
        let sag = catenary_sag(100.0);
        assert!((sag / 50.0 - 1.0).abs() < 0.03, "{sag}");
    }
}
