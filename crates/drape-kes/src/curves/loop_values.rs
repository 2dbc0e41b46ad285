//! G, 2HG, 2HG5, B and 2HB of a hysteresis loop, in SI.

use crate::curves::curve::Curve;
use crate::error::Error;
use crate::test::Test;

/// Curvatures at which B and 2HB are read. Laboratories differ, so the curvatures are settings.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BendingPoints {
    /// Curvatures between which B is the mean slope, in 1/m. The default is 0.5 and 1.5 cm⁻¹.
    pub slope: [f64; 2],
    /// Curvature at which 2HB is the width of the loop, in 1/m. The default is 1 cm⁻¹.
    pub width: f64,
}

impl Default for BendingPoints {
    /// Returns the points of the standard test.
    fn default() -> Self {
        Self { slope: [50.0, 150.0], width: 100.0 }
    }
}

/// Angles at which G, 2HG and 2HG5 are read.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ShearPoints {
    /// Angles between which G is the mean slope, in rad. The default is 0.5° and 2.5°.
    pub slope: [f64; 2],
    /// Angle at which 2HG is the width of the loop, in rad. The default is 0.5°.
    pub width: f64,
    /// Angle at which 2HG5 is the width of the loop, in rad. The default is 5°.
    pub wide: f64,
}

impl Default for ShearPoints {
    /// Returns the points of the standard test.
    fn default() -> Self {
        Self {
            slope: [0.5_f64.to_radians(), 2.5_f64.to_radians()],
            width: 0.5_f64.to_radians(),
            wide: 5.0_f64.to_radians(),
        }
    }
}

/// Part of the largest deformation of a side up to which values are read. At the tip of a loop the
/// branches meet.
const NEAR_TIP: f64 = 0.95;

/// KES values of a bending loop, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendingValues {
    /// B: bending rigidity per width, in N·m.
    pub rigidity: f64,
    /// 2HB: width of the loop, moment per width, in N.
    pub loop_width: f64,
}

/// KES values of a shear loop, in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearValues {
    /// G: shear stiffness, in N/(m·rad).
    pub stiffness: f64,
    /// 2HG: width of the loop at the small angle, in N/m.
    pub loop_width: f64,
    /// 2HG5: width of the loop at the large angle, in N/m.
    pub wide_loop_width: f64,
}

/// Loads at the last rising and the last falling passage of one deformation.
struct Passages {
    rising: f64,
    falling: f64,
}

impl Curve {
    /// Reads B and 2HB from a bending loop at `points` \[Kaw80\].
    ///
    /// Both values are read at ±κ and averaged over the sides of the loop. The slope is the slope
    /// of the line midway between the two branches. Friction does not change this slope after it
    /// has reached its plateau.
    ///
    /// # Errors
    /// The curve is of another test, or has no loop at one of `points`.
    pub fn bending_values(&self, points: &BendingPoints) -> Result<BendingValues, Error> {
        self.expect_test(Test::Bending)?;
        let rigidity = self.loop_slope(points.slope)?;
        let loop_width = self.loop_width(points.width)?;
        Ok(BendingValues { rigidity, loop_width })
    }

    /// Reads G, 2HG and 2HG5 from a shear loop at `points` \[Kaw80\].
    ///
    /// The values are read in the manner of [`bending_values`](Self::bending_values).
    ///
    /// # Errors
    /// The curve is of another test, or has no loop at one of `points`.
    pub fn shear_values(&self, points: &ShearPoints) -> Result<ShearValues, Error> {
        self.expect_test(Test::Shear)?;
        let stiffness = self.loop_slope(points.slope)?;
        let loop_width = self.loop_width(points.width)?;
        let wide_loop_width = self.loop_width(points.wide)?;
        Ok(ShearValues { stiffness, loop_width, wide_loop_width })
    }

    /// Returns the width of the loop at ±`deformation`, averaged over the sides of the loop, in the
    /// unit of the load.
    ///
    /// # Errors
    /// The curve does not pass `deformation` rising and falling on either side.
    pub fn loop_width(&self, deformation: f64) -> Result<f64, Error> {
        self.mean_of_sides(deformation, |side| {
            let Passages { rising, falling } = self.passages(side * deformation)?;
            Some(rising - falling)
        })
    }

    /// Returns the slope of the loop's middle line between the two deformations `between`, averaged
    /// over both sides.
    pub(crate) fn loop_slope(&self, between: [f64; 2]) -> Result<f64, Error> {
        self.mean_of_sides(between[1], |side| self.slope_of_side(between, side))
    }

