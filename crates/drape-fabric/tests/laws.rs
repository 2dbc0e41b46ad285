//! The laws against finite differences, against the closed forms of their loops, and as energy.

use drape_fabric::{
    BendingBackbone, BendingLaw, BlimanSorine, Buckling, Dahl, ExponentialToe, Law, Locking,
    Memory, Piecewise, Polynomial, Primed, ProportionalFriction, ShearBackbone, ShearLaw,
    TractionBackbone, TractionFriction, TractionLaw, Varying, drive,
};

fn primed(toe_ratio: f64, after: f64) -> TractionLaw {
    TractionLaw {
        backbone: TractionBackbone::Primed(Primed {
            stiffness: 4000.0,
            toe_ratio,
            toe_strain: 0.015,
            toe_strain_after: after,
        }),
        friction: BlimanSorine::first_order(3.0, 0.001).expect("a friction").into(),
        buckling: Buckling::default(),
    }
}

fn exponential(steepness: f64, after: f64, friction: ProportionalFriction) -> TractionLaw {
    let toe = ExponentialToe {
        base_stiffness: 400.0,
        stiffness: 4000.0,
        steepness,
        toe_strain: 0.015,
        toe_strain_after: after,
    };
    let strain = friction.buckling_strain(&toe);
    TractionLaw {
        backbone: TractionBackbone::Exponential(toe),
        friction: friction.into(),
        buckling: Buckling { strain, ..Buckling::default() },
    }
}

/// Laws with an exponential toe, with friction of each kind, and with the three resonances of the
/// work: the rate of the toe is the rate of the friction, or of the toe that moves.
fn exponentials() -> Vec<TractionLaw> {
    let friction = |ratio, plateau, length| ProportionalFriction { ratio, plateau, length };
    vec![
        exponential(0.01, 0.015, friction(0.5, 0.0, 0.002)),
        exponential(3.0, 0.015, friction(0.98, 0.0, 0.015 / 3.0)),
        exponential(3.0, 0.025, friction(0.9, 4.0, 0.01)),
        exponential(6.0, 0.03, friction(0.7, 3.0, 0.015)),
        exponential(12.0, 0.02, friction(0.0, 3.0, 0.001)),
    ]
}

fn polynomial() -> TractionLaw {
    TractionLaw {
        backbone: TractionBackbone::Polynomial(Polynomial { quadratic: 8.4e4, quartic: 1.2e7 }),
        friction: TractionFriction::none(),
        buckling: Buckling::default(),
    }
}

fn bending(backbone: BendingBackbone, friction: BlimanSorine) -> BendingLaw {
    BendingLaw { backbone, rest_curvature: 12.0, friction }
}

fn shear(backbone: ShearBackbone, growth: f64) -> ShearLaw {
    let friction = BlimanSorine::parallel(
        Dahl::new(0.5, 0.004).expect("a friction"),
        Dahl::new(0.3, 0.05).expect("a friction"),
    )
    .expect("a friction");
    ShearLaw { backbone, friction, growth, locking: Some(Locking::default()) }
}

/// Rigidity that falls to a third.
const SOFTENING: Varying =
    Varying { initial_stiffness: 1.8e-5, final_stiffness: 0.6e-5, transition: 80.0 };

/// Memories that a random walk over the given range leaves, with trials from each of them.
fn walk(law: &impl Law, low: f64, high: f64) -> Vec<(Memory, f64)> {
    let mut state = 99_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        low + (high - low) * ((state >> 11) as f64 / (1_u64 << 53) as f64)
    };
    let mut memory = law.virgin();
    let mut all = Vec::new();
    for _ in 0..300 {
        let trial = random();
        all.push((memory, trial));
        memory = law.commit(&memory, trial);
    }
    all
}

/// Five-point derivative.
fn slope(f: impl Fn(f64) -> f64, at: f64, d: f64) -> f64 {
    (f(at - 2.0 * d) - 8.0 * f(at - d) + 8.0 * f(at + d) - f(at + 2.0 * d)) / (12.0 * d)
}

