//! Exports of instruments and laboratories, written here from one known curve, and read back.
//!
//! Each has the layout of a program's own export, as its manual or its users describe it; the
//! numbers are the curve's, so what is read can be compared point by point.

use std::io::Write as _;
use std::path::Path;

use drape_input::{Diagnostic, Diagnostics};
use drape_kes::{Curve, Error, Sheet};

/// Free length of the strip, in mm.
const GAUGE: f64 = 50.0;
/// Width of the strip, in mm.
const WIDTH: f64 = 200.0;
/// Gram-force per centimetre, in N/m.
const GF_PER_CM: f64 = 0.980_665;

/// Point of the curve: strain as a ratio, load in N/m.
#[derive(Clone, Copy)]
struct Point {
    strain: f64,
    load: f64,
}

/// Strip stretched to 4 % and 480 gf/cm and released, in numbers with few digits.
fn curve() -> Vec<Point> {
    let up = (0..=20).map(|i| f64::from(i) * 0.2).map(|e| (e, 30.0 * e * e));
    let down = (0..20).rev().map(|i| f64::from(i) * 0.2).map(|e| (e, 7.0 * e * e * e));
    let point = |(percent, gf): (f64, f64)| Point { strain: percent / 100.0, load: gf * GF_PER_CM };
    up.chain(down).map(point).collect()
}

impl Point {
    fn percent(self) -> f64 {
        100.0 * self.strain
    }
    fn millimetres(self) -> f64 {
        GAUGE * self.strain
    }
    fn gf_per_cm(self) -> f64 {
        self.load / GF_PER_CM
    }
    /// Force of the whole strip, in N.
    fn newtons(self) -> f64 {
        self.load * WIDTH / 1000.0
    }
    fn time(self, index: usize) -> f64 {
        self.strain * 0.0 + 0.25 * index as f64
    }
}

/// Writes a row of the curve for every point.
fn rows(row: impl Fn(usize, Point) -> String) -> String {
    curve().into_iter().enumerate().map(|(index, point)| row(index, point) + "\n").collect()
}

/// Number with a decimal comma.
fn comma(number: f64) -> String {
    format!("{number:.9}").replace('.', ",")
}

/// Sheet of a strip along the warp, with further keys of its curve.
fn sheet(file: &str, keys: &str) -> String {
    format!(
        "name = \"strip\"\n[[curve]]\ntest = \"tensile\"\ndirection = \"warp\"\nfile = \"{file}\"\n{keys}\n"
    )
}

fn read(file: &str, bytes: &[u8], keys: &str) -> Result<Sheet, Error> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join(file), bytes).expect("written");
    std::fs::write(folder.path().join("sheet.toml"), sheet(file, keys)).expect("written");
    Sheet::read(folder.path())
}

/// Reads an export and holds it against the curve; returns what it was taken for.
fn assert_read(file: &str, bytes: &[u8], keys: &str) -> String {
    let sheet = read(file, bytes, keys).unwrap_or_else(|error| panic!("{file}: {error}"));
    assert_eq!(sheet.warnings(), [], "{file}");
    assert_eq!(sheet.curves.len(), 1, "{file}");
    assert_same(file, &sheet.curves[0], 1.0);
    sheet.readings()[0].clone()
}

/// Holds a curve against the known one, its loads times a factor.
fn assert_same(file: &str, found: &Curve, factor: f64) {
    let wanted = curve();
    assert_eq!(found.load().len(), wanted.len(), "{file}");
    for (index, point) in wanted.into_iter().enumerate() {
        let (strain, load) = (found.deformation()[index], found.load()[index]);
        let off = (strain - point.strain).abs() > 1e-8 || (load - factor * point.load).abs() > 1e-5;
        assert!(
            !off,
            "{file}, point {index}: {strain} and {load}, not {} and {}",
            point.strain, point.load
        );
    }
}

fn shift_jis(text: &str) -> Vec<u8> {
    encoding_rs::SHIFT_JIS.encode(text).0.into_owned()
}

