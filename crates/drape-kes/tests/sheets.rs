//! Sheets as a laboratory writes them, and the message for each mistake.

use std::path::Path;

use drape_input::Document;
use drape_kes::{Direction, Model, Sheet, Test};

use self::sheet::{GOOD_CURVE, finding, help, mistakes, read};

#[path = "support/sheet.rs"]
mod sheet;

const CURVE: &str = r#"
[[curve]]
test = "tensile"
direction = "warp"
file = "pull.csv"
deformation = { column = "strain", unit = "%" }
load = { column = "force", unit = "gf/cm" }
"#;

#[test]
fn a_whole_sheet_is_read_into_laboratory_values_and_si_curves() {
    let text = format!(
        "name = \"poplin\"\nsource = \"us\"\nW = 12.38\nT = 0.497\nTM = 0.3\nMIU = 0.18\n[warp]\nB = 0.118\n2HB = 0.124\nLT = 0.7\n\
         EM = 4\n[weft]\nB = \"1.2e-5 N.m\"\n{CURVE}"
    );
    let sheet = read(&text, GOOD_CURVE).unwrap();
    assert_eq!((sheet.name.as_str(), sheet.w, sheet.warp.b), ("poplin", Some(12.38), Some(0.118)));
    let close = |a: Option<f64>, b: f64| (a.unwrap() / b - 1.0).abs() < 1e-12;
    assert!(close(sheet.density(), 0.1238));
    assert!(close(sheet.thickness(), 0.497e-3));
    assert!(close(sheet.pressed_thickness(), 0.3e-3));
    assert_eq!(sheet.miu, Some(0.18));
    let mut unpressed = sheet.clone();
    unpressed.tm = None;
    assert_ne!(sheet.digest(), unpressed.digest());
    assert!(close(Some(sheet.maximum_tension()), 490.3325));
    assert!(close(sheet.warp.bending_rigidity(), 0.118 * 9.80665e-5));
    assert!(close(sheet.warp.bending_loop_width(), 0.124 * 9.80665e-3));
    assert!(close(sheet.warp.tensile_extension(), 0.04));
    assert_eq!(sheet.warp.tensile_linearity(), Some(0.7));
    assert!(close(sheet.weft.bending_rigidity(), 1.2e-5));
    assert!(close(sheet.weft.b, 1.2e-5 / 9.80665e-5));
    let curve = sheet.curves_of(Test::Tensile, Direction::Warp).next().unwrap();
    assert_eq!(curve.deformation(), [0.0, 0.01, 0.02]);
    assert!((curve.load()[2] / (200.0 * 0.980665) - 1.0).abs() < 1e-12);
    // The values are of 500 gf/cm, the curve ends at 200.
    let [warning] = sheet.warnings() else { panic!("{:?}", sheet.warnings()) };
    assert!(warning.message.contains("ends at 200.0 gf/cm"), "{warning}");
    assert!(help(warning).contains("write FM = 200.0"), "{warning}");
}

#[test]
fn the_load_of_the_tensile_test_is_that_of_the_curves_where_nothing_else_tells_it() {
    let load = |text: &str| {
        let sheet = read(&format!("name = \"poplin\"\n{text}{CURVE}"), GOOD_CURVE).unwrap();
        assert_eq!(sheet.warnings(), [], "{text}");
        sheet.maximum_tension() / 0.980_665
    };
    assert!((load("") - 200.0).abs() < 1e-9);
    assert!((load("FM = 200\n[warp]\nLT = 0.7\n") - 200.0).abs() < 1e-9);
    assert!((load("FM = 50\n") - 50.0).abs() < 1e-9);
}

#[test]
fn a_surface_and_a_compression_that_cannot_be_are_refused() {
    let thick = finding("name = \"a\"\nT = 0.3\nTM = 0.4\n", GOOD_CURVE);
    assert_eq!(thick.message, "TM: 0.4 is more than T, 0.3");
    assert!(help(&thick).contains("50 gf/cm²"));
    let percent = finding("name = \"a\"\nMIU = 18\n", GOOD_CURVE);
    assert_eq!(percent.message, "MIU: 18 is not between 0 and 2");
}

