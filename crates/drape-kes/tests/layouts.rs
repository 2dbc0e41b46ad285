//! Layouts that differ from those of `exports.rs` in one point each, read to the same curve.

use drape_input::{Diagnostic, Diagnostics};
use drape_kes::{Error, Sheet};

/// Strip stretched to 4 % and released: strain in percent, load in gf/cm.
fn points() -> Vec<[f64; 2]> {
    let up = (0..=20).map(|i| f64::from(i) * 0.2).map(|e| [e, 30.0 * e * e]);
    let down = (0..20).rev().map(|i| f64::from(i) * 0.2).map(|e| [e, 7.0 * e * e * e]);
    up.chain(down).collect()
}

fn rows(row: impl Fn(usize, [f64; 2]) -> String) -> String {
    points().into_iter().enumerate().map(|(index, point)| row(index, point) + "\n").collect()
}

/// Lengthening of a strip of 50 mm, in mm.
fn mm(percent: f64) -> f64 {
    0.5 * percent
}

/// Force of a strip of 200 mm, in N.
fn newtons(gf: f64) -> f64 {
    gf * 0.980_665 * 0.2
}

fn read(bytes: &[u8], keys: &str) -> Result<Sheet, Error> {
    read_file("strip.csv", bytes, keys)
}

fn read_file(file: &str, bytes: &[u8], keys: &str) -> Result<Sheet, Error> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join(file), bytes).expect("written");
    let sheet = format!(
        "name = \"strip\"\n[[curve]]\ntest = \"tensile\"\ndirection = \"warp\"\nfile = \"{file}\"\n{keys}\n"
    );
    std::fs::write(folder.path().join("sheet.toml"), sheet).expect("written");
    Sheet::read(folder.path())
}

/// Returns the one mistake of a layout that is not read.
fn mistake(read: Result<Sheet, Error>) -> Diagnostic {
    match read {
        Err(Error::Input(Diagnostics(mut found))) if found.len() == 1 => found.remove(0),
        other => panic!("not one mistake but {other:?}"),
    }
}

/// Reads a layout and compares every point.
fn assert_read(name: &str, text: &str, keys: &str) {
    let sheet = read(text.as_bytes(), keys).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_points(name, &sheet);
}

/// Compares every point of a sheet.
fn assert_points(name: &str, sheet: &Sheet) {
    assert_eq!(sheet.warnings(), [], "{name}: {:?}", sheet.readings());
    let [curve] = &sheet.curves[..] else { panic!("{name}: {} curves", sheet.curves.len()) };
    assert_eq!(curve.load().len(), points().len(), "{name}: {:?}", sheet.readings());
    for (index, [percent, gf]) in points().into_iter().enumerate() {
        let (strain, load) = (curve.deformation()[index], curve.load()[index]);
        assert!(
            (strain - 0.01 * percent).abs() < 1e-7 && (load - 0.980_665 * gf).abs() < 1e-4,
            "{name}, point {index}: {strain} and {load}, not {percent} % and {gf} gf/cm"
        );
    }
}

const SIZES: &str = "deformation = { gauge = \"50 mm\" }\nload = { width = \"200 mm\" }";

#[test]
fn bluehill_2_with_inputs_above_and_columns_without_unit() {
    let text = format!(
        "Text Inputs : Specimen label,\"22L.3\"\nGeneral : Start Date,13/11/2018 5:14 PM\n\n\
         Time,Extension,Load,Segment ID,Total Cycle Count\n(sec),(mm),(N),,\n{}",
        rows(|i, [e, f]| format!("{:.5},{:.7},{:.7},22476,0", 0.02 * i as f64, mm(e), newtons(f)))
    );
    assert_read("bluehill 2", &text, SIZES);
}

#[test]
fn mts_793_with_its_line_of_formats() {
    for (number, sign) in [(0, "  "), (1, ","), (2, "\t")] {
        let text = format!(
            "MTS793|MPT|ENU|1|{number}|.|/|:|1|0|0|A\n\nData Header:{sign}Time:{sign}1.5{sign}Sec\n\
             Data Acquisition{sign}Timed\nAxial Displacement{sign}Axial Force{sign}Running Time\n\
             mm{sign}N{sign}Sec\n{}",
            rows(|i, [e, f]| format!(
                "{:.7}{sign}{:.7}{sign}{:.4}",
                mm(e),
                newtons(f),
                0.1 * i as f64
            ))
        );
        assert_read(&format!("MTS {number}"), &text, SIZES);
    }
}