fn windows_1252(text: &str) -> Vec<u8> {
    encoding_rs::WINDOWS_1252.encode(text).0.into_owned()
}

fn utf_16(text: &str) -> Vec<u8> {
    "\u{feff}"
        .chars()
        .chain(text.chars())
        .collect::<String>()
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect()
}

#[test]
fn kes_fb1_of_the_kato_tech_program() {
    // Kato Tech KES-FB1-A, "tensile and shear tester": test conditions above, Japanese Windows.
    let text = format!(
        "KES-FB1 引張り試験\n試料名,cotton broad\n試料幅,20,cm\n最大荷重,500,gf/cm\n\n伸び率(%),荷重(gf/cm)\n{}",
        rows(|_, p| format!("{:.6},{:.6}", p.percent(), p.gf_per_cm()))
    );
    let reading = assert_read("FB1T.csv", &shift_jis(&text), "");
    assert!(reading.contains("Shift_JIS") && reading.contains("header on line 6"), "{reading}");
}

#[test]
fn kes_fb_auto_with_a_test_a_sheet() {
    // KES-FB-AUTO-A writes workbooks; laboratories keep a sheet for each test and direction.
    let mut book = rust_xlsxwriter::Workbook::new();
    for (name, factor) in [("Tensile WARP", 1.0), ("Tensile WEFT", 1.5), ("Bending WARP", 0.0)] {
        let sheet = book.add_worksheet().set_name(name).expect("a name");
        sheet.write(0, 0, "KES-FB-AUTO-A").expect("written");
        let units = if factor > 0.0 {
            ["Strain (%)", "Force (gf/cm)"]
        } else {
            ["Curvature (1/cm)", "Moment (gf.cm/cm)"]
        };
        units.iter().enumerate().for_each(|(column, unit)| {
            sheet.write(2, column as u16, *unit).expect("written");
        });
        for (row, point) in curve().into_iter().enumerate() {
            sheet.write(row as u32 + 3, 0, point.percent()).expect("written");
            sheet.write(row as u32 + 3, 1, factor * point.gf_per_cm()).expect("written");
        }
    }
    let bytes = book.save_to_buffer().expect("a workbook");
    let reading = assert_read("auto.xlsx", &bytes, "");
    assert!(reading.contains("sheet \"Tensile WARP\""), "{reading}");
    let weft = read("auto.xlsx", &bytes, "sheet = \"tensile weft\"").expect("declared");
    assert_same("weft", &weft.curves[0], 1.5);
}

#[test]
fn bluehill_raw_data_below_its_table_of_results() {
    // Instron Bluehill 3 and Universal, "Raw data" export: results, then names and units in quotes.
    let text = format!(
        "\"Results Table 1\"\n,\"Maximum Load\",\"Tensile extension at Maximum Load\"\n,\"(N)\",\"(mm)\"\n1,\"94.144\",\"2.000\"\n\n\
         \"Time\",\"Extension\",\"Load\"\n\"(s)\",\"(mm)\",\"(N)\"\n{}",
        rows(|i, p| format!(
            "\"{:.3}\",\"{:.7}\",\"{:.7}\"",
            p.time(i),
            p.millimetres(),
            p.newtons()
        ))
    );
    let keys = "deformation = { gauge = \"50 mm\" }\nload = { width = \"200 mm\" }";
    let reading = assert_read("Specimen_RawData_1.csv", text.as_bytes(), keys);
    assert!(reading.contains("an extension"), "{reading}");
}

#[test]
fn bluehill_states_gauge_and_width_itself() {
    // The parameters of the test stand above as "name : value unit".
    let text = format!(
        "\"Width : 200 mm\"\n\"Gauge length : 50 mm\"\n\n\"Time (s)\",\"Tensile extension (mm)\",\"Load (N)\",\"Tensile stress (MPa)\"\n{}",
        rows(|i, p| format!(
            "{:.3},{:.7},{:.7},{:.3}",
            p.time(i),
            p.millimetres(),
            p.newtons(),
            3.0 * p.load
        ))
    );
    let reading = assert_read("test.is_tens.csv", text.as_bytes(), "");
    assert!(reading.contains("\"Gauge length\" on line 2"), "{reading}");
}