#[test]
fn clamp_distances_and_whole_forces_become_strains_and_forces_per_width() {
    let text = r#"
name = "strip"
[[curve]]
test = "tensile"
direction = "weft"
file = "pull.csv"
slack = true
deformation = { column = "d", unit = "mm", gauge = "gauge" }
load = { column = "F", unit = "N", width = "5 cm" }
[[curve]]
test = "loop-bending"
direction = "weft"
file = "pull.csv"
deformation = { column = 1, unit = "mm", gauge = "80 mm" }
load = { column = 2, unit = "N", width = 0.05 }
"#;
    let sheet = read(text, "d;F;gauge\n79,5;0,1;0,08\n81;1;0,08\n").unwrap();
    let strip = &sheet.curves[0];
    assert!(strip.slack);
    for (found, exact) in strip.deformation().iter().zip([-0.00625, 0.0125]) {
        assert!((found - exact).abs() < 1e-15, "{found} against {exact}");
    }
    for (found, exact) in strip.load().iter().zip([2.0, 20.0]) {
        assert!((found - exact).abs() < 1e-13, "{found} against {exact}");
    }
    let arch = &sheet.curves[1];
    assert_eq!((arch.gauge, arch.slack), (Some(0.08), false));
    assert_eq!(arch.deformation(), strip.deformation());
}

#[test]
fn a_column_of_lengths_is_read_in_its_unit_or_refused() {
    let sheet = |gauge: &str| {
        format!(
            "name = \"strip\"\n[[curve]]\ntest = \"tensile\"\ndirection = \"warp\"\nfile = \"pull.csv\"\n\
             deformation = {{ column = \"d\", unit = \"mm\", zero = \"extension\", gauge = \"{gauge}\" }}\n"
        )
    };
    let curve = "d,Force (gf/cm),long (cm),weight (g),short (mm)\n0,0,8,1,80\n0.8,2,8,1,-80\n";
    let strain = read(&sheet("long"), curve).unwrap().curves[0].deformation()[1];
    assert!((strain - 0.01).abs() < 1e-15, "{strain}");
    let weight = finding(&sheet("weight"), curve);
    assert!(weight.message.starts_with("column \"weight\": "), "{weight}");
    assert!(help(&weight).contains("cm"), "{weight}");
    let short = finding(&sheet("short"), curve);
    assert_eq!(
        (short.message.as_str(), short.line),
        ("column \"short\" has a length of -80 (tensile warp)", Some(3))
    );
}

#[test]
fn an_unknown_key_is_named_with_its_line_and_the_key_that_was_meant() {
    let found = finding("name = \"a\"\nW = 10\n[warp]\n2HBB = 0.1\n", GOOD_CURVE);
    assert_eq!(found.line, Some(4));
    assert_eq!(found.message, "warp.2HBB: there is no such key");
    assert_eq!(help(&found), "did you mean `2HB`?");
}

#[test]
fn a_missing_file_is_named_with_the_one_that_is_there() {
    let text = format!("name = \"a\"\n{}", CURVE.replace("pull.csv", "pul.csv"));
    let found = finding(&text, GOOD_CURVE);
    assert_eq!(found.line, Some(6));
    assert!(found.message.starts_with("curve[0].file: there is no file"), "{}", found.message);
    assert!(help(&found).contains("did you mean \"pull.csv\"?"), "{}", help(&found));
}

#[test]
fn a_missing_sheet_is_one_error_with_its_path() {
    let found = mistakes(Sheet::read("no/such/sheet.toml"));
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].file, Path::new("no/such/sheet.toml"));
}

#[test]
fn a_wrong_unit_is_refused_with_the_units_accepted() {
    let text = format!("name = \"a\"\n{}", CURVE.replace("gf/cm", "gf.cm"));
    let found = finding(&text, GOOD_CURVE);
    assert_eq!(found.line, Some(8));
    assert!(found.message.contains("\"gf.cm\" is not a unit of force per width"), "{found}");
    assert!(help(&found).contains("did you mean `gf/cm`?"), "{}", help(&found));
    let found = finding("name = \"a\"\nW = \"10 kg/m\"\n", GOOD_CURVE);
    assert_eq!((found.line, found.column), (Some(2), Some(5)));
}

#[test]
fn a_value_that_is_not_a_number_is_refused_in_sheet_and_file() {
    let found = finding("name = \"a\"\n[warp]\nB = nan\n", GOOD_CURVE);
    assert_eq!((found.line, found.column), (Some(3), Some(5)));
    assert_eq!(found.message, "warp.B: NaN is not a finite number");
    let text = format!("name = \"a\"\n{CURVE}");
    let found = finding(&text, "strain,force\n0,0\n1,NaN\n");
    assert_eq!((found.line, found.file.file_name().unwrap().to_str()), (Some(3), Some("pull.csv")));
    assert!(found.message.contains("\"NaN\""), "{found}");
}

