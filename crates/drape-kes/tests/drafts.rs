//! Folders of exports drafted as sheets: the same curves as by hand, and plain answers.

use std::path::Path;

use drape_kes::{Curve, Direction, Sheet, SheetDraft, Symbol, Test};

/// Writes the files of a folder.
fn folder(files: &[(&str, &[u8])]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a parent")).expect("made");
        std::fs::write(path, bytes).expect("written");
    }
    folder
}

/// Drafts a folder, writes the sheet into it, and reads it.
fn drafted(folder: &Path) -> (SheetDraft, Sheet) {
    let draft = SheetDraft::of_folder(folder, folder).unwrap_or_else(|error| panic!("{error}"));
    std::fs::write(folder.join("sheet.toml"), &draft.text).expect("written");
    let sheet = Sheet::read(folder).unwrap_or_else(|error| panic!("{error}\n{}", draft.text));
    assert_eq!(sheet.curves.len(), draft.curves, "{}", draft.text);
    (draft, sheet)
}

/// Reads a sheet that is written by hand beside the files.
fn by_hand(folder: &Path, text: &str) -> Sheet {
    let path = folder.join("hand.toml");
    std::fs::write(&path, format!("name = \"hand\"\n{text}")).expect("written");
    Sheet::read(path).unwrap_or_else(|error| panic!("{error}"))
}

/// Compares curves point by point, without regard to their order.
fn assert_same(found: &Sheet, wanted: &Sheet) {
    let sorted = |sheet: &Sheet| -> Vec<Curve> {
        let mut curves = sheet.curves.clone();
        curves.sort_by_key(|curve| (curve.test, curve.direction));
        curves
    };
    let (found, wanted) = (sorted(found), sorted(wanted));
    assert_eq!(found.len(), wanted.len());
    for (a, b) in found.iter().zip(&wanted) {
        assert_eq!((a.test, a.direction, a.gauge), (b.test, b.direction, b.gauge));
        assert_eq!((a.deformation(), a.load()), (b.deformation(), b.load()));
        assert_eq!(a.repeats(), b.repeats());
    }
}

/// Tensile test to 500 gf/cm and back: percent, gf/cm.
fn tensile() -> Vec<[f64; 2]> {
    let up = (0..=50).map(|i| f64::from(i) * 0.08).map(|e| [e, 31.25 * e * e]);
    let down = (0..50).rev().map(|i| f64::from(i) * 0.08).map(|e| [e, 7.8125 * e * e * e]);
    up.chain(down).collect()
}

/// Loop between plus and minus a largest deformation.
fn looped(largest: f64, slope: f64, half_width: f64) -> Vec<[f64; 2]> {
    let steps = |i: i32| largest * f64::from(i) / 40.0;
    let up = (-40..=40).map(move |i| [steps(i), slope * steps(i) + half_width]);
    let down = (-40..40).rev().map(move |i| [steps(i), slope * steps(i) - half_width]);
    up.chain(down).collect()
}

fn scaled(points: &[[f64; 2]], factor: f64) -> Vec<[f64; 2]> {
    points.iter().map(|[q, f]| [*q, factor * f]).collect()
}

fn rows(points: &[[f64; 2]], row: impl Fn(usize, [f64; 2]) -> String) -> String {
    points.iter().enumerate().map(|(i, point)| row(i, *point) + "\r\n").collect()
}

fn comma(number: f64) -> String {
    format!("{number:.6}").replace('.', ",")
}

/// File of the Kawabata program: conditions in Japanese above, Shift_JIS.
fn kes_auto(test: &str, direction: &str, heads: &str, points: &[[f64; 2]]) -> Vec<u8> {
    let text = format!(
        "KES-FB-AUTO-A\r\n測定項目,{test}\r\n方向,{direction}\r\n試料幅,20,cm\r\n\r\n{heads}\r\n{}",
        rows(points, |_, [q, f]| format!("{q:.5},{f:.6}"))
    );
    encoding_rs::SHIFT_JIS.encode(&text).0.into_owned()
}

