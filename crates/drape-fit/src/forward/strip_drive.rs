//! Loads of a traction law along the history of a strip, which may hang slack between its clamps.
//!
//! Used by the tensile fits of `curves`. Along a history the models take half the time of the laws
//! of drape-fabric, because they store quantities that need an exponential: `weighted` for the laws
//! of the papers, `exponential` for the law with an exponential toe.

mod exponential;
mod strip_state;
mod weighted;

use drape_fabric::TractionLaw;

use crate::forward::strip_drive::exponential::ExponentialStrip;
use crate::forward::strip_drive::strip_state::{StripState, StripStep};
use crate::forward::strip_drive::weighted::WeightedStrip;

/// Number of bisections for the strain at which a strip goes slack. Further bisections would not
/// change the strain, because a double has 53 significant bits.
const BISECTIONS: usize = 60;

/// Strip with a law that was prepared.
enum Strip<'a> {
    Exponential(ExponentialStrip),
    Weighted(WeightedStrip<'a>),
}

impl<'a> Strip<'a> {
    /// Prepares `law` for a history.
    fn new(law: &'a TractionLaw) -> Self {
        ExponentialStrip::new(law)
            .map_or_else(|| Self::Weighted(WeightedStrip::new(law)), Self::Exponential)
    }

    /// Returns the state of a strip at rest that was never stretched.
    fn virgin(&self) -> StripState {
        match self {
            Self::Exponential(strip) => strip.virgin(),
            Self::Weighted(strip) => strip.virgin(),
        }
    }

    /// Returns load and state at `strain`, after the state `state`.
    fn step(&self, state: &StripState, strain: f64) -> StripStep {
        match self {
            Self::Exponential(strip) => strip.step(state, strain),
            Self::Weighted(strip) => strip.step(state, strain),
        }
    }

    /// Returns the state at which the load vanishes, before a lower `strain` with a negative load.
    fn vanishing(&self, state: &StripState, strain: f64) -> StripState {
        let (mut slack, mut taut) = (strain, state.memory.position);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (slack + taut);
            if self.step(state, middle).load < 0.0 {
                slack = middle;
            } else {
                taut = middle;
            }
        }
        self.step(state, taut).state
    }
}

/// Writes the loads of a virgin fabric along the strains of `history` to `out`.
///
/// The history need not start at zero: the fabric is first stretched monotonically to its first
/// point.
pub(crate) fn drive_strip(law: &TractionLaw, history: impl Iterator<Item = f64>, out: &mut [f64]) {
    let strip = Strip::new(law);
    let mut state = strip.virgin();
    for (load, strain) in out.iter_mut().zip(history) {
        let step = strip.step(&state, strain);
        (*load, state) = (step.load, step.state);
    }
}

/// Writes the loads of a strip to `out`. The strain of `clamps` may be negative, when the clamps
/// are closer than the strip is long.
///
/// A strip carries no compression: where the load of the law would be negative, the strip sags. It
/// then keeps the strain at which its load vanished, and carries load again once the clamps pass
/// that strain.
pub(crate) fn drive_slack_strip(
    law: &TractionLaw,
    clamps: impl Iterator<Item = f64>,
    out: &mut [f64],
) {
    let strip = Strip::new(law);
    let mut state = strip.virgin();
    let mut sags = false;
    for (load, strain) in out.iter_mut().zip(clamps) {
        *load = 0.0;
        if sags && strain <= state.memory.position {
            continue;
        }
        let taut = strip.step(&state, strain);
        sags = taut.load < 0.0;
        if sags {
            state = strip.vanishing(&state, strain);
        } else {
            (*load, state) = (taut.load, taut.state);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::{
        BlimanSorine, Buckling, ExponentialToe, Law, Polynomial, Primed, ProportionalFriction,
        TractionBackbone, TractionFriction, drive,
    };

    fn law() -> TractionLaw {
        TractionLaw {
            backbone: TractionBackbone::Primed(Primed {
                stiffness: 1e4,
                toe_ratio: 0.6,
                toe_strain: 0.01,
                toe_strain_after: 0.014,
            }),
            friction: BlimanSorine::first_order(4.0, 0.001).expect("a friction").into(),
            buckling: Buckling::default(),
        }
    }

    #[test]
    fn a_taut_strip_follows_the_law_and_a_slack_one_carries_nothing() {
        let law = law();
        let history = [0.01, 0.03, 0.05, 0.045, 0.05];
        let (mut plain, mut strip) = ([0.0; 5], [0.0; 5]);
        drive_strip(&law, history.into_iter(), &mut plain);
        drive_slack_strip(&law, history.into_iter(), &mut strip);
        assert_eq!(plain, strip);
        let mut slack = [1.0; 3];
        drive_slack_strip(&law, [-0.02, -0.01, 0.0].into_iter(), &mut slack);
        assert_eq!(slack, [0.0; 3]);
    }

    #[test]
    fn how_far_a_strip_sags_does_not_matter_to_its_next_loading() {
        let law = law();
        let reload = |slack: f64| {
            let mut loads = [0.0; 4];
            drive_slack_strip(&law, [0.04, slack, 0.02, 0.03].into_iter(), &mut loads);
            loads
        };
        let (little, much) = (reload(-0.001), reload(-0.02));
        assert_eq!(little[1], 0.0);
        for (a, b) in little.iter().zip(&much) {
            // The strain at which it went slack is found to the last bits.
            assert!((a - b).abs() < 1e-9 * little[0], "{little:?} against {much:?}");
        }
    }

    #[test]
    fn it_is_the_law() {
        let polynomial = TractionBackbone::Polynomial(Polynomial { quadratic: 9e4, quartic: 2e7 });
        let TractionLaw { backbone: TractionBackbone::Primed(primed), .. } = law() else {
            panic!("the law is primed")
        };
        let still = TractionBackbone::Primed(Primed { toe_strain_after: 0.01, ..primed });
        // Loading, recovery and buckling, in steps that pass several knots and in small ones.
        let mut history = vec![0.004, 0.02, -0.01, 0.05, 0.013, 0.0, -0.001, 0.03, 0.03, 0.08];
        history.extend(
            (0..200).map(|i| 0.04 * (1.0 + 0.005 * f64::from(i)) * (0.2 * f64::from(i)).sin()),
        );
        let weighted = [law().backbone, polynomial, still];
        let weighted = weighted.map(|backbone| TractionLaw { backbone, ..law() });
        let friction = ProportionalFriction { ratio: 0.8, plateau: 3.0, length: 0.004 };
        let exponential = [0.01, 0.016].map(|toe_strain_after| TractionLaw {
            backbone: TractionBackbone::Exponential(ExponentialToe {
                base_stiffness: 400.0,
                stiffness: 1e4,
                steepness: 3.0,
                toe_strain: 0.01,
                toe_strain_after,
            }),
            friction: TractionFriction::Proportional(friction),
            buckling: Buckling { strain: 0.005, ..Buckling::default() },
        });
        for law in weighted.into_iter().chain(exponential) {
            let mut found = vec![0.0; history.len()];
            drive_strip(&law, history.iter().copied(), &mut found);
            let exact = drive(&law, law.virgin(), &history);
            for ((strain, found), exact) in history.iter().zip(&found).zip(&exact) {
                // Sums of some hundred N/m in another order.
                assert!((found - exact).abs() < 1e-11, "{law:?} at {strain}: {found} {exact}");
            }
        }
    }
}
