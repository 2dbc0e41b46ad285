//! EM, WT, LT and RT of a tensile curve, in SI.

use crate::curves::curve::Curve;
use crate::error::Error;
use crate::test::Test;

/// KES values of a tensile curve, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TensileValues {
    /// Largest load, per width; in N/m.
    pub maximum_tension: f64,
    /// EM: strain at the largest load, a ratio.
    pub extension: f64,
    /// WT: work per area up to the largest load, in J/m².
    pub work: f64,
    /// LT: work over the work of a straight line to the largest load, a ratio.
    pub linearity: f64,
    /// RT: work recovered down to zero load over the work spent, a ratio; `None` without recovery.
    pub resilience: Option<f64>,
}

impl Curve {
    /// Reads EM, WT, LT and RT from the first cycle of a tensile curve \[Kaw80\].
    ///
    /// ```math
    /// W = \int_0^{\varepsilon_m} F\,d\varepsilon,\qquad
    /// LT = \frac{W}{\tfrac12 F_m\varepsilon_m},\qquad
    /// RT = \frac1W\int_{\varepsilon_m}^{F=0} F\,d\varepsilon
    /// ```
    ///
    /// Strain counts from the first point, and the integrals are trapezoids between points.
    ///
    /// # Errors
    /// The curve is of another test, or its first branch does not rise.
    pub fn tensile_values(&self) -> Result<TensileValues, Error> {
        if self.test != Test::Tensile {
            let (given, needed) = (self.test.name(), Test::Tensile.name());
            return Err(Error::WrongTest { given, needed });
        }
        let branches = self.branches();
        let (strain, load) = (self.deformation(), self.load());
        let first = strain[0];
        let Some(loading) = branches.first().filter(|branch| branch.rising) else {
            let range = self.deformation_range();
            return Err(Error::OutOfRange { deformation: first, low: range.low, high: range.high });
        };

        let top = loading.points.end - 1;
        let (maximum_tension, extension) = (load[top], strain[top] - first);
        let work = work(&strain[..=top], &load[..=top]);
        let resilience = branches.get(1).map(|recovery| {
            let (strain, load) = (&strain[recovery.points.clone()], &load[recovery.points.clone()]);
            recovered_work(strain, load) / work
        });
        let linearity = work / (0.5 * maximum_tension * extension);
        Ok(TensileValues { maximum_tension, extension, work, linearity, resilience })
    }
}

/// Returns the work done on the fabric along the points of `strain` and `load`, by trapezoids.
fn work(strain: &[f64], load: &[f64]) -> f64 {
    strain.windows(2).zip(load.windows(2)).map(|(q, f)| 0.5 * (f[0] + f[1]) * (q[1] - q[0])).sum()
}

/// Returns the work recovered along the points of `strain` and `load` until the load first reaches
/// zero.
fn recovered_work(strain: &[f64], load: &[f64]) -> f64 {
    let slack = load.iter().position(|&load| load <= 0.0);
    let Some(end) = slack.filter(|&end| end > 0) else {
        return -work(strain, load);
    };
    // The last trapezoid is the triangle down to zero load.
    let part = load[end - 1] / (load[end - 1] - load[end]);
    let triangle = 0.5 * load[end - 1] * part * (strain[end - 1] - strain[end]);
    triangle - work(&strain[..end], &load[..end])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test::Direction;

    fn tensile(points: impl Iterator<Item = (f64, f64)>) -> Curve {
        let (strain, load) = points.unzip();
        Curve::new(Test::Tensile, Direction::Warp, strain, load).unwrap()
    }

    /// Trapezoids on `n` steps of a quadratic err by W''h²/12 relative to the work: 1/(2n²) at most
    /// here.
    const STEPS: usize = 4000;
    const TRAPEZOID: f64 = 1.0 / (STEPS * STEPS) as f64;

    #[test]
    fn a_parabola_out_and_a_line_back_have_the_values_of_their_areas() {
        let (top, tension) = (0.05, 490.0);
        let n = STEPS as f64;
        let out = (0..=STEPS).map(|i| i as f64 / n).map(|x| (top * x, tension * x * x));
        // The recovery is a straight line that reaches zero at 60 % of the extension.
        let back = (1..=STEPS)
            .map(|i| 1.0 - i as f64 / n)
            .map(|x| (top * x, (tension * (x - 0.6) / 0.4).max(0.0)));
        let values = tensile(out.chain(back)).tensile_values().unwrap();
        assert_eq!((values.maximum_tension, values.extension), (tension, top));
        let work = (values.work / (tension * top / 3.0) - 1.0).abs();
        assert!(work < TRAPEZOID, "work off by {work}");
        let linearity = (values.linearity / (2.0 / 3.0) - 1.0).abs();
        assert!(linearity < TRAPEZOID, "linearity off by {linearity}");
        // Recovered: a triangle of height `tension` over 0.4 of the extension.
        let resilience = values.resilience.unwrap();
        assert!((resilience / 0.6 - 1.0).abs() < 2.0 * TRAPEZOID, "resilience {resilience}");
    }

    #[test]
    fn a_line_has_linearity_one_and_no_resilience_without_a_recovery() {
        let values = tensile((0..=10).map(|i| (0.001 * f64::from(i), f64::from(i))));
        let values = values.tensile_values().unwrap();
        assert!((values.linearity - 1.0).abs() < 1e-12, "{}", values.linearity);
        assert_eq!(values.resilience, None);
    }

    #[test]
    fn a_strip_that_gives_way_at_its_largest_strain_recovers_nothing() {
        let points = [(0.0, 0.0), (0.01, 5.0), (0.02, 0.0), (0.01, 0.0), (0.0, 0.0)];
        let values = tensile(points.into_iter()).tensile_values().unwrap();
        assert!((values.work - 0.05).abs() < 1e-15, "{}", values.work);
        assert_eq!(values.resilience, Some(0.0));
    }

    #[test]
    fn another_test_is_refused() {
        let curve =
            Curve::new(Test::Shear, Direction::Warp, vec![0.0, 0.1], vec![0.0, 1.0]).unwrap();
        assert!(matches!(curve.tensile_values(), Err(Error::WrongTest { .. })));
    }
}