#[test]
fn text_exports_of_the_automatic_instruments() {
    let strain = "ひずみ(%),荷重(gf/cm)";
    let angle = "せん断角(deg),荷重(gf/cm)";
    let curvature = "曲率(1/cm),曲げモーメント(gf・cm/cm)";
    let [t, s, b] = [tensile(), looped(8.0, 0.6, 1.0), looped(2.5, 0.1, 0.04)];
    let summary =
        "Item,Unit,Warp,Weft\r\nLC,-,0.31\r\nT0,mm,0.62\r\nW,mg/cm2,14.2\r\nMIU,-,0.18,0.19\r\n";
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("001-1.csv", kes_auto("引張り", "たて", strain, &t)),
        ("001-2.csv", kes_auto("引張り", "よこ", strain, &scaled(&t, 0.7))),
        ("002-1.csv", kes_auto("せん断", "たて", angle, &s)),
        ("003-1.csv", kes_auto("純曲げ", "たて", curvature, &b)),
        ("003-2.csv", kes_auto("純曲げ", "よこ", curvature, &scaled(&b, 0.8))),
        ("results.csv", summary.into()),
    ];
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, b)| (*name, b.as_slice())).collect();
    let folder = folder(&files);
    let (draft, sheet) = drafted(folder.path());
    assert_eq!((draft.curves, draft.open), (5, 0), "{}", draft.text);
    let section = |test: &str, direction: &str, file: &str| {
        format!("[[curve]]\ntest = \"{test}\"\ndirection = \"{direction}\"\nfile = \"{file}\"\n")
    };
    let hand = [
        section("tensile", "warp", "001-1.csv"),
        section("tensile", "weft", "001-2.csv"),
        section("shear", "warp", "002-1.csv"),
        section("bending", "warp", "003-1.csv"),
        section("bending", "weft", "003-2.csv"),
    ];
    assert_same(&sheet, &by_hand(folder.path(), &hand.concat()));
    assert_eq!((sheet.w, sheet.t0, sheet.lc), (Some(14.2), Some(0.62), Some(0.31)));
    let miu = [Direction::Warp, Direction::Weft].map(|direction| sheet.values(direction).miu);
    assert_eq!(miu, [Some(0.18), Some(0.19)], "{}", draft.text);
    assert!(sheet.miu.is_some_and(|miu| (miu - 0.185).abs() < 1e-12), "{:?}", sheet.miu);
    for words in [
        "encoding = \"Shift_JIS\"",
        "header = 6",
        "unit = \"gf.cm/cm\"",
        "# by line 3, \"方向 たて\"",
        "# by line 2, \"測定項目 引張り\"",
    ] {
        assert!(draft.text.contains(words), "{words} is missing in\n{}", draft.text);
    }
}

#[test]
fn one_workbook_with_a_test_a_sheet() {
    let mut book = rust_xlsxwriter::Workbook::new();
    let tests = [
        ("Tensile warp", "Strain (%)", "Force (gf/cm)", tensile()),
        ("Tensile weft", "Strain (%)", "Force (gf/cm)", scaled(&tensile(), 0.5)),
        ("Shear warp", "Shear angle (deg)", "Shear force (gf/cm)", looped(8.0, 0.6, 1.0)),
        ("Bending warp", "Curvature (1/cm)", "Moment (gf.cm/cm)", looped(2.5, 0.1, 0.04)),
    ];
    for (name, q, f, points) in &tests {
        let sheet = book.add_worksheet().set_name(*name).expect("a name");
        sheet.write(0, 0, "cotton poplin").expect("written");
        sheet.write(2, 1, *q).expect("written").write(2, 2, *f).expect("written");
        for (row, [q, f]) in points.iter().enumerate() {
            let row = row as u32 + 3;
            sheet.write(row, 1, *q).expect("written").write(row, 2, *f).expect("written");
        }
    }
    let sheet = book.add_worksheet().set_name("Compression").expect("a name");
    sheet.write(0, 0, "Thickness (mm)").expect("written");
    sheet.write(0, 1, "Pressure (gf/cm2)").expect("written");
    let way: Vec<u32> = (0..=100).chain((0..100).rev()).collect();
    for (row, step) in way.into_iter().enumerate() {
        // A straight line: LC is 1, and all work is given back.
        let pressure = 0.5 * f64::from(step);
        let thickness = 0.6 - 0.2 * (pressure - 0.5) / 49.5;
        let row = row as u32 + 1;
        sheet.write(row, 0, thickness).expect("written").write(row, 1, pressure).expect("written");
    }
    let bytes = book.save_to_buffer().expect("a workbook");
    let folder = folder(&[("poplin.xlsx", &bytes)]);
    let (draft, sheet) = drafted(folder.path());
    assert_eq!((draft.curves, draft.open), (4, 0), "{}", draft.text);
    let hand = |test: &str, direction: &str, name: &str| {
        format!(
            "[[curve]]\ntest = \"{test}\"\ndirection = \"{direction}\"\nfile = \"poplin.xlsx\"\nsheet = \"{name}\"\n"
        )
    };
    let hand = [
        hand("tensile", "warp", "Tensile warp"),
        hand("tensile", "weft", "Tensile weft"),
        hand("shear", "warp", "Shear warp"),
        hand("bending", "warp", "Bending warp"),
    ];
    assert_same(&sheet, &by_hand(folder.path(), &hand.concat()));
    let near = |found: Option<f64>, wanted: f64| {
        let found = found.unwrap_or(f64::NAN);
        assert!((found / wanted - 1.0).abs() < 1e-4, "{found}, not {wanted}\n{}", draft.text);
    };
    near(sheet.t0, 0.6);
    near(sheet.tm, 0.4);
    // Half of the sum of 0.5 and 50 gf/cm2 over 0.02 cm.
    near(sheet.wc, 0.505);
    near(sheet.lc, 1.01);
    near(sheet.rc, 100.0);
}