#[test]
fn test_xpert_in_german() {
    // ZwickRoell testXpert II/III, ASCII export: tabs, decimal comma, Windows-1252, CRLF.
    let text = format!(
        "Prüfprotokoll\r\nPrüfer\tMüller\r\nEinspannlänge\t50\tmm\r\nProbenbreite\t200\tmm\r\nPrüfzeit\tStandardweg\tStandardkraft\r\ns\tmm\tN\r\n{}",
        rows(|i, p| format!(
            "{}\t{}\t{}\t",
            comma(p.time(i)),
            comma(p.millimetres()),
            comma(p.newtons())
        ))
        .replace('\n', "\r\n")
    );
    let reading = assert_read("Probe.TRA", &windows_1252(&text), "");
    for words in ["windows-1252", "tabs", "decimal comma", "units on line 6"] {
        assert!(reading.contains(words), "{words}: {reading}");
    }
}

#[test]
fn test_xpert_with_the_position_of_the_crosshead() {
    // testXpert III in English, semicolons; the position counts from the home of the crosshead.
    let text = format!(
        "\"Test time [s]\";\"Crosshead absolute [mm]\";\"Standard force [N]\"\n{}",
        rows(|i, p| format!(
            "{};{};{}",
            comma(p.time(i)),
            comma(312.5 + p.millimetres()),
            comma(p.newtons())
        ))
    );
    let keys = "deformation = { gauge = \"50 mm\" }\nload = { width = \"200 mm\" }";
    let reading = assert_read("xpert.csv", text.as_bytes(), keys);
    assert!(reading.contains("a position of a clamp"), "{reading}");
}

#[test]
fn mts_test_suite_with_blanks_between() {
    // MTS TestSuite / TestWorks, "Data Acquisition: Timed": names, units, columns of fixed width.
    let text = format!(
        "MTS793|MPT|ENU|1|2\nData Acquisition: Timed\n\n     Crosshead          Load          Time\n            mm             N             s\n{}",
        rows(|i, p| format!("{:>14.7E}{:>14.7E}{:>14.4}", p.millimetres(), p.newtons(), p.time(i)))
    );
    let keys =
        "deformation = { gauge = \"50 mm\", zero = \"extension\" }\nload = { width = \"20 cm\" }";
    assert_read("specimen.dat", text.as_bytes(), keys);
}

#[test]
fn trapezium_of_shimadzu() {
    // Shimadzu TRAPEZIUM X, CSV in Shift_JIS: names, units, everything in quotes.
    let text = format!(
        "\"試験名\",\"引張\"\n\"時間\",\"試験力\",\"ストローク\"\n\"sec\",\"N\",\"mm\"\n{}",
        rows(|i, p| format!(
            "\"{:.3}\",\"{:.7}\",\"{:.7}\"",
            p.time(i),
            p.newtons(),
            p.millimetres()
        ))
    );
    let keys = "deformation = { gauge = \"50 mm\" }\nload = { width = \"200 mm\" }";
    assert_read("trapezium.csv", &shift_jis(&text), keys);
}

#[test]
fn fast_3_as_a_table_of_load_and_extension() {
    // CSIRO FAST-3 gives the extension at given loads: the load stands first.
    let text = format!(
        "FAST-3 extensibility|\nLoad (gf/cm)|Extension (%)|\n{}",
        rows(|_, p| format!("{:.6}|{:.6}|", p.gf_per_cm(), p.percent()))
    );
    let reading = assert_read("fast3.txt", text.as_bytes(), "");
    assert!(reading.contains("bars between the cells"), "{reading}");
}

