//! Preparation of a curve for a fit: points after a break are removed, and the path is made steady.

use std::borrow::Cow;

use crate::curves::curve::{Curve, Point};
use crate::curves::preparation::{Preparation, Rupture};
use crate::curves::steady::{Line, SteadyPath, steady_path};
use crate::test::Test;

/// Fall of the load, over its largest value, that is a break of a strip under further strain.
///
/// Yarns that slip or break one by one let the load step down by less.
const BREAK_FALL: f64 = 0.5;
/// Part of the largest load of the curve that a strip must have carried before it can break.
const BREAK_LOAD: f64 = 0.3;
/// Strain, over the largest strain, within which the load vanishes after a break at the largest
/// strain.
const SUDDEN: f64 = 0.005;
/// Longest step of a recovery, over [`SUDDEN`], whose fall of the load can show a break.
const SHORT: f64 = 4.0;
/// Load over the largest load below which the load has vanished.
const VANISHED: f64 = 0.1;

/// Part of its range of loads above which the first load of a tensile test is a pretension.
const PRETENSION: f64 = 0.02;
/// Number of points of the line that gives the load at the start.
const START_POINTS: usize = 8;
/// Load at the start, over its error, that is not due to chance.
const CERTAIN: f64 = 4.0;
/// Part of the range of loads below which a load counts as zero.
const NO_LOAD: f64 = 0.005;
/// Part of the largest strain over which a load of zero may mean a slack strip.
const FLAT_START: f64 = 0.15;

/// Part of the standard test's deformation that a complete loop reaches.
const REACHED: f64 = 0.9;
/// Largest deformation to one side, over the largest deformation to the other side, of half a loop.
const HALF: f64 = 0.1;

impl Curve {
    /// Returns the curve prepared for a fit. [`Curve::preparation`] holds the changes.
    ///
    /// The points after the break of a strip are removed. The deformation moves in one direction
    /// between its turns. A turn is a reversal larger than the noise of the deformation. A path
    /// that moves back between two turns is smoothed and made monotone. A prepared curve is
    /// returned unchanged.
    ///
    /// ```
    /// use drape_kes::{Curve, Direction, Test};
    ///
    /// // A sensor that jitters by 0.02 % of strain, to 4 % and back.
    /// let at = |i: i32| 1e-4 * f64::from(i) + if i % 2 == 0 { 2e-4 } else { 0.0 };
    /// let strain: Vec<f64> = (0..=400).chain((0..400).rev()).map(at).collect();
    /// let load = strain.iter().map(|strain| 4000.0 * strain).collect();
    /// let curve = Curve::new(Test::Tensile, Direction::Warp, strain, load)?;
    ///
    /// let prepared = curve.prepared();
    /// let path = prepared.preparation().and_then(|done| done.path).expect("it turned back");
    /// assert_eq!(path.turns, 1);
    /// assert!(prepared.deformation()[..400].windows(2).all(|pair| pair[0] <= pair[1]));
    /// # Ok::<(), drape_kes::Error>(())
    /// ```
    #[must_use]
    pub fn prepared(&self) -> Cow<'_, Self> {
        if self.preparation().is_some() {
            return Cow::Borrowed(self);
        }
        let mut curve = self.clone();
        curve.repeats = self.repeats.iter().map(|c| c.prepared().into_owned()).collect();

        let path = curve.make_steady();
        let rupture = find_rupture(&curve);
        if let Some(rupture) = rupture {
            let kept = curve.load().len() - rupture.points_after;
            let points: Vec<Point> = curve.points().take(kept).collect();
            curve = curve.with_points(points);
        }

