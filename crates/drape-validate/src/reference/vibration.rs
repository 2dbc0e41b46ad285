//! Vibrations of hanging strips and pendulums: modes, periods and swings.
//!
//! Modes of a chain are zeros of a Bessel function \[Ber38\]. Modes of a strip with bending
//! rigidity come from cubic finite elements. The period of a pendulum is an arithmetic–geometric
//! mean \[Gau99\].

use std::f64::consts::TAU;

use nalgebra::{DMatrix, SymmetricEigen};

use super::runge_kutta::trajectory;

/// Angular frequencies of the swinging modes of a chain of length `$L$` that hangs from one end,
/// over `$\sqrt{g/L}$`: half the zeros of the Bessel function `$J_0$` \[Ber38\].
pub const CHAIN_MODES: [f64; 3] = [1.202_412_778_848, 2.760_039_055_143, 4.326_863_956_455];

/// Elements along the hanging strip. With this number the lowest frequencies are right to a
/// millionth for a rigidity of 1e-6 and above.
const ELEMENTS: usize = 60;

/// Points and weights of Gauss's integration on 0 … 1, exact to the seventh power.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Returns the `count` lowest angular frequencies, over `$\sqrt{g/L}$`, of a strip that hangs from
/// a clamp and has bending rigidity. `rigidity` is `$\beta = B/(wL^3)$`, a ratio.
///
/// The modes solve
///
/// ```math
/// \beta\,y'''' - \left((1-x)\,y'\right)' = \omega^2 y,\qquad y(0)=y'(0)=0,\quad y''(1)=y'''(1)=0
/// ```
///
/// The equation is discretised by cubic finite elements.
#[must_use]
pub fn strip_modes(rigidity: f64, count: usize) -> Vec<f64> {
    // Elements are shorter towards the clamp, where a limp strip bends within √β of its length.
    fn node(i: usize) -> f64 {
        (i as f64 / ELEMENTS as f64).powi(2)
    }

    // The two matrices are integrated element by element.
    let size = 2 * (ELEMENTS + 1);
    let mut stiffness = DMatrix::<f64>::zeros(size, size);
    let mut mass = DMatrix::<f64>::zeros(size, size);
    for element in 0..ELEMENTS {
        let h = node(element + 1) - node(element);
        for (part, weight) in GAUSS {
            let tension = 1.0 - node(element) - part * h;
            let [value, slope, bend] = cubic(part, h);
            for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
                let at = (2 * element + i, 2 * element + j);
                let elastic = rigidity * bend[i] * bend[j] + tension * slope[i] * slope[j];
                stiffness[at] += weight * h * elastic;
                mass[at] += weight * h * value[i] * value[j];
            }
        }
    }

    // The clamp holds the first deflection and the first slope.
    let free = size - 2;
    let stiffness = stiffness.view((2, 2), (free, free)).into_owned();
    let mass = mass.view((2, 2), (free, free)).into_owned();

    // With the factor L of the mass, L⁻¹KL⁻ᵀ is symmetric and has the squares as eigenvalues.
    let lower = mass.cholesky().expect("the mass of elements is positive").l();
    let half = lower.solve_lower_triangular(&stiffness).expect("its diagonal is positive");
    let whole = lower.solve_lower_triangular(&half.transpose()).expect("its diagonal is positive");
    let symmetric = 0.5 * (&whole + whole.transpose());
    let eigen = SymmetricEigen::new(symmetric);
    let mut squares: Vec<f64> = eigen.eigenvalues.iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares.into_iter().take(count).map(|square| square.max(0.0).sqrt()).collect()
}

/// Returns values, slopes and curvatures of the cubics that belong to deflection and slope of both
/// ends of an element of length `h`, at the part `t` of its length.
fn cubic(t: f64, h: f64) -> [[f64; 4]; 3] {
    let value = [
        (1.0 + 2.0 * t) * (1.0 - t).powi(2),
        h * t * (1.0 - t).powi(2),
        t * t * (3.0 - 2.0 * t),
        h * t * t * (t - 1.0),
    ];
    let slope = [
        6.0 * t * (t - 1.0) / h,
        (1.0 - t) * (1.0 - 3.0 * t),
        6.0 * t * (1.0 - t) / h,
        t * (3.0 * t - 2.0),
    ];
    let bend = [
        (12.0 * t - 6.0) / (h * h),
        (6.0 * t - 4.0) / h,
        (6.0 - 12.0 * t) / (h * h),
        (6.0 * t - 2.0) / h,
    ];
    [value, slope, bend]
}

