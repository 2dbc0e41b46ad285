//! Breen's derivation of work curves from the first branches of KES loops.

use std::f64::consts::FRAC_PI_4;

use drape_fabric::Piecewise;

/// Angle of shear at which Breen's work has its pole, in rad: cloth does not shear to about 60°.
const SHEAR_LIMIT: f64 = 1.05;

/// Curvature of three particles with mean spacing `$h$` and the inner angle `$\theta$` between their segments
/// (`$\pi$`: straight), in 1/m [Breen, House & Wozny 1994, eq. 5.5].
///
/// ```math
/// K = \frac2h\cos\frac\theta2\;(\theta > \tfrac\pi4), \qquad
/// K = \left(\frac\pi4\right)^2\frac{\beta}{\theta} + \alpha - \frac\pi4\beta\;(\theta \le \tfrac\pi4)
/// ```
///
/// with `$\alpha = \frac2h\cos\frac\pi8$` and `$\beta = \frac1h\sin\frac\pi8$`. The paper prints the second line
/// with signs that make a folded cloth infinitely limp; with these it is infinitely stiff, and value and slope
/// meet at `$\pi/4$`.
#[must_use]
pub fn breen_curvature(spacing: f64, angle: f64) -> f64 {
    if angle > FRAC_PI_4 {
        return 2.0 / spacing * (0.5 * angle).cos();
    }
    let half = 0.5 * FRAC_PI_4;
    let (alpha, beta) = (2.0 / spacing * half.cos(), half.sin() / spacing);
    FRAC_PI_4 * FRAC_PI_4 * beta / angle + alpha - FRAC_PI_4 * beta
}

/// Work of bending and shearing per area, from a quadratic and a line for each [Breen, House & Wozny 1994, §5].
///
/// What a simulation uses are the same loads as backbones of the laws; this is the derivation as it stands in the
/// paper, work against angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BreenWork {
    /// Moment per width against curvature, from the first branch of a bending test.
    pub bending: Piecewise,
    /// Force per length against the sine of the shear angle, from the first branch of a shear test.
    pub shear: Piecewise,
    /// Shear angle where the test ends and the continuation begins, in rad; below 1.05.
    pub shear_end: f64,
}

impl BreenWork {
    /// Work of bending to an inner angle of segments of a spacing, in J/m²: `$\int_0^K M\,\mathrm{d}K$`.
    #[must_use]
    pub fn bending(&self, spacing: f64, angle: f64) -> f64 {
        self.bending.energy(breen_curvature(spacing, angle))
    }

