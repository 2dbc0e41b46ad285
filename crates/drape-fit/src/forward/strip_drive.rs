//! Loads of a traction law along the history of a strip, which may hang slack between its clamps.
//!
//! Used by the tensile fits of `curves`.

use drape_fabric::{Memory, Primed, TractionBackbone, TractionLaw};
use drape_hysteresis::Slip;

/// Bisections for the strain at which a strip goes slack: the bits of a double.
const BISECTIONS: usize = 60;

/// Memory of a strip, with the length of the priming zone that follows from it.
#[derive(Clone, Copy)]
struct State {
    memory: Memory,
    toe: f64,
}

/// State after a step, with the load there.
struct Step {
    load: f64,
    state: State,
}

/// Traction law that stores the length of its priming zone, which takes an exponential to compute.
///
/// It is the law of drape-fabric, in half the time along a history.
struct Strip<'a> {
    law: &'a TractionLaw,
    primed: Option<Primed>,
    /// Weight of the friction at rest.
    weight_at_rest: f64,
}

impl<'a> Strip<'a> {
    fn new(law: &'a TractionLaw) -> Self {
        match law.backbone {
            TractionBackbone::Primed(primed) => {
                Self { law, primed: Some(primed), weight_at_rest: 2.0 - 1.0 / primed.toe_ratio }
            }
            TractionBackbone::Polynomial(_) => Self { law, primed: None, weight_at_rest: 1.0 },
        }
    }

    fn virgin(&self) -> State {
        let toe = self.primed.map_or(0.0, |primed| primed.toe_strain);
        State { memory: Memory::default(), toe }
    }

    /// Returns load and state at a strain that follows a state.
    ///
    /// With the toe ratio `$r$` the elastic load is
    /// `$k\varepsilon((1 - r)\varepsilon/\varepsilon_c + 2r - 1)$` up to the end `$\varepsilon_c$`
    /// of the priming zone, and `$k(\varepsilon - (1 - r)\varepsilon_c)$` beyond \[NB04, eq. 3\].
    fn step(&self, state: &State, strain: f64) -> Step {
        let State { memory, toe } = *state;
        let peak = memory.peak.max(strain);
        let (elastic, next_toe) = match self.primed {
            Some(primed) if strain >= 0.0 => {
                let Primed { stiffness, toe_ratio, toe_strain, toe_strain_after } = primed;
                let quadratic = 1.0 - toe_ratio;
                let longer = strain > memory.peak.max(toe_strain);
                let grows = longer && toe_strain_after != toe_strain;
                let next = if grows { primed.toe(strain) } else { toe };
                let load = if longer || strain > toe {
                    stiffness * (strain - quadratic * next)
                } else {
                    stiffness * strain * (quadratic * strain / toe + 2.0 * toe_ratio - 1.0)
                };
                (load, next)
            }
            _ => (self.law.elastic(memory.peak, strain).load, toe),
        };
        let friction = self.friction(state, strain);
        let memory = Memory { position: strain, friction, peak };
        let load = elastic + friction[0] + friction[1];
        Step { load, state: State { memory, toe: next_toe } }
    }

    /// Returns the friction after a monotonic step, which is split where the slope of its weight
    /// changes.
    fn friction(&self, state: &State, strain: f64) -> [f64; 2] {
        let State { memory, toe } = *state;
        let slack = -self.law.buckling.strain;
        let weight = |strain: f64| {
            if strain >= toe {
                1.0
            } else if strain >= 0.0 {
                self.weight_at_rest + (1.0 - self.weight_at_rest) * strain / toe
            } else {
                self.weight_at_rest * (1.0 - strain / slack).max(0.0)
            }
        };
        let (mut at, mut loads) = (memory.position, memory.friction);
        let mut advance = |end: f64| {
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
            knots.into_iter().filter(between).for_each(&mut advance);
        } else {
            knots.into_iter().rev().filter(between).for_each(&mut advance);
        }
        advance(strain);
        loads
    }

    /// Returns the state at which the load vanishes, before a lower strain with a negative load.
    fn vanishing(&self, state: &State, strain: f64) -> State {
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

/// Writes the loads of a virgin fabric along a history of strains.
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

/// Writes the loads of a strip between clamps that may come closer than its length.
///
/// A strip carries no compression: where the load of the law would be negative the strip sags. It
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
        for backbone in [law().backbone, polynomial, still] {
            let law = TractionLaw { backbone, ..law() };
            let mut found = vec![0.0; history.len()];
            drive_strip(&law, history.iter().copied(), &mut found);
            let exact = drive(&law, law.virgin(), &history);
            for ((strain, found), exact) in history.iter().zip(&found).zip(&exact) {
                // Sums of some hundred N/m in another order.
                assert!((found - exact).abs() < 1e-11, "{backbone:?} at {strain}: {found} {exact}");
            }
        }
    }
}
