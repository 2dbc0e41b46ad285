//! Bending law from strips that buckle between approaching clamps.
//!
//! All strips of one direction are fitted together. Therefore the fit has special residuals, and
//! calls search and uncertainty directly. `fabric` uses the fit if no bending loop was measured.

use drape_fabric::{BendingBackbone, BendingLaw};
use drape_kes::{Curve, Test};
use drape_lm::{Parameter, Problem};

use crate::curves::features::check;
use crate::curves::loop_form::friction;
use crate::curves::loop_start::LEAST_LENGTH;
use crate::curves::remark::remarks;
use crate::error::Error;
use crate::forward::arch::Arch;
use crate::regression::curve_fit::{CurveFit, Identified};
use crate::regression::residuals::{NamedParameter, PointProblem};
use crate::regression::search::{multistart, refine};
use crate::regression::uncertainty::{FitEnd, uncertainty};
use crate::settings::FitSettings;

/// Least shortening of a strip at points that are used, over the length of the strip.
///
/// Below it the arch is so flat that the clamp distance hardly determines its height: an error of
/// 0.1 mm in the length of a strip of 2 cm is a quarter of this.
const LEAST_SHORTENING: f64 = 0.02;

/// Friction lengths to start from, over the largest curvature.
const LENGTH_STARTS: [f64; 3] = [0.01, 0.06, 0.3];

/// Number of parameters that all strips share: rigidity, plateau, length.
const SHARED: usize = 3;
/// Number of parameters of each strip: zero, drift, state.
const PER_STRIP: usize = 3;

/// Identifies rigidity and friction of bending from the loop-bending `curves` of one direction.
///
/// Each strip is an arch of an inextensible elastica. Its friction is an element of first order
/// that slips with the mean curvature `$\bar\kappa$` of the arch, so that the work lost at the
/// clamps is the friction moment `$M_r$` times the rotation of the strip:
///
/// ```math
/// F = F_0 + F_d\,t - P - M_r(\bar\kappa)\,\frac{d(4\theta_{max})}{d\Delta}
/// ```
///
/// with the compressive force `$P$` and the largest slope angle `$\theta_{max}$` of the arch and
/// the shortening `$\Delta$` of the clamp distance. All strips share one law. Each strip has a zero
/// `$F_0$` of the force, a steady drift `$F_d$` of the zero over the test (`$t$` from 0 to 1), and
/// a state of the friction at the start, over its plateau, because the strip was bent by hand
/// before.
///
/// Weight is neglected. Weight loads a strip of 0.1 kg/m² and 2 cm with 3 % of its bending force,
/// and a strip of 8 cm with more than its whole bending force. Use short strips, and arches up as
/// well as down, whose errors have opposite signs.
///
/// Each curve is returned with its fit, in the given order. The law is equal in all.
///
/// # Errors
/// A curve is of another test, has no load or no gauge, its strip is hardly bent, or all curves
/// together have fewer points than the law has parameters.
pub fn identify_loop_bending(
    curves: &[&Curve],
    settings: &FitSettings,
) -> Result<Vec<Identified<BendingLaw>>, Error> {
    let strips: Result<Vec<Strip<'_>>, Error> =
        curves.iter().map(|&curve| Strip::new(curve)).collect();
    let problem = Strips(strips?);
    if problem.0.is_empty() {
        return Ok(Vec::new());
    }
    problem.check_point_count()?;
    let result = refine(&problem, multistart(&problem, &problem.starts()));
    let p = &result.report.parameters;
    let end = FitEnd { parameters: &result.parameters, report: &result.report, unweighted: p };
    let uncertainty = uncertainty(&problem, &end, settings.intervals);
    let law = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: p[0] },
        rest_curvature: 0.0,
        friction: friction(&p[1..SHARED]),
    };

    let mut first = 0;
    let identified = problem.0.iter().enumerate().map(|(index, strip)| {
        let first_own = SHARED + PER_STRIP * index;
        let mut out = vec![0.0; strip.load.len()];
        strip.residuals(p, &p[first_own..first_own + PER_STRIP], &mut out);
        let squares: f64 = out.iter().map(|residual| residual * residual).sum();
        let residuals = first..first + out.len();
        first = residuals.end;
        let part =
            uncertainty.select((0..SHARED).chain(first_own..first_own + PER_STRIP), residuals);
        let mut band = vec![0.0; strip.curve.load().len()];
        for (&index, width) in strip.used.iter().zip(&part.band) {
            band[index] = width / strip.scale;
        }
        let mut fit = CurveFit::new(strip.curve, result.clone(), part, strip.all_loads(&out));
        // Points at which the arch is too flat are not used, and are not counted.
        fit.misfit = (squares / out.len() as f64).sqrt();
        fit.rms = fit.misfit / strip.scale;
        fit.band = band;
        fit.remarks = remarks(strip.curve, &fit, settings);
        Identified { law, fit }
    });
    Ok(identified.collect())
}