#[test]
fn an_empty_curve_and_a_one_point_curve_are_refused() {
    let text = format!("name = \"a\"\n{CURVE}");
    for empty in ["", "strain,force\n", "# nothing\n"] {
        let found = finding(&text, empty);
        assert_eq!(found.message, "the file has no rows of numbers (tensile warp)", "{empty:?}");
    }
    let found = finding(&text, "strain,force\n0,0\n");
    assert_eq!(found.message, "a curve needs at least two points; this one has 1 (tensile warp)");
    assert_eq!(found.file.file_name().unwrap().to_str(), Some("pull.csv"));
}

#[test]
fn a_negative_density_is_refused() {
    let found = finding("name = \"a\"\nW = -10\n", GOOD_CURVE);
    assert_eq!((found.line, found.column), (Some(2), Some(5)));
    assert_eq!(found.message, "W: -10 is not greater than 0");
}

#[test]
fn a_rigidity_no_fabric_has_is_refused_with_what_was_probably_meant() {
    // The SI value where the laboratory's is expected.
    let found = finding("name = \"a\"\n[warp]\nB = 1.2e-5\n", GOOD_CURVE);
    assert_eq!(found.line, Some(3));
    assert!(help(&found).contains("did you mean \"0.000012 N.m\""), "{}", help(&found));
    // The laboratory's value where it says SI.
    let found = finding("name = \"a\"\n[warp]\nB = \"0.118 N.m\"\n", GOOD_CURVE);
    assert!(help(&found).contains("0.118 in gf.cm2/cm"), "{}", help(&found));
    // Micronewton metres written bare.
    let found = finding("name = \"a\"\n[warp]\nB = 12\n", GOOD_CURVE);
    assert!(help(&found).contains("\"12 uN.m\""), "{}", help(&found));
}

#[test]
fn every_error_of_a_sheet_is_reported_at_once_in_the_order_of_the_file() {
    let text = "name = \"a\"\nW = -1\ncolour = \"red\"\n[warp]\nB = inf\nEM = 3\n[weft]\nRT = 140\n[[curve]]\ntest = \"tensil\"\n";
    let found = mistakes(read(text, GOOD_CURVE));
    let lines: Vec<_> = found.iter().map(|finding| finding.line).collect();
    // The curve has a wrong test and two missing keys.
    let expected = [2, 3, 5, 8, 9, 9, 10].map(Some);
    assert_eq!(lines, expected, "{found:#?}");
    assert!(found.iter().all(|finding| finding.help.is_some()), "{found:#?}");
}

#[test]
fn text_that_is_not_toml_is_one_error_at_its_line() {
    let found = finding("name = \"a\"\nW = = 3\n", GOOD_CURVE);
    assert_eq!(found.line, Some(2));
}

#[test]
fn an_unusual_value_is_a_warning_and_not_an_error() {
    let sheet = read("name = \"a\"\nW = 60\n[warp]\nB = 0.1\n", GOOD_CURVE).unwrap();
    // 0.6 kg/m² is beyond the 95th percentile; the bending length 11.9 mm is not below the 5th.
    let warnings = sheet.warnings();
    assert_eq!(warnings.len(), 1, "{warnings:#?}");
    assert_eq!(warnings[0].line, Some(2));
    assert!(
        warnings[0].message.contains("a mass per area of 6.000e-1 kg/m2 is unusual"),
        "{}",
        warnings[0]
    );
}

#[test]
fn a_sheet_may_ask_for_a_law() {
    for law in Model::ALL {
        let text = format!("name = \"x\"\nmodel = \"{}\"", law.name());
        let sheet = read(&text, "").expect("a good sheet");
        assert_eq!(sheet.model, Some(law));
        assert_eq!(sheet.warnings(), []);
    }
    let mistake = finding("name = \"x\"\nmodel = \"two-element\"", "");
    assert_eq!(help(&mistake), "did you mean \"two-elements\"?");
}

#[test]
fn a_former_name_of_a_law_is_accepted_with_a_remedy_that_works() {
    for (former, law) in [("parallel", Model::TwoElements), ("breen-1994", Model::Piecewise)] {
        let text = format!("name = \"x\"\nmodel = \"{former}\"\n");
        let sheet = read(&text, "").expect("a good sheet");
        assert_eq!(sheet.model, Some(law));
        let [warning] = sheet.warnings() else { panic!("{former}: {:?}", sheet.warnings()) };
        let message = format!("model: `{former}` is now called `{}`", law.name());
        assert_eq!((warning.line, &warning.message), (Some(2), &message));

        let [edit] = warning.edits.as_slice() else { panic!("{former}: {:?}", warning.edits) };
        let old = edit.old.as_deref().expect("the name in the sheet");
        let mended = text.replace(old, edit.new.as_deref().expect("a name of today"));
        let sheet = read(&mended, "").expect("a good sheet");
        assert_eq!(sheet.model, Some(law));
        assert_eq!(sheet.warnings(), []);
    }
}

