//! Rotation between the yarns and a panel's frame.

/// Rotation from a panel's frame to its yarns.
///
/// The panel's frame has its width along x and its height along y, its right side towards the
/// reader. At an angle `$\gamma$` the warp is rotated from y and the weft from x, anticlockwise:
///
/// ```math
/// \text{weft} = (\cos\gamma, \sin\gamma),\qquad \text{warp} = (-\sin\gamma, \cos\gamma)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grain {
    cos: f64,
    sin: f64,
}

impl Default for Grain {
    /// Returns the grain with the warp along the height.
    fn default() -> Self {
        Self { cos: 1.0, sin: 0.0 }
    }
}

impl Grain {
    /// Returns the grain of yarns rotated by `angle`, in degrees. Multiples of 90° are exact.
    #[must_use]
    pub fn from_degrees(angle: f64) -> Self {
        let quarters = (angle / 90.0).round();
        let (sin, cos) = (angle - 90.0 * quarters).to_radians().sin_cos();
        match quarters.rem_euclid(4.0) {
            0.0 => Self { cos, sin },
            1.0 => Self { cos: -sin, sin: cos },
            2.0 => Self { cos: -cos, sin: -sin },
            _ => Self { cos: sin, sin: -cos },
        }
    }

    /// Returns the direction of the weft in the panel's frame, as `[x, y]`.
    #[must_use]
    pub fn weft(&self) -> [f64; 2] {
        [self.cos, self.sin]
    }

    /// Returns the point in the panel's frame with the material coordinates `u` and `v`.
    #[must_use]
    pub fn to_panel(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        [u * self.cos - v * self.sin, u * self.sin + v * self.cos]
    }

    /// Returns the material coordinates of the point (`x`, `y`) in the panel's frame.
    #[must_use]
    pub fn to_material(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x * self.cos + y * self.sin, y * self.cos - x * self.sin]
    }

    /// Returns the lengths `a` and `b` along the sides of a panel as lengths along the yarns
    /// nearest to them, weft and warp. The method is its inverse too.
    pub(crate) fn exchanged(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        if self.sin.abs() > self.cos.abs() { [b, a] } else { [a, b] }
    }

    /// Returns whether the yarns are parallel to the sides of a rectangle.
    pub(crate) fn is_straight(&self) -> bool {
        self.cos == 0.0 || self.sin == 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_warp_turns_from_the_height_anticlockwise() {
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-15;
        let half = std::f64::consts::FRAC_1_SQRT_2;
        assert!(near(Grain::from_degrees(45.0).to_panel([0.0, 1.0]), [-half, half]));
        assert!(near(Grain::from_degrees(45.0).to_panel([1.0, 0.0]), [half, half]));
        assert!(near(Grain::from_degrees(-30.0).to_panel([0.0, 1.0]), [0.5, 0.75_f64.sqrt()]));
        for angle in [-200.0, -45.0, 10.0, 135.0, 300.0] {
            let grain = Grain::from_degrees(angle);
            assert!(near(grain.to_material(grain.to_panel([0.3, -0.2])), [0.3, -0.2]), "{angle}");
        }
    }

    #[test]
    fn quarters_are_exact() {
        assert_eq!(Grain::from_degrees(0.0), Grain::default());
        for (angle, warp) in [(90.0, [-1.0, 0.0]), (180.0, [0.0, -1.0]), (-90.0, [1.0, 0.0])] {
            let grain = Grain::from_degrees(angle);
            assert_eq!(grain.to_panel([0.0, 1.0]), warp, "{angle}");
            assert!(grain.is_straight());
        }
    }
}
