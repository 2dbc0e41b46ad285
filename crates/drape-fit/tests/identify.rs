//! A fabric from values alone, with a note on everything that the sheet does not have.

use drape_fabric::{BendingBackbone, Fabric, Law, drive};
use drape_fit::{
    Error, FitSettings, FrictionOrder, LoopModel, identify, identify_bending, identify_shear,
    identify_tensile, identify_with,
};
use drape_kes::{BendingPoints, Curve, Direction, Model, ShearPoints, Sheet, Test, Values};

const STEPS: usize = 4000;

/// Returns the curve of a simulated KES test of a law.
fn cycle(test: Test, law: &impl Law, reversals: &[f64]) -> Curve {
    let mut q = vec![reversals[0]];
    for ends in reversals.windows(2) {
        q.extend((1..=STEPS).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / STEPS as f64));
    }
    let driven: Vec<f64> = match test {
        Test::Shear => q.iter().map(|angle| angle.sin()).collect(),
        _ => q.clone(),
    };
    let load = drive(law, law.virgin(), &driven);
    Curve::new(test, Direction::Warp, q, load).expect("a curve of a law")
}

/// Returns the KES values of a fabric from simulated tests.
fn values_of(fabric: &Fabric, direction: Direction, extension: f64) -> Values {
    let laws = match direction {
        Direction::Warp => &fabric.warp,
        Direction::Weft => &fabric.weft,
    };
    let stretched = cycle(Test::Tensile, &laws.traction, &[0.0, extension, 0.0]);
    let tensile = stretched.tensile_values().expect("a cycle");
    let loop_ = cycle(Test::Bending, &laws.bending, &[0.0, 250.0, -250.0, 250.0]);
    let bending = loop_.bending_values(&BendingPoints::default()).expect("a loop");
    let reversals = [0.0, 8.0, -8.0, 8.0].map(f64::to_radians);
    let loop_ = cycle(Test::Shear, &fabric.shear, &reversals);
    let shear = loop_.shear_values(&ShearPoints::default()).expect("a loop");
    Values {
        b: Some(bending.rigidity / 9.806_65e-5),
        two_hb: Some(bending.loop_width / 9.806_65e-3),
        g: Some(shear.stiffness / 56.187_966),
        two_hg: Some(shear.loop_width / 0.980_665),
        two_hg5: Some(shear.wide_loop_width / 0.980_665),
        lt: Some(tensile.linearity),
        wt: Some(tensile.work / 0.980_665),
        rt: tensile.resilience.map(|resilience| 100.0 * resilience),
        em: Some(100.0 * tensile.extension),
        miu: None,
        mmd: None,
        smd: None,
    }
}

fn sheet(warp: Values, weft: Values) -> Sheet {
    let mut sheet = Sheet::default();
    sheet.name = "by values".to_owned();
    sheet.w = Some(15.0);
    sheet.t = Some(0.4);
    sheet.warp = warp;
    sheet.weft = weft;
    sheet
}

const WARP: Values = Values {
    b: Some(0.09),
    two_hb: Some(0.06),
    g: Some(0.7),
    two_hg: Some(0.9),
    two_hg5: Some(1.8),
    lt: Some(0.72),
    wt: None,
    rt: Some(62.0),
    em: Some(4.5),
    miu: None,
    mmd: None,
    smd: None,
};