/// Denim D of table 5 of "Regenerated Cellulose-Based Denim Fabric for Tropical Regions", Journal
/// of Textiles, vol. 2016, article 4614168 (Hindawi, CC BY): one value for both directions, as
/// printed, in the paper's order and with its EMT. Its MIU and W are those of the table, unusual as
/// they are.
const PUBLISHED: &str = "name = \"denim D\"\nsource = \"J. Textiles 2016, 4614168, table 5\"\n\
    EMT = 5.135\nLT = 0.676\nWT = 8.675\nRT = 52.450\nB = 0.147\n2HB = 0.141\nG = 1.613\n2HG = 3.513\n\
    2HG5 = 6.412\nMIU = 1.788\nMMD = 0.715\nSMD = 3.462\nLC = 0.255\nWC = 0.307\nRC = 29.483\nT = 1.040\n\
    W = 107.77\n";

#[test]
fn a_complete_published_sheet_is_kept_to_the_last_value() {
    let sheet = read(PUBLISHED, GOOD_CURVE).expect("all of its values are known");
    let listed = sheet.listed();
    for line in PUBLISHED.lines().skip(2) {
        let (key, value) = line.split_once(" = ").expect("a value");
        let symbol = if key == "EMT" { "EM" } else { key };
        let value: f64 = value.parse().expect("a number");
        let found: Vec<f64> =
            listed.iter().filter(|one| one.symbol == symbol).map(|one| one.value).collect();
        let directed = !["LC", "WC", "RC", "T", "W"].contains(&symbol);
        assert_eq!(found, vec![value; if directed { 2 } else { 1 }], "{symbol}");
    }
    let unused: Vec<&str> =
        listed.iter().filter(|one| one.used_for.is_none()).map(|one| one.symbol).collect();
    assert_eq!(unused, ["RC", "MMD", "SMD", "MMD", "SMD"]);
    // T − 2 WC/(LC · 50 gf/cm²), in mm.
    let pressed = sheet.pressed_thickness().expect("by LC and WC");
    assert!((1e3 * pressed - (1.040 - 20.0 * 0.307 / (0.255 * 50.0))).abs() < 1e-12);
    assert_eq!(sheet.compression_linearity(), Some(0.255));
    // A mass of 1.08 kg/m² is told, and nothing else hinders the reading.
    let warnings: Vec<&str> = sheet.warnings().iter().map(|w| w.message.as_str()).collect();
    assert!(warnings.iter().all(|w| w.contains("unusual")), "{warnings:#?}");
}

#[test]
fn values_may_be_spelt_and_placed_in_many_ways() {
    let sheets = [
        "[warp]\nB = 0.1\nEM = 4\n2HG5 = 2\n[weft]\nB = 0.08\nEM = 9\n2HG5 = 3\n",
        "[Kette]\nb = 0.1\nEMT = 4\n2HG_5 = 2\n[filling]\nb = 0.08\nEMT = 9\n2hg5 = 3\n",
        "B_warp = 0.1\nB_weft = 0.08\nEMT-1 = 4\nEMT-2 = 9\n2HG5_1 = 2\n2HG5_2 = 3\n",
        "[mean]\nB = 7\n[warp]\nB = 0.1\nEM = 4\n2HG5 = 2\n[weft]\nB = 0.08\nEM = 9\n2HG5 = 3\n",
    ];
    for text in sheets {
        let sheet = read(&format!("name = \"a\"\n{text}"), GOOD_CURVE).expect(text);
        let of = |values: &drape_kes::Values| (values.b, values.em, values.two_hg5);
        assert_eq!(of(&sheet.warp), (Some(0.1), Some(4.0), Some(2.0)), "{text}");
        assert_eq!(of(&sheet.weft), (Some(0.08), Some(9.0), Some(3.0)), "{text}");
        assert!(sheet.shared.is_empty(), "{text}");
    }
    let sheet = read("name = \"a\"\nT_0 = 0.8\nT_m = 0.6\nB = 0.1\n", GOOD_CURVE).expect("a mean");
    assert_eq!((sheet.t0, sheet.tm, sheet.shared.as_slice()), (Some(0.8), Some(0.6), &["B"][..]));
    let found = finding("name = \"a\"\nB = { warp = 0.1 }\n", GOOD_CURVE);
    assert!(help(&found).contains("B_warp"), "{found}");
}

