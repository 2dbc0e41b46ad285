//! Two-stage barrier: the energy that keeps surfaces and particles apart.
//!
//! The chapters [`particle`](crate::particle) and [`surface`](crate::surface) evaluate the barrier
//! for each contact. Particles use [`Barrier::new`], with a parabola at small gaps. Surfaces never
//! close their gap and use [`Barrier::strict`].

/// Fraction of the activation distance below which the barrier is a parabola.
///
/// The logarithm alone is infinite at the surface, so a solver's trial beyond the surface would
/// have no energy to compare. With a tenth, the stiffest contact is 25 times the softest, which
/// costs the linear solver little. A particle at rest then carries up to five times the pressure
/// `$k_A \hat g$` before it sinks in. A smaller value carries more and conditions worse.
const EXTENDED: f64 = 0.1;

/// Two-stage barrier `$b(g)$` of a gap `$g$` below an activation gap `$\hat g$` \[Che25\].
///
/// ```math
/// b = \tfrac12 (\hat g - g)^2                         \quad (\hat g/2 \le g < \hat g), \qquad
/// b = -\tfrac14 \hat g^2 (\ln(2g/\hat g) - \tfrac12)  \quad (g_0 \le g < \hat g/2)
/// ```
///
/// The barrier is zero at gaps of `$\hat g$` and more. Below `$g_0$` it is its Taylor parabola at
/// `$g_0$`, so energy and force are finite and grow with penetration. Value and slope are
/// continuous everywhere. The second derivative is continuous but at `$\hat g$`, where it jumps
/// from 1 to 0.
///
/// A [`strict`](Barrier::strict) barrier has no parabola: it is infinite at gaps of 0 and less.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Barrier {
    /// Activation gap `$\hat g$`, in m.
    activation: f64,
    /// Gap `$g_0$` below which the barrier is a parabola, in m.
    end: f64,
}

impl Barrier {
    /// Returns the barrier with the gap `activation`, in m, and with a parabola at small gaps.
    pub(crate) fn new(activation: f64) -> Barrier {
        Barrier { activation, end: EXTENDED * activation }
    }

    /// Returns the barrier with the gap `activation`, in m, that is infinite where the gap closes.
    pub(crate) fn strict(activation: f64) -> Barrier {
        Barrier { activation, end: 0.0 }
    }

    /// Returns the smallest gap at which the barrier is zero, `$\hat g$`, in m.
    pub(crate) fn activation(&self) -> f64 {
        self.activation
    }

    /// Returns `$b$`, in m².
    pub(crate) fn energy(&self, gap: f64) -> f64 {
        let activation = self.activation;
        if gap >= activation {
            0.0
        } else if gap >= 0.5 * activation {
            0.5 * (activation - gap).powi(2)
        } else if gap > self.end {
            -0.25 * activation * activation * ((2.0 * gap / activation).ln() - 0.5)
        } else if self.end == 0.0 {
            // The sum below would subtract infinities.
            f64::INFINITY
        } else {
            let over = gap - self.end;
            let [energy, slope] = self.value_and_slope_at_end();
            energy + over * (slope + 0.5 * over * self.curvature(self.end))
        }
    }

    /// Returns `$b'$`, in m; never positive.
    pub(crate) fn slope(&self, gap: f64) -> f64 {
        let activation = self.activation;
        if gap >= activation {
            0.0
        } else if gap >= 0.5 * activation {
            gap - activation
        } else if gap > self.end {
            -0.25 * activation * activation / gap
        } else if self.end == 0.0 {
            f64::NEG_INFINITY
        } else {
            self.value_and_slope_at_end()[1] + (gap - self.end) * self.curvature(self.end)
        }
    }

    /// Returns value and slope at the upper end `$g_0$` of the parabola.
    fn value_and_slope_at_end(&self) -> [f64; 2] {
        let (activation, end) = (self.activation, self.end);
        [
            -0.25 * activation * activation * ((2.0 * end / activation).ln() - 0.5),
            -0.25 * activation * activation / end,
        ]
    }

    /// Returns `$b''$`, without unit; never negative.
    pub(crate) fn curvature(&self, gap: f64) -> f64 {
        let activation = self.activation;
        if gap >= activation {
            0.0
        } else if gap >= 0.5 * activation {
            1.0
        } else {
            (0.5 * activation / gap.max(self.end)).powi(2)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGE: f64 = 1e-3;

    #[test]
    fn the_barrier_is_smooth_where_its_pieces_meet() {
        let barrier = Barrier::new(RANGE);
        for joint in [EXTENDED * RANGE, 0.5 * RANGE, RANGE] {
            let (below, above) = (joint * (1.0 - 1e-12), joint * (1.0 + 1e-12));
            let energy = barrier.energy(below) - barrier.energy(above);
            let slope = barrier.slope(below) - barrier.slope(above);
            // The functions move by their derivative times 2e-15 m; 25 is the largest curvature.
            assert!(energy.abs() < 1e-17, "energy jumps by {energy:e} at {joint}");
            assert!(slope.abs() < 1e-13, "slope jumps by {slope:e} at {joint}");
            if joint < RANGE {
                let curvature = barrier.curvature(below) - barrier.curvature(above);
                assert!(curvature.abs() < 1e-9, "curvature jumps by {curvature:e}");
            }
        }
        assert_eq!(barrier.slope(RANGE), 0.0);
    }

    #[test]
    fn slope_and_curvature_are_the_derivatives_of_the_energy() {
        let barrier = Barrier::new(RANGE);
        let h = 1e-7;
        for gap in [-3e-3, -1e-4, 4e-5, 2e-4, 4e-4, 6e-4, 9e-4] {
            let slope = (barrier.energy(gap + h) - barrier.energy(gap - h)) / (2.0 * h);
            let curvature = (barrier.slope(gap + h) - barrier.slope(gap - h)) / (2.0 * h);
            let miss = (slope / barrier.slope(gap) - 1.0).abs();
            assert!(miss < 1e-6, "slope at {gap}: off by {miss:e}");
            let miss = (curvature / barrier.curvature(gap) - 1.0).abs();
            assert!(miss < 1e-6, "curvature at {gap}: off by {miss:e}");
        }
    }

    #[test]
    fn energy_and_force_grow_as_the_gap_closes() {
        let barrier = Barrier::new(RANGE);
        let gaps = (0..4000).map(|k| RANGE * (1.0 - f64::from(k) * 0.01));
        let mut last = (0.0, 0.0);
        for gap in gaps.skip(1) {
            let now = (barrier.energy(gap), -barrier.slope(gap));
            assert!(now.0 > last.0 && now.1 > last.1, "at {gap}: {now:?} {last:?}");
            last = now;
        }
    }
}
