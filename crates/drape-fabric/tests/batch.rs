//! Laws side by side against the same laws one by one.

use drape_fabric::{
    BatchLaw, BendingBackbone, BendingBatch, BendingLaw, BlimanSorine, Buckling, Dahl,
    ExponentialToe, LANES, Lanes, Law, Locking, Memory, Piecewise, Polynomial, Primed,
    ProportionalFriction, Responses, ShearBackbone, ShearBatch, ShearLaw, TractionBackbone,
    TractionBatch, TractionFriction, TractionLaw, Varying,
};

/// Rounding of a dozen operations and of the exponential, on the scale of what is compared.
const TOLERANCE: f64 = 1e-13;

fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
    (*state >> 11) as f64 / (1_u64 << 53) as f64
}

/// Drives connectors along random walks, side by side and one by one; `places` are deformations to
/// come back to exactly, so that knots are met, left and passed.
fn compare<L: Law, B: BatchLaw>(law: &L, batch: &B, range: (f64, f64), places: &[f64]) {
    let mut state = 5_u64;
    let mut together = batch.memories(LANES);
    let mut apart = [law.virgin(); LANES];
    let mut scales = [0.0_f64; 4];
    let mut errors = [0.0_f64; 4];
    let mut note = |kind: usize, found: f64, exact: f64, context: &str| {
        scales[kind] = scales[kind].max(exact.abs());
        errors[kind] = errors[kind].max((found - exact).abs());
        assert!(found.is_finite(), "{context}: {found} for {exact}");
    };
    for round in 0..400 {
        let mut trial: Lanes = [0.0; LANES];
        for (lane, trial) in trial.iter_mut().enumerate() {
            let pick = random(&mut state);
            let narrow = if round % 3 == 0 { 1.0 } else { 0.02 };
            *trial = if pick < 0.1 {
                places[(random(&mut state) * places.len() as f64) as usize]
            } else if pick < 0.15 {
                apart[lane].position
            } else {
                let step = narrow * (range.1 - range.0) * (random(&mut state) - 0.5);
                (apart[lane].position + step).clamp(range.0, range.1)
            };
        }
        let memory = together.batch(0);
        let mut responses = Responses::default();
        batch.respond::<true>(&memory, &trial, &mut responses);
        let mut loads = Responses::default();
        batch.respond::<false>(&memory, &trial, &mut loads);
        assert_eq!(responses.load, loads.load, "with tangents and without");
        let (mut end, mut start) = ([0.0; LANES], [0.0; LANES]);
        batch.add_work(&memory, &trial, &mut end);
        let positions = apart.map(|memory| memory.position);
        batch.add_work(&memory, &positions, &mut start);
        let lost = batch.commit(&mut together.tail_mut(0), 0, &trial);
        let mut stored = [0.0; LANES];
        batch.add_stored(&together.batch(0), &mut stored);
        for lane in 0..LANES {
            let (before, trial) = (apart[lane], trial[lane]);
            let context = format!("round {round}, {before:?} to {trial}");
            let exact = law.respond(&before, trial);
            note(0, responses.load[lane], exact.load, &context);
            note(1, responses.tangent[lane], exact.tangent, &context);
            let work = law.work(&before, trial);
            note(2, end[lane] - start[lane], work, &context);
            let after = law.commit(&before, trial);
            note(3, stored[lane], law.stored(&after), &context);
            let exact = work - (law.stored(&after) - law.stored(&before));
            note(3, lost[lane], exact, &context);
            let found: Memory = together.get(lane);
            assert_eq!(found.position, after.position);
            assert_eq!(found.peak, after.peak);
            for element in 0..2 {
                note(0, found.friction[element], after.friction[element], &context);
            }
            apart[lane] = after;
            apart[lane].friction = found.friction;
        }
    }
    for kind in 0..4 {
        let error = errors[kind] / scales[kind];
        assert!(error < TOLERANCE, "relative error {error:e} of kind {kind}");
    }
}