#[test]
fn french_laboratory_with_groups_of_thousands() {
    let text = format!(
        "sep=;\nDéformation (%);Force (mN/m)\n{}",
        rows(|_, p| {
            let milli = 1000.0 * p.load;
            let (whole, fraction) = (milli.trunc() as i64, ((milli.fract()) * 1e6).round());
            let grouped = if whole >= 1000 {
                format!("{} {:03}", whole / 1000, whole % 1000)
            } else {
                whole.to_string()
            };
            format!("{};{grouped},{fraction:06}", comma(p.percent()))
        })
    );
    assert_read("essai.csv", &windows_1252(&text), "");
}

#[test]
fn old_kes_program_in_utf_16_with_percent_in_the_cells() {
    let text = format!(
        "strain force\n{}mean 2.5\n",
        rows(|_, p| format!("{:.6}% {:.6}", p.percent(), p.gf_per_cm()))
    );
    assert_read("notepad.txt", &utf_16(&text), "load = { unit = \"gf/cm\" }");
}

#[test]
fn kilogram_forces_of_a_whole_strip_by_number() {
    let kgf = |p: Point| p.newtons() / 9.80665;
    let text = rows(|_, p| format!("{:.9}\t{:.9}", kgf(p), p.millimetres()));
    let keys = "deformation = { column = 2, unit = \"mm\", gauge = \"5 cm\" }\n\
                load = { column = 1, unit = \"kgf\", width = \"20 cm\" }";
    assert_read("log.txt", text.as_bytes(), keys);
}

/// Repeats of the curve with 10 % less and more load, side by side.
fn side_by_side(group: [&str; 3]) -> String {
    let [a, b, c] = group;
    format!(
        "{a};;{b};;{c};\nStrain (%);Force (gf/cm);Strain (%);Force (gf/cm);Strain (%);Force (gf/cm)\n{}",
        rows(|_, p| {
            let pair =
                |factor: f64| format!("{};{}", comma(p.percent()), comma(factor * p.gf_per_cm()));
            [0.9, 1.0, 1.1].map(pair).join(";")
        })
    )
}

#[test]
fn repeats_side_by_side_have_mean_and_scatter() {
    let text = side_by_side(["Specimen 1", "Specimen 2", "Specimen 3"]);
    let sheet = read("repeats.csv", text.as_bytes(), "").expect("three repeats");
    let curve = &sheet.curves[0];
    assert_same("the mean", curve, 1.0);
    assert_eq!(curve.repeats().len(), 3);
    let largest = curve.load_range().high;
    assert!((curve.scatter()[20] / largest - 0.1).abs() < 1e-6, "{:?}", curve.scatter());
    assert!(sheet.readings()[0].contains("3 repeats: Specimen 1"), "{:?}", sheet.readings());
    // Those that the sheet names, and those of the direction.
    let two = read("repeats.csv", text.as_bytes(), "table = [1, 3]").expect("two repeats");
    assert_eq!(two.curves[0].repeats().len(), 2);
    let text = side_by_side(["Warp 1", "Warp 2", "Weft 1"]);
    let warp = read("repeats.csv", text.as_bytes(), "").expect("two repeats");
    assert_same("warp", &warp.curves[0], 0.95);
}

