//! Wrong curves: each is refused with a precise message, or repaired with a warning.

use drape_input::{Diagnostic, Diagnostics};
use drape_kes::{Direction, Error, Sheet, Test};

/// Reads a sheet with one curve of the given test, units and points.
fn read(test: &str, units: (&str, &str), points: &[(f64, f64)]) -> Result<Sheet, Error> {
    let rows: String = points.iter().map(|(q, f)| format!("{q},{f}\n")).collect();
    read_text(test, units, &format!("q,f\n{rows}"))
}

fn read_text(test: &str, (q, f): (&str, &str), table: &str) -> Result<Sheet, Error> {
    let folder = tempfile::tempdir().expect("a folder");
    let sheet = format!(
        "name = \"poplin\"\n[[curve]]\ntest = \"{test}\"\ndirection = \"warp\"\nfile = \"a.csv\"\n\
         deformation = {{ column = \"q\", unit = \"{q}\" }}\nload = {{ column = \"f\", unit = \"{f}\" }}\n"
    );
    std::fs::write(folder.path().join("sheet.toml"), sheet).expect("written");
    std::fs::write(folder.path().join("a.csv"), table).expect("written");
    Sheet::read(folder.path())
}

#[test]
fn a_strip_that_hangs_slack_further_than_it_is_stretched_is_not_turned() {
    let folder = tempfile::tempdir().expect("a folder");
    let sheet = "name = \"strip\"\n[[curve]]\ntest = \"tensile\"\ndirection = \"warp\"\nfile = \"a.csv\"\n\
                 slack = true\ndeformation = { column = \"q\", unit = \"%\" }\n\
                 load = { column = \"f\", unit = \"N/m\" }\n";
    let table = "q,f\n-2,0\n-1,0\n0,0\n1,30\n1.5,80\n1,20\n0,0\n-2,0\n";
    std::fs::write(folder.path().join("sheet.toml"), sheet).expect("written");
    std::fs::write(folder.path().join("a.csv"), table).expect("written");
    let sheet = Sheet::read(folder.path()).expect("a good strip");
    assert_eq!(sheet.curves[0].deformation()[0], -0.02);
    assert_eq!(sheet.warnings(), []);
}

fn refusal(result: Result<Sheet, Error>) -> Diagnostic {
    match result {
        Err(Error::Input(Diagnostics(mut mistakes))) if mistakes.len() == 1 => mistakes.remove(0),
        other => panic!("not one mistake: {other:?}"),
    }
}

fn says(finding: &Diagnostic, words: &[&str]) {
    let text = finding.to_string();
    for word in words {
        assert!(text.contains(word), "{word:?} is missing in: {text}");
    }
    assert!(finding.line.is_some() && finding.help.is_some(), "{text}");
}

/// Returns loading and recovery of a tensile test: strain in %, load in gf/cm.
fn tensile() -> Vec<(f64, f64)> {
    let up = (0..=20).map(|i| f64::from(i) * 0.2).map(|e| (e, 30.0 * e * e));
    let down = (0..20).rev().map(|i| f64::from(i) * 0.2).map(|e| (e, 28.0 * e * e * (e / 4.0)));
    up.chain(down).collect()
}

/// Returns a shear loop: angle in degrees, load in gf/cm.
fn shear() -> Vec<(f64, f64)> {
    let load = |a: f64, sense: f64| 0.4 * a + 0.8 * sense;
    let up = (-8..=8).map(f64::from).map(|a| (a, load(a, 1.0)));
    let down = (-8..8).rev().map(f64::from).map(|a| (a, load(a, -1.0)));
    up.chain(down).collect()
}

const GF: &str = "gf/cm";

#[test]
fn right_curves_pass_without_a_word() {
    for (test, unit, points) in [("tensile", "%", tensile()), ("shear", "deg", shear())] {
        let sheet = read(test, (unit, GF), &points).expect("the curve is right");
        assert!(sheet.warnings().is_empty(), "{:?}", sheet.warnings());
        assert_eq!(sheet.curves[0].load().len(), points.len());
    }
}

#[test]
fn unloading_above_loading_is_refused_with_its_place() {
    let mut points = tensile();
    points[21..].iter_mut().for_each(|(e, f)| *f = 40.0 * *e * *e);
    says(
        &refusal(read("tensile", ("%", GF), &points)),
        &["unloading lies above loading", "gives back"],
    );
    let reversed: Vec<_> = shear().into_iter().map(|(a, f)| (a, 0.8 * a - f)).collect();
    says(&refusal(read("shear", ("deg", GF), &reversed)), &["unloading lies above loading"]);
}

#[test]
fn swapped_columns_are_refused() {
    let swap =
        |points: Vec<(f64, f64)>| points.into_iter().map(|(q, f)| (f, q)).collect::<Vec<_>>();
    let finding = refusal(read("tensile", ("%", GF), &swap(tensile())));
    says(&finding, &["deformation reaches", "exchange the columns"]);
    // Here both sizes could be right; the loop then runs in the wrong direction.
    let finding = refusal(read("shear", ("deg", GF), &swap(shear())));
    says(&finding, &["columns exchanged"]);
}

