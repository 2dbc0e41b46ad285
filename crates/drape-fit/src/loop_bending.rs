//! The bending law from strips that buckle between approaching clamps.

use drape_fabric::{BendingBackbone, BendingLaw};
use drape_kes::{Curve, Test};

use crate::bending::span;
use crate::curve_fit::{self, Identified};
use crate::elastica::Arch;
use crate::line::{LEAST_LENGTH, friction};
use crate::search::{Named, refine, search};
use crate::statistics::statistics;
use crate::{CurveFit, Error, Settings};
use drape_lm::{Parameter, Problem};

/// Least shortening of the strip that is used, a part of its length.
///
/// Below it the arch is so flat that the clamp distance hardly tells its height: an error of 0.1 mm in the
/// length of a strip of 2 cm is a quarter of this.
const LEAST_SHORTENING: f64 = 0.02;

/// Friction lengths to start from, over the largest curvature.
const LENGTH_STARTS: [f64; 3] = [0.01, 0.06, 0.3];

/// Parameters that all strips share: rigidity, plateau, length.
const SHARED: usize = 3;
/// Parameters of each strip: zero, drift, state.
const OWN: usize = 3;

/// Identifies rigidity and friction of bending from the loop-bending curves of one direction.
///
/// Each strip is taken as the arch of an inextensible elastica. Its friction is an element of first order
/// that slips with the mean curvature of the arch: the work that the clamps lose is then the friction moment
/// times the turning of the strip. All strips share one law. Each has its own zero of the force, a steady
/// drift of that zero over the test, and a state of the friction at the start (over its plateau), because the
/// strip was bent by hand before.
///
/// Weight is neglected. It pulls a strip of 0.1 kg/m² and 2 cm with 3 % of its bending force, and one of
/// 8 cm with more than all of it: use short strips, and arches up as well as down, which err to opposite
/// sides.
///
/// Each curve comes back with its fit, in the order given; the law is the same in all.
///
/// # Errors
/// A curve is of another test, has no load or no gauge, or its strip is hardly bent.
pub fn identify_loop_bending(
    curves: &[&Curve],
    settings: &Settings,
) -> Result<Vec<Identified<BendingLaw>>, Error> {
    let strips: Result<Vec<Strip<'_>>, Error> =
        curves.iter().map(|&curve| Strip::new(curve)).collect();
    let problem = Strips(strips?);
    if problem.0.is_empty() {
        return Ok(Vec::new());
    }
    let found = refine(&problem, search(&problem, &problem.starts()));
    let p = &found.report.parameters;
    let statistics = statistics(&problem, &found.named, &found.report, (p, settings.intervals));
    let law = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: p[0] },
        rest_curvature: 0.0,
        friction: friction(&p[1..SHARED]),
    };
    let mut first = 0;
    let identified = problem.0.iter().enumerate().map(|(index, strip)| {
        let own = SHARED + OWN * index;
        let mut out = vec![0.0; strip.load.len()];
        strip.residuals(p, &p[own..own + OWN], &mut out);
        let squares: f64 = out.iter().map(|residual| residual * residual).sum();
        let residuals = first..first + out.len();
        first = residuals.end;
        let share = statistics.of((0..SHARED).chain(own..own + OWN), residuals);
        let mut band = vec![0.0; strip.curve.load().len()];
        for (&index, width) in strip.used.iter().zip(&share.band) {
            band[index] = width / strip.scale;
        }
        let mut fit = CurveFit::new(strip.curve, found.clone(), share, strip.whole(&out));
        // Points that are too flat are not used, and do not count.
        fit.misfit = (squares / out.len() as f64).sqrt();
        fit.rms = fit.misfit / strip.scale;
        fit.band = band;
        Identified { law, fit }
    });
    Ok(identified.collect())
}

/// One strip: its arches where it is bent enough.
struct Strip<'a> {
    curve: &'a Curve,
    /// The points that are used.
    used: Vec<usize>,
    /// Their arches.
    arches: Vec<Arch>,
    /// Their loads.
    load: Vec<f64>,
    /// One over the range of the loads.
    scale: f64,
}

impl<'a> Strip<'a> {
    fn new(curve: &'a Curve) -> Result<Self, Error> {
        curve_fit::expect(curve, Test::LoopBending)?;
        let name = || curve.name.clone();
        let length = curve.gauge.ok_or_else(|| Error::NoGauge { name: name() })?;
        let strain = curve.deformation();
        let bent = |&i: &usize| -strain[i] >= LEAST_SHORTENING;
        let used: Vec<usize> = (0..strain.len()).filter(bent).collect();
        if used.len() <= SHARED + OWN {
            return Err(Error::HardlyBent { name: name(), needed: 100.0 * LEAST_SHORTENING });
        }
        let arches = used.iter().map(|&i| Arch::new(length, -strain[i])).collect();
        let load = used.iter().map(|&i| curve.load()[i]).collect();
        Ok(Self { curve, used, arches, load, scale: 1.0 / span(curve) })
    }