#[test]
fn spreadsheet_of_a_laboratory_with_decimal_commas() {
    let text = |factor: f64| {
        format!(
            "Prüfprotokoll;Köper\r\nEinspannlänge;50;mm\r\nProbenbreite;50;mm\r\n\r\nZeit;Weg;Kraft\r\ns;mm;N\r\n{}",
            rows(&tensile(), |i, [e, f]| format!(
                "{};{};{}",
                comma(0.1 * i as f64),
                comma(0.5 * e),
                comma(factor * f * 0.980_665 * 0.05)
            ))
        )
    };
    let text = |factor| encoding_rs::WINDOWS_1252.encode(&text(factor)).0.into_owned();
    let [a, b, weft] = [0.95, 1.05, 0.6].map(text);
    let folder =
        folder(&[("Zug Kette 1.csv", &a), ("Zug Kette 2.csv", &b), ("Zug Schuss 1.csv", &weft)]);
    let (draft, sheet) = drafted(folder.path());
    assert_eq!((draft.curves, draft.open), (2, 0), "{}", draft.text);
    let hand = "[[curve]]\ntest = \"tensile\"\ndirection = \"warp\"\n\
                file = [\"Zug Kette 1.csv\", \"Zug Kette 2.csv\"]\n\
                deformation = { gauge = \"50 mm\" }\nload = { width = \"50 mm\" }\n\
                [[curve]]\ntest = \"tensile\"\ndirection = \"weft\"\nfile = \"Zug Schuss 1.csv\"\n";
    assert_same(&sheet, &by_hand(folder.path(), hand));
    assert_eq!(sheet.curves[0].repeats().len(), 2);
    for words in [
        "decimal = \",\"",
        "gauge = \"50 mm\", zero = \"extension\"",
        "# width: \"Probenbreite\" on line 3",
        "taken for repeats",
    ] {
        assert!(draft.text.contains(words), "{words} is missing in\n{}", draft.text);
    }
}

#[test]
fn what_cannot_be_told_is_a_comment_whose_remedy_works() {
    let text = format!(
        "Strain (%),Force (gf/cm)\n{}",
        rows(&tensile(), |_, [q, f]| format!("{q:.5},{f:.6}"))
    );
    let folder = folder(&[("specimen.csv", text.as_bytes()), ("photo.jpg", b"\xff\xd8")]);
    let (draft, sheet) = drafted(folder.path());
    assert_eq!((draft.curves, draft.open, sheet.curves.len()), (0, 1, 0), "{}", draft.text);
    assert!(draft.text.contains("say warp or weft"), "{}", draft.text);
    assert!(draft.notes.iter().any(|note| note.contains("photo.jpg")), "{:?}", draft.notes);
    let start = draft.text.find("# [[curve]]").expect("a section");
    let end = draft.text.find("\n# Files").expect("the files that are left out");
    let section: String =
        draft.text[start..end].lines().map(|l| l[2..].to_owned() + "\n").collect();
    let sheet = by_hand(folder.path(), &section);
    assert_eq!(sheet.curves.len(), 1);
    assert_eq!(sheet.curves[0].test, Test::Tensile);
}