#[test]
fn a_fabric_from_values_has_these_values() {
    let weft = Values { b: Some(0.05), em: Some(7.0), lt: Some(0.62), ..WARP };
    let fit = identify(&sheet(WARP, weft)).expect("identified");
    for (direction, exact) in [(Direction::Warp, WARP), (Direction::Weft, weft)] {
        let extension = exact.em.expect("given") / 100.0;
        let found = values_of(&fit.fabric, direction, extension);
        let work = exact.lt.zip(exact.em).map(|(lt, em)| 0.5 * lt * 500.0 * em / 100.0);
        let pairs = [
            (found.b, exact.b),
            (found.two_hb, exact.two_hb),
            (found.g, exact.g),
            (found.two_hg, exact.two_hg),
            (found.two_hg5, exact.two_hg5),
            (found.lt, exact.lt),
            (found.wt, work),
            (found.rt, exact.rt),
        ];
        for (found, exact) in pairs {
            let (found, exact) = (found.expect("measured"), exact.expect("given"));
            // The law has the values exactly; the curve has 4000 points a branch and is
            // interpolated linearly.
            assert!((found / exact - 1.0).abs() < 1e-4, "{direction:?}: {found} against {exact}");
        }
    }
}

#[test]
fn work_stands_in_for_linearity_or_extension() {
    // WT = ½·LT·FM·EM in gf·cm/cm², EM in percent.
    let work = 0.5 * 0.72 * 500.0 * 0.045;
    let without_linearity = Values { lt: None, wt: Some(work), ..WARP };
    let without_extension = Values { em: None, wt: Some(work), ..WARP };
    let whole = identify(&sheet(WARP, WARP)).expect("identified").fabric;
    for values in [without_linearity, without_extension] {
        let fabric = identify(&sheet(values, values)).expect("identified").fabric;
        let load = |fabric: &Fabric| {
            let law = &fabric.warp.traction;
            law.respond(&law.virgin(), 0.03).load
        };
        let error = load(&fabric) / load(&whole) - 1.0;
        assert!(error.abs() < 1e-9, "{values:?}: {error}");
    }
}

#[test]
fn everything_that_is_missing_is_named_and_a_whole_sheet_leaves_little() {
    let mut bare = Sheet::default();
    bare.name = "nothing known".to_owned();
    let fit = identify(&bare).expect("a fabric of assumptions");
    for what in [
        "density",
        "thickness",
        "surface_friction",
        "traction",
        "bending",
        "shear stiffness",
        "shear loop",
    ] {
        let named =
            fit.assumed.iter().any(|note| note.starts_with(&format!("{what}: not measured")));
        assert!(named, "{what} is not in {:#?}", fit.assumed);
    }
    assert_eq!(fit.fabric.problems(), []);
    let provenance = fit.fabric.provenance.as_ref().expect("a fitted fabric says so");
    assert_eq!(provenance.assumed, fit.assumed);

    let whole = identify(&sheet(WARP, WARP)).expect("identified");
    for what in ["density", "thickness", "traction:", "bending:", "shear stiffness", "shear loop"] {
        let named = whole.assumed.iter().any(|note| note.starts_with(what));
        assert!(!named, "{what} was given: {:#?}", whole.assumed);
    }
}

#[test]
fn compression_and_friction_of_the_surface_are_those_of_the_sheet() {
    let mut sheet = sheet(WARP, WARP);
    (sheet.t, sheet.tm, sheet.miu) = (Some(0.5), Some(0.3), Some(0.18));
    let fit = identify(&sheet).expect("identified");
    assert_eq!(fit.fabric.surface_friction, 0.18);
    assert!((fit.fabric.thickness_under_pressure() - 3e-4).abs() < 1e-18);
    assert!(
        !fit.assumed.iter().any(|note| note.contains("friction: not") || note.contains("pressed"))
    );
    assert!(fit.fabric.to_toml().contains("\npressed_thickness = 0.0003\n"));
    sheet.tm = None;
    let fit = identify(&sheet).expect("identified");
    assert!((fit.fabric.thickness_under_pressure() - 3.5e-4).abs() < 1e-18);
}

#[test]
fn a_missing_direction_is_taken_from_the_other() {
    let fit = identify(&sheet(WARP, Values::default())).expect("identified");
    assert_eq!(fit.fabric.weft.bending, fit.fabric.warp.bending);
    assert_eq!(fit.fabric.weft.traction, fit.fabric.warp.traction);
    assert!(fit.assumed.contains(&"weft bending: not measured, the warp's taken".to_owned()));
}

