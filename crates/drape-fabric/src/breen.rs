//! Work curves of Breen, House & Wozny, derived from the laws of a fabric. The particles after
//! Breen in `drape-cloth` evaluate these curves.

use std::f64::consts::FRAC_PI_4;

use drape_hysteresis::BlimanSorine;

use crate::laws::bending::{BendingBackbone, BendingLaw};
use crate::laws::piecewise::Piecewise;
use crate::laws::shear::{Locking, ShearBackbone, ShearLaw};
use crate::laws::varying::Varying;

/// Shear angle of the pole of the work, in rad. The pole keeps the shear below about 60°.
const SHEAR_LIMIT: f64 = 1.05;

/// Returns the curvature of three particles with the mean `spacing` `$h$`, in m, and the inner
/// `angle` `$\theta$` between their segments, in rad (`$\pi$` if straight), in 1/m \[BHW94, eq.
/// 5.5\].
///
/// ```math
/// K = \frac2h\cos\frac\theta2\;(\theta > \tfrac\pi4), \qquad
/// K = \left(\frac\pi4\right)^2\frac{\beta}{\theta} + \alpha - \frac\pi4\beta
/// \;(\theta \le \tfrac\pi4)
/// ```
///
/// with `$\alpha = \frac2h\cos\frac\pi8$` and `$\beta = \frac1h\sin\frac\pi8$`. With the signs
/// printed in the paper the curvature would fall to `$-\infty$` at small angles, with a jump of the
/// slope at `$\pi/4$`. With the signs of this formula the curvature rises to `$+\infty$`, and value
/// and slope are continuous.
#[must_use]
pub fn breen_curvature(spacing: f64, angle: f64) -> f64 {
    if angle > FRAC_PI_4 {
        return 2.0 / spacing * (0.5 * angle).cos();
    }
    let half = 0.5 * FRAC_PI_4;
    let (alpha, beta) = (2.0 / spacing * half.cos(), half.sin() / spacing);
    FRAC_PI_4 * FRAC_PI_4 * beta / angle + alpha - FRAC_PI_4 * beta
}

/// Work of bending and shearing per area, from a quadratic and a line for each \[BHW94, §5\].
///
/// Eq. 5.4 of the paper has the work of a bent beam, `$MK/2$`. This work is right only for a moment
/// proportional to the curvature: cloth with this work would not reproduce the measured moment. The
/// work in this struct is `$\int M\,\mathrm{d}K$`, like the work of shearing in the paper.
///
/// ```
/// use drape_fabric::{
///     BendingBackbone, BendingLaw, BlimanSorine, BreenWork, ShearBackbone, ShearLaw,
/// };
///
/// let rigidity = 1.2e-5;
/// let bending = BendingLaw {
///     backbone: BendingBackbone::Linear { rigidity },
///     rest_curvature: 0.0,
///     friction: BlimanSorine::none(),
/// };
/// let shear = ShearLaw {
///     backbone: ShearBackbone::Linear { stiffness: 35.0 },
///     friction: BlimanSorine::none(),
///     growth: 0.0,
///     locking: None,
/// };
/// let work = BreenWork::from_laws(&bending, &shear);
/// // Without friction the work of bending is ½BK².
/// let curvature = drape_fabric::breen_curvature(0.005, 3.0);
/// let exact = 0.5 * rigidity * curvature * curvature;
/// assert!((work.bending(0.005, 3.0) / exact - 1.0).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BreenWork {
    /// Moment per width against curvature, from the first branch of a bending test.
    pub bending: Piecewise,
    /// Force per length against the sine of the shear angle, from the first branch of a shear test.
    pub shear: Piecewise,
    /// Shear angle at which the test ends and the continuation with a pole begins, in rad, below
    /// 1.05.
    pub shear_end: f64,
}

/// Work per area at a deformation and its derivatives with respect to the deformation.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Work {
    /// Work, in J/m².
    pub work: f64,
    /// First derivative, in J/m² per deformation.
    pub first: f64,
    /// Second derivative, in J/m² per deformation squared.
    pub second: f64,
}

