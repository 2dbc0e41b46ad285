//! Exponential function without branches, for the SIMD loops of the prepared elements.

/// Returns `$e^x - 1$` for `$x \le 0$`, without branches, so that a loop over it is vectorised.
///
/// With `$x = k\ln 2 + r$` and `$|r| \le \tfrac12\ln 2$` the result is
/// `$2^k(e^r - 1) + (2^k - 1)$`. The Taylor polynomial of order 13 has an error of at most
/// `$2\times10^{-17}$` of `$e^r - 1$`. The relative error of the result is below
/// `$5\times10^{-16}$`, also near zero. The result for NaN is NaN.
#[inline(always)]
#[must_use]
pub fn exp_m1(x: f64) -> f64 {
    /// Argument below which the result is −1 to the last bit.
    const LEAST: f64 = -40.0;
    /// 1.5 · 2⁵² plus the bias of an exponent. A number plus 1.5 · 2⁵² has the rounded number in
    /// its last bits.
    const ROUNDER: f64 = 6_755_399_441_055_744.0 + 1023.0;
    /// High part of the natural logarithm of 2. It ends in enough zeros that `k` times it is exact.
    const LN_2_HIGH: f64 = 0.693_147_180_369_123_8;
    /// Low part of the natural logarithm of 2.
    const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

    // `f64::max` would replace NaN by `LEAST`.
    let x = if x < LEAST { LEAST } else { x };
    let shifted = x * std::f64::consts::LOG2_E + ROUNDER;
    let k = shifted - ROUNDER;
    let r = (x - k * LN_2_HIGH) - k * LN_2_LOW;
    let power = f64::from_bits(shifted.to_bits() << 52);

    // The coefficients are 1/2!, 1/3!, …. Even and odd powers are summed separately, so that the
    // processor computes the two sums in parallel.
    let s = r * r;
    let even = 1.0 / 2.0
        + s * (1.0 / 24.0
            + s * (1.0 / 720.0
                + s * (1.0 / 40_320.0 + s * (1.0 / 3_628_800.0 + s * (1.0 / 479_001_600.0)))));
    let odd = 1.0 / 6.0
        + s * (1.0 / 120.0
            + s * (1.0 / 5_040.0
                + s * (1.0 / 362_880.0 + s * (1.0 / 39_916_800.0 + s * (1.0 / 6_227_020_800.0)))));
    let part = r + s * (even + r * odd);
    power * part + (power - 1.0)
}

#[cfg(test)]
mod tests {
    use super::exp_m1;

    #[test]
    fn it_is_the_function_of_the_mathematics_library() {
        // Every binary order of magnitude from 1e-300 to 1000, at 200 places each.
        let mut worst = 0.0_f64;
        for order in -1000..10 {
            for place in 0..200 {
                let x = -(1.0 + f64::from(place) / 200.0) * 2_f64.powi(order);
                let (found, exact) = (exp_m1(x), x.exp_m1());
                worst = worst.max((found / exact - 1.0).abs());
            }
        }
        println!("relative error {worst:.1e}");
        assert!(worst < 5e-16, "relative error {worst:e}");
    }

    #[test]
    fn the_ends_of_its_range_are_exact() {
        assert_eq!(exp_m1(0.0), 0.0);
        assert_eq!(exp_m1(-1e9), -1.0);
        assert_eq!(exp_m1(f64::NEG_INFINITY), -1.0);
        assert!(exp_m1(f64::NAN).is_nan());
    }
}
