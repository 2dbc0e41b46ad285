//! A fabric survives its file, and a wrong file is answered with line, value and remedy.

use drape_fabric::Fabric;
use drape_input::{Diagnostics, Document};

const LINEN: &str = r#"name = "linen"
density = 0.18
thickness = 0.0004
shear = { stiffness = 40.0, growth = 6.0, friction = [{ plateau = 0.6, length = 0.006 }], locking = { onset = 0.139, limit = 0.867 } }

[warp.traction]
friction = [{ plateau = 4.0, length = 0.001 }]
primed = { stiffness = 9000.0, toe_ratio = 0.6, toe_strain = 0.02, toe_strain_after = 0.03 }
[warp.bending]
rigidity = 2.5e-5
friction = [{ plateau = 9e-4, length = 3.0 }, { plateau = -2e-4, length = 20.0 }]

[weft.traction]
polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
[weft.bending]
piecewise = { slope = 2e-5, intercept = 4e-4, knot = 40.0 }
"#;

fn read(text: &str) -> Result<Fabric, Diagnostics> {
    Fabric::from_document(&Document::new("linen.toml", text))
}

#[test]
fn a_fabric_survives_its_file_to_the_last_bit() {
    let text = LINEN.replacen("0.0004\n", "0.0004\npressed_thickness = 0.0003\n", 1);
    let fabric = read(&text).expect("the file is right");
    assert_eq!(fabric.pressed_thickness, Some(3e-4));
    let again = read(&fabric.to_toml()).expect("what was written is right");
    assert_eq!(fabric, again);
}

#[test]
fn wrong_values_are_all_reported_with_line_and_remedy() {
    let text = LINEN
        .replace("density = 0.18", "density = 180")
        .replace("rigidity = 2.5e-5", "rigidity = 0.25")
        .replace("toe_ratio = 0.6", "toe_ratio = 0.4")
        .replace("plateau = -2e-4", "plateau = -2e-3");
    let mistakes = read(&text).expect_err("four values are wrong").0;
    let lines: Vec<_> = mistakes.iter().map(|m| m.line).collect();
    assert_eq!(lines, [Some(2), Some(8), Some(10), Some(11)], "{mistakes:#?}");
    assert!(mistakes.iter().all(|m| m.help.is_some()));
    assert!(mistakes[0].message.contains("180"), "{}", mistakes[0]);
}

#[test]
fn nan_and_negative_numbers_are_refused() {
    for (good, bad) in [
        ("0.18", "nan"),
        ("0.18", "-0.18"),
        ("0.0004", "inf"),
        ("stiffness = 40.0", "stiffness = nan"),
    ] {
        let mistakes = read(&LINEN.replacen(good, bad, 1)).expect_err("the value is wrong").0;
        assert_eq!(mistakes.len(), 1, "{bad}: {mistakes:?}");
    }
}

#[test]
fn a_curve_must_be_given_once() {
    let none = read(&LINEN.replace("rigidity = 2.5e-5", "")).expect_err("no bending").0;
    assert!(none[0].help.as_deref().is_some_and(|h| h.contains("rigidity")), "{}", none[0]);
    let twice = LINEN.replace(
        "rigidity = 2.5e-5",
        "rigidity = 2.5e-5\npiecewise = { slope = 2e-5, intercept = 0, knot = 9 }",
    );
    assert_eq!(read(&twice).expect_err("bending twice").0.len(), 1);
}

#[test]
fn numbers_that_a_file_may_leave_out_have_those_of_apparel_weaves() {
    let missing = read(LINEN).expect("the file is right");
    assert_eq!(missing.surface_friction, 0.2);
    assert!((missing.thickness_under_pressure() - 2.8e-4).abs() < 1e-15);
    let measured = "0.0004\nsurface_friction = 0.35\npressed_thickness = 0.0003\n";
    let given = read(&LINEN.replacen("0.0004\n", measured, 1)).expect("the file is right");
    assert_eq!(given.surface_friction, 0.35);
    assert_eq!(given.thickness_under_pressure(), 3e-4);
}
