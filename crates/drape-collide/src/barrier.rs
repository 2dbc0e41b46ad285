/// Share of the gap below which the barrier goes on as a parabola.
///
/// The logarithm alone is infinite at the surface, so one trial of the solver beyond it would have
/// no energy to compare. With a tenth, the stiffest contact is 25 times the softest, which costs
/// the linear solver little, and a particle at rest carries up to five times the pressure
/// `$k_A r$` before it sinks in. Smaller carries more and conditions worse.
const EXTENDED: f64 = 0.1;

/// The two-stage barrier `$b(g)$` of a distance `$g$` within a range `$r$`.
///
/// ```math
/// b = \tfrac12 (r - g)^2                       \quad (r/2 \le g < r), \qquad
/// b = -\tfrac14 r^2 (\ln(2g/r) - \tfrac12)     \quad (g_0 \le g < r/2)
/// ```
///
/// Zero from `$r$` on; below `$g_0$` its Taylor parabola at `$g_0$`, so energy and force are finite
/// and grow with any penetration. Value and slope are continuous everywhere, the second derivative
/// everywhere but at `$r$`, where it jumps from 1 to 0.
///
/// A [`strict`](Barrier::strict) barrier has no such parabola: it is infinite from 0 down.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Barrier {
    range: f64,
    /// The gap `$g_0$` below which the barrier goes on as a parabola, in m.
    end: f64,
}

impl Barrier {
    pub(crate) fn new(range: f64) -> Barrier {
        Barrier { range, end: EXTENDED * range }
    }

    /// A barrier that no gap above zero gets through.
    pub(crate) fn strict(range: f64) -> Barrier {
        Barrier { range, end: 0.0 }
    }

    /// The gap from which on the barrier is zero, in m.
    pub(crate) fn range(&self) -> f64 {
        self.range
    }

    /// `$b$`, in m².
    pub(crate) fn energy(&self, gap: f64) -> f64 {
        let range = self.range;
        if gap >= range {
            0.0
        } else if gap >= 0.5 * range {
            0.5 * (range - gap).powi(2)
        } else if gap > self.end {
            -0.25 * range * range * ((2.0 * gap / range).ln() - 0.5)
        } else if self.end == 0.0 {
            // Not the sum below, which would take infinities from each other.
            f64::INFINITY
        } else {
            let over = gap - self.end;
            let [energy, slope] = self.at_end();
            energy + over * (slope + 0.5 * over * self.curvature(self.end))
        }
    }

    /// `$b'$`, in m; never positive.
    pub(crate) fn slope(&self, gap: f64) -> f64 {
        let range = self.range;
        if gap >= range {
            0.0
        } else if gap >= 0.5 * range {
            gap - range
        } else if gap > self.end {
            -0.25 * range * range / gap
        } else if self.end == 0.0 {
            f64::NEG_INFINITY
        } else {
            self.at_end()[1] + (gap - self.end) * self.curvature(self.end)
        }
    }

    /// Value and slope at the upper end of the parabola.
    fn at_end(&self) -> [f64; 2] {
        let (range, end) = (self.range, self.end);
        [-0.25 * range * range * ((2.0 * end / range).ln() - 0.5), -0.25 * range * range / end]
    }

    /// `$b''$`, without unit; never negative.
    pub(crate) fn curvature(&self, gap: f64) -> f64 {
        let range = self.range;
        if gap >= range {
            0.0
        } else if gap >= 0.5 * range {
            1.0
        } else {
            (0.5 * range / gap.max(self.end)).powi(2)
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
    fn deeper_is_always_dearer_and_harder() {
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