impl BreenWork {
    /// Returns the work curves of the first branches of `bending` and `shear`, the loads of a
    /// fabric that was never deformed.
    ///
    /// The line of a curve is the backbone plus the plateau of the friction. The knot is chosen so
    /// that the work beyond the knot equals the work of the law. If the friction overshoots its
    /// plateau, no quadratic has this work, and the knot follows from the fast element alone. The
    /// curves are even: a rest curvature is ignored.
    #[must_use]
    pub fn from_laws(bending: &BendingLaw, shear: &ShearLaw) -> Self {
        let backbone = match bending.backbone {
            BendingBackbone::Linear { rigidity } => Asymptote::line(rigidity),
            BendingBackbone::Varying(varying) => Asymptote::varying(&varying),
            BendingBackbone::Piecewise(piecewise) => Asymptote::piecewise(&piecewise),
        };
        let bending = branch(backbone, &bending.friction, 0.0);
        let backbone = match shear.backbone {
            ShearBackbone::Linear { stiffness } => Asymptote::line(stiffness),
            ShearBackbone::Varying(varying) => Asymptote::varying(&varying),
            ShearBackbone::Piecewise(piecewise) => Asymptote::piecewise(&piecewise),
        };
        let end = shear.locking.unwrap_or_default().onset.min(Locking::default().limit);
        Self {
            bending,
            shear: branch(backbone, &shear.friction, shear.growth),
            shear_end: end.asin().min(0.95 * SHEAR_LIMIT),
        }
    }

    /// Returns the work of bending segments with the given `spacing`, in m, to an inner `angle`, in
    /// rad: `$\int_0^K M\,\mathrm{d}K$`, in J/m².
    #[must_use]
    pub fn bending(&self, spacing: f64, angle: f64) -> f64 {
        self.bending.energy(breen_curvature(spacing, angle))
    }

    /// Returns the work of shearing to `angle`, in rad, in J/m².
    ///
    /// Up to the end of the test the work is `$\int_0^\varphi F\cos\varphi\,\mathrm{d}\varphi$`
    /// \[BHW94, eq. 5.7\]. Beyond the end it is `$a/(1.05-\varphi)+b$`, with continuous value and
    /// slope. From 1.05 rad it is infinite.
    #[must_use]
    pub fn shearing(&self, angle: f64) -> f64 {
        let (angle, end) = (angle.abs(), self.shear_end);
        if angle <= end {
            return self.shear.energy(angle.sin());
        }
        if angle >= SHEAR_LIMIT {
            return f64::INFINITY;
        }
        let span = SHEAR_LIMIT - end;
        let pole = self.shear.load(end.sin()) * end.cos() * span * span;
        self.shear.energy(end.sin()) + pole * (1.0 / (SHEAR_LIMIT - angle) - 1.0 / span)
    }

    /// Returns the work of bending segments with the given `spacing`, in m, as a function of
    /// `chord`.
    ///
    /// The chord is the length of the difference of the unit directions of two segments,
    /// `$2\cos\frac\theta2$` for the inner angle `$\theta$`: 0 for a straight yarn, 2 for a folded
    /// yarn.
    #[must_use]
    pub fn at_chord(&self, spacing: f64, chord: f64) -> Work {
        let [curvature, first, second] = curvature_of_chord(spacing, chord);
        let (moment, rigidity) = (self.bending.load(curvature), self.bending.tangent(curvature));
        Work {
            work: self.bending.energy(curvature),
            first: moment * first,
            second: rigidity * first * first + moment * second,
        }
    }