#[test]
fn repeats_below_each_other_and_in_a_column_and_in_files() {
    let table =
        |factor: f64| rows(|_, p| format!("{:.6},{:.6}", p.percent(), factor * p.gf_per_cm()));
    let block = |n: u32, factor: f64| {
        format!("Specimen {n}\nStrain (%),Force (gf/cm)\n{}\n", table(factor))
    };
    let text = block(1, 0.9) + &block(2, 1.1);
    let below = read("below.csv", text.as_bytes(), "").expect("two repeats");
    assert_same("below", &below.curves[0], 1.0);
    let column = |n: u32, factor: f64| {
        rows(|_, p| format!("{n},{:.6},{:.6}", p.percent(), factor * p.gf_per_cm()))
    };
    let text = format!("Specimen,Strain (%),Force (gf/cm)\n{}{}", column(1, 0.9), column(2, 1.1));
    let column = read("column.csv", text.as_bytes(), "").expect("two repeats");
    assert_same("column", &column.curves[0], 1.0);
    let second = read("column.csv", text.as_bytes(), "specimen = 2").expect("one of them");
    assert_same("the second", &second.curves[0], 1.1);
    let folder = tempfile::tempdir().expect("a folder");
    for (name, factor) in [("a.csv", 0.9), ("b.csv", 1.1)] {
        let text = format!("Strain (%),Force (gf/cm)\n{}", table(factor));
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    let text = sheet("a.csv", "").replace("\"a.csv\"", "[\"a.csv\", \"b.csv\"]");
    std::fs::write(folder.path().join("sheet.toml"), text).expect("written");
    let files = Sheet::read(folder.path()).expect("two files");
    assert_same("files", &files.curves[0], 1.0);
}

#[test]
fn cycles_are_one_history_or_those_that_are_named() {
    let cycle =
        |n: u32| rows(|_, p| format!("{n};{};{}", comma(p.percent()), comma(p.gf_per_cm())));
    let text = format!("Zyklus;Dehnung (%);Kraft (gf/cm)\n{}{}", cycle(1), cycle(2));
    let both = read("cycles.csv", text.as_bytes(), "").expect("a history");
    assert_eq!(both.curves[0].branches().len(), 4);
    let first = read("cycles.csv", text.as_bytes(), "cycle = 1").expect("one cycle");
    assert_same("the first cycle", &first.curves[0], 1.0);
}

#[test]
fn loading_and_recovery_side_by_side_are_one_history() {
    // The recovery from its end at zero up, as plotting programs want it.
    let there: Vec<Point> = curve().into_iter().take(21).collect();
    let back: Vec<Point> = curve().into_iter().skip(21).rev().collect();
    let row = |(index, p): (usize, &Point)| {
        let of_back = back
            .get(index)
            .map_or(";".into(), |p| format!("{};{}", comma(p.percent()), comma(p.gf_per_cm())));
        format!("{};{};{of_back}\n", comma(p.percent()), comma(p.gf_per_cm()))
    };
    let text = format!(
        "Loading;;Recovery;\nStrain (%);Force (gf/cm);Strain (%);Force (gf/cm)\n{}",
        there.iter().enumerate().map(row).collect::<String>()
    );
    let reading = assert_read("parts.csv", text.as_bytes(), "");
    assert!(reading.contains("turned around"), "{reading}");
}

#[test]
fn columns_without_a_header_are_named_by_their_numbers() {
    let text = rows(|_, p| format!("{:.6},{:.6}", p.percent(), p.gf_per_cm()));
    let found = mistake("plain.csv", text.as_bytes(), "");
    let columns = "columns of the file: 1, 2";
    let words = ["deformation = { column = 1", "load = { column = 2", columns];
    says(&found, "plain.csv", Some(1), &words);
    let keys =
        "deformation = { column = 1, unit = \"%\" }\nload = { column = 2, unit = \"gf/cm\" }";
    assert_read("plain.csv", text.as_bytes(), keys);
}

/// Writes an OpenDocument spreadsheet of one sheet with the cells of some rows.
fn ods(name: &str, rows: &[Vec<String>]) -> Vec<u8> {
    let cell = |cell: &String| match cell.parse::<f64>() {
        Ok(number) => format!(
            "<table:table-cell office:value-type=\"float\" office:value=\"{number}\"><text:p>{number}</text:p></table:table-cell>"
        ),
        Err(_) => format!(
            "<table:table-cell office:value-type=\"string\"><text:p>{cell}</text:p></table:table-cell>"
        ),
    };
    let row = |row: &Vec<String>| {
        format!("<table:table-row>{}</table:table-row>", row.iter().map(cell).collect::<String>())
    };
    let body: String = rows.iter().map(row).collect();
    let content = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><office:document-content \
         xmlns:office=\"urn:oasis:names:tc:opendocument:xmlns:office:1.0\" \
         xmlns:table=\"urn:oasis:names:tc:opendocument:xmlns:table:1.0\" \
         xmlns:text=\"urn:oasis:names:tc:opendocument:xmlns:text:1.0\" office:version=\"1.2\">\
         <office:body><office:spreadsheet><table:table table:name=\"{name}\">{body}</table:table>\
         </office:spreadsheet></office:body></office:document-content>"
    );
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    for (file, text) in [
        ("mimetype", "application/vnd.oasis.opendocument.spreadsheet"),
        (
            "META-INF/manifest.xml",
            "<?xml version=\"1.0\"?><manifest:manifest xmlns:manifest=\"urn:oasis:names:tc:opendocument:xmlns:manifest:1.0\"/>",
        ),
        ("content.xml", content.as_str()),
    ] {
        zip.start_file(file, options).expect("a file");
        zip.write_all(text.as_bytes()).expect("written");
    }
    zip.finish().expect("a zip file").into_inner()
}