#[test]
fn a_curve_comes_before_the_values() {
    let law = drape_fit::bending_from_values(&drape_kes::BendingValues {
        rigidity: 2e-5,
        loop_width: 1e-3,
    });
    let mut sheet = sheet(WARP, WARP);
    sheet.curves.push(cycle(Test::Bending, &law, &[0.0, 250.0, -250.0, 0.0]));
    let fit = identify(&sheet).expect("identified");
    let rigidity = |law: &drape_fabric::BendingLaw| law.backbone.respond(0.0).tangent;
    let warp = rigidity(&fit.fabric.warp.bending);
    assert!((warp / 2e-5 - 1.0).abs() < 1e-6, "{warp:e}");
    let weft = rigidity(&fit.fabric.weft.bending);
    assert!((weft / (0.09 * 9.806_65e-5) - 1.0).abs() < 1e-12, "{weft:e}");
    assert_eq!(fit.curves.len(), 1);
}

#[test]
fn a_value_is_used_even_where_its_companion_is_missing() {
    let friction_only = Values { two_hb: Some(0.06), ..Values::default() };
    let resilience_only = Values { rt: Some(80.0), ..Values::default() };
    let fit = identify(&sheet(friction_only, resilience_only)).expect("identified");
    let plateau = fit.fabric.warp.bending.friction.plateau();
    assert!((plateau / (0.03 * 9.806_65e-3) - 1.0).abs() < 1e-12, "{plateau:e}");
    let found = values_of(&fit.fabric, Direction::Weft, 0.05);
    assert!((found.rt.expect("measured") - 80.0).abs() < 0.01, "{found:?}");
    for what in ["warp B:", "weft EM:", "weft LT:"] {
        let named = fit.assumed.iter().any(|note| note.starts_with(what));
        assert!(named, "{what} is not in {:#?}", fit.assumed);
    }
}

#[test]
fn a_work_that_linearity_and_extension_contradict_is_named() {
    let values = Values { wt: Some(16.2), ..WARP };
    let fit = identify(&sheet(values, WARP)).expect("identified");
    // ½·0.72·500·0.045 = 8.1 gf·cm/cm².
    let named = fit.assumed.iter().any(|note| note.starts_with("warp WT: 15.887 J/m² not used"));
    assert!(named, "{:#?}", fit.assumed);
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let law = drape_fit::bending_from_values(&drape_kes::BendingValues {
        rigidity: 2e-5,
        loop_width: 1e-3,
    });
    let mut sheet = sheet(WARP, WARP);
    let mut loop_ = cycle(Test::Bending, &law, &[0.0, 250.0, -250.0, 0.0]);
    // With noise the end of the search depends on its path.
    let noisy = loop_.load().iter().enumerate().map(|(i, m)| m + 1e-5 * ((i * i) as f64).sin());
    loop_ =
        Curve::new(Test::Bending, Direction::Warp, loop_.deformation().to_vec(), noisy.collect())
            .expect("a curve");
    sheet.curves.push(loop_);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| identify(&sheet).expect("identified"))
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn a_sheet_asks_for_a_law_and_the_settings_overrule_it() {
    let law = drape_fit::bending_from_values(&drape_kes::BendingValues {
        rigidity: 2e-5,
        loop_width: 1e-3,
    });
    let mut sheet = sheet(WARP, WARP);
    sheet.curves.push(cycle(Test::Bending, &law, &[0.0, 250.0, -250.0, 0.0]));
    sheet.model = Some(Model::Piecewise);
    let fit = identify(&sheet).expect("identified");
    let bending = fit.fabric.warp.bending;
    assert!(matches!(bending.backbone, BendingBackbone::Piecewise(_)), "{bending:?}");
    assert_eq!(bending.friction.plateau(), 0.0);
    let model = Some(LoopModel::Linear(FrictionOrder::First));
    let fit = identify_with(&sheet, &FitSettings { bending: model, ..FitSettings::default() });
    let bending = fit.expect("identified").fabric.warp.bending;
    assert!(matches!(bending.backbone, BendingBackbone::Linear { .. }), "{bending:?}");
}