    /// Work of shearing to an angle, in J/m²: `$\int_0^\varphi F\cos\varphi\,\mathrm{d}\varphi$` up to the end of
    /// the test [eq. 5.7], and `$a/(1.05-\varphi)+b$` beyond, with the same value and slope; infinite from
    /// 1.05 rad on.
    #[must_use]
    pub fn shearing(&self, angle: f64) -> f64 {
        let (angle, end) = (angle.abs(), self.shear_end);
        if angle <= end {
            return self.shear.energy(angle.sin());
        }
        if angle >= SHEAR_LIMIT {
            return f64::INFINITY;
        }
        let left = SHEAR_LIMIT - end;
        let pole = self.shear.load(end.sin()) * end.cos() * left * left;
        self.shear.energy(end.sin()) + pole * (1.0 / (SHEAR_LIMIT - angle) - 1.0 / left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORK: BreenWork = BreenWork {
        bending: Piecewise { slope: 1.2e-5, intercept: 6e-4, knot: 70.0 },
        shear: Piecewise { slope: 33.0, intercept: 0.6, knot: 0.02 },
        shear_end: 0.14,
    };

    /// Simpson's rule on pieces, exact for the cubics here.
    fn integral(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
        const PIECES: usize = 20_000;
        let h = (to - from) / PIECES as f64;
        let at = |i: usize| from + h * i as f64;
        let piece = |i: usize| h / 6.0 * (f(at(i)) + 4.0 * f(at(i) + 0.5 * h) + f(at(i + 1)));
        (0..PIECES).map(piece).sum()
    }

    /// Derivatives from below and from above, by one-sided differences of second order.
    fn sides(f: impl Fn(f64) -> f64, at: f64, h: f64) -> [f64; 2] {
        let below = (3.0 * f(at) - 4.0 * f(at - h) + f(at - 2.0 * h)) / (2.0 * h);
        let above = (-3.0 * f(at) + 4.0 * f(at + h) - f(at + 2.0 * h)) / (2.0 * h);
        [below, above]
    }

    fn assert_smooth(f: impl Fn(f64) -> f64, at: f64, what: &str) {
        let h = 1e-5 * at;
        let jump = (f(at * (1.0 + 1e-13)) - f(at)).abs() / f(at).abs();
        assert!(jump < 1e-11, "{what} jumps by {jump:e}");
        let [below, above] = sides(&f, at, h);
        // Rounding of 1e-16 over steps of 1e-5, and a formula that errs by the step squared.
        assert!((below / above - 1.0).abs() < 1e-7, "{what}: slope {below} and {above}");
    }

    #[test]
    fn curvature_meets_its_continuation_and_grows_without_end_when_folded() {
        let curvature = |angle: f64| breen_curvature(0.005, angle);
        assert_smooth(curvature, FRAC_PI_4, "curvature");
        assert!(curvature(std::f64::consts::PI).abs() < 1e-10);
        assert!((curvature(FRAC_PI_4) * 0.005 - 1.8478).abs() < 1e-4);
        let angles = [3.0, 2.0, 1.0, 0.7, 0.3, 0.1, 1e-3, 1e-6];
        let rises = angles.windows(2).all(|pair| curvature(pair[1]) > curvature(pair[0]));
        assert!(rises && curvature(1e-9) > 1e10);
    }

    #[test]
    fn loads_and_work_are_smooth_where_their_pieces_meet() {
        let BreenWork { bending, shear, shear_end } = WORK;
        assert_smooth(|k| bending.load(k), bending.knot, "moment");
        assert_smooth(|s| shear.load(s), shear.knot, "force");
        assert_smooth(|k| bending.energy(k), bending.knot, "bending work");
        assert_smooth(|angle| WORK.shearing(angle), shear.knot.asin(), "shearing work");
        assert_smooth(|angle| WORK.shearing(angle), shear_end, "shearing work at the end");
        assert_smooth(|angle| WORK.bending(0.005, angle), FRAC_PI_4, "bending work of a fold");
    }

    #[test]
    fn work_is_the_integral_of_the_load() {
        let BreenWork { bending, shear, .. } = WORK;
        for angle in [3.1, 2.8, 2.0, 1.0, 0.5, 0.1] {
            let curvature = breen_curvature(0.005, angle);
            let exact = integral(|k| bending.load(k), 0.0, curvature);
            let error = (WORK.bending(0.005, angle) / exact - 1.0).abs();
            assert!(error < 1e-9, "angle {angle}: off by {error}");
        }
        for angle in [0.01, 0.05, 0.1, 0.14] {
            let exact = integral(|phi| shear.load(phi.sin()) * phi.cos(), 0.0, angle);
            let error = (WORK.shearing(angle) / exact - 1.0).abs();
            assert!(error < 1e-9, "shear {angle}: off by {error}");
        }
    }

    #[test]
    fn no_shear_passes_the_limit() {
        let angles = [0.14, 0.3, 0.6, 0.9, 1.0, 1.04, 1.0499];
        let work = angles.map(|angle| WORK.shearing(angle));
        assert!(work.windows(2).all(|pair| pair[1] > pair[0]), "{work:?}");
        assert!(work[6] > 100.0 * work[4] && WORK.shearing(1.05).is_infinite(), "{work:?}");
        assert_eq!(WORK.shearing(-0.6), WORK.shearing(0.6));
    }
}