#[test]
fn open_document_of_a_laboratory() {
    let mut table =
        vec![vec!["cotton broad".to_owned()], vec!["Width".into(), "20".into(), "cm".into()]];
    table.push(vec!["Elongation (%)".into(), "Load (N)".into()]);
    let point = |p: Point| vec![format!("{:.9}", p.percent()), format!("{:.9}", p.newtons())];
    table.extend(curve().into_iter().map(point));
    let reading = assert_read("lab.ods", &ods("strip", &table), "");
    assert!(reading.contains("\"Width\" on line 2"), "{reading}");
}

/// Returns the one mistake of an export, which names its file and its remedy.
fn mistake(file: &str, bytes: &[u8], keys: &str) -> Diagnostic {
    match read(file, bytes, keys) {
        Err(Error::Input(Diagnostics(mut found))) if found.len() == 1 => {
            assert!(found[0].help.is_some(), "{:?}", found[0]);
            found.remove(0)
        }
        other => panic!("{file}: not one mistake but {other:?}"),
    }
}

fn says(found: &Diagnostic, file: &str, line: Option<usize>, words: &[&str]) {
    let text = found.to_string();
    assert_eq!((found.file.file_name(), found.line), (Path::new(file).file_name(), line), "{text}");
    words.iter().for_each(|word| assert!(text.contains(word), "{word:?} is missing in: {text}"));
}

#[test]
fn two_cells_of_load_are_answered_with_the_key_that_decides() {
    let text = format!(
        "Strain (%),Load cell A (gf/cm),Load cell B (gf/cm)\n{}",
        rows(|_, p| format!("{:.6},{:.6},{:.6}", p.percent(), p.gf_per_cm(), 0.5 * p.gf_per_cm()))
    );
    let found = mistake("two.csv", text.as_bytes(), "");
    says(
        &found,
        "two.csv",
        Some(1),
        &[
            "\"Load cell A\" and \"Load cell B\" could each be the load",
            "load = { column = \"Load cell A\" }",
        ],
    );
    assert_read("two.csv", text.as_bytes(), "load = { column = \"Load cell A\" }");
}

#[test]
fn a_comma_that_may_be_either_is_not_guessed() {
    // Whole gf/cm in groups, strains in whole numbers: 1,200 may be 1.2 or 1200.
    let text = "Strain (%);Force (mN/m)\n0;0\n1;1,200\n2;4,800\n3;9,900\n";
    let found = mistake("group.csv", text.as_bytes(), "");
    says(&found, "group.csv", Some(3), &["\"1,200\" may be 1.200 or 1200", "decimal = "]);
    let point = read("group.csv", text.as_bytes(), "decimal = \".\"").expect("declared");
    assert!((point.curves[0].load()[3] - 9.9).abs() < 1e-12);
    let comma = read("group.csv", text.as_bytes(), "decimal = \",\"\nload = { unit = \"N/m\" }");
    assert!((comma.expect("declared").curves[0].load()[3] - 9.9).abs() < 1e-12);
}