#[test]
fn a_curve_of_few_points_gives_a_law_of_few_parameters_or_an_error() {
    let settings = FitSettings::default();
    let tests = [Test::Tensile, Test::Bending, Test::Shear];
    for (test, points) in tests.into_iter().flat_map(|test| (2_u32..9).map(move |n| (test, n))) {
        // A rise that is curved, so that no law of two parameters meets it exactly.
        let deformation: Vec<f64> = (0..points).map(|i| 0.01 * f64::from(i)).collect();
        let load = deformation.iter().map(|q| 30.0 * q + 400.0 * q * q).collect();
        let Ok(curve) = Curve::new(test, Direction::Warp, deformation, load) else {
            continue;
        };
        let parameters = match test {
            Test::Tensile => identify_tensile(&curve, &settings).map(|law| law.fit.parameters),
            Test::Bending => identify_bending(&curve, &settings).map(|law| law.fit.parameters),
            _ => identify_shear(&curve, &settings).map(|law| law.fit.parameters),
        };
        let needed = match parameters {
            Ok(parameters) => {
                assert!(points >= 4 && parameters.len() <= points as usize, "{test:?}: {points}");
                continue;
            }
            Err(Error::TooFewPoints { points: counted, needed, .. }) => {
                assert_eq!(counted, points as usize);
                needed
            }
            Err(other) => panic!("{test:?} of {points} points: {other}"),
        };
        assert!(needed == 4 && points < 4, "{test:?} of {points} points");
    }

    let two = Curve::new(Test::Bending, Direction::Warp, vec![0.0, 1.0], vec![0.0, 1e-5]);
    let refused = identify_bending(&two.expect("a curve"), &settings).map(|law| law.law);
    let text = refused.expect_err("two points").to_string();
    assert!(text.contains(": a law needs 4 points, and there are 2;"), "{text}");
}

#[test]
fn settings_and_fits_have_a_json_form_with_the_names_of_the_project() {
    let settings = FitSettings {
        bending: Some(LoopModel::Linear(FrictionOrder::TwoElements)),
        ..FitSettings::default()
    };
    let json = serde_json::to_value(settings).expect("it has a JSON form");
    assert_eq!((&json["bending"], &json["intervals"]), (&"two-elements".into(), &"wald".into()));
    assert_eq!(serde_json::from_value::<FitSettings>(json).expect("it is right"), settings);
    let some = serde_json::from_str::<FitSettings>(r#"{"shear":"varying"}"#).expect("it is right");
    assert_eq!(some, FitSettings { shear: Some(LoopModel::Varying), ..FitSettings::default() });

    let angles: Vec<f64> = (0..=40).chain((-40..40).rev()).map(|i| 0.003 * f64::from(i)).collect();
    let forces = angles.iter().map(|angle| 30.0 * angle.sin()).collect();
    let curve = Curve::new(Test::Shear, Direction::Weft, angles, forces).expect("it moves");
    let identified = identify_shear(&curve, &settings).expect("a law");
    let json = serde_json::to_value(&identified).expect("it has a JSON form");
    assert_eq!(
        (&json["fit"]["test"], &json["fit"]["direction"]),
        (&"shear".into(), &"weft".into())
    );
    let stiffness = identified.law.backbone;
    let drape_fabric::ShearBackbone::Linear { stiffness } = stiffness else { panic!("a line") };
    assert_eq!(json["law"]["stiffness"], stiffness);
    assert!(
        json["fit"]["values"]
            .as_array()
            .is_some_and(|all| all.iter().any(|v| v["symbol"] == "2HG5"))
    );
}