    /// Returns the work of shearing as a function of the `sine` of the angle. The work is even.
    #[must_use]
    pub fn at_sine(&self, sine: f64) -> Work {
        let (size, end) = (sine.abs(), self.shear_end);
        let (onset, limit) = (end.sin(), SHEAR_LIMIT.sin());
        let (first, second) = if size <= onset {
            (self.shear.load(size), self.shear.tangent(size))
        } else if size < limit {
            let angle = size.asin();
            let (cosine, remaining) = (angle.cos(), SHEAR_LIMIT - angle);
            let pole = self.shear.load(onset) * end.cos() * (SHEAR_LIMIT - end).powi(2);
            let [first, second] = [pole / remaining.powi(2), 2.0 * pole / remaining.powi(3)];
            (first / cosine, (second + first * size / cosine) / cosine.powi(2))
        } else {
            (f64::INFINITY, f64::INFINITY)
        };
        let work = if size < limit { self.shearing(size.min(1.0).asin()) } else { f64::INFINITY };
        Work { work, first: first * sine.signum(), second }
    }
}

/// Returns the curvature at `chord` and its first two derivatives \[BHW94, eq. 5.5\].
fn curvature_of_chord(spacing: f64, chord: f64) -> [f64; 3] {
    let half = 0.5 * chord;
    // cos(θ/2) at θ = π/4.
    if half <= (0.5 * FRAC_PI_4).cos() {
        return [chord / spacing, 1.0 / spacing, 0.0];
    }
    let angle = 2.0 * half.min(1.0).acos();
    let (sine, cosine) = (0.5 * angle).sin_cos();
    let size = FRAC_PI_4 * FRAC_PI_4 * (0.5 * FRAC_PI_4).sin() / spacing;
    let first = size / (angle * angle * sine);
    let second = first * (2.0 / (angle * sine) + 0.5 * cosine / (sine * sine));
    [breen_curvature(spacing, angle), first, second]
}

/// Line to which a curve tends, and the work of the line less the work of the curve.
#[derive(Debug, Clone, Copy)]
struct Asymptote {
    slope: f64,
    intercept: f64,
    deficit: f64,
}

impl Asymptote {
    /// Returns the asymptote of a line through the origin with `slope`: the line itself.
    fn line(slope: f64) -> Self {
        Self { slope, intercept: 0.0, deficit: 0.0 }
    }

    /// Returns the asymptote of a quadratic and a line: the line.
    fn piecewise(curve: &Piecewise) -> Self {
        let Piecewise { slope, intercept, knot } = *curve;
        Self { slope, intercept, deficit: intercept * knot / 3.0 }
    }

    /// Returns the asymptote of a `curve` with varying stiffness: a line with the final stiffness.
    ///
    /// The line exceeds the load by `$(k_0 - k_\infty)(q_t - q/\sqrt{1 + (q/q_t)^2})$`. The
    /// integral of this difference over all deformations is `$(k_0 - k_\infty)\,q_t^2$`.
    fn varying(curve: &Varying) -> Self {
        let Varying { initial_stiffness, final_stiffness, transition } = *curve;
        let intercept = (initial_stiffness - final_stiffness) * transition;
        Self { slope: final_stiffness, intercept, deficit: intercept * transition }
    }
}

