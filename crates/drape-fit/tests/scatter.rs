//! Standard deviations that a sheet states, carried to the laws of its values.

mod random;

use drape_fit::identify;
use drape_kes::{Direction, Scatter, Sheet, Symbol, Values};
use random::Random;

fn sheet() -> Sheet {
    let values = Values {
        b: Some(0.118),
        two_hb: Some(0.05),
        g: Some(0.6),
        two_hg: Some(0.5),
        two_hg5: Some(0.9),
        em: Some(4.5),
        lt: Some(0.85),
        rt: Some(70.0),
        ..Values::default()
    };
    let mut sheet = Sheet::default();
    (sheet.name, sheet.warp, sheet.weft) = ("poplin".into(), values, values);
    sheet
}

fn scatter(direction: Direction, symbol: Symbol, deviation: f64) -> Scatter {
    Scatter { direction, symbol, deviation }
}

/// Returns a standard error of the fabric, in SI.
fn error(sheet: &Sheet, key: &str) -> Option<f64> {
    let provenance = identify(sheet).expect("a fabric").fabric.provenance.expect("fitted");
    provenance.standard_errors.get(key).copied()
}

fn same(found: Option<f64>, exact: f64, tolerance: f64) {
    let found = found.expect("an error");
    assert!((found / exact - 1.0).abs() < tolerance, "{found} where {exact} is exact");
}

#[test]
fn parameters_that_are_values_have_their_deviations() {
    let mut sheet = sheet();
    assert_eq!(error(&sheet, "warp.bending.rigidity"), None);
    sheet.scatter = vec![
        scatter(Direction::Warp, Symbol::B, 0.006),
        scatter(Direction::Warp, Symbol::TwoHb, 0.004),
    ];
    same(error(&sheet, "warp.bending.rigidity"), 0.006 * 9.806_65e-5, 1e-9);
    // The plateau is half of the loop's width.
    same(error(&sheet, "warp.bending.friction[0].plateau"), 0.5 * 0.004 * 9.806_65e-3, 1e-9);
    assert_eq!(error(&sheet, "weft.bending.rigidity"), None, "nothing is stated of the weft");
}

#[test]
fn a_mean_of_two_directions_scatters_less_unless_it_is_one_number() {
    let mut sheet = sheet();
    sheet.scatter = [Direction::Warp, Direction::Weft].map(|d| scatter(d, Symbol::G, 0.06)).into();
    let one = 0.06 * 0.980_665 * 180.0 / std::f64::consts::PI;
    same(error(&sheet, "shear.stiffness"), one / 2.0_f64.sqrt(), 1e-3);
    sheet.shared = vec!["G"];
    same(error(&sheet, "shear.stiffness"), one, 1e-3);
}

#[test]
fn tensile_errors_are_those_of_many_sheets() {
    let mut sheet = sheet();
    let deviations = [(Symbol::Em, 0.1), (Symbol::Lt, 0.01), (Symbol::Rt, 1.0)];
    sheet.scatter = deviations.map(|(symbol, d)| scatter(Direction::Warp, symbol, d)).into();
    let mut random = Random(7);
    let trials = 400;
    let stiffness: Vec<[f64; 2]> = (0..trials)
        .map(|_| {
            let mut drawn = sheet.clone();
            drawn.scatter.clear();
            for (symbol, deviation) in deviations {
                let value = drawn.warp.get_mut(symbol).as_mut().expect("given");
                *value += deviation * random.normal();
            }
            let law = identify(&drawn).expect("a fabric").fabric.warp.traction;
            let drape_fabric::TractionBackbone::Primed(primed) = law.backbone else {
                panic!("not primed")
            };
            let drape_fabric::TractionFriction::Plateau(friction) = law.friction else {
                panic!("without a plateau")
            };
            [primed.stiffness, friction.plateau()]
        })
        .collect();
    for (index, key) in ["primed.stiffness", "friction[0].plateau"].into_iter().enumerate() {
        let mean = stiffness.iter().map(|s| s[index]).sum::<f64>() / f64::from(trials);
        let square = stiffness.iter().map(|s| (s[index] - mean).powi(2)).sum::<f64>();
        let drawn = (square / f64::from(trials - 1)).sqrt();
        // The deviation of 400 draws is known to 3.5 %; three times that.
        same(error(&sheet, &format!("warp.traction.{key}")), drawn, 0.11);
    }
}

#[test]
fn deviations_that_cannot_be_carried_are_told() {
    let mut sheet = sheet();
    (sheet.warp.lt, sheet.warp.rt) = (Some(0.75), Some(60.0));
    sheet.scatter = vec![scatter(Direction::Warp, Symbol::Lt, 0.05)];
    let fit = identify(&sheet).expect("a fabric");
    let told = fit.assumed.iter().any(|note| note.starts_with("standard deviations of the values"));
    let carried = error(&sheet, "warp.traction.primed.stiffness").is_some();
    assert!(told != carried, "{:?}", fit.assumed);
}