#[test]
fn force_gauge_with_units_in_columns_of_their_own() {
    let text = format!(
        "001\n2024,05,13,10,11,12\n{}",
        rows(|_, [e, f]| format!("{:+.6},N,{:+.6},mm", newtons(f), mm(e)))
    );
    assert_read("force gauge", &text, SIZES);
}

#[test]
fn directions_in_a_column_are_two_curves() {
    let of = |name: &str, factor: f64| {
        rows(|_, [e, f]| format!("{name};{e:.6};{:.6}", factor * f)).replace('.', ",")
    };
    let text =
        format!("Direction;Strain (%);Force (gf/cm)\n{}{}", of("Weft", 0.5), of("Warp", 1.0));
    assert_read("a column of directions", &text, "");
}

#[test]
fn small_differences_of_the_text_change_nothing() {
    let plain = rows(|_, [e, f]| format!("{e:.6},{f:.6}"));
    let cases = [
        (
            "line ends of old machines",
            format!("Strain (%),Force (gf/cm)\n{plain}").replace('\n', "\r"),
        ),
        ("a separator at the end of lines", {
            let rows = rows(|_, [e, f]| format!("{e:.6};{f:.6};"));
            format!("Strain (%);Force (gf/cm);\n{rows}")
        }),
        ("an empty column between", {
            let rows = rows(|_, [e, f]| format!("{e:.6},,{f:.6}"));
            format!("Strain (%),,Force (gf/cm)\n{rows}")
        }),
        ("a line of comment at the end", format!("Strain (%),Force (gf/cm)\n{plain}End of test\n")),
        ("empty lines between", format!("\n\nStrain (%),Force (gf/cm)\n\n{plain}\n\n")),
        ("names in quotes over two lines", format!("\"Strain\n(%)\",\"Force\n(gf/cm)\"\n{plain}")),
        ("a ratio", {
            let rows = rows(|_, [e, f]| format!("{:.8},{f:.6}", 0.01 * e));
            format!("Strain (mm/mm),Force (gf/cm)\n{rows}")
        }),
        ("a clock in the first column", {
            let rows = rows(|i, [e, f]| format!("10:11:{:02}.5,{e:.6},{f:.6}", i % 60));
            format!("Clock,Strain (%),Force (gf/cm)\n{rows}")
        }),
        ("numbers of lines", {
            let rows = rows(|i, [e, f]| format!("{},{e:.6},{f:.6}", i + 1));
            format!("No.,Strain (%),Force (gf/cm)\n{rows}")
        }),
        ("full-width signs of Japanese", { format!("伸度（％）,荷重（gf/cm）\n{plain}") }),
        ("minus signs of typesetters", {
            let rows = plain.replacen("0.000000,0.000000", "\u{2212}0.000000,0.000000", 1);
            format!("Strain (%),Force (gf/cm)\n{rows}")
        }),
        ("newtons over five centimetres", {
            let rows = rows(|_, [e, f]| format!("{e:.6},{:.9}", 0.980_665 * f / 20.0));
            format!("Elongation (%),Force (N/5cm)\n{rows}")
        }),
        ("groups of thousands with points", {
            let rows = rows(|_, [e, f]| {
                let milli = format!("{:.3}", 980.665 * f);
                let whole = milli.find('.').expect("a point");
                let grouped = match whole {
                    7.. => format!(
                        "{},{},{}",
                        &milli[..whole - 6],
                        &milli[whole - 6..whole - 3],
                        &milli[whole - 3..]
                    ),
                    4.. => format!("{},{}", &milli[..whole - 3], &milli[whole - 3..]),
                    _ => milli,
                };
                format!("{e:.6}\t{grouped}")
            });
            format!("Strain (%)\tForce (mN/m)\n{rows}")
        }),
    ];
    for (name, text) in cases {
        assert_read(name, &text, "");
    }
}