#[test]
fn a_folder_with_nothing_to_read_is_answered_with_every_file() {
    let folder = folder(&[
        ("notes.txt", b"washed twice\nironed\n"),
        ("scan.pdf", b"%PDF"),
        ("surface.csv", b"Distance (mm),MIU\n0,0.2\n1,0.21\n2,0.19\n"),
    ]);
    let error = SheetDraft::of_folder(folder.path(), folder.path()).expect_err("nothing is there");
    let text = error.to_string();
    for words in ["notes.txt: it has no rows", "scan.pdf: no table", "surface.csv", "MIU, MMD, SMD"]
    {
        assert!(text.contains(words), "{words:?} is missing in: {text}");
    }
    let empty = tempfile::tempdir().expect("a folder");
    let error = SheetDraft::of_folder(empty.path(), empty.path()).expect_err("it is empty");
    assert!(error.to_string().contains("holds no files"), "{error}");
}

#[test]
fn tables_of_results_are_read_in_rows_and_in_columns() {
    let columns = "Fabric;B (gf.cm2/cm);2HB (gf.cm/cm);G;2HG;2HG5\r\n\
                   Warp;0,118;0,124;0,6;1,1;2,3\r\nWeft;0,1;0,09;0,5;1,0;2,0\r\n";
    let rows = "Property\tmean\nEMT (%)\t4.5\nLT\t0.62\nRT (%)\t55\nW (g/m2)\t142\n";
    let folder = folder(&[("a.csv", columns.as_bytes()), ("b.txt", rows.as_bytes())]);
    let (draft, sheet) = drafted(folder.path());
    let of = |direction: Direction, symbol: Symbol| sheet.values(direction).get(symbol);
    assert_eq!(of(Direction::Warp, Symbol::B), Some(0.118), "{}", draft.text);
    assert_eq!(of(Direction::Weft, Symbol::TwoHg5), Some(2.0), "{}", draft.text);
    assert_eq!(of(Direction::Weft, Symbol::Em), Some(4.5), "{}", draft.text);
    assert!(sheet.w.is_some_and(|w| (w - 14.2).abs() < 1e-12), "{}", draft.text);
}

#[test]
fn a_sheet_beside_the_folder_of_exports_names_them_from_its_own_folder() {
    let head = "Direction,Warp\r\nStrain (%),Load (gf/cm)\r\n";
    let rows = rows(&tensile(), |_, [q, f]| format!("{q:.5},{f:.6}"));
    let text = format!("{head}{rows}");
    let folder = folder(&[("exports/pull.csv", text.as_bytes()), ("sheets/notes.txt", b"none\n")]);
    let [exports, sheets] = ["exports", "sheets"].map(|name| folder.path().join(name));
    let draft = SheetDraft::of_folder(&exports, &sheets).unwrap_or_else(|error| panic!("{error}"));
    assert!(draft.text.contains("file = \"../exports/pull.csv\""), "{}", draft.text);
    let draft = SheetDraft::of_folder(&exports, &exports).unwrap_or_else(|error| panic!("{error}"));
    assert!(draft.text.contains("file = \"pull.csv\""), "{}", draft.text);
}

#[test]
fn two_tests_side_by_side_in_a_file_are_two_curves() {
    let pull = tensile();
    let bend = looped(2.5, 0.1, 0.04);
    let head = "Direction,Warp\r\nStrain (%),Load (gf/cm),Curvature (1/cm),Moment (gf.cm/cm)\r\n";
    let row = |index: usize| {
        let pair = |points: &[[f64; 2]]| match points.get(index) {
            Some([q, f]) => format!("{q:.5},{f:.6}"),
            None => ",".to_owned(),
        };
        format!("{},{}\r\n", pair(&pull), pair(&bend))
    };
    let text = (0..pull.len().max(bend.len())).map(row).collect::<String>();
    let folder = folder(&[("both.csv", format!("{head}{text}").as_bytes())]);
    let (draft, sheet) = drafted(folder.path());
    let mut tests: Vec<Test> = sheet.curves.iter().map(|curve| curve.test).collect();
    tests.sort();
    assert_eq!(tests, [Test::Tensile, Test::Bending], "{}", draft.text);
}

