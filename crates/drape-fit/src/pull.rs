//! A traction law driven along the history of a strip.

use drape_fabric::{Memory, Primed, TractionBackbone, TractionLaw};
use drape_hysteresis::Slip;

/// Halvings when looking for the strain at which a strip goes slack: as many as a double has bits to give.
const HALVINGS: usize = 60;

/// What a strip remembers, with the length of the priming zone that follows from it.
#[derive(Clone, Copy)]
struct State {
    memory: Memory,
    toe: f64,
}

/// A traction law that keeps the length of its priming zone, which is an exponential.
///
/// It is the law of drape-fabric, twice as fast along a history.
struct Pull<'a> {
    law: &'a TractionLaw,
    primed: Option<Primed>,
    /// Weight of the friction at rest.
    at_rest: f64,
}

impl<'a> Pull<'a> {
    fn new(law: &'a TractionLaw) -> Self {
        match law.backbone {
            TractionBackbone::Primed(primed) => {
                Self { law, primed: Some(primed), at_rest: 2.0 - 1.0 / primed.toe_ratio }
            }
            TractionBackbone::Polynomial(_) => Self { law, primed: None, at_rest: 1.0 },
        }
    }

    fn virgin(&self) -> State {
        let toe = self.primed.map_or(0.0, |primed| primed.toe_strain);
        State { memory: Memory::default(), toe }
    }

    /// Load at a strain that follows a state, and the state there.
    fn step(&self, state: &State, strain: f64) -> (f64, State) {
        let State { memory, toe } = *state;
        let peak = memory.peak.max(strain);
        let (elastic, next_toe) = match self.primed {
            Some(primed) if strain >= 0.0 => {
                let Primed { stiffness, toe_ratio, toe_strain, toe_strain_after } = primed;
                let bow = 1.0 - toe_ratio;
                let longer = strain > memory.peak.max(toe_strain);
                let grows = longer && toe_strain_after != toe_strain;
                let next = if grows { primed.toe(strain) } else { toe };
                let load = if longer || strain > toe {
                    stiffness * (strain - bow * next)
                } else {
                    stiffness * strain * (bow * strain / toe + 2.0 * toe_ratio - 1.0)
                };
                (load, next)
            }
            _ => (self.law.elastic(memory.peak, strain).load, toe),
        };
        let friction = self.friction(state, strain);
        let memory = Memory { position: strain, friction, peak };
        (elastic + friction[0] + friction[1], State { memory, toe: next_toe })
    }

    /// The friction at the end of a straight way, which is cut where the slope of its weight changes.
    fn friction(&self, state: &State, strain: f64) -> [f64; 2] {
        let State { memory, toe } = *state;
        let slack = -self.law.buckling.strain;
        let weight = |strain: f64| {
            if strain >= toe {
                1.0
            } else if strain >= 0.0 {
                self.at_rest + (1.0 - self.at_rest) * strain / toe
            } else {
                self.at_rest * (1.0 - strain / slack).max(0.0)
            }
        };
        let (mut at, mut loads) = (memory.position, memory.friction);
        let mut go = |end: f64| {
            let slip = Slip::weighted(end - at, weight(at), weight(end));
            loads = self.law.friction.advance(loads, slip);
            at = end;
        };
        let knots = [slack, 0.0, toe];
        let between = |knot: &f64| {
            (*knot > memory.position && *knot < strain)
                || (*knot < memory.position && *knot > strain)
        };
        if strain >= memory.position {
            knots.into_iter().filter(between).for_each(&mut go);
        } else {
            knots.into_iter().rev().filter(between).for_each(&mut go);
        }
        go(strain);
        loads
    }

    /// The state in which the load vanishes, on the way to a lower strain with a negative load.
    fn vanishing(&self, state: &State, strain: f64) -> State {
        let (mut slack, mut taut) = (strain, state.memory.position);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (slack + taut);
            if self.step(state, middle).0 < 0.0 {
                slack = middle;
            } else {
                taut = middle;
            }
        }
        self.step(state, taut).1
    }
}

/// Writes the loads that a virgin fabric shows along a history of strains.
///
/// The history need not start at zero: the way to its first point is part of it, in one straight stretch.
pub(crate) fn along(law: &TractionLaw, history: impl Iterator<Item = f64>, out: &mut [f64]) {
    let pull = Pull::new(law);
    let mut state = pull.virgin();
    for (load, strain) in out.iter_mut().zip(history) {
        (*load, state) = pull.step(&state, strain);
    }
}

/// Writes the loads of a strip between clamps that may come closer than its length.
///
/// A strip carries no compression: where the law's load would be negative the strip sags instead. It then
/// keeps the strain at which its load vanished, and takes up load again once the clamps pass that strain.
pub(crate) fn along_slack(law: &TractionLaw, clamps: impl Iterator<Item = f64>, out: &mut [f64]) {
    let pull = Pull::new(law);
    let mut state = pull.virgin();
    let mut sags = false;
    for (load, strain) in out.iter_mut().zip(clamps) {
        *load = 0.0;
        if sags && strain <= state.memory.position {
            continue;
        }
        let (taut, next) = pull.step(&state, strain);
        sags = taut < 0.0;
        if sags {
            state = pull.vanishing(&state, strain);
        } else {
            (*load, state) = (taut, next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::{BlimanSorine, Buckling, Law, Polynomial, drive};

    fn law() -> TractionLaw {
        TractionLaw {
            backbone: TractionBackbone::Primed(Primed {
                stiffness: 1e4,
                toe_ratio: 0.6,
                toe_strain: 0.01,
                toe_strain_after: 0.014,
            }),
            friction: BlimanSorine::first_order(4.0, 0.001),
            buckling: Buckling::default(),
        }
    }

    #[test]
    fn a_taut_strip_follows_the_law_and_a_slack_one_carries_nothing() {
        let law = law();
        let history = [0.01, 0.03, 0.05, 0.045, 0.05];
        let (mut plain, mut strip) = ([0.0; 5], [0.0; 5]);
        along(&law, history.into_iter(), &mut plain);
        along_slack(&law, history.into_iter(), &mut strip);
        assert_eq!(plain, strip);
        let mut slack = [1.0; 3];
        along_slack(&law, [-0.02, -0.01, 0.0].into_iter(), &mut slack);
        assert_eq!(slack, [0.0; 3]);
    }

    #[test]
    fn how_far_a_strip_sags_does_not_matter_to_its_next_pull() {
        let law = law();
        let pull_again = |slack: f64| {
            let mut loads = [0.0; 4];
            along_slack(&law, [0.04, slack, 0.02, 0.03].into_iter(), &mut loads);
            loads
        };
        let (little, much) = (pull_again(-0.001), pull_again(-0.02));
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
        // Pulls, recoveries, and buckling, in steps that pass several knots and in small ones.
        let mut history = vec![0.004, 0.02, -0.01, 0.05, 0.013, 0.0, -0.001, 0.03, 0.03, 0.08];
        history.extend(
            (0..200).map(|i| 0.04 * (1.0 + 0.005 * f64::from(i)) * (0.2 * f64::from(i)).sin()),
        );
        for backbone in [law().backbone, polynomial, still] {
            let law = TractionLaw { backbone, ..law() };
            let mut found = vec![0.0; history.len()];
            along(&law, history.iter().copied(), &mut found);
            let exact = drive(&law, law.virgin(), &history);
            for ((strain, found), exact) in history.iter().zip(&found).zip(&exact) {
                // Sums of some hundred N/m in another order.
                assert!((found - exact).abs() < 1e-11, "{backbone:?} at {strain}: {found} {exact}");
            }
        }
    }
}