/// Load = d work / d deformation and tangent = d load / d deformation, away from the few points
/// where a second derivative jumps.
fn check_derivatives(law: &impl Law, range: (f64, f64), kinks: &[f64]) {
    let width = range.1 - range.0;
    let d = 1e-5 * width;
    let trials = walk(law, range.0, range.1);
    let scale = trials.iter().map(|(m, s)| law.respond(m, *s).load.abs()).fold(0.0, f64::max);
    let stiff = trials.iter().map(|(m, s)| law.respond(m, *s).tangent.abs()).fold(0.0, f64::max);
    let mut checked = 0;
    for (memory, trial) in &trials {
        let near = |k: f64| (trial - k).abs() < 3.0 * d;
        if kinks.iter().any(|&k| near(k)) || near(memory.position) || near(memory.peak) {
            continue;
        }
        let response = law.respond(memory, *trial);
        let load = slope(|s| law.work(memory, s), *trial, d);
        assert!(
            (load - response.load).abs() < 1e-7 * scale,
            "{memory:?} at {trial}: load {} but work has slope {load}",
            response.load
        );
        let tangent = slope(|s| law.respond(memory, s).load, *trial, d);
        assert!(
            (tangent - response.tangent).abs() < 1e-6 * stiff,
            "{memory:?} at {trial}: tangent {} but load has slope {tangent}",
            response.tangent
        );
        assert!(law.work(memory, memory.position).abs() < 1e-12 * scale * width);
        checked += 1;
    }
    assert!(checked > 250, "only {checked} trials were away from the kinks");
}

#[test]
fn traction_load_and_tangent_are_derivatives_of_the_work() {
    for (ratio, after) in [(0.505, 0.015), (0.6, 0.022), (0.8, 0.03), (1.0, 0.02)] {
        let law = primed(ratio, after);
        let TractionBackbone::Primed(backbone) = law.backbone else {
            continue;
        };
        // The toe's end moves with the memory: leave out trials near any of its places.
        let places: Vec<f64> =
            walk(&law, -0.01, 0.06).iter().map(|(m, _)| backbone.toe(m.peak)).collect();
        let kinks = [&places[..1], &places[places.len() - 1..], &[0.0, -0.002, 0.015]].concat();
        check_derivatives(&law, (-0.01, 0.06), &kinks);
    }
    check_derivatives(&polynomial(), (-0.01, 0.06), &[0.0]);
    for law in exponentials() {
        let TractionBackbone::Exponential(backbone) = law.backbone else { continue };
        let places: Vec<f64> =
            walk(&law, -0.01, 0.06).iter().map(|(m, _)| backbone.toe(m.peak)).collect();
        let kinks = [&places[..1], &places[places.len() - 1..], &[0.0, 0.015]].concat();
        check_derivatives(&law, (-0.01, 0.06), &kinks);
    }
}

#[test]
fn bending_load_and_tangent_are_derivatives_of_the_work() {
    let linear = BendingBackbone::Linear { rigidity: 1.2e-5 };
    let breen = Piecewise { slope: 1.2e-5, intercept: 4e-4, knot: 40.0 };
    for law in [
        bending(linear, BlimanSorine::first_order(6e-4, 4.0).expect("a friction")),
        bending(linear, BlimanSorine::second_order(9e-4, 3e-4, 0.2, 20.0).expect("a friction")),
        bending(BendingBackbone::Piecewise(breen), BlimanSorine::none()),
        bending(
            BendingBackbone::Varying(SOFTENING),
            BlimanSorine::first_order(6e-4, 4.0).expect("a friction"),
        ),
    ] {
        check_derivatives(&law, (-250.0, 250.0), &[12.0, 52.0, -28.0]);
    }
}

#[test]
fn shear_load_and_tangent_are_derivatives_of_the_work() {
    let locking = Locking::default();
    let straight = locking.onset + 0.95 * (locking.limit - locking.onset);
    let breen = Piecewise { slope: 30.0, intercept: 0.6, knot: 0.02 };
    let stiffening = Varying { initial_stiffness: 20.0, final_stiffness: 90.0, transition: 0.1 };
    for backbone in [
        ShearBackbone::Linear { stiffness: 35.0 },
        ShearBackbone::Piecewise(breen),
        ShearBackbone::Varying(stiffening),
    ] {
        for (growth, range) in [(0.0, 0.14), (11.0, 0.14), (11.0, 0.95)] {
            let kinks = [0.0, 0.02, -0.02, locking.onset, -locking.onset, straight, -straight];
            check_derivatives(&shear(backbone, growth), (-range, range), &kinks);
        }
    }
}