    /// Returns the slopes of the loop's middle line between the two deformations `between`, on the
    /// positive and on the negative side. Returns `None` for half a loop.
    #[must_use]
    pub fn side_slopes(&self, between: [f64; 2]) -> Option<[f64; 2]> {
        Some([self.slope_of_side(between, 1.0)?, self.slope_of_side(between, -1.0)?])
    }

    /// Returns the slope of the loop's middle line between the two deformations `between`, on the
    /// `side` 1 or -1.
    fn slope_of_side(&self, between: [f64; 2], side: f64) -> Option<f64> {
        let [from, to] = between;
        Some(side * (self.middle_load(side * to)? - self.middle_load(side * from)?) / (to - from))
    }

    /// Returns the load of the loop's middle line at `deformation`.
    fn middle_load(&self, deformation: f64) -> Option<f64> {
        self.passages(deformation).map(|passages| 0.5 * (passages.rising + passages.falling))
    }

    /// Fails if the curve is not of `test`.
    fn expect_test(&self, test: Test) -> Result<(), Error> {
        if self.test == test {
            return Ok(());
        }
        Err(Error::WrongTest { given: self.test.name(), needed: test.name() })
    }

    /// Averages the `value` of a side, 1 or -1, over the sides of the loop that reach beyond
    /// `deformation`.
    fn mean_of_sides(
        &self,
        deformation: f64,
        value: impl Fn(f64) -> Option<f64>,
    ) -> Result<f64, Error> {
        let range = self.deformation_range();
        let sides: Vec<f64> = [(1.0, range.high), (-1.0, -range.low)]
            .into_iter()
            .filter(|(_, end)| deformation <= NEAR_TIP * end)
            .filter_map(|(side, _)| value(side))
            .collect();
        if sides.is_empty() {
            return Err(Error::OutOfRange { deformation, low: range.low, high: range.high });
        }
        Ok(sides.iter().sum::<f64>() / sides.len() as f64)
    }