#[test]
fn a_comma_that_is_both_sign_and_separator_is_refused() {
    let text = "Strain (%),Force (gf/cm)\n0,0\n0,5,7,5\n1,0,30,25\n";
    let found = mistake("both.csv", text.as_bytes(), "");
    says(&found, "both.csv", Some(2), &["2 names stand above up to 4 cells", "semicolons"]);
    let mended = "Strain (%);Force (gf/cm)\n0;0\n0,5;7,5\n1,0;30,25\n";
    assert!(read("both.csv", mended.as_bytes(), "").is_ok());
}

#[test]
fn tables_without_titles_are_listed() {
    let table = |factor: f64| {
        format!(
            "Strain (%),Force (gf/cm)\n{}",
            rows(|_, p| format!("{:.6},{:.6}", p.percent(), factor * p.gf_per_cm()))
        )
    };
    let text = table(1.0) + &table(1.4);
    let found = mistake("many.csv", text.as_bytes(), "");
    says(
        &found,
        "many.csv",
        Some(2),
        &["2 tables could be the curve", "table = 1", "table = \"all\""],
    );
    assert_read("many.csv", text.as_bytes(), "table = 1");
    let all = read("many.csv", text.as_bytes(), "table = \"all\"").expect("repeats");
    assert_same("all", &all.curves[0], 1.2);
}

#[test]
fn an_extension_that_begins_at_the_gauge_is_no_extension() {
    let text = format!(
        "Extension (mm),Load (N)\n{}",
        rows(|_, p| format!("{:.7},{:.7}", GAUGE + p.millimetres(), p.newtons()))
    );
    let keys = "deformation = { gauge = \"50 mm\" }\nload = { width = \"200 mm\" }";
    let found = mistake("gauge.csv", text.as_bytes(), keys);
    says(&found, "sheet.toml", Some(6), &["begins at 1.000 of the gauge", "zero = \"extension\""]);
    let keys =
        "deformation = { gauge = \"50 mm\", zero = \"distance\" }\nload = { width = \"200 mm\" }";
    assert_read("gauge.csv", text.as_bytes(), keys);
}

#[test]
fn a_load_in_a_unit_of_stress_or_without_width_is_answered() {
    let text = format!(
        "Strain (%),Stress (MPa)\n{}",
        rows(|_, p| format!("{:.6},{:.6}", p.percent(), p.load))
    );
    let found = mistake("stress.csv", text.as_bytes(), "");
    says(&found, "stress.csv", Some(1), &["no column is a load by its heading", "Stress (MPa)"]);
    assert_read("stress.csv", text.as_bytes(), "load = { column = 2, unit = \"N/m\" }");
    let text = format!(
        "Strain (%),Load (N)\n{}",
        rows(|_, p| format!("{:.6},{:.7}", p.percent(), p.newtons()))
    );
    let found = mistake("width.csv", text.as_bytes(), "");
    says(&found, "sheet.toml", Some(2), &["a load in N needs it", "width = \"20 cm\""]);
    assert_read("width.csv", text.as_bytes(), "load = { width = \"20 cm\" }");
}

#[test]
fn points_and_commas_in_one_column_are_refused_with_both_lines() {
    let text = "Strain (%);Force (gf/cm)\n0;0\n0,5;7.5\n1,0;30\n";
    let found = mistake("mixed.csv", text.as_bytes(), "");
    says(&found, "mixed.csv", Some(3), &["\"7.5\" on line 3", "\"0,5\" on line 3"]);
}

#[test]
fn a_good_extension_is_not_turned() {
    // Lengthening in mm from zero was once read as a distance, and its strains of −100 % turned.
    let text = format!(
        "e (mm),F (N)\n{}",
        rows(|_, p| format!("{:.7},{:.7}", p.millimetres(), p.newtons()))
    );
    let keys = "deformation = { column = 1, gauge = \"50 mm\" }\nload = { column = 2, width = \"200 mm\" }";
    assert_read("plain.csv", text.as_bytes(), keys);
}