/// Returns the first branch of a law with the given `backbone`, `friction`, and `growth` of the
/// plateau.
///
/// Along this branch an element of plateau `$F$`, length `$\ell$` and growth `$\gamma$` has the
/// load `$F(1 + \gamma(s - \ell)) - F(1 - \gamma\ell)e^{-s/\ell}$`.
fn branch(backbone: Asymptote, friction: &BlimanSorine, growth: f64) -> Piecewise {
    let Asymptote { mut slope, mut intercept, mut deficit } = backbone;
    for element in &friction.elements {
        let outer = element.plateau * (1.0 - growth * element.length);
        slope += element.plateau * growth;
        intercept += outer;
        deficit += outer * element.length;
    }
    let fast = 3.0 * friction.elements[0].length;
    let knot = 3.0 * deficit / intercept;
    let knot = if knot > 0.0 && knot.is_finite() { knot } else { fast };
    Piecewise { slope, intercept: intercept.max(-0.5 * slope * knot), knot }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Law;

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
    fn work_by_chord_and_by_sine_is_that_by_angle() {
        let spacing = 0.005;
        for angle in [3.1, 2.5, 1.2, 0.79, 0.78, 0.5, 0.1] {
            let chord = 2.0 * f64::cos(0.5 * angle);
            let work = WORK.at_chord(spacing, chord).work;
            let exact = WORK.bending(spacing, angle);
            // Near a fold the angle is the root of a small difference.
            assert!((work / exact - 1.0).abs() < 1e-11, "{work} and {exact} at {angle}");
        }
        for angle in [-1.0, -0.3, -0.1, 0.0, 0.01, 0.14, 0.2, 1.04] {
            let (work, exact) = (WORK.at_sine(f64::sin(angle)).work, WORK.shearing(angle));
            assert!((work - exact).abs() <= 1e-12 * exact, "{work} and {exact} at {angle}");
        }
        assert!(
            WORK.at_sine(0.868).work.is_infinite() && WORK.at_sine(-0.9).first == f64::NEG_INFINITY
        );
    }

    #[test]
    fn derivatives_of_the_work_are_its_derivatives() {
        let check = |work: &dyn Fn(f64) -> Work, at: f64, scale: f64| {
            let h = 1e-5 * scale;
            let Work { first, second, .. } = work(at);
            let slope = (work(at + h).work - work(at - h).work) / (2.0 * h);
            let bend = (work(at + h).first - work(at - h).first) / (2.0 * h);
            let size = second.abs() * scale;
            assert!((slope - first).abs() < 1e-7 * size, "{slope} and {first} at {at}");
            assert!((bend - second).abs() < 1e-6 * second.abs(), "{bend} and {second} at {at}");
        };
        for chord in [0.01, 0.3, 1.0, 1.8, 1.9, 1.99] {
            check(&|chord| WORK.at_chord(0.005, chord), chord, 2.0 - chord);
        }
        for sine in [-0.8, -0.2, -0.1, 0.005, 0.05, 0.3, 0.6, 0.85] {
            check(&|sine| WORK.at_sine(sine), sine, 0.867 - f64::abs(sine));
        }
    }

    #[test]
    fn the_first_branch_of_a_law_has_its_load_far_out_and_its_work() {
        let friction = BlimanSorine::first_order(6e-4, 4.0).expect("a friction");
        let law = BendingLaw {
            backbone: BendingBackbone::Linear { rigidity: 1.2e-5 },
            rest_curvature: 0.0,
            friction,
        };
        let shear = ShearLaw {
            backbone: ShearBackbone::Linear { stiffness: 30.0 },
            friction: BlimanSorine::first_order(0.4, 0.004).expect("a friction"),
            growth: 6.0,
            locking: Some(Locking::default()),
        };
        let found = BreenWork::from_laws(&law, &shear);
        // Beyond the knot the load is the law's to the exponential's tail, and so is the work.
        let (virgin, far) = (law.virgin(), 150.0);
        let (load, work) = (law.respond(&virgin, far).load, law.work(&virgin, far));
        assert!((found.bending.load(far) / load - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.bending.energy(far) / work - 1.0).abs() < 1e-12, "{found:?}");
        let (virgin, far) = (shear.virgin(), 0.13);
        let (load, work) = (shear.respond(&virgin, far).load, shear.work(&virgin, far));
        assert!((found.shear.load(far) / load - 1.0).abs() < 1e-9, "{found:?}");
        assert!((found.shear.energy(far) / work - 1.0).abs() < 1e-9, "{found:?}");
        assert!((found.shear_end - 8_f64.to_radians()).abs() < 1e-12);
        // A curve that is Breen's already stays what it is.
        let again = BendingLaw {
            backbone: BendingBackbone::Piecewise(found.bending),
            friction: BlimanSorine::none(),
            ..law
        };
        let twice = BreenWork::from_laws(&again, &shear).bending;
        assert!((twice.knot / found.bending.knot - 1.0).abs() < 1e-12, "{twice:?}");
        // Friction that overshoots has a knot all the same.
        let stiction = BlimanSorine::second_order(6e-4, 5e-4, 0.1, 4.0).expect("a friction");
        let found = BreenWork::from_laws(&BendingLaw { friction: stiction, ..law }, &shear).bending;
        assert!(found.knot > 0.0 && found.intercept > 0.0, "{found:?}");
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