#[test]
fn the_priming_zone_meets_the_line_with_value_and_slope() {
    let law = primed(0.7, 0.015);
    let memory = law.virgin();
    let (k, e1, f1) = (4000.0, 0.015, 0.7 * 4000.0 * 0.015);
    // The paper's form: (aε + b)·k ε/ε_c with a = 1 − F1/(k ε_c), b = 2F1/k − ε_c.
    let paper = |e: f64| ((1.0 - f1 / (k * e1)) * e + 2.0 * f1 / k - e1) * k * e / e1;
    for e in [0.002, 0.007, 0.0149] {
        let load = law.elastic(0.0, e).load;
        assert!((load - paper(e)).abs() < 1e-12 * f1, "at {e}: {load} against {}", paper(e));
    }
    for (e, side) in [(e1 * (1.0 - 1e-12), "below"), (e1 * (1.0 + 1e-12), "above")] {
        let response = law.elastic(0.0, e);
        assert!((response.load - f1).abs() < 1e-9, "{side}: {}", response.load);
        assert!((response.tangent - k).abs() < 1e-6, "{side}: {}", response.tangent);
    }
    assert!((law.respond(&memory, 0.0).load).abs() < 1e-15);
}

#[test]
fn a_stretched_fabric_has_a_longer_toe_and_no_jump_at_the_reversal() {
    let law = primed(0.6, 0.028);
    let stretched = law.commit(&law.virgin(), 0.05);
    let virgin_load = law.respond(&law.virgin(), 0.05).load;
    let again = law.respond(&stretched, 0.05).load;
    assert!((virgin_load - again).abs() < 1e-12 * virgin_load, "{virgin_load} {again}");
    let mut released = law.commit(&stretched, 0.0);
    released.friction = [0.0; 2];
    let (second, first) =
        (law.respond(&released, 0.03).load, law.respond(&law.virgin(), 0.03).load);
    assert!(second < 0.95 * first, "the second stretch is softer: {second} after {first}");
}

#[test]
fn closed_loops_of_every_law_dissipate() {
    fn cycle(law: &impl Law, low: f64, high: f64) {
        let mut memory = law.virgin();
        for turn in 0..6 {
            let before = law.stored(&memory);
            let mut work = 0.0;
            for end in [high, low] {
                work += law.work(&memory, end);
                memory = law.commit(&memory, end);
            }
            let lost = work - (law.stored(&memory) - before);
            assert!(lost > 0.0, "cycle {turn} between {low} and {high} gained {lost}");
        }
    }
    for after in [0.015, 0.025] {
        for (low, high) in [(0.0, 0.04), (0.01, 0.012), (-0.005, 0.03)] {
            cycle(&primed(0.6, after), low, high);
        }
    }
    for law in exponentials() {
        for (low, high) in [(0.0, 0.04), (0.01, 0.012), (-0.005, 0.03)] {
            cycle(&law, low, high);
        }
    }
    let friction = BlimanSorine::second_order(9e-4, 3e-4, 0.2, 20.0).expect("a friction");
    let law = bending(BendingBackbone::Linear { rigidity: 1.2e-5 }, friction);
    for (low, high) in [(-250.0, 250.0), (-5.0, 3.0), (100.0, 140.0)] {
        cycle(&law, low, high);
    }
    for (low, high) in [(-0.139, 0.139), (0.02, 0.03), (-0.3, 0.5)] {
        cycle(&shear(ShearBackbone::Linear { stiffness: 35.0 }, 11.0), low, high);
    }
}

#[test]
fn a_finely_cut_history_gives_the_loads_of_a_coarse_one() {
    let law = primed(0.6, 0.025);
    let coarse = [0.04, -0.01, 0.02, 0.05];
    let mut fine = Vec::new();
    let mut from = 0.0;
    for to in coarse {
        fine.extend((1..=64).map(|i| from + (to - from) * f64::from(i) / 64.0));
        from = to;
    }
    let coarse_loads = drive(&law, law.virgin(), &coarse);
    let fine_loads = drive(&law, law.virgin(), &fine);
    for (index, load) in coarse_loads.iter().enumerate() {
        let other = fine_loads[64 * index + 63];
        // Friction in the toe depends on the toe's length when the piece began.
        assert!((load - other).abs() < 1e-9 * 160.0, "point {index}: {load} against {other}");
    }
}