/// Returns the period of a pendulum that swings to `amplitude` (in rad), over the period of small
/// swings.
///
/// ```math
/// T/T_0 = 1/\mathrm{agm}\left(1, \cos\tfrac{\alpha}{2}\right)
/// ```
///
/// with the arithmetic–geometric mean \[Gau99\].
#[must_use]
pub fn pendulum_period(amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    1.0 / a
}

/// Returns the swing of a pendulum that is released at `amplitude` (in rad): time over the period
/// of small swings, and angle in rad, after each of `steps` equal parts of `periods` such periods.
///
/// The swing is an integral of `$\theta'' = -\sin\theta$`.
#[must_use]
pub fn pendulum_swing(amplitude: f64, periods: f64, steps: usize) -> Vec<[f64; 2]> {
    let end = periods * TAU;
    let swing =
        trajectory(|_, [angle, rate]| [rate, -f64::sin(angle)], [amplitude, 0.0], end, steps);
    let later =
        swing.enumerate().map(|(k, [angle, _])| [periods * (k + 1) as f64 / steps as f64, angle]);
    std::iter::once([0.0, amplitude]).chain(later).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stiff_strip_swings_as_a_cantilever() {
        // cos(k)·cosh(k) = −1: k² = 3.51602, 22.0345; the weight adds little.
        let rigidity = 1e6;
        let modes = strip_modes(rigidity, 2);
        for (mode, exact) in modes.iter().zip([3.516_015_27, 22.034_491_6]) {
            assert!((mode / rigidity.sqrt() / exact - 1.0).abs() < 1e-6, "{mode} for {exact}");
        }
    }

    #[test]
    fn a_limp_strip_swings_as_a_chain_shortened_at_its_clamp() {
        // A clamp takes √(B/T) of the length of a string under tension: here √β.
        // What bending adds elsewhere is of the order of β and of the fourth power of the mode.
        let rigidity: f64 = 1e-6;
        let shorter = 1.0 - rigidity.sqrt();
        let modes = strip_modes(rigidity, 2);
        for (mode, chain) in modes.iter().zip(CHAIN_MODES) {
            let expected = chain / shorter.sqrt();
            assert!((mode / expected - 1.0).abs() < 2e-4, "{mode} for {expected}");
        }
    }

    #[test]
    fn the_modes_of_a_chain_are_half_the_zeros_of_bessels_function() {
        // J₀(2ω) = Σ (−ω²)ᵏ/k!².
        for omega in CHAIN_MODES {
            let (mut sum, mut term) = (0.0, 1.0);
            for k in 1..60 {
                sum += term;
                term *= -omega * omega / f64::from(k * k);
            }
            assert!(f64::abs(sum) < 1e-10, "J₀ is {sum:e} at {omega}");
        }
    }

    #[test]
    fn a_pendulum_is_back_after_its_period() {
        let amplitude = 90f64.to_radians();
        let swing = pendulum_swing(amplitude, pendulum_period(amplitude), 4000);
        let [half, whole] = [2000, 4000].map(|k| swing[k][1]);
        assert!((half + amplitude).abs() < 1e-9 && (whole - amplitude).abs() < 1e-9);
    }

    #[test]
    fn a_pendulum_slows_with_its_amplitude() {
        // 1 + α²/16 + 11 α⁴/3072 + 173 α⁶/737280, to the eighth order.
        let alpha: f64 = 30f64.to_radians();
        let series = 1.0
            + alpha.powi(2) / 16.0
            + 11.0 * alpha.powi(4) / 3072.0
            + 173.0 * alpha.powi(6) / 737_280.0;
        assert!((pendulum_period(alpha) - series).abs() < 1e-6);
        assert!((pendulum_period(90f64.to_radians()) - 1.180_340_599).abs() < 1e-8);
    }
}
