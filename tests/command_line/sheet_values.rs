//! A sheet of values is checked value by value.

use serde_json::Value;

use crate::succeeds;

const SHEET: &str = "name = \"odd\"\nW = \"150 g/m2\"\nT0 = 0.5\nRC = 40\n[warp]\nB = \"0.1 ± 0.01\"\nG = 5.0\nRT = 60\n\
                     [weft]\nB = 9.0\n";

#[test]
fn each_value_has_its_unit_si_and_whether_it_is_usual() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    std::fs::write(folder.join("sheet.toml"), SHEET).expect("a sheet");
    let text = succeeds(folder, &["check", "sheet.toml"]);
    for line in [
        // 0.1 gf·cm²/cm is 9.80665e-6 N·m, 5 gf/(cm·deg) 280.9 N/(m·rad).
        "  B warp, bending rigidity: 0.1 ± 0.01 gf·cm²/cm = 9.807e-6 N·m, usual: nine fabrics in ten have",
        "  B weft, bending rigidity: 9 gf·cm²/cm = 0.0008826 N·m, UNUSUAL: nine fabrics in ten have 9.8e-7 to",
        "  G warp, shear stiffness: 5 gf/(cm·deg) = 280.9 N/(m·rad), UNUSUAL: nine fabrics in ten have",
        "  W, mass per area: 15 mg/cm² = 0.15 kg/m², usual: nine fabrics in ten have 0.041 to 0.487 kg/m²",
        "  RT warp, tensile resilience: 60 % = 0.6\n",
        "  RC, compression resilience: 40 % = 0.4; not used by the model\n",
        "  c weft, bending length, from B and W: 8.434 cm = 0.08434 m, UNUSUAL",
    ] {
        assert!(text.contains(line), "{line}\nis not in\n{text}");
    }

    let json = succeeds(folder, &["check", "sheet.toml", "--json"]);
    let checked: Value = serde_json::from_str(&json).expect("JSON");
    let values = checked[0]["values"].as_array().expect("values");
    let of = |symbol: &str, direction: &str| {
        let mut of = values.iter().filter(|value| value["symbol"] == symbol);
        of.find(|value| value["direction"] == direction).expect("a value")
    };
    assert_eq!(of("B", "warp")["is_usual"], true);
    assert_eq!(of("B", "warp")["deviation"], 0.01);
    assert_eq!(of("B", "weft")["is_usual"], false);
    assert_eq!(of("RT", "warp")["is_usual"], Value::Null);

    // The fit names them too.
    let fitted = succeeds(folder, &["fit", "sheet.toml"]);
    let warnings = fitted.split("[Warnings]").nth(1).expect("warnings").replace("\n    ", " ");
    assert!(
        warnings.contains("weft.B: a bending rigidity of 8.826e-4 N.m is unusual"),
        "{warnings}"
    );
    assert!(
        warnings.contains("G warp: a shear stiffness of 280.9 N/(m·rad) is unusual"),
        "{warnings}"
    );
}

#[test]
fn curves_are_checked_with_their_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let sheet = "name = \"x\"\nW = 12\n[[curve]]\ntest = \"bending\"\ndirection = \"weft\"\nfile = \"b.csv\"\n";
    std::fs::write(folder.join("sheet.toml"), sheet).expect("a sheet");
    let table = "curvature (1/cm),moment (gf cm/cm)\n0,0\n1,-0.1\n2,-0.2\n1,-0.05\n0,0.02\n-1,0.12\n-2,0.2\n0,0\n";
    std::fs::write(folder.join("b.csv"), table).expect("a table");
    let text = succeeds(folder, &["check", "sheet.toml"]);
    assert!(
        text.contains("bending weft, b.csv: 8 points, curvature -2.0000e2 to 2.0000e2 1/m"),
        "{text}"
    );
    assert!(text.contains("read b.csv, bending weft: 8 points"), "{text}");
    assert!(text.contains("the load has the opposite sign (bending weft, b.csv)"), "{text}");
}