#[test]
fn a_steady_bending_loop_has_the_closed_form() {
    let (b, fc, length, tip) = (1.2e-5, 6e-4, 30.0, 250.0);
    let law = BendingLaw {
        backbone: BendingBackbone::Linear { rigidity: b },
        rest_curvature: 0.0,
        friction: BlimanSorine::first_order(fc, length).expect("a friction"),
    };
    let mut history = [tip, -tip].repeat(10);
    history.extend([50.0, tip, 50.0]);
    let loads = drive(&law, law.virgin(), &history);
    let last = &loads[loads.len() - 3..];
    let (rising, top, falling) = (last[0], last[1], last[2]);
    let exact_top = b * tip + fc * (tip / length).tanh();
    assert!((top - exact_top).abs() < 1e-9 * exact_top, "tip {top}, exact {exact_top}");
    let exact = 2.0 * fc * (1.0 - (50.0 / length).cosh() / (tip / length).cosh());
    let width = rising - falling;
    assert!((width - exact).abs() < 1e-9 * exact, "width {width}, exact {exact}");
}

#[test]
fn locking_keeps_the_shear_below_its_limit() {
    let law = shear(ShearBackbone::Linear { stiffness: 35.0 }, 0.0);
    let limit = Locking::default().limit;
    let load = |s: f64| law.respond(&law.virgin(), s).load;
    assert!(load(0.99 * limit) > 20.0 * 35.0 * limit, "{}", load(0.99 * limit));
    assert!(load(2.0).is_finite() && load(2.0) > load(0.9 * limit));
    assert!((load(0.3) + load(-0.3)).abs() < 1e-12, "odd");
}

#[test]
fn the_secant_of_breens_curve_is_that_of_its_quadratic_and_its_line() {
    let law = Piecewise { slope: 1.2e-5, intercept: 4e-4, knot: 40.0 };
    // L(d) = p·d + q·d² up to the knot, with q = −c/d_k² and p = s + 2c/d_k; beyond it c + s·d.
    let (p, q) = (1.2e-5 + 2.0 * 4e-4 / 40.0, -4e-4 / 1600.0);
    for d in [0.0, 1.0, 15.0, 40.0] {
        assert!((law.secant(d) / (p + q * d) - 1.0).abs() < 1e-12, "at {d}: {}", law.secant(d));
    }
    for d in [40.1, 70.0, 250.0] {
        let exact = 1.2e-5 + 4e-4 / d;
        assert!((law.secant(d) / exact - 1.0).abs() < 1e-12, "at {d}: {}", law.secant(d));
    }
}

#[test]
fn a_varying_stiffness_has_its_two_ends_and_the_secant_of_its_load() {
    let Varying { initial_stiffness, final_stiffness, transition } = SOFTENING;
    let tangent = |q: f64| SOFTENING.respond(q).tangent;
    assert_eq!(tangent(0.0), initial_stiffness);
    // A hundred transitions away (1 + u²)^{-3/2} is a millionth.
    assert!((tangent(100.0 * transition) / final_stiffness - 1.0).abs() < 3e-6);
    for q in [1e-6, 3.0, 80.0, 400.0] {
        let response = SOFTENING.respond(q);
        let secant = SOFTENING.secant(q * q);
        assert!((response.load / (q * secant) - 1.0).abs() < 1e-12, "at {q}");
        let excess = SOFTENING.excess(q * q) * q * q;
        assert!((response.tangent - secant - excess).abs() < 1e-12 * secant, "at {q}");
        assert!((SOFTENING.respond(-q).load + response.load).abs() == 0.0, "odd at {q}");
        // Connectors that take a third of the curvature have a third of the moment, there.
        let third = SOFTENING.of_fraction(1.0 / 3.0);
        let exact = response.load / 3.0;
        assert!((third.respond(3.0 * q).load / exact - 1.0).abs() < 1e-12, "at {q}");
    }
}