    /// Returns the loads at the last rising and the last falling passage of `deformation`.
    ///
    /// The first cycle of a test starts from rest and is not closed, so the last passages are used.
    fn passages(&self, deformation: f64) -> Option<Passages> {
        let (q, load) = (self.deformation(), self.load());
        let (mut rising, mut falling) = (None, None);
        for branch in self.branches() {
            let mut steps = branch.points.start..branch.points.end - 1;
            let passage = steps.find(|&i| {
                (q[i] - deformation) * (q[i + 1] - deformation) <= 0.0 && q[i] != q[i + 1]
            });
            if let Some(i) = passage {
                let part = (deformation - q[i]) / (q[i + 1] - q[i]);
                let here = load[i] + part * (load[i + 1] - load[i]);
                *(if branch.rising { &mut rising } else { &mut falling }) = Some(here);
            }
        }
        Some(Passages { rising: rising?, falling: falling? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test::Direction;

    /// The steady loop of a linear spring beside a Dahl element, between ±`top`.
    struct Loop {
        stiffness: f64,
        plateau: f64,
        slope: f64,
        top: f64,
    }

    impl Loop {
        /// Load on the rising or falling branch of the steady loop: the exact solution of
        /// dF/dq = σ(1 ∓ F/Fc) between the tips ±Fc·tanh(σ·top/Fc).
        fn load(&self, q: f64, rising: bool) -> f64 {
            let sign = if rising { 1.0 } else { -1.0 };
            let rate = self.slope / self.plateau;
            let tip = self.plateau * (rate * self.top).tanh();
            let decay = (-rate * (self.top + sign * q)).exp();
            self.stiffness * q + sign * (self.plateau - (self.plateau + tip) * decay)
        }

        fn curve(&self, test: Test) -> Curve {
            let n = STEPS as f64;
            let up = (0..=STEPS).map(|i| (self.top * (2.0 * i as f64 / n - 1.0), true));
            let down = (1..=STEPS).map(|i| (self.top * (1.0 - 2.0 * i as f64 / n), false));
            let (q, load) = up.chain(down).map(|(q, rising)| (q, self.load(q, rising))).unzip();
            Curve::new(test, Direction::Warp, q, load).unwrap()
        }

        /// 2Fc·(1 − cosh(σq/Fc)/cosh(σ·top/Fc)).
        fn width(&self, q: f64) -> f64 {
            let rate = self.slope / self.plateau;
            2.0 * self.plateau * (1.0 - (rate * q).cosh() / (rate * self.top).cosh())
        }

        /// The middle line Kq + Fc·sinh(σq/Fc)/cosh(σ·top/Fc), half the sum of the two branches.
        fn middle(&self, q: f64) -> f64 {
            let rate = self.slope / self.plateau;
            self.stiffness * q + self.plateau * (rate * q).sinh() / (rate * self.top).cosh()
        }
    }

    /// Linear interpolation on this many steps errs by (σh/Fc)²/8 of the plateau at most: with
    /// σ·top/Fc = 12 and h = 2·top/STEPS that is 4.5e-8 of it.
    const STEPS: usize = 40_000;
    const INTERPOLATION: f64 = 5e-8;

    fn bending(friction_length: f64) -> Loop {
        let plateau = 6e-4;
        Loop { stiffness: 1.2e-5, plateau, slope: plateau / friction_length, top: 250.0 }
    }

    #[test]
    fn bending_values_obey_the_loop_identities() {
        // From friction that slips at once to friction still sticking at the end of the test.
        for friction_length in [250.0 / 12.0, 80.0, 250.0, 600.0] {
            let exact = bending(friction_length);
            let points = BendingPoints::default();
            let values = exact.curve(Test::Bending).bending_values(&points).unwrap();
            let width = (values.loop_width - exact.width(100.0)).abs() / exact.plateau;
            assert!(width < INTERPOLATION, "length {friction_length}: width off by {width}");
            let slope = (exact.middle(150.0) - exact.middle(50.0)) / 100.0;
            let error = (values.rigidity / slope - 1.0).abs();
            assert!(error < INTERPOLATION, "length {friction_length}: slope off by {error}");
        }
    }

    #[test]
    fn the_evaluation_points_are_settings() {
        let exact = bending(60.0);
        let points = BendingPoints { slope: [0.0, 100.0], width: 50.0 };
        let values = exact.curve(Test::Bending).bending_values(&points).unwrap();
        let width = (values.loop_width - exact.width(50.0)).abs() / exact.plateau;
        assert!(width < INTERPOLATION, "width off by {width}");
        let error = (values.rigidity / (exact.middle(100.0) / 100.0) - 1.0).abs();
        assert!(error < INTERPOLATION, "slope off by {error}");
    }

    #[test]
    fn shear_values_obey_the_loop_identities() {
        let top = 8.0_f64.to_radians();
        let plateau = 0.8;
        let exact = Loop { stiffness: 40.0, plateau, slope: plateau / (top / 10.0), top };
        let values = exact.curve(Test::Shear).shear_values(&ShearPoints::default()).unwrap();
        let degrees = f64::to_radians;
        for (found, at) in [(values.loop_width, 0.5), (values.wide_loop_width, 5.0)] {
            let error = (found - exact.width(degrees(at))).abs() / plateau;
            assert!(error < INTERPOLATION, "width at {at}° off by {error}");
        }
        let slope = (exact.middle(degrees(2.5)) - exact.middle(degrees(0.5))) / degrees(2.0);
        let error = (values.stiffness / slope - 1.0).abs();
        assert!(error < INTERPOLATION, "slope off by {error}");
    }

    #[test]
    fn a_test_that_starts_from_rest_gives_the_values_of_its_steady_loop() {
        // 0 → +top → −top → 0: each side is passed rising and falling, the positive one on the
        // first loading, when a short friction has reached its plateau by the first evaluation
        // point.
        let exact = bending(5.0);
        let n = 20_000;
        let at = |i: usize| exact.top * i as f64 / n as f64;
        let first = (0..=n).map(|i| {
            let q = at(i);
            let friction = exact.plateau * (1.0 - (-q / 5.0).exp());
            (q, exact.stiffness * q + friction)
        });
        let down = (1..=2 * n).map(|i| exact.top - at(i)).map(|q| (q, exact.load(q, false)));
        let up = (1..=n).map(|i| at(i) - exact.top).map(|q| (q, exact.load(q, true)));
        let (q, load) = first.chain(down).chain(up).unzip();
        let curve = Curve::new(Test::Bending, Direction::Warp, q, load).unwrap();
        let values = curve.bending_values(&BendingPoints::default()).unwrap();
        // e^{-50/5} of the plateau is still sticking at 0.5 cm⁻¹, over a slope base of 1 cm⁻¹.
        let error = (values.rigidity - exact.stiffness).abs() / (exact.plateau / 100.0);
        assert!(error < (-10.0_f64).exp(), "slope off by {error}");
    }

    #[test]
    fn a_loop_that_ends_short_of_the_point_is_refused() {
        let exact = Loop { top: 120.0, ..bending(5.0) };
        let result = exact.curve(Test::Bending).bending_values(&BendingPoints::default());
        assert!(
            matches!(result, Err(Error::OutOfRange { deformation, .. }) if deformation == 150.0)
        );
    }
}