        curve.set_preparation(Preparation { rupture, path, zero_is_given: false });
        Cow::Owned(curve)
    }

    /// Returns whether a tensile test begins under a load. The strain without load is then unknown,
    /// unless it was given to the sheet.
    #[must_use]
    pub fn has_pretension(&self) -> bool {
        let is_given = self.preparation().is_some_and(|done| done.zero_is_given);
        self.test == Test::Tensile && !self.slack && !is_given && self.begins_loaded()
    }

    /// Returns whether the line through the first [`START_POINTS`] points begins above zero load,
    /// by more than noise explains.
    fn begins_loaded(&self) -> bool {
        let count = START_POINTS.min(self.load().len());
        let (strain, load) = (&self.deformation()[..count], &self.load()[..count]);
        let line = Line::through(strain, load);
        let start = line.at(strain[0]);
        let square: f64 =
            strain.iter().zip(load).map(|(strain, load)| (line.at(*strain) - load).powi(2)).sum();
        // The end of a line of n points errs by twice the noise over the square root of n.
        let freedom = count.saturating_sub(2).max(1) as f64;
        let error = 2.0 * (square / freedom / count as f64).sqrt();
        start > PRETENSION * self.load_range().span() && start > CERTAIN * error
    }

    /// Returns remarks on a prepared curve, one sentence each without a full stop: a break, a noisy
    /// deformation, a pretension, a flat start, half a loop or a small loop. A curve that is not
    /// prepared has no remark.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        let Some(Preparation { rupture, path, zero_is_given }) = self.preparation() else {
            return Vec::new();
        };
        let mut remarks = Vec::new();
        if let Some(Rupture { strain, load, points_after }) = rupture {
            remarks.push(format!(
                "the strip breaks at a strain of {:.2} % under {load:.4} N/m; the {points_after} \
                 points after the break were left out",
                100.0 * strain
            ));
        }

        if let Some(path) = path {
            remarks.push(path.describe(self.deformation_range().span()));
        }
        if self.test == Test::Tensile && !zero_is_given {
            remarks.extend(tensile_remark(self));
        }
        remarks.extend(loop_remark(self));
        remarks
    }

    /// Makes the path of the deformation steady. Returns the change, or `None` for a steady path.
    fn make_steady(&mut self) -> Option<SteadyPath> {
        let (deformation, path) = steady_path(self.deformation(), self.time())?;
        self.set_deformation(deformation);
        Some(path)
    }
}

/// Returns the break of the strip of `curve`, if it is a tensile test that ends with a break.
fn find_rupture(curve: &Curve) -> Option<Rupture> {
    if curve.test != Test::Tensile {
        return None;
    }
    let (strain, load) = (curve.deformation(), curve.load());
    let start = if curve.slack { curve.load_range().low } else { 0.0 };
    let largest = curve.load_range().high - start;
    for branch in curve.branches() {
        let points = branch.points.clone();
        if branch.rising {
            // The load falls while the strip is stretched further.
            let mut top = points.start;
            for i in points {
                if load[i] > load[top] {
                    top = i;
                }
                let carried = load[top] - start;
                if carried >= BREAK_LOAD * largest && load[i] - start < BREAK_FALL * carried {
                    return Some(rupture_at(curve, top));
                }
            }
        } else {
            // The load vanishes as soon as the strip is released.
            let top = points.start;
            let carried = load[top] - start;
            let mut released = points
                .map(|i| (i, (strain[top] - strain[i]) / strain[top].abs()))
                .filter(|(_, released)| *released >= SUDDEN);
            let Some((next, step)) = released.next() else { continue };
            // Over a long step of a curve with few points the load may fall by friction.
            let is_clear = step <= SHORT * SUDDEN && carried >= BREAK_LOAD * largest;
            if is_clear && load[next] - start < VANISHED * carried {
                return Some(rupture_at(curve, top));
            }
        }
    }
    None
}

/// Returns a break of `curve` at the index `point`.
fn rupture_at(curve: &Curve, point: usize) -> Rupture {
    let (strain, load) = (curve.deformation(), curve.load());
    Rupture { strain: strain[point], load: load[point], points_after: load.len() - 1 - point }
}

/// Returns a remark on the zero of strain of the tensile `curve`: a pretension, or a flat start.
fn tensile_remark(curve: &Curve) -> Option<String> {
    if curve.slack {
        return None;
    }
    let (strain, load) = (curve.deformation(), curve.load());
    let span = curve.load_range().span();
    if curve.has_pretension() {
        return Some(format!(
            "the test begins under a pretension of {:.3} N/m; the strain at which the strip carries \
             nothing is fitted",
            load[0]
        ));
    }

    // A long start without load may be the slack of a strip.
    let taut = load.iter().position(|&load| load > NO_LOAD * span)?;
    let flat = strain[taut] - strain[0];
    (flat > FLAT_START * curve.deformation_range().span()).then(|| {
        format!(
            "the load stays below {:.1} % of its range up to a strain of {:.2} %, as on a soft toe; \
             if the strip hung slack there, write zero_strain = \"{:.2} %\"",
            100.0 * NO_LOAD,
            100.0 * flat,
            100.0 * flat
        )
    })
}