#[test]
fn degrees_for_radians_are_refused_with_the_right_unit() {
    says(&refusal(read("shear", ("rad", GF), &shear())), &["unit = \"deg\""]);
    let radians: Vec<_> = shear().into_iter().map(|(a, f)| (a.to_radians(), f)).collect();
    says(&refusal(read("shear", ("deg", GF), &radians)), &["unit = \"rad\""]);
    let ratios: Vec<_> = tensile().into_iter().map(|(e, f)| (0.01 * e, f)).collect();
    says(&refusal(read("tensile", ("%", GF), &ratios)), &["unit = \"1\""]);
}

#[test]
fn grams_for_milligrams_are_refused_with_the_right_unit() {
    for (w, unit) in [("0.0126", "g/cm2"), ("0.126", "kg/m2"), ("1260", "g/m2")] {
        let folder = tempfile::tempdir().expect("a folder");
        let text = format!("name = \"poplin\"\nW = {w}\n");
        std::fs::write(folder.path().join("sheet.toml"), text).expect("written");
        let result = Sheet::read(folder.path());
        if unit == "g/m2" {
            // 1260 mg/cm² is 12.6 kg/m²; as g/m² it would be unusual, not impossible.
            says(&refusal(result), &["1260", "no fabric"]);
        } else {
            says(&refusal(result), &[w, unit, "did you mean"]);
        }
    }
}

#[test]
fn a_rigidity_that_no_fabric_has_is_refused_with_what_it_may_mean() {
    for (b, meant) in [("0.001", "\"0.001 mN.m\""), ("30", "\"30 uN.m\"")] {
        let folder = tempfile::tempdir().expect("a folder");
        let text = format!("name = \"poplin\"\n[warp]\nB = {b}\n");
        std::fs::write(folder.path().join("sheet.toml"), text).expect("written");
        says(&refusal(Sheet::read(folder.path())), &[b, "did you mean", meant]);
    }
}

#[test]
fn a_reversed_sign_is_turned_and_told() {
    let turned: Vec<_> = shear().into_iter().map(|(a, f)| (a, -f)).collect();
    // The loop of a load with the wrong sign is right once the sign is.
    let sheet = read("shear", ("deg", GF), &turned).expect("safe to repair");
    says(&sheet.warnings()[0], &["the load has the opposite sign", "turned"]);
    let right = read("shear", ("deg", GF), &shear()).expect("right");
    assert_eq!(sheet.curves[0].load(), right.curves[0].load());
    let both: Vec<_> = tensile().into_iter().map(|(e, f)| (-e, -f)).collect();
    let sheet = read("tensile", ("%", GF), &both).expect("safe to repair");
    says(&sheet.warnings()[0], &["deformation and load have the opposite sign"]);
    assert!(
        sheet.curves[0].load_range().low >= 0.0
            && sheet.curves[0].deformation_range().low >= -1e-15
    );
}

#[test]
fn repeated_points_are_left_out_and_told() {
    let points: Vec<_> = tensile().into_iter().flat_map(|p| [p, p]).collect();
    let sheet = read("tensile", ("%", GF), &points).expect("safe to repair");
    says(&sheet.warnings()[0], &["41 of 82 points repeat"]);
    assert_eq!(sheet.curves[0].load().len(), 41);
}

#[test]
fn a_last_line_that_breaks_off_is_left_out_and_told() {
    let mut text: String =
        tensile().iter().fold("q,f\n".into(), |t, (q, f)| t + &format!("{q},{f}\n"));
    text.push_str("0.1");
    let sheet = read_text("tensile", ("%", GF), &text).expect("safe to repair");
    says(&sheet.warnings()[0], &["line 43", "breaks off", "left out"]);
    assert_eq!(sheet.curves[0].load().len(), 41);
}

#[test]
fn a_strain_that_does_not_start_at_zero_is_shifted_or_refused() {
    let late: Vec<_> = tensile().into_iter().map(|(e, f)| (e + 0.5, f)).collect();
    let sheet = read("tensile", ("%", GF), &late).expect("safe to repair");
    says(&sheet.warnings()[0], &["starts at a strain of 5.0000e-3 without load", "taken as zero"]);
    assert_eq!(sheet.curves[0].deformation()[0], 0.0);
    let loaded: Vec<_> = tensile()[5..].to_vec();
    says(&refusal(read("tensile", ("%", GF), &loaded)), &["with a load of", "slack = true"]);
}

#[test]
fn loop_bending_and_slack_strips_keep_their_offsets() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fabrics/cupro-weave");
    let sheet = Sheet::read(root).expect("the shipped sheet is right");
    assert!(sheet.warnings().is_empty(), "{:?}", sheet.warnings());
    let strips: Vec<_> = sheet.curves_of(Test::Tensile, Direction::Warp).collect();
    assert!(!strips.is_empty() && strips[0].deformation()[0] < 0.0, "the strip hangs slack");
}
