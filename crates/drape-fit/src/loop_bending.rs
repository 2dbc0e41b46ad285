//! The bending law from a strip that buckles between approaching clamps.

use drape_fabric::{BendingBackbone, BendingLaw};
use drape_kes::{Curve, Test};

use crate::Error;
use crate::bending::{friction, friction_starts, span};
use crate::curve_fit::{self, Identified, Named};
use crate::elastica::Arch;
use crate::lm::Parameter;
use crate::{CurveFit, FrictionOrder};

/// Least shortening of the strip that is used, a part of its length.
///
/// Below it the arch is so flat that the clamp distance hardly tells its height: an error of 0.1 mm in the
/// length of a strip of 2 cm is a quarter of this.
const LEAST_SHORTENING: f64 = 0.02;

/// Identifies rigidity and friction of bending from a loop-bending curve.
///
/// The strip is taken as the arch of an inextensible elastica. Its friction is a [`BlimanSorine`](drape_fabric::BlimanSorine) element of
/// first order that slips with the mean curvature of the arch: the work that the clamps lose is then the
/// friction moment times the turning of the strip. Weight is neglected. It pulls a strip of 0.1 kg/m² and
/// 2 cm with 3 % of its bending force, and one of 8 cm with more than all of it, so use short strips; arches
/// up and down err to opposite sides. The zero of the force and its steady drift over the test are fitted
/// too.
///
/// # Errors
/// The curve is of another test, has no load or no gauge, or the strip is hardly bent.
pub fn identify_loop_bending(curve: &Curve) -> Result<Identified<BendingLaw>, Error> {
    curve_fit::expect(curve, Test::LoopBending)?;
    let name = || curve.name.clone();
    let length = curve.gauge.ok_or_else(|| Error::NoGauge { name: name() })?;
    let last = (curve.load().len() - 1) as f64;
    let used: Vec<usize> = (0..curve.load().len())
        .filter(|&i| -curve.deformation()[i] >= LEAST_SHORTENING)
        .collect();
    let pick = |values: &[f64]| used.iter().map(|&i| values[i]).collect();
    let bent = Curve::new(
        curve.test,
        curve.direction,
        pick(curve.deformation()),
        pick(curve.load()),
    );
    let hardly_bent = || Error::HardlyBent {
        name: name(),
        needed: 100.0 * LEAST_SHORTENING,
    };
    let mut bent = bent.map_err(|_| hardly_bent())?;
    bent.name = name();
    let arches: Vec<Arch> = bent
        .deformation()
        .iter()
        .map(|strain| Arch::new(length, -strain))
        .collect();
    let times: Vec<f64> = used.iter().map(|&i| i as f64 / last).collect();

    let starts = starts(&bent, &arches);
    let fit = curve_fit::fit(&bent, &starts, |p, out| {
        let friction = friction(&p[3..]);
        let mut moments = [0.0; 2];
        let mut before = 0.0;
        for (((load, arch), time), _) in out.iter_mut().zip(&arches).zip(&times).zip(&used) {
            moments = friction.advance(moments, arch.curvature - before);
            before = arch.curvature;
            let resisting = p[0] * arch.force + arch.turning * (moments[0] + moments[1]);
            *load = p[1] + p[2] * time - resisting;
        }
    });
    let p = fit.values();
    let law = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: p[0] },
        rest_curvature: 0.0,
        friction: friction(&p[3..]),
    };
    Ok(Identified {
        law,
        fit: CurveFit {
            load: whole(curve, &used, &fit.load),
            ..fit
        },
    })
}

/// Half of the load's range from the rigidity, a tenth from the friction.
fn starts(bent: &Curve, arches: &[Arch]) -> Vec<Vec<Named>> {
    let range = |value: fn(&Arch) -> f64| {
        arches
            .iter()
            .map(value)
            .fold((f64::INFINITY, 0.0_f64), |(low, high), v| {
                (low.min(v), high.max(v))
            })
    };
    let load = span(bent);
    let (low, high) = range(|arch| arch.force);
    let rigidity = 0.5 * load / (high - low);
    let (turning, _) = range(|arch| arch.turning);
    let (_, reach) = range(|arch| arch.curvature);
    let zero = bent.load().iter().sum::<f64>() / bent.load().len() as f64 + rigidity * low;
    let own = [
        (
            "rigidity",
            Parameter::new(rigidity).between(1e-3 * rigidity, 1e2 * rigidity),
        ),
        ("zero", Parameter::new(zero).with_scale(load)),
        ("drift", Parameter::new(0.0).with_scale(load)),
    ];
    let moment = load / turning;
    friction_starts(FrictionOrder::First, 0.1 * moment, reach, moment)
        .into_iter()
        .map(|friction| own.into_iter().chain(friction).collect())
        .collect()
}

/// The model's loads at all points of the curve; where the strip was too flat, the measured ones.
fn whole(curve: &Curve, used: &[usize], loads: &[f64]) -> Vec<f64> {
    let mut whole = curve.load().to_vec();
    for (&index, &load) in used.iter().zip(loads) {
        whole[index] = load;
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::BlimanSorine;
    use drape_kes::Direction;

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

    #[test]
    fn rigidity_and_friction_are_recovered_through_drift_and_an_unknown_zero() {
        let (rigidity, plateau, slip, length) = (1.1e-5, 8e-5, 20.0, 0.0208);
        let friction = BlimanSorine::first_order(plateau, slip);
        let shortenings = cycles();
        let (mut moments, mut before) = ([0.0; 2], 0.0);
        let count = shortenings.len() as f64 - 1.0;
        let load = shortenings.iter().enumerate().map(|(i, &shortening)| {
            let arch = Arch::new(length, shortening);
            moments = friction.advance(moments, arch.curvature - before);
            before = arch.curvature;
            0.7 + 0.2 * i as f64 / count - rigidity * arch.force - arch.turning * moments[0]
        });
        let load = load.collect();
        let strain = shortenings.iter().map(|shortening| -shortening).collect();
        let mut curve = Curve::new(Test::LoopBending, Direction::Warp, strain, load).unwrap();
        curve.gauge = Some(length);
        let found = identify_loop_bending(&curve).unwrap();
        let exact = [rigidity, 0.7, 0.2, plateau, slip];
        for ((name, value), exact) in found.fit.parameters.iter().zip(exact) {
            let error = (value / exact - 1.0).abs();
            assert!(error < 1e-6, "{name} is {value:e}, exactly {exact:e}");
        }
    }

    #[test]
    fn a_strip_that_is_hardly_bent_or_of_unknown_length_is_refused() {
        let strain = vec![0.0, -0.005, -0.01];
        let load = vec![0.0, -0.1, -0.11];
        let mut curve = Curve::new(Test::LoopBending, Direction::Warp, strain, load).unwrap();
        assert!(matches!(
            identify_loop_bending(&curve),
            Err(Error::NoGauge { .. })
        ));
        curve.gauge = Some(0.02);
        assert!(matches!(
            identify_loop_bending(&curve),
            Err(Error::HardlyBent { .. })
        ));
    }
}