    /// Loads of the law less those measured, over their range.
    fn residuals(&self, shared: &[f64], own: &[f64], out: &mut [f64]) {
        let (rigidity, friction) = (shared[0], friction(&shared[1..SHARED]));
        let [zero, drift, state] = *own else { return };
        let last = (self.curve.load().len() - 1) as f64;
        let mut moments = [state * friction.plateau(), 0.0];
        let mut before = self.arches[0].curvature;
        for (k, residual) in out.iter_mut().enumerate() {
            let arch = &self.arches[k];
            moments = friction.advance(moments, arch.curvature - before);
            before = arch.curvature;
            let resisting = rigidity * arch.force + arch.turning * (moments[0] + moments[1]);
            let load = zero + drift * self.used[k] as f64 / last - resisting;
            *residual = (load - self.load[k]) * self.scale;
        }
    }

    /// The model's loads at all points of the curve; where the strip was too flat, the measured ones.
    fn whole(&self, residuals: &[f64]) -> Vec<f64> {
        let mut whole = self.curve.load().to_vec();
        for (&index, residual) in self.used.iter().zip(residuals) {
            whole[index] += residual / self.scale;
        }
        whole
    }

    /// Lowest and highest of a property of the arches.
    fn range(&self, value: fn(&Arch) -> f64) -> (f64, f64) {
        let start = (f64::INFINITY, 0.0_f64);
        let wider = |(low, high): (f64, f64), v: f64| (low.min(v), high.max(v));
        self.arches.iter().map(value).fold(start, wider)
    }

    /// The rigidity with which the arch alone gives half of the load's range.
    fn rigidity(&self) -> f64 {
        let (low, high) = self.range(|arch| arch.force);
        0.5 / (self.scale * (high - low))
    }

    fn own(&self) -> [Named; OWN] {
        let load = 1.0 / self.scale;
        let mean = self.load.iter().sum::<f64>() / self.load.len() as f64;
        let zero = mean + self.rigidity() * self.range(|arch| arch.force).0;
        [
            ("zero", Parameter::new(zero).with_scale(load)),
            ("drift", Parameter::new(0.0).with_scale(load)),
            ("state", Parameter::new(0.0).between(-1.0, 1.0)),
        ]
    }
}

/// All strips of one direction.
struct Strips<'a>(Vec<Strip<'a>>);

impl Strips<'_> {
    fn starts(&self) -> Vec<Vec<Named>> {
        let mean = |value: &dyn Fn(&Strip<'_>) -> f64| {
            self.0.iter().map(value).sum::<f64>() / self.0.len() as f64
        };
        let rigidity = mean(&|strip| strip.rigidity());
        let shared =
            ("rigidity", Parameter::new(rigidity).between(1e-3 * rigidity, 1e2 * rigidity));
        let moment = mean(&|strip| 1.0 / (strip.scale * strip.range(|arch| arch.turning).0));
        let reach = mean(&|strip| strip.range(|arch| arch.curvature).1);
        let own: Vec<Named> = self.0.iter().flat_map(Strip::own).collect();
        let plateau =
            Parameter::new(0.1 * moment).with_scale(0.01 * moment).between(0.0, 2.0 * moment);
        let start = |part: f64| {
            let length = Parameter::new(part * reach).between(LEAST_LENGTH * reach, 5.0 * reach);
            let shared = [shared, ("plateau", plateau), ("length", length)];
            [&shared, own.as_slice()].concat()
        };
        LENGTH_STARTS.map(start).into()
    }
}

impl Problem for Strips<'_> {
    fn residual_count(&self) -> usize {
        self.0.iter().map(|strip| strip.load.len()).sum()
    }

    fn residuals(&self, p: &[f64], out: &mut [f64]) {
        let (shared, own) = p.split_at(SHARED);
        let mut rest = out;
        for (strip, own) in self.0.iter().zip(own.chunks_exact(OWN)) {
            let (now, later) = rest.split_at_mut(strip.load.len());
            strip.residuals(shared, own, now);
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

    /// Three growing cycles between 7 and 42 % shortening of a strip of 2 cm, as the instrument makes them.
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
            zero + drift * i as f64 / last - rigidity * arch.force - arch.turning * moments[0]
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
        let friction = BlimanSorine::first_order(plateau, slip);
        let own = [[0.7, 0.2, -0.4], [-0.3, 0.1, 0.6]];
        let curves = own.map(|own| strip(rigidity, &friction, own));
        let found = identify_loop_bending(&[&curves[0], &curves[1]], &Settings::default()).unwrap();
        for (found, own) in found.iter().zip(own) {
            let exact = [rigidity, plateau, slip].into_iter().chain(own);
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
            identify_loop_bending(&[&curve], &Settings::default()),
            Err(Error::NoGauge { .. })
        ));
        curve.gauge = Some(0.02);
        assert!(matches!(
            identify_loop_bending(&[&curve], &Settings::default()),
            Err(Error::HardlyBent { .. })
        ));
    }
}
