//! The traction law with an exponential toe and friction that grows with the tension: what makes it
//! a law of cloth.

use drape_fabric::{
    Buckling, ExponentialToe, FRICTION_RATIO_MAX, Law, Memory, ProportionalFriction,
    TractionBackbone, TractionLaw, drive,
};

fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

fn toe(random_state: &mut u64) -> ExponentialToe {
    let toe_strain = 0.005 + 0.05 * random(random_state);
    ExponentialToe {
        base_stiffness: 800.0 * random(random_state),
        stiffness: 500.0 + 2e4 * random(random_state),
        steepness: 0.05 + 9.0 * random(random_state),
        toe_strain,
        toe_strain_after: toe_strain * (1.0 + random(random_state)),
    }
}

/// Returns random laws: with the largest ratio of friction, and with and without a plateau.
fn laws() -> Vec<TractionLaw> {
    let mut state = 7_u64;
    let law = |index: usize| {
        let toe = toe(&mut state);
        let friction = ProportionalFriction {
            ratio: FRICTION_RATIO_MAX
                * if index.is_multiple_of(3) { 1.0 } else { random(&mut state) },
            plateau: if index.is_multiple_of(2) { 0.0 } else { 8.0 * random(&mut state) },
            length: 0.0005 + 0.04 * random(&mut state),
        };
        let strain = friction.buckling_strain(&toe);
        TractionLaw {
            backbone: TractionBackbone::Exponential(toe),
            friction: friction.into(),
            buckling: Buckling { strain, ..Buckling::default() },
        }
    };
    (0..24).map(law).collect()
}

/// Returns a random memory of a law, after some turns between compression and large strains.
fn memory(law: &TractionLaw, state: &mut u64) -> Memory {
    let turns = 1 + (5.0 * random(state)) as usize;
    let turn = |memory: Memory, _: usize| law.commit(&memory, -0.01 + 0.08 * random(state));
    (0..turns).fold(law.virgin(), turn)
}

#[test]
fn the_load_rises_with_the_strain_on_every_branch() {
    let mut state = 3_u64;
    for law in laws() {
        for _ in 0..50 {
            let memory = memory(&law, &mut state);
            let at = |i: u32| law.respond(&memory, -0.02 + 0.1 * f64::from(i) / 400.0);
            for i in 0..400 {
                let (less, more) = (at(i), at(i + 1));
                assert!(less.load < more.load, "{law:?} {memory:?}: {less:?} then {more:?}");
                assert!(less.tangent > 0.0, "{law:?} {memory:?}: {less:?}");
            }
        }
    }
}

#[test]
fn yarns_without_a_plateau_never_push() {
    let mut state = 4_u64;
    for law in laws().into_iter().step_by(2) {
        for _ in 0..50 {
            let memory = memory(&law, &mut state);
            for i in 0..200 {
                let load = law.respond(&memory, 0.08 * f64::from(i) / 200.0).load;
                assert!(load >= 0.0, "{law:?} {memory:?}: {load}");
            }
        }
    }
}

#[test]
fn the_work_is_the_integral_of_the_load() {
    let mut state = 5_u64;
    // Gauss's three points on each of 200 parts err by the sixth power of a part.
    let nodes = [(-(0.6_f64.sqrt()), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6_f64.sqrt(), 5.0 / 9.0)];
    for law in laws() {
        let mut worst = 0.0_f64;
        let mut scale = 0.0_f64;
        for _ in 0..20 {
            let memory = memory(&law, &mut state);
            let end = -0.005 + 0.08 * random(&mut state);
            // Parts end at the kinks of the load.
            let TractionBackbone::Exponential(toe) = law.backbone else { continue };
            let kinks = [0.0, toe.toe(memory.peak), memory.peak.max(toe.toe_strain)];
            let (low, high) = (memory.position.min(end), memory.position.max(end));
            let mut ends = vec![low];
            ends.extend(kinks.into_iter().filter(|k| *k > low && *k < high));
            ends.push(high);
            let mut integral = 0.0;
            for part in ends.windows(2) {
                let half = 0.5 * (part[1] - part[0]) / 200.0;
                for i in 0..200 {
                    let middle = part[0] + half * f64::from(2 * i + 1);
                    for (node, weight) in nodes {
                        let load = law.respond(&memory, middle + half * node).load;
                        integral += half * weight * load;
                    }
                }
            }
            let integral = if end < memory.position { -integral } else { integral };
            worst = worst.max((law.work(&memory, end) - integral).abs());
            scale = scale.max(integral.abs());
        }
        assert!(worst < 1e-9 * scale, "{law:?}: {worst:e} of {scale:e}");
    }
}

