//! Critical loads of an upright strip, under its own weight \[Gre81\] and an end load \[Eul44\].

/// Weight at which an upright strip, clamped at its foot, bends over: `$wL^3/B$`, a ratio.
///
/// `$\tfrac94 j^2$` with the first zero `$j$` of the Bessel function `$J_{-1/3}$` \[Gre81\].
pub const SELF_WEIGHT_BUCKLING: f64 = 7.837_347_439;

/// End load per width at which a strip clamped at one end bends over: `$PL^2/B$`, a ratio
/// \[Eul44\].
pub const END_LOAD_BUCKLING: f64 = std::f64::consts::PI * std::f64::consts::PI / 4.0;

#[cfg(test)]
mod tests {
    use super::super::root;
    use super::super::runge_kutta::march;
    use super::*;

    /// Returns the least load between `low` and `high` at which a straight column has a bent
    /// neighbour in balance. `pull` is the axial force over the load, at a distance from the tip.
    fn critical(pull: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
        let slope_at_clamp = |load: f64| {
            let law = |s: f64, [theta, bend]: [f64; 2]| [bend, -load * pull(s) * theta];
            march(law, [1.0, 0.0], 1.0, 4000)[0]
        };
        root(slope_at_clamp, low, high)
    }

    #[test]
    fn the_critical_loads_are_where_the_straight_column_has_a_neighbour() {
        let weight = critical(|s| s, 5.0, 10.0);
        assert!((weight / SELF_WEIGHT_BUCKLING - 1.0).abs() < 1e-8, "{weight}");
        let load = critical(|_| 1.0, 1.0, 4.0);
        assert!((load / END_LOAD_BUCKLING - 1.0).abs() < 1e-8, "{load}");
    }
}