#[test]
fn bending_and_shear_in_the_signs_of_their_programs() {
    let looped = |largest: f64| {
        let steps = (-20..=20).chain((-20..20).rev()).enumerate();
        steps
            .map(|(i, step)| {
                let q = largest * f64::from(step) / 20.0;
                [q, 0.1 * q + if i <= 40 { 0.02 } else { -0.02 }]
            })
            .collect::<Vec<_>>()
    };
    let of = |test: &str, head: &str, largest: f64| {
        let rows: String =
            looped(largest).iter().map(|[q, f]| format!("{q:.6}\t{f:.6}\n")).collect();
        let bytes = encoding_rs::SHIFT_JIS.encode(&format!("{head}\n{rows}")).0.into_owned();
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("loop.txt"), bytes).expect("written");
        let sheet = format!(
            "name = \"loop\"\n[[curve]]\ntest = \"{test}\"\ndirection = \"warp\"\nfile = \"loop.txt\"\n"
        );
        std::fs::write(folder.path().join("sheet.toml"), sheet).expect("written");
        let sheet = Sheet::read(folder.path()).unwrap_or_else(|error| panic!("{head}: {error}"));
        assert_eq!(sheet.warnings(), [], "{head}");
        let high = sheet.curves[0].deformation_range().high;
        (high, sheet.curves[0].load_range().high)
    };
    for head in [
        "K (1/cm)\tM (gf･cm/cm)",
        "曲率(1/cm)\t曲げモーメント(gf・cm/cm)",
        "曲率［cm-1］\tモーメント［gfcm/cm］",
    ] {
        let (curvature, moment) = of("bending", head, 2.5);
        assert!(
            (curvature - 250.0).abs() < 1e-9 && (moment - 0.27 * 9.806_65e-3).abs() < 1e-9,
            "{head}"
        );
    }
    for head in
        ["せん断角(°)\tせん断力(gf/cm)", "φ (deg)\tFs (gf/cm)", "ずり角（度）\tずり力（gf/cm）"]
    {
        let (angle, load) = of("shear", head, 8.0);
        assert!(
            (angle - 8_f64.to_radians()).abs() < 1e-12 && (load - 0.82 * 0.980_665).abs() < 1e-9,
            "{head}"
        );
    }
}

#[test]
fn channels_in_rows() {
    let across = |of: usize| points().iter().map(|p| format!(",{:.6}", p[of])).collect::<String>();
    let text = format!("Strain (%){}\nForce (gf/cm){}\n", across(0), across(1));
    assert_read("two rows", &text, "");
    let time = (0..points().len()).map(|k| format!(";{k}")).collect::<String>();
    let of = |size: fn(f64) -> f64, of: usize| {
        points()
            .iter()
            .map(|p| format!(";{:.7}", size(p[of])).replace('.', ","))
            .collect::<String>()
    };
    let text = format!(
        "Specimen label;22L.3\nTime;(sec){time}\nExtension;(mm){}\nLoad;(N){}\n",
        of(mm, 0),
        of(newtons, 1)
    );
    assert_read("settings above, units in a column, decimal commas", &text, SIZES);
}

#[test]
fn units_in_the_cells() {
    let text = format!("Strain,Force\n{}", rows(|_, [e, f]| format!("{e:.6} %,{f:.6} gf/cm")));
    assert_read("blanks before the units", &text, "");
    let text = format!(
        "Gauge length;50 mm\nWidth;200 mm\n\nExtension;Load\n{}",
        rows(|_, [e, f]| format!("{:.7}mm;{:.7}N", mm(e), newtons(f)).replace('.', ","))
    );
    assert_read("no blanks, settings above", &text, SIZES);
}

#[test]
fn a_unit_that_changes_within_a_column_is_refused() {
    let text = "Strain,Force\n0 %,0 gf/cm\n1 %,10 gf/cm\n2 %,0.4 N/cm\n1 %,5 gf/cm\n";
    let Err(Error::Input(mistakes)) = read(text.as_bytes(), "") else { panic!("it is read") };
    let told = mistakes.to_string();
    let parts = ["strip.csv:4", "holds \"0.4 N/cm\", and its first cell is in gf/cm", "one unit"];
    assert!(parts.iter().all(|part| told.contains(part)), "{told}");
}