#[test]
fn every_piece_of_a_path_dissipates() {
    let mut state = 6_u64;
    for law in laws() {
        let mut memory = law.virgin();
        let mut scale = 0.0_f64;
        for _ in 0..400 {
            let end = memory.position + 0.02 * (random(&mut state) - 0.5);
            let end = end.clamp(-0.01, 0.07);
            let work = law.work(&memory, end);
            let next = law.commit(&memory, end);
            let lost = work - (law.stored(&next) - law.stored(&memory));
            scale = scale.max(law.stored(&next));
            assert!(lost >= -1e-12 * scale, "{law:?} {memory:?} to {end}: gained {lost:e}");
            memory = next;
        }
    }
}

#[test]
fn no_path_gives_back_more_than_is_stored() {
    let mut state = 8_u64;
    for law in laws() {
        for _ in 0..40 {
            let start = memory(&law, &mut state);
            let stored = law.stored(&start);
            let (mut at, mut returned) = (start, 0.0);
            for _ in 0..30 {
                // Strains that were not reached before are left out: they change the toe.
                let end =
                    (at.position + 0.02 * (random(&mut state) - 0.6)).clamp(-0.01, start.peak);
                returned -= law.work(&at, end);
                at = law.commit(&at, end);
                assert!(returned <= stored * (1.0 + 1e-12), "{law:?}: {returned} of {stored}");
            }
        }
    }
}

#[test]
fn a_finely_cut_history_gives_the_loads_and_works_of_a_coarse_one() {
    for law in laws() {
        let (mut coarse, mut fine) = (law.virgin(), law.virgin());
        let (mut coarse_work, mut fine_work) = (0.0, 0.0);
        for end in [0.04, -0.004, 0.02, 0.035, 0.05, 0.001] {
            coarse_work += law.work(&coarse, end);
            coarse = law.commit(&coarse, end);
            let from = fine.position;
            for i in 1..=64 {
                let next = from + (end - from) * f64::from(i) / 64.0;
                fine_work += law.work(&fine, next);
                fine = law.commit(&fine, next);
            }
            assert!((coarse.friction[0] - fine.friction[0]).abs() < 1e-12, "{law:?}");
            // The toe moves from cut to cut on a virgin path, and the work follows it.
            let error = (coarse_work - fine_work).abs();
            assert!(error < 1e-10 * coarse_work.abs(), "{law:?}: {coarse_work} {fine_work}");
        }
    }
}

#[test]
fn the_toe_meets_its_tangent_and_has_the_linearity_of_its_closed_form() {
    let toe = ExponentialToe {
        base_stiffness: 0.0,
        stiffness: 9000.0,
        steepness: 4.0,
        toe_strain: 0.05,
        toe_strain_after: 0.05,
    };
    let law = TractionLaw {
        backbone: TractionBackbone::Exponential(toe),
        friction: ProportionalFriction { ratio: 0.0, plateau: 0.0, length: 1.0 }.into(),
        buckling: Buckling::default(),
    };
    let virgin = law.virgin();
    for strain in [0.05 * (1.0 - 1e-12), 0.05 * (1.0 + 1e-12)] {
        let response = law.respond(&virgin, strain);
        let exact = 9000.0 * 0.05 / 4.0 * (1.0 - (-4.0_f64).exp());
        assert!((response.load / exact - 1.0).abs() < 1e-10, "{response:?} {exact}");
        assert!((response.tangent / 9000.0 - 1.0).abs() < 1e-10, "{response:?}");
    }
    assert_eq!(law.respond(&virgin, 0.0).load, 0.0);
    // With F ~ e^{bx} − 1, the work is (e^b − 1 − b)/b, so LT = 2 (1/b − 1/(e^b − 1)).
    let load = law.respond(&virgin, 0.05).load;
    let linearity = law.work(&virgin, 0.05) / (0.5 * load * 0.05);
    let exact = 2.0 * (0.25 - 1.0 / 4.0_f64.exp_m1());
    assert!((linearity / exact - 1.0).abs() < 1e-12, "{linearity} {exact}");
}

#[test]
fn the_loads_of_a_loop_lie_between_those_of_full_friction() {
    let mut state = 9_u64;
    for law in laws() {
        let history: Vec<f64> = (0..200).map(|_| 0.06 * random(&mut state)).collect();
        let loads = drive(&law, law.virgin(), &history);
        let mut peak = 0.0_f64;
        for (strain, load) in history.iter().zip(loads) {
            let elastic = law.elastic(peak, *strain).load;
            peak = peak.max(*strain);
            let drape_fabric::TractionFriction::Proportional(friction) = law.friction else {
                continue;
            };
            let most = friction.plateau + friction.ratio * elastic;
            assert!((load - elastic).abs() <= most * (1.0 + 1e-12), "{law:?} at {strain}");
        }
    }
}