#[test]
fn gauge_and_width_in_columns_are_read_in_their_units() {
    let text = |heads: &str, sizes: &str| {
        let row = |_, [e, f]: [f64; 2]| format!("{:.5},{:.6},{sizes}", 0.5 * e, 0.049 * f);
        format!("{heads}\n{}", rows(&tensile(), row))
    };
    let warp = text("Extension (mm),Force (N),Gauge length (mm),Width (cm)", "50,5");
    let weft = text("Extension (mm),Force (N),l0 [cm],Specimen width / mm", "5,50");
    let folder = folder(&[("warp.csv", warp.as_bytes()), ("weft.csv", weft.as_bytes())]);
    let (draft, sheet) = drafted(folder.path());
    assert_eq!((draft.curves, draft.open), (2, 0), "{}", draft.text);
    assert!(draft.text.contains("gauge = \"Gauge length\""), "{}", draft.text);
    let keys = "deformation = { gauge = \"50 mm\" }\nload = { width = \"50 mm\" }\n";
    let section = |direction: &str| {
        format!(
            "[[curve]]\ntest = \"tensile\"\ndirection = \"{direction}\"\nfile = \"{direction}.csv\"\n{keys}"
        )
    };
    let hand = by_hand(folder.path(), &[section("warp"), section("weft")].concat());
    for (found, wanted) in sheet.curves.iter().zip(&hand.curves) {
        let pairs = [(found.deformation(), wanted.deformation()), (found.load(), wanted.load())];
        for (a, b) in pairs.iter().flat_map(|(found, wanted)| found.iter().zip(*wanted)) {
            assert!((a - b).abs() <= 1e-12 * b.abs(), "{a} for {b}");
        }
    }
}

#[test]
fn a_width_that_changes_is_not_that_of_the_specimen() {
    let text = |sizes: &str| {
        let row = |_, [e, f]: [f64; 2]| {
            format!("{:.5},{:.6},{:.5},{sizes}", 0.5 * e, 0.049 * f, -0.1 * e)
        };
        let heads = "Extension (mm),Force (N),Width change (mm),l0 (mm)";
        format!("{heads}\n{}", rows(&tensile(), row))
    };
    let folder = folder(&[("warp.csv", text("50").as_bytes())]);
    let (draft, _) = drafted(folder.path());
    assert_eq!((draft.curves, draft.open), (0, 1), "{}", draft.text);
    assert!(draft.notes[0].ends_with("the file does not state its width"), "{:?}", draft.notes);
}

#[test]
fn repeats_are_strips_of_one_length_in_whatever_order_they_come() {
    let text = |gauge: f64| {
        let row =
            |_, [e, f]: [f64; 2]| format!("{:.5},{:.6},{gauge},5", 0.01 * gauge * e, 0.049 * f);
        format!("Extension (mm),Force (N),l0 (mm),Width (cm)\n{}", rows(&tensile(), row))
    };
    let [short, long] = [50.0, 100.0].map(text);
    let names = ["warp 1.csv", "warp 2.csv", "warp 3.csv"];
    let files = names.iter().zip([&short, &long, &long]);
    let files: Vec<(&str, &[u8])> = files.map(|(name, text)| (*name, text.as_bytes())).collect();
    let (draft, sheet) = drafted(folder(&files).path());
    let repeats: Vec<usize> = sheet.curves.iter().map(|curve| curve.repeats().len()).collect();
    assert_eq!((draft.open, repeats), (0, vec![0, 2]), "{}", draft.text);
}