#[test]
fn traction_side_by_side_is_traction_one_by_one() {
    let frictions = [
        BlimanSorine::none(),
        BlimanSorine::first_order(3.0, 0.001).expect("a friction"),
        BlimanSorine::second_order(5.0, 2.0, 0.2, 0.01).expect("a friction"),
    ];
    for friction in frictions {
        for (toe_ratio, toe_strain_after) in [(0.505, 0.015), (0.6, 0.022), (1.0, 0.03)] {
            let law = TractionLaw {
                backbone: TractionBackbone::Primed(Primed {
                    stiffness: 4000.0,
                    toe_ratio,
                    toe_strain: 0.015,
                    toe_strain_after,
                }),
                friction: friction.into(),
                buckling: Buckling::default(),
            };
            let places = [-0.01, -0.002, 0.0, 0.015, 0.03];
            compare(&law, &TractionBatch::new(law), (-0.02, 0.06), &places);
        }
        let law = TractionLaw {
            backbone: TractionBackbone::Polynomial(Polynomial { quadratic: 8.4e4, quartic: 1.2e7 }),
            friction: friction.into(),
            buckling: Buckling::default(),
        };
        compare(&law, &TractionBatch::new(law), (-0.02, 0.06), &[-0.002, 0.0]);
    }
}

#[test]
fn traction_with_an_exponential_toe_side_by_side_is_that_law_one_by_one() {
    for (steepness, toe_strain_after) in [(0.01, 0.02), (3.0, 0.015), (6.0, 0.028)] {
        for (ratio, plateau, length) in [(0.0, 0.0, 1.0), (0.8, 0.0, 0.005), (0.98, 2.0, 0.03)] {
            let toe = ExponentialToe {
                base_stiffness: 300.0,
                stiffness: 4000.0,
                steepness,
                toe_strain: 0.015,
                toe_strain_after,
            };
            let friction = ProportionalFriction { ratio, plateau, length };
            let law = TractionLaw {
                backbone: TractionBackbone::Exponential(toe),
                friction: TractionFriction::Proportional(friction),
                buckling: Buckling {
                    strain: friction.buckling_strain(&toe),
                    ..Buckling::default()
                },
            };
            let places = [-0.01, -0.002, 0.0, 0.015, 0.03];
            compare(&law, &TractionBatch::new(law), (-0.02, 0.06), &places);
        }
    }
}

#[test]
fn shear_side_by_side_is_shear_one_by_one() {
    let breen = Piecewise { slope: 30.0, intercept: 0.6, knot: 0.02 };
    let varying = Varying { initial_stiffness: 20.0, final_stiffness: 90.0, transition: 0.1 };
    let backbones = [
        ShearBackbone::Linear { stiffness: 35.0 },
        ShearBackbone::Piecewise(breen),
        ShearBackbone::Varying(varying),
    ];
    for backbone in backbones {
        for (growth, locking) in [(0.0, None), (11.0, Some(Locking::default()))] {
            let friction = BlimanSorine::parallel(
                Dahl::new(0.5, 0.004).expect("a friction"),
                Dahl::new(0.3, 0.05).expect("a friction"),
            )
            .expect("a friction");
            let law = ShearLaw { backbone, friction, growth, locking };
            let places = [-0.14, -0.02, 0.0, 0.02, 0.139];
            compare(&law, &ShearBatch::new(law), (-0.2, 0.2), &places);
            compare(&law, &ShearBatch::new(law), (-1.0, 1.0), &places);
        }
    }
}

#[test]
fn bending_side_by_side_is_bending_one_by_one() {
    let breen = Piecewise { slope: 1.2e-5, intercept: 4e-4, knot: 40.0 };
    let varying = Varying { initial_stiffness: 1.8e-5, final_stiffness: 6e-6, transition: 80.0 };
    let backbones = [
        BendingBackbone::Linear { rigidity: 1.2e-5 },
        BendingBackbone::Piecewise(breen),
        BendingBackbone::Varying(varying),
    ];
    for backbone in backbones {
        for friction in [
            BlimanSorine::none(),
            BlimanSorine::second_order(9e-4, 3e-4, 0.2, 20.0).expect("a friction"),
        ] {
            let law = BendingLaw { backbone, rest_curvature: 12.0, friction };
            let places = [0.0, 12.0, 52.0];
            compare(&law, &BendingBatch::new(law), (-250.0, 250.0), &places);
        }
    }
}

#[test]
fn a_trial_that_is_no_number_gives_none() {
    let law = ShearLaw {
        backbone: ShearBackbone::Linear { stiffness: 35.0 },
        friction: BlimanSorine::first_order(0.5, 0.004).expect("a friction"),
        growth: 6.0,
        locking: Some(Locking::default()),
    };
    let batch = ShearBatch::new(law);
    let memories = batch.memories(LANES);
    let mut responses = Responses::default();
    batch.respond::<true>(&memories.batch(0), &[f64::NAN; LANES], &mut responses);
    let mut works = [0.0; LANES];
    batch.add_work(&memories.batch(0), &[f64::NAN; LANES], &mut works);
    assert!(responses.load.iter().chain(&works).all(|x| x.is_nan()));
}
