//! A law driven along a measured history.

use drape_fabric::{BendingLaw, Law, Memory, ShearBackbone, ShearLaw, TractionLaw};

/// Halvings when looking for the strain at which a strip goes slack: as many as a double has bits to give.
const HALVINGS: usize = 60;

/// A law whose elastic load can be had without its friction.
///
/// Committing a step already gives the friction at its end, so the load costs nothing more. Following a
/// history this way is twice as fast as asking for the response first.
pub(crate) trait Driven: Law {
    /// Elastic load at a deformation that follows a memory.
    fn elastic_load(&self, memory: &Memory, deformation: f64) -> f64;

    /// Load at a deformation, and the memory there.
    fn step(&self, memory: &Memory, deformation: f64) -> (f64, Memory) {
        let next = self.commit(memory, deformation);
        let [first, second] = next.friction;
        (self.elastic_load(memory, deformation) + first + second, next)
    }
}

impl Driven for TractionLaw {
    fn elastic_load(&self, memory: &Memory, strain: f64) -> f64 {
        self.elastic(memory.peak, strain).load
    }
}

impl Driven for BendingLaw {
    fn elastic_load(&self, _memory: &Memory, curvature: f64) -> f64 {
        self.backbone.respond(curvature - self.rest_curvature).load
    }
}

/// Without locking: no measured curve goes beyond its onset.
impl Driven for ShearLaw {
    fn elastic_load(&self, _memory: &Memory, shear: f64) -> f64 {
        match self.backbone {
            ShearBackbone::Linear { stiffness } => stiffness * shear,
            ShearBackbone::Piecewise(piecewise) => piecewise.load(shear),
        }
    }
}

/// Writes the loads that a virgin fabric shows along a history.
///
/// The history need not start at zero: the way to its first point is part of it, in one straight stretch.
pub(crate) fn along(law: &impl Driven, history: impl Iterator<Item = f64>, out: &mut [f64]) {
    let mut memory = law.virgin();
    for (load, deformation) in out.iter_mut().zip(history) {
        (*load, memory) = law.step(&memory, deformation);
    }
}

/// Writes the loads of a strip between clamps that may come closer than its length.
///
/// A strip carries no compression: where the law's load would be negative the strip sags instead. It then
/// keeps the strain at which its load vanished, and takes up load again once the clamps pass that strain.
pub(crate) fn along_slack(law: &TractionLaw, clamps: impl Iterator<Item = f64>, out: &mut [f64]) {
    let mut memory = law.virgin();
    let mut sags = false;
    for (load, strain) in out.iter_mut().zip(clamps) {
        *load = 0.0;
        if sags && strain <= memory.position {
            continue;
        }
        let (taut, next) = law.step(&memory, strain);
        sags = taut < 0.0;
        if sags {
            memory = law.commit(&memory, vanishing(law, &memory, strain));
        } else {
            (*load, memory) = (taut, next);
        }
    }
}

/// The strain at which the load vanishes, between the remembered one and a lower one with a negative load.
fn vanishing(law: &TractionLaw, memory: &Memory, strain: f64) -> f64 {
    let (mut slack, mut taut) = (strain, memory.position);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (slack + taut);
        if law.step(memory, middle).0 < 0.0 {
            slack = middle;
        } else {
            taut = middle;
        }
    }
    taut
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::{BlimanSorine, Buckling, Primed, TractionBackbone};

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
}
