//! Tables of FAST, and the values of its published conversions.

use drape_kes::{Sheet, SheetDraft};

#[path = "support/table.rs"]
mod table;

use table::{Table, n, t};

#[test]
fn fast_gives_the_values_of_its_conversions_in_rows_and_in_columns() {
    let measured = [
        ("Weight g/m2", 213.0),
        ("ST2 mm", 0.412),
        ("ST100 mm", 0.352),
        ("E5-1 %", 0.4),
        ("E5-2 %", 0.7),
        ("E20-1 %", 1.1),
        ("E20-2 %", 1.9),
        ("E100-1 %", 3.2),
        ("E100-2 %", 4.1),
        ("EB5 %", 4.2),
        ("C-1 mm", 17.5),
        ("C-2 mm", 15.1),
    ];
    let pairs = || std::iter::once(("Fabric", t("W1"))).chain(measured.map(|(k, v)| (k, n(v))));
    let in_rows = Table(pairs().map(|(key, value)| vec![t(key), value]).collect());
    let in_columns =
        Table(vec![pairs().map(|(k, _)| t(k)).collect(), pairs().map(|(_, v)| v).collect()]);
    // Warp, weft and bias in columns; the unit of each extension in the heading.
    let in_directions = Table(vec![
        ["FAST", "Warp", "Weft", "Bias"].map(t).to_vec(),
        vec![t("Bending length C (mm)"), n(17.5), n(15.1), t("")],
        vec![t("E5 (%)"), n(0.4), n(0.7), n(4.2)],
        vec![t("E20 (%)"), n(1.1), n(1.9), t("")],
        vec![t("E100 (%)"), n(3.2), n(4.1), t("")],
        vec![t("Weight (g/m²)"), n(213.0)],
        vec![t("T2 (mm)"), n(0.412)],
        vec![t("T100 (mm)"), n(0.352)],
    ]);
    for (what, table) in [("rows", in_rows), ("columns", in_columns), ("directions", in_directions)]
    {
        for (file, bytes) in [("fast.csv", table.csv()), ("weft.xlsx", table.workbook("FAST"))] {
            let folder = tempfile::tempdir().expect("a folder");
            std::fs::write(folder.path().join(file), bytes).expect("written");
            let draft = SheetDraft::of_folder(folder.path(), folder.path()).expect(what);
            let sheet = draft.read(folder.path()).unwrap_or_else(|e| panic!("{e}\n{}", draft.text));
            assert_fast(&format!("{what}, {file}"), &sheet, &draft);
        }
    }
}

fn assert_fast(what: &str, sheet: &Sheet, draft: &SheetDraft) {
    let near = |found: Option<f64>, wanted: f64, of: &str| {
        let found = found.unwrap_or(f64::NAN);
        assert!(
            (found / wanted - 1.0).abs() < 1e-4,
            "{what}, {of}: {found}, not {wanted}\n{}",
            draft.text
        );
    };
    near(sheet.density(), 0.213, "W");
    near(sheet.t, 0.412, "T");
    near(sheet.tm, 0.352, "TM");
    near(sheet.fm, 100.0, "FM");
    for (values, length, extension) in [(&sheet.warp, 17.5_f64, 3.2), (&sheet.weft, 15.1, 4.1)] {
        let rigidity = 9.81e-6 * 213.0 * length.powi(3);
        near(values.bending_rigidity().map(|b| 1e6 * b), rigidity, "B");
        near(values.shear_stiffness(), 123.0 / 4.2, "G");
        near(values.em, extension, "EM");
        // Between a line through E100 and a curve that bends as sharply as the points allow.
        assert!(values.lt.is_some_and(|lt| (0.6..0.85).contains(&lt)), "{what}: {:?}", values.lt);
    }
}