#[test]
fn layouts_that_are_not_read_are_answered() {
    let cases = [
        ("a picture", "\u{89}PNG\r\n\u{1a}\n".to_owned()),
        ("only forces", format!("Force (gf/cm)\n{}", rows(|_, [_, f]| format!("{f:.5}")))),
    ];
    for (name, text) in cases {
        match read(text.as_bytes(), "") {
            Err(Error::Input(mistakes)) => {
                assert!(mistakes.0.iter().all(|m| m.help.is_some()), "{name}: {mistakes}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

#[test]
fn text_under_xls_is_read_and_under_xlsx_refused() {
    let text =
        format!("Strain (%)\tForce (gf/cm)\n{}", rows(|_, [e, f]| format!("{e:.6}\t{f:.6}")));
    let sheet = read_file("strip.XLS", text.as_bytes(), "").expect("text of an old program");
    assert_points("text under xls", &sheet);
    let found = mistake(read_file("strip.xlsx", text.as_bytes(), ""));
    assert!(found.message.starts_with("not a spreadsheet that can be read"), "{found}");
    let help = "save it again as .xlsx, or each sheet as .csv";
    assert_eq!(found.help.as_deref(), Some(help));
}

#[test]
fn a_sheet_that_is_not_there_is_answered_with_those_that_are() {
    let text = format!("Strain (%),Force (gf/cm)\n{}", rows(|_, [e, f]| format!("{e:.6},{f:.6}")));
    let found = mistake(read(text.as_bytes(), "sheet = \"Tensile\""));
    assert_eq!(found.message, "there is no sheet \"Tensile\" (tensile warp)");
    assert_eq!(found.help.as_deref(), Some("this file is text, without sheets: remove `sheet`"));
    let mut book = rust_xlsxwriter::Workbook::new();
    let page = book.add_worksheet().set_name("Zug").expect("a name");
    page.write(0, 0, "Strain (%)").expect("written").write(0, 1, "Force (gf/cm)").expect("written");
    for (row, [e, f]) in (1..).zip(points()) {
        page.write(row, 0, e).expect("written").write(row, 1, f).expect("written");
    }
    let bytes = book.save_to_buffer().expect("a workbook");
    let found = mistake(read_file("strip.xlsx", &bytes, "sheet = \"Tensile\""));
    assert_eq!(found.help.as_deref(), Some("sheets of the file: \"Zug\""));
    let sheet = read_file("strip.xlsx", &bytes, "sheet = \"Zug\"").expect("it is there");
    assert_points("the sheet of the file", &sheet);
}

#[test]
fn of_tables_without_a_load_the_largest_is_named_and_the_first_of_equals() {
    let table = |unit: &str, count: usize| {
        let rows: String = (0..count).map(|i| format!("{i},{}\n", 3 * i)).collect();
        format!("Strain (%),Stress ({unit})\n{rows}")
    };
    for (counts, line, unit) in [([5, 5], 1, "MPa"), ([5, 6], 7, "kPa"), ([6, 5], 1, "MPa")] {
        let text = table("MPa", counts[0]) + &table("kPa", counts[1]);
        let found = mistake(read(text.as_bytes(), ""));
        let help = found.help.as_deref().unwrap_or_default();
        let columns = format!("columns of the file: Strain (%), Stress ({unit})");
        assert!(help.ends_with(&columns), "{counts:?}: {help}");
        assert_eq!(found.line, Some(line), "{counts:?}");
    }
}

#[test]
fn cells_without_names_between_semicolons_are_no_fractions() {
    // The same cells between commas may be numbers with decimal commas, and are refused.
    let text = "Strain (%);Force (gf/cm)\n0;0;1\n1;50;2\n2;200;3\n";
    let sheet = read(text.as_bytes(), "").expect("the separator is no decimal sign");
    let curve = &sheet.curves[0];
    assert_eq!(curve.deformation(), [0.0, 0.01, 0.02]);
    assert!((curve.load()[2] - 200.0 * 0.980_665).abs() < 1e-12, "{:?}", curve.load());
    let found = mistake(read(text.replace(';', ",").as_bytes(), ""));
    assert!(found.message.contains("the comma is both"), "{found}");
}

#[test]
fn the_line_that_names_the_separator_is_no_title() {
    let table = format!("Strain (%);Force (gf/cm)\n{}", rows(|_, [e, f]| format!("{e:.6};{f:.6}")));
    let text = format!("sep=;\n{table}{table}");
    let found = mistake(read(text.as_bytes(), ""));
    assert_eq!(found.message, "2 tables could be the curve: 1 line 3, 2 line 45 (tensile warp)");
    assert_read("the first table", &text, "table = 1");
}