/// One strip, with the arches of the points at which it is bent enough.
struct Strip<'a> {
    curve: &'a Curve,
    /// Indices of the points that are used.
    used: Vec<usize>,
    /// Arch of each used point.
    arches: Vec<Arch>,
    /// Load of each used point.
    load: Vec<f64>,
    /// Reciprocal range of the loads.
    scale: f64,
}

/// Smallest and largest of a property of the arches.
struct Extremes {
    low: f64,
    high: f64,
}

impl<'a> Strip<'a> {
    /// Computes the arches of `curve`. Fails if its gauge is missing, or if it is hardly bent.
    fn new(curve: &'a Curve) -> Result<Self, Error> {
        check(curve, Test::LoopBending)?;
        let name = curve.name.clone();
        let Some(length) = curve.gauge else { return Err(Error::MissingGauge { name }) };
        let strain = curve.deformation();
        let used: Vec<usize> =
            (0..strain.len()).filter(|&i| -strain[i] >= LEAST_SHORTENING).collect();
        if used.len() <= SHARED + PER_STRIP {
            return Err(Error::FlatArch { name, needed: 100.0 * LEAST_SHORTENING });
        }
        let arches = used.iter().map(|&i| Arch::new(length, -strain[i])).collect();
        let load = used.iter().map(|&i| curve.load()[i]).collect();
        Ok(Self { curve, used, arches, load, scale: 1.0 / curve.load_range().span() })
    }

    /// Writes the loads of the law less the measured loads, over their range, to `out`. The law has
    /// the parameters `shared`, and the strip the other parameters.
    fn residuals(&self, shared: &[f64], parameters: &[f64], out: &mut [f64]) {
        let (rigidity, friction) = (shared[0], friction(&shared[1..SHARED]));
        let [zero, drift, state] = *parameters else { return };
        let last = (self.curve.load().len() - 1) as f64;
        let mut moments = [state * friction.plateau(), 0.0];
        let mut before = self.arches[0].curvature;
        for (k, residual) in out.iter_mut().enumerate() {
            let arch = &self.arches[k];
            moments = friction.advance(moments, arch.curvature - before);
            before = arch.curvature;
            let resisting = rigidity * arch.force + arch.rotation_rate * (moments[0] + moments[1]);
            let load = zero + drift * self.used[k] as f64 / last - resisting;
            *residual = (load - self.load[k]) * self.scale;
        }
    }

    /// Returns the loads of the law at all points of the curve. Where the arch is too flat, the
    /// measured load is returned.
    fn all_loads(&self, residuals: &[f64]) -> Vec<f64> {
        let mut loads = self.curve.load().to_vec();
        for (&index, residual) in self.used.iter().zip(residuals) {
            loads[index] += residual / self.scale;
        }
        loads
    }

    /// Returns the smallest and the largest `value` of the arches.
    fn extremes(&self, value: fn(&Arch) -> f64) -> Extremes {
        let mut extremes = Extremes { low: f64::INFINITY, high: 0.0 };
        for value in self.arches.iter().map(value) {
            extremes = Extremes { low: extremes.low.min(value), high: extremes.high.max(value) };
        }
        extremes
    }

    /// Returns the rigidity with which the arch alone gives half of the load range.
    fn rigidity(&self) -> f64 {
        let Extremes { low, high } = self.extremes(|arch| arch.force);
        0.5 / (self.scale * (high - low))
    }

    /// Returns the initial guess of the parameters of the strip.
    fn strip_start(&self) -> [NamedParameter; PER_STRIP] {
        let load = 1.0 / self.scale;
        let mean = self.load.iter().sum::<f64>() / self.load.len() as f64;
        let zero = mean + self.rigidity() * self.extremes(|arch| arch.force).low;
        [
            NamedParameter::new("zero", Parameter::new(zero).with_scale(load)),
            NamedParameter::new("drift", Parameter::new(0.0).with_scale(load)),
            NamedParameter::new("state", Parameter::new(0.0).between(-1.0, 1.0)),
        ]
    }
}

/// All strips of one direction.
struct Strips<'a>(Vec<Strip<'a>>);