#[test]
fn strips_of_a_laboratory_and_arches_are_told_apart() {
    let folder_of_curves = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fabrics/cupro-weave");
    let names =
        ["loop-bend-up-warp", "loop-bend-down-1-warp", "stretch-2cm-warp", "stretch-8cm-warp"];
    let files = names.map(|name| format!("{name}.csv"));
    let bytes = |file: &String| std::fs::read(folder_of_curves.join(file)).expect("a curve");
    let files: Vec<(&str, Vec<u8>)> = files.iter().map(|file| (&**file, bytes(file))).collect();
    let files: Vec<(&str, &[u8])> = files.iter().map(|(name, b)| (*name, b.as_slice())).collect();
    let folder = folder(&files);
    let (draft, sheet) = drafted(folder.path());
    assert_eq!((draft.curves, draft.open), (4, 0), "{}", draft.text);
    let section = |test: &str, file: &str| {
        format!(
            "[[curve]]\ntest = \"{test}\"\ndirection = \"warp\"\nfile = \"{file}.csv\"\nslack = {}\n\
             deformation = {{ column = \"clamp_distance_m\", unit = \"m\", gauge = \"specimen_length_m\" }}\n\
             load = {{ column = \"force_N\", unit = \"N\", width = \"clamp_width_m\" }}\n",
            test == "tensile"
        )
    };
    let [up, down, short, long] = names;
    let hand = [
        section("loop-bending", down),
        section("loop-bending", up),
        section("tensile", short),
        section("tensile", long),
    ];
    assert_same(&sheet, &by_hand(folder.path(), &hand.concat()));
    assert!(sheet.curves.iter().all(|curve| curve.slack == (curve.test == Test::Tensile)));
}

/// Drafts a folder whose only file is a table of results.
fn of_results(text: &str) -> Sheet {
    let folder = folder(&[("results.csv", text.as_bytes())]);
    drafted(folder.path()).1
}

#[test]
fn a_direction_in_brackets_behind_a_symbol_is_no_unit() {
    let sheet = of_results("Property;Value\nB (warp);0,118\nB (weft);0,1\n2HB [gf.cm/cm];0,2\n");
    let rigidities = [Direction::Warp, Direction::Weft].map(|of| sheet.values(of).b);
    assert_eq!(rigidities, [Some(0.118), Some(0.1)]);
    assert_eq!(sheet.shared, ["2HB"]);
    let sheet = of_results(
        "Property;Value\nG (gf/(cm.deg)) warp;0,6\nEMT [%] Weft;4\nB (mN.m) WP;0,0118\n",
    );
    assert_eq!((sheet.warp.g, sheet.weft.em, sheet.weft.g), (Some(0.6), Some(4.0), None));
    assert!((sheet.warp.bending_rigidity().expect("it is there") / 1.18e-5 - 1.0).abs() < 1e-12);
}

#[test]
fn units_below_the_symbols_are_those_of_the_values() {
    let sheet = of_results(
        "Fabric;B;2HB;LT;EM;G\n;mN.m;mN;-;;(gf/(cm.deg))\nWarp;0,0118;1,2;0,7;4;0,6\nWeft;0,01;1;0,6;9;0,5\n",
    );
    let near = |found: Option<f64>, wanted: f64| {
        let found = found.expect("it is in the sheet");
        assert!((found / wanted - 1.0).abs() < 1e-12, "{found}, not {wanted}");
    };
    near(sheet.warp.bending_rigidity(), 1.18e-5);
    near(sheet.weft.bending_rigidity(), 1e-5);
    near(sheet.warp.bending_loop_width(), 1.2e-3);
    assert_eq!([sheet.warp.lt, sheet.weft.lt], [Some(0.7), Some(0.6)]);
    assert_eq!([sheet.warp.g, sheet.weft.g], [Some(0.6), Some(0.5)]);
    // Without a unit a value is in the laboratory's, here percent.
    assert_eq!([sheet.warp.em, sheet.weft.em], [Some(4.0), Some(9.0)]);
}

#[test]
fn rows_of_specimens_are_averaged_and_a_row_that_is_neither_warp_nor_weft_is_left_out() {
    let specimens = "Fabric;B;2HB\nWarp 1;0,118;0,124\nWarp 2;0,13;0,14\nWeft;0,1;0,09\n";
    for table in [specimens.to_owned(), format!("{specimens}Mean warp;0,124;0,132\n")] {
        let sheet = of_results(&table);
        assert_eq!((sheet.warp.b, sheet.warp.two_hb), (Some(0.124), Some(0.132)), "{table}");
        assert_eq!((sheet.weft.b, sheet.weft.two_hb), (Some(0.1), Some(0.09)), "{table}");
        let scatter = sheet.scatter.iter().find(|scatter| scatter.symbol == Symbol::B);
        let deviation = scatter.map(|scatter| scatter.deviation).unwrap_or(f64::NAN);
        assert!((deviation - 0.006 * 2.0_f64.sqrt()).abs() < 1e-6, "{table}: {deviation}");
    }
    let table = "Fabric;B;2HB\nWarp;0,118;0,124\nWeft;0,1;0,09\nOther;0,3;0,4\n";
    let folder = folder(&[("a.csv", table.as_bytes())]);
    let (draft, sheet) = drafted(folder.path());
    assert_eq!((sheet.warp.b, sheet.weft.b, draft.values), (Some(0.118), Some(0.1), 4));
    let told = |note: &String| note.contains("\"Other\" (line 4) is left out");
    assert!(draft.notes.iter().any(told), "{:?}", draft.notes);
}

