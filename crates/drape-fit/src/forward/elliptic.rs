//! Complete elliptic integrals by the arithmetic-geometric mean, for `arch`.

use std::f64::consts::FRAC_PI_2;

/// Iterations of the mean: it doubles its digits with each, so a handful is enough for any `$m$`.
const ITERATIONS: usize = 12;

/// Complete elliptic integrals of the first and second kind, `$K(m)$` and `$E(m)$` \[AS64, §17.6\].
pub(crate) struct CompleteIntegrals {
    pub(crate) k: f64,
    pub(crate) e: f64,
}

impl CompleteIntegrals {
    /// Computes both for `$0 \le m < 1$`, with `$m = k^2$`.
    pub(crate) fn new(m: f64) -> Self {
        let (mut a, mut b) = (1.0, (1.0 - m).sqrt());
        // E/K = 1 − Σ 2ⁿ⁻¹ cₙ², where c₀² = m and cₙ₊₁ = (aₙ − bₙ)/2.
        let (mut sum, mut weight) = (0.5 * m, 1.0);
        for _ in 0..ITERATIONS {
            let c = 0.5 * (a - b);
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
            sum += weight * c * c;
            weight *= 2.0;
            if c == 0.0 {
                break;
            }
        }
        let k = FRAC_PI_2 / a;
        Self { k, e: k * (1.0 - sum) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integrals_have_their_tabulated_values() {
        // Abramowitz & Stegun, table 17.1.
        let table = [
            (0.0, FRAC_PI_2, FRAC_PI_2),
            (0.5, 1.854_074_677_301_372, 1.350_643_881_047_675),
            (0.9, 2.578_092_113_348_173, 1.104_774_732_704_073),
        ];
        for (m, k, e) in table {
            let CompleteIntegrals { k: found_k, e: found_e } = CompleteIntegrals::new(m);
            assert!((found_k - k).abs() < 1e-14, "K({m}) = {found_k}");
            assert!((found_e - e).abs() < 1e-14, "E({m}) = {found_e}");
        }
    }

    #[test]
    fn legendres_relation_holds() {
        for i in 1..20 {
            let m = f64::from(i) / 20.0;
            let CompleteIntegrals { k, e } = CompleteIntegrals::new(m);
            let CompleteIntegrals { k: kc, e: ec } = CompleteIntegrals::new(1.0 - m);
            let relation = e * kc + ec * k - k * kc;
            assert!((relation - FRAC_PI_2).abs() < 1e-13, "m = {m}: {relation}");
        }
    }
}