#[test]
fn widths_of_the_shear_loop_are_forces_per_width() {
    let text = "name = \"a\"\n[warp]\nG = 0.6\n2HG = 1.5\n2HG5 = 3\n[weft]\n2HG5 = \"2 N/m\"\n";
    let sheet = read(text, GOOD_CURVE).expect("a good sheet");
    let near = |found: Option<f64>, wanted: f64| {
        let found = found.expect("it is given");
        assert!((found / wanted - 1.0).abs() < 1e-12, "{found}, not {wanted}");
    };
    near(sheet.warp.shear_loop_width(), 1.5 * 0.980665);
    near(sheet.warp.shear_loop_width_at_five_degrees(), 3.0 * 0.980665);
    near(sheet.weft.shear_loop_width_at_five_degrees(), 2.0);
    assert_eq!(sheet.weft.shear_loop_width(), None);
}

#[test]
fn a_shear_curve_of_one_direction_takes_the_place_of_the_values_of_both() {
    let curve = CURVE.replace("tensile", "shear").replace('%', "deg");
    let values = "G = 0.6\n2HG = 1.5\nLT = 0.7\nB = 0.1\n";
    let text = format!("name = \"a\"\n[warp]\n{values}[weft]\n{values}{curve}");
    let loops = "strain,force\n-8,-2.4\n0,1\n8,5.8\n0,-1\n-8,-2.4\n";
    let sheet = read(&text, loops).expect("a good sheet");
    let uses: Vec<_> = sheet.listed().iter().map(|one| (one.symbol, one.used_for)).collect();
    let expected = [("LT", Some("traction")), ("G", None), ("2HG", None), ("B", Some("bending"))];
    let of_both: Vec<_> = expected.into_iter().flat_map(|one| [one, one]).collect();
    assert_eq!(uses, of_both);
}

#[test]
fn a_sheet_keeps_the_scatter_of_values_that_no_law_uses() {
    let text = "name = \"poplin\"\nT = \"0.5 ± 0.02 mm\"\nLC = \"0.3 ± 0.03\"\nRC = \"50 ± 2\"\n[warp]\nMIU = \"0.2 ± 0.01\"\nSMD = \"4 ± 0.5\"\nB = \"0.1 ± 0.01\"\n";
    let sheet = Sheet::from_document(&Document::new("sheet.toml", text)).expect("it is right");
    let of = |symbol: &str, direction: Option<Direction>| {
        let own = sheet.other_scatter.iter();
        let mut found = own.filter(|own| own.symbol == symbol && own.direction == direction);
        found.next().map(|own| own.deviation).expect(symbol)
    };
    let warp = Some(Direction::Warp);
    let expected = [
        ("T", None, 0.02),
        ("LC", None, 0.03),
        ("RC", None, 2.0),
        ("MIU", warp, 0.01),
        ("SMD", warp, 0.5),
    ];
    for (symbol, direction, deviation) in expected {
        let found = of(symbol, direction);
        assert!((found / deviation - 1.0).abs() < 1e-12, "{symbol}: {found}");
    }
    assert_eq!(sheet.other_scatter.len(), expected.len(), "that of B gives an interval");
}

#[test]
fn the_record_of_a_test_is_read_and_checked() {
    let read = |text: &str| {
        let text = format!("name = \"poplin\"\nW = 12\n{text}");
        Sheet::from_document(&Document::new("sheet.toml", text)).map(|sheet| sheet.record)
    };
    let text = "customer = \"Mill\"\narticle = 4711\ndate = \"2026-03\"\nspecimens = \"3 of 20 cm × 20 cm\"\n";
    let record = read(text).expect("it is right");
    let lines = record.lines().map(|(_, text)| text);
    assert_eq!(
        lines,
        [Some("Mill"), Some("4711"), Some("3 of 20 cm × 20 cm"), Some("2026-03"), None]
    );
    for (text, message) in [
        ("date = \"14.03.2026\"\n", "date: is not a date"),
        ("date = 2026-03-14T10:00:00\n", "date: is not a date"),
        ("specimens = 0\n", "specimens: is not a number of specimens"),
        ("customer = \"\"\n", "customer: is empty"),
        ("laboratory = [1]\n", "laboratory: is a list where text in quotes is needed"),
        ("costumer = \"Mill\"\n", "did you mean `customer`?"),
    ] {
        let mistake = read(text).expect_err(text).to_string();
        assert!(mistake.contains(message), "{mistake}");
    }
}