/// Returns a remark on a `curve` that is half a loop, or that is smaller than the loop of the
/// standard test.
fn loop_remark(curve: &Curve) -> Option<String> {
    let standard = curve.test.standard_deformation()?;
    let range = curve.deformation_range();
    let (most, least) = (range.high.max(-range.low), range.high.min(-range.low));
    let to_one_side = least < HALF * most;
    let reaches = if to_one_side { most } else { least };
    let short = reaches < REACHED * standard;
    if !to_one_side && !short {
        return None;
    }

    let (reach, standard) = (curve.test.describe(reaches), curve.test.describe(standard));
    let what = if to_one_side { "half a loop, to one side" } else { "a loop" };
    let goes = if short {
        format!("; it ends at {reach}, where the standard test goes on to {standard}")
    } else {
        String::new()
    };
    let sides = if to_one_side { ": values are those of this side" } else { "" };
    Some(format!("the curve is {what}{sides}{goes}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test::Direction;

    fn tensile(points: impl Iterator<Item = (f64, f64)>) -> Curve {
        let (strain, load) = points.unzip();
        Curve::new(Test::Tensile, Direction::Warp, strain, load).expect("a curve")
    }

    /// A J-shape up to 5 % and 500 N/m.
    fn loading() -> impl Iterator<Item = (f64, f64)> {
        (0..=120).map(|i| f64::from(i) / 120.0).map(|x| (0.05 * x, 500.0 * x.powf(2.2)))
    }

    #[test]
    fn a_strip_that_breaks_ends_at_its_break() {
        // Torn: the load falls to nearly nothing while the clamps go on.
        let tail = (1..200).map(f64::from).map(|i| (0.05 + 2e-4 * i, 150.0 * (-i / 20.0).exp()));
        // Torn at the largest strain: the clamps come back without load.
        let back = (0..=120).rev().map(|i| (0.05 * f64::from(i) / 120.0, 0.0));
        for (name, curve) in [
            ("pulled on", tensile(loading().chain(tail))),
            ("brought back", tensile(loading().chain(back))),
        ] {
            let curve = curve.prepared();
            let rupture = curve.preparation().and_then(|done| done.rupture).expect(name);
            assert!((rupture.strain - 0.05).abs() < 1e-12, "{name}: {rupture:?}");
            assert_eq!(rupture.load, 500.0, "{name}");
            assert_eq!(curve.load().len(), 121, "{name}");
            let remark = &curve.remarks()[0];
            assert!(remark.starts_with("the strip breaks at a strain of 5.00 %"), "{remark}");
        }
    }

    #[test]
    fn a_strip_that_recovers_or_loses_a_yarn_does_not_break() {
        let back =
            (0..120).rev().map(|i| f64::from(i) / 120.0).map(|x| (0.05 * x, 500.0 * x.powi(5)));
        let whole = tensile(loading().chain(back));
        assert_eq!(whole.prepared().preparation().expect("prepared").rupture, None);
        // One yarn of three gives way at 3 %, and the load rises again.
        let weaker = loading().map(|(q, f)| (q, if q > 0.03 { 0.7 * f } else { f }));
        assert_eq!(tensile(weaker).prepared().preparation().expect("prepared").rupture, None);
    }

    #[test]
    fn half_a_loop_and_a_small_loop_are_named() {
        let remark = |ends: &[f64]| {
            let mut q = vec![0.0];
            for pair in ends.windows(2) {
                q.extend((1..=50).map(|i| pair[0] + (pair[1] - pair[0]) * f64::from(i) / 50.0));
            }
            let load = q.iter().map(|q| 1e-5 * q).collect();
            let curve = Curve::new(Test::Bending, Direction::Warp, q, load).expect("a curve");
            curve.prepared().remarks().join("; ")
        };
        assert_eq!(remark(&[0.0, 250.0, -250.0, 0.0]), "");
        assert!(remark(&[0.0, 250.0, 0.0]).starts_with("the curve is half a loop, to one side"));
        let small = remark(&[0.0, 100.0, -100.0, 0.0]);
        assert!(
            small.contains("it ends at 1.00 1/cm, where the standard test goes on to 2.50 1/cm")
        );
    }

    #[test]
    fn a_pretension_and_a_flat_start_are_told() {
        let remark = |curve: Curve| curve.prepared().remarks().join("; ");
        assert_eq!(remark(tensile(loading())), "");
        let pretension =
            tensile(loading().filter(|(_, load)| *load > 15.0).map(|(q, f)| (q - 0.0104, f)));
        assert!(remark(pretension).contains("begins under a pretension of 15."));
        let slack = (0..40).map(|i| (4e-4 * f64::from(i), 0.0));
        let slack = tensile(slack.chain(loading().map(|(q, f)| (q + 0.016, f))));
        assert!(remark(slack).contains("write zero_strain = "));
    }

    #[test]
    fn a_prepared_curve_stays_as_it_is() {
        let once = tensile(loading()).prepared().into_owned();
        assert!(matches!(once.prepared(), Cow::Borrowed(_)));
    }
}