/// Compression to 50 gf/cm² and back, along straight lines between few points.
const COMPRESSION: &str = "Thickness (mm),Pressure (gf/cm2)\n1.0,0\n0.9,0.25\n0.8,1\n0.6,5\n0.5,20\n0.4,50\n\
                           0.45,20\n0.55,5\n0.75,1\n0.9,0.25\n";

#[test]
fn a_compression_curve_has_the_values_of_its_trapezoids() {
    let folder = folder(&[("compression.csv", COMPRESSION.as_bytes())]);
    let (draft, sheet) = drafted(folder.path());
    let near = |found: Option<f64>, wanted: f64| {
        let found = found.unwrap_or(f64::NAN);
        assert!((found / wanted - 1.0).abs() < 1e-5, "{found}, not {wanted}\n{}", draft.text);
    };
    // By hand, at 0.5 gf/cm² between the points of 0.25 and 1.
    near(sheet.t0, 0.9 - 0.1 / 3.0);
    near(sheet.tm, 0.4);
    // 0.75/15 + 3 · 0.2 + 12.5 · 0.1 + 35 · 0.1 in gf/cm² · mm.
    near(sheet.wc, 0.54);
    near(sheet.lc, 2.0 * 0.54 / (50.0 * 0.1 * (0.4 + 1.0 / 15.0)));
    // 35 · 0.05 + 12.5 · 0.1 + 3 · 0.2 comes back down to the last point above 0.5 gf/cm².
    near(sheet.rc, 100.0 * 3.6 / 5.4);
}

#[test]
fn a_compression_curve_without_its_ends_is_answered() {
    let late = COMPRESSION.replace("1.0,0\n0.9,0.25\n", "");
    let short = COMPRESSION.replace("0.4,50\n", "");
    for (text, words) in [
        (late, "it does not begin below 49 Pa (0.5 gf/cm2), where T0 is measured"),
        (short, "it reaches 1961 Pa, and TM is the thickness at 4903 Pa (50 gf/cm2)"),
    ] {
        let folder = folder(&[("compression.csv", text.as_bytes())]);
        let error = SheetDraft::of_folder(folder.path(), folder.path()).expect_err("no values");
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn a_length_with_a_force_is_tensile_where_it_goes_one_way_whatever_its_size() {
    // Lengths of a strip of 50 mm; the clamp may run on a little past its start.
    let text = |lengths: &[f64]| {
        let row = |length: &f64| format!("{length},{},50,5\n", length.max(0.0) * length);
        let rows: String = lengths.iter().map(row).collect();
        format!("Extension (mm),Force (N),Gauge length (mm),Width (cm)\n{rows}")
    };
    for largest in [0.2, 0.5, 2.0, 10.0] {
        let scaled = |parts: &[f64]| parts.iter().map(|part| largest * part).collect::<Vec<f64>>();
        let one_way =
            text(&scaled(&[0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 0.7, 0.4, 0.2, 0.0, -0.1, -0.2]));
        let both_ways = text(&scaled(&[0.0, 0.5, 1.0, 0.5, 0.0, -0.2, -0.4, -0.2, 0.0]));
        let folder_of = |text: &str| folder(&[("warp.csv", text.as_bytes())]);
        let (draft, sheet) = drafted(folder_of(&one_way).path());
        let tests: Vec<Test> = sheet.curves.iter().map(|curve| curve.test).collect();
        assert_eq!(tests, [Test::Tensile], "{largest} mm: {}", draft.text);
        assert!(draft.text.contains("the length goes one way"), "{largest} mm: {}", draft.text);
        let (draft, _) = drafted(folder_of(&both_ways).path());
        assert_eq!((draft.curves, draft.open), (0, 1), "{largest} mm: {}", draft.text);
        assert!(draft.text.contains("and it goes both ways"), "{largest} mm: {}", draft.text);
    }
}