impl Strips<'_> {
    /// Checks that there are at least as many points as parameters.
    fn check_point_count(&self) -> Result<(), Error> {
        let (points, needed) = (self.residual_count(), SHARED + PER_STRIP * self.0.len());
        if points < needed {
            let name = self.0[0].curve.name.clone();
            return Err(Error::TooFewPoints { name, points, needed });
        }
        Ok(())
    }

    /// Returns the initial guesses of all parameters, for several friction lengths.
    fn starts(&self) -> Vec<Vec<NamedParameter>> {
        let rigidity = self.mean(|strip| strip.rigidity());
        let bounded = Parameter::new(rigidity).between(1e-3 * rigidity, 1e2 * rigidity);
        let rigidity = NamedParameter::new("rigidity", bounded);
        let moment =
            self.mean(|strip| 1.0 / (strip.scale * strip.extremes(|arch| arch.rotation_rate).low));
        let curvature = self.mean(|strip| strip.extremes(|arch| arch.curvature).high);
        let strip_starts: Vec<NamedParameter> =
            self.0.iter().flat_map(Strip::strip_start).collect();
        let plateau =
            Parameter::new(0.1 * moment).with_scale(0.01 * moment).between(0.0, 2.0 * moment);
        let plateau = NamedParameter::new("plateau", plateau);

        LENGTH_STARTS
            .map(|part| {
                let length = Parameter::new(part * curvature)
                    .between(LEAST_LENGTH * curvature, 5.0 * curvature);
                let shared = [rigidity, plateau, NamedParameter::new("length", length)];
                [&shared, strip_starts.as_slice()].concat()
            })
            .into()
    }

    /// Returns the mean of a `value` over all strips.
    fn mean(&self, value: impl Fn(&Strip<'_>) -> f64) -> f64 {
        self.0.iter().map(value).sum::<f64>() / self.0.len() as f64
    }
}

impl PointProblem for Strips<'_> {}

impl Problem for Strips<'_> {
    fn residual_count(&self) -> usize {
        self.0.iter().map(|strip| strip.load.len()).sum()
    }

    fn residuals(&self, p: &[f64], out: &mut [f64]) {
        let (shared, strip_parameters) = p.split_at(SHARED);
        let mut rest = out;
        for (strip, strip_parameters) in self.0.iter().zip(strip_parameters.chunks_exact(PER_STRIP))
        {
            let (now, later) = rest.split_at_mut(strip.load.len());
            strip.residuals(shared, strip_parameters, now);
            rest = later;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::BlimanSorine;
    use drape_kes::Direction;

    const LENGTH: f64 = 0.0208;

    /// Three growing cycles between 7 and 42 % shortening of a strip of 2 cm, as in the
    /// measurements.
    fn cycles() -> Vec<f64> {
        let ends = [0.07, 0.19, 0.07, 0.3, 0.07, 0.42, 0.07];
        let steps = 25;
        let between = |ends: &[f64]| {
            let (from, to) = (ends[0], ends[1]);
            (0..steps).map(move |i| from + (to - from) * f64::from(i) / f64::from(steps))
        };
        ends.windows(2).flat_map(between).collect()
    }

    fn strip(rigidity: f64, friction: &BlimanSorine, [zero, drift, state]: [f64; 3]) -> Curve {
        let shortenings = cycles();
        let last = (shortenings.len() - 1) as f64;
        let mut moments = [state * friction.plateau(), 0.0];
        let mut before = Arch::new(LENGTH, shortenings[0]).curvature;
        let load = shortenings.iter().enumerate().map(|(i, &shortening)| {
            let arch = Arch::new(LENGTH, shortening);
            moments = friction.advance(moments, arch.curvature - before);
            before = arch.curvature;
            zero + drift * i as f64 / last - rigidity * arch.force - arch.rotation_rate * moments[0]
        });
        let load = load.collect();
        let strain = shortenings.iter().map(|shortening| -shortening).collect();
        let mut curve = Curve::new(Test::LoopBending, Direction::Warp, strain, load).unwrap();
        curve.gauge = Some(LENGTH);
        curve
    }

    #[test]
    fn one_law_is_recovered_from_two_strips_through_drift_and_unknown_zeros() {
        let (rigidity, plateau, slip) = (1.1e-5, 8e-5, 20.0);
        let friction = BlimanSorine::first_order(plateau, slip).expect("a friction");
        let strip_start = [[0.7, 0.2, -0.4], [-0.3, 0.1, 0.6]];
        let curves = strip_start.map(|strip_start| strip(rigidity, &friction, strip_start));
        let found =
            identify_loop_bending(&[&curves[0], &curves[1]], &FitSettings::default()).unwrap();
        for (found, strip_start) in found.iter().zip(strip_start) {
            let exact = [rigidity, plateau, slip].into_iter().chain(strip_start);
            for (estimate, exact) in found.fit.parameters.iter().zip(exact) {
                let (name, value) = (estimate.name, estimate.value);
                let error = (value / exact - 1.0).abs();
                assert!(error < 1e-6, "{name} is {value:e}, exactly {exact:e}");
            }
            assert!(found.fit.misfit < 1e-9, "misfit {}", found.fit.misfit);
        }
    }

    #[test]
    fn a_strip_that_is_hardly_bent_or_of_unknown_length_is_refused() {
        let strain = vec![0.0, -0.005, -0.01];
        let load = vec![0.0, -0.1, -0.11];
        let mut curve = Curve::new(Test::LoopBending, Direction::Warp, strain, load).unwrap();
        assert!(matches!(
            identify_loop_bending(&[&curve], &FitSettings::default()),
            Err(Error::MissingGauge { .. })
        ));
        curve.gauge = Some(0.02);
        assert!(matches!(
            identify_loop_bending(&[&curve], &FitSettings::default()),
            Err(Error::FlatArch { .. })
        ));
    }
}
