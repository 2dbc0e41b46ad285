//! Reports to customers: what is on the page, the drapes that it takes, and its mistakes.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::{drape, fails, succeeds};

/// Row of the CSV by column.
type Row = BTreeMap<String, String>;

/// Returns the path of a shipped fabric.
fn shipped(name: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fabrics").join(name);
    folder.to_string_lossy().into_owned()
}

fn page(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).expect("a page")
}

fn rows(folder: &Path, name: &str) -> Vec<Row> {
    let mut reader = csv::Reader::from_path(folder.join(name)).expect("a table");
    let heads = reader.headers().expect("a head").clone();
    let row = |record: csv::StringRecord| {
        heads.iter().map(str::to_owned).zip(record.iter().map(str::to_owned)).collect()
    };
    reader.records().map(|record| row(record.expect("a row"))).collect()
}

/// Returns the row of a value of a fabric.
fn value<'a>(rows: &'a [Row], fabric: &str, item: &str, direction: &str) -> &'a Row {
    let is_it = |row: &&Row| {
        row["fabric"].starts_with(fabric)
            && row["part"] == "value"
            && row["item"] == item
            && row["direction"] == direction
    };
    rows.iter().find(is_it).unwrap_or_else(|| panic!("no {item} {direction} of {fabric}"))
}

fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} of {row:?}"))
}

/// Returns the pages' text without tags.
fn text(page: &str) -> String {
    let body = &page[page.find("<body>").expect("a body")..];
    let (mut text, mut is_tag) = (String::new(), false);
    for letter in body.chars() {
        match letter {
            '<' => is_tag = true,
            '>' => {
                is_tag = false;
                text.push(' ');
            }
            letter if !is_tag => text.push(letter),
            _ => {}
        }
    }
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn two_shipped_fabrics_stand_side_by_side_on_one_page() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let [a, b] = ["matsudaira-a", "matsudaira-b"].map(shipped);
    let arguments = [
        "report",
        &a,
        &b,
        "-o",
        "two.html",
        "--csv",
        "two.csv",
        "--customer",
        "Mill & Co",
        "--article",
        "A-1",
        "--article",
        "B-2",
        "--specimens",
        "3 of 20 cm × 20 cm",
    ];
    let said = succeeds(folder, &arguments);
    assert!(said.contains("report written to two.html"), "{said}");
    let page = page(folder, "two.html");
    assert!(page.len() < 3_000_000, "{} bytes", page.len());
    // One file: nothing is fetched.
    for outside in ["src=\"http", "href=\"http", "url(", "@import", "<link rel=\"stylesheet"] {
        assert!(!page.contains(outside), "{outside}");
    }
    let text = text(&page);
    for part in [
        "Customer Mill &#38; Co Mill &#38; Co",
        "Article A-1 B-2",
        "Specimens 3 of 20 cm × 20 cm 3 of 20 cm × 20 cm",
        "Date of the tests Laboratory Made from",
        "B warp bending rigidity gf·cm²/cm",
        "no published range",
        "ACM Transactions on Graphics 41(6), 2022",
        "moment, gf·cm/cm",
        "No drape was given",
        "Assumed, not measured",
    ] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
    let assumed = "shear stiffness: not measured, 28.1 N/(m·rad) taken";
    assert_eq!(text.matches(assumed).count(), 1, "an assumption of both is said once");
    assert!(!text.contains("shear, warp"), "an assumed law is not drawn as a loop");

    let rows = rows(folder, "two.csv");
    for (fabric, rigidity, width, mass) in
        [("Matsudaira A", 0.118, 0.124, 12.38), ("Matsudaira B", 0.067, 0.033, 16.29)]
    {
        for (item, expected) in [("B", rigidity), ("2HB", width)] {
            for direction in ["warp", "weft"] {
                let row = value(&rows, fabric, item, direction);
                assert_eq!(number(row, "measured"), expected, "{fabric} {item}");
                let law = number(row, "law");
                assert!((law / expected - 1.0).abs() < 1e-3, "{fabric} {item}: {law}");
            }
        }
        let row = value(&rows, fabric, "W", "");
        assert_eq!((number(row, "measured"), row["law"].as_str()), (mass, ""));
        assert_eq!([number(row, "from"), number(row, "to")], [4.1, 48.7]);
        let points = rows.iter().filter(|row| row["part"] == "loop");
        assert!(points.filter(|row| row["fabric"].starts_with(fabric)).count() > 100);
    }
}

#[test]
fn the_head_and_the_scatter_come_from_the_sheet_and_loops_have_their_fit() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let sheet = "name = \"twill, navy\"\ncustomer = \"Weberei Müller\"\nlaboratory = \"Lab 7\"\n\
                 date = 2026-03-14\nspecimens = 5\nW = 18\nT0 = \"0.62 ± 0.02\"\nRC = 52\n[warp]\n\
                 B = \"0.118 ± 0.006\"\n2HB = 0.05\n[weft]\nB = 0.09\n2HB = 0.04\nMIU = \"0.2 ± 0.01\"\n";
    std::fs::write(folder.join("twill.toml"), sheet).expect("a sheet");
    succeeds(folder, &["report", "twill.toml", "--csv", "twill.csv", "--date", "2026"]);
    let own = text(&page(folder, "report.html"));
    for part in [
        "Customer Weberei Müller Article Specimens 5 Date of the tests 2026 Laboratory Lab 7",
        "B warp bending rigidity gf·cm²/cm 0.1180 ± 0.0060",
        "T0 thickness at 0.5 gf/cm² mm 0.620 ± 0.020",
        "MIU weft surface friction 0.200 ± 0.010",
    ] {
        assert!(own.contains(part), "{part} is not in {own}");
    }
    let rows = rows(folder, "twill.csv");
    assert_eq!(number(value(&rows, "twill, navy", "T0", ""), "standard_deviation"), 0.02);
    assert_eq!(value(&rows, "twill, navy", "RC", "")["law"], "", "no law has RC");

    // Curves: the fit is judged, and a law that is read beyond its curve says so.
    succeeds(folder, &["report", &shipped("cupro-weave"), "-o", "cupro.html", "--csv", "c.csv"]);
    let cupro = text(&page(folder, "cupro.html"));
    assert!(cupro.contains("stretch 8 cm, warp · fit doubtful misfit"), "{cupro}");
    assert!(cupro.contains("the law is continued beyond what was measured"), "{cupro}");
    assert!(cupro.contains("tension, gf/cm"), "{cupro}");
    let rows = self::rows(folder, "c.csv");
    assert!(rows.iter().all(|row| row["item"] != "EM"), "its law is not known at 500 gf/cm");
    assert!(number(value(&rows, "cupro", "B", "warp"), "law") > 0.0);

    // Laws alone: no measured loops, and the page says so.
    succeeds(folder, &["fit", &shipped("cupro-weave"), "-o", "laws.toml"]);
    succeeds(folder, &["report", "laws.toml", "-o", "laws.html"]);
    let laws = text(&page(folder, "laws.html"));
    assert!(laws.contains("no measured loops and no measured values are at hand"), "{laws}");
}

#[test]
fn tables_are_reported_as_they_are_fitted() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let table = "fabric;B warp (gf.cm2/cm);B weft (gf.cm2/cm);W (mg/cm2);T (mm)\n\
                 poplin;0.118;0.1;12.4;0.5\ntwill;0.2;0.15;20;0.7\n";
    std::fs::write(folder.join("values.csv"), table).expect("a table");
    succeeds(folder, &["report", "values.csv", "-o", "all.html"]);
    let all = text(&page(folder, "all.html"));
    assert!(all.contains("poplin") && all.contains("twill"), "{all}");
    succeeds(folder, &["report", "values.csv", "--fabric", "twill", "-o", "one.html"]);
    let one = text(&page(folder, "one.html"));
    assert!(!one.contains("poplin") && one.contains("0.2000"), "{one}");
}

/// Arguments of a drape that takes a second: the particles are far apart, which the page says.
const COARSE: [&str; 5] = ["--drape", "--starts", "2", "--spacing", "30"];

#[test]
fn drapes_are_written_by_test_and_taken_by_report() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let b = shipped("matsudaira-b");
    let mut arguments = vec!["test", &b, "--report", "drapes"];
    arguments.extend(COARSE);
    let output = drape(folder, &arguments);
    let [said, noted] = [&output.stdout, &output.stderr].map(|own| String::from_utf8_lossy(own));
    assert!(output.status.success(), "{noted}");
    assert!(said.contains("results written to drapes/matsudaira-b-drape.json"), "{said}");
    assert!(noted.contains("17 specimens, about"), "{noted}");
    for file in ["matsudaira-b-drape.png", "matsudaira-b-drape-shadow.svg"] {
        assert!(folder.join("drapes").join(file).exists(), "{file}");
    }
    let stored = std::fs::read_to_string(folder.join("drapes/matsudaira-b-drape.json"));
    let stored: Value = serde_json::from_str(&stored.expect("a result")).expect("JSON");
    let fitted = &stored["evaluations"][0];
    let coefficient = 100.0 * fitted["coefficient"].as_f64().expect("a number");

    succeeds(folder, &["report", &b, "--drapes", "drapes", "-o", "b.html", "--csv", "b.csv"]);
    let own = page(folder, "b.html");
    assert!(own.contains("data:image/png;base64,") && own.contains("class=\"plot shadow\""));
    assert!(own.len() < 3_000_000, "{} bytes", own.len());
    let own = text(&own);
    assert!(own.contains(&format!("drape coefficient {coefficient:.1} ±")), "{own}");
    assert!(own.contains("nine of ten fabrics with the same sheet"), "{own}");
    assert!(own.contains("so the coefficient is not reliable"), "{own}");
    let rows = rows(folder, "b.csv");
    let row = rows.iter().find(|row| row["item"] == "drape coefficient").expect("a drape");
    assert!((number(row, "law") - coefficient).abs() < 1e-6);
    let [low, high] = ["from", "to"].map(|end| number(row, end));
    assert!(low < coefficient && coefficient < high, "{low} {coefficient} {high}");

    // Of other laws it is left out, and both page and console say so.
    let changed = std::fs::read_to_string(Path::new(&b).join("sheet.toml")).expect("a sheet");
    std::fs::write(folder.join("b.toml"), changed.replace("0.067", "0.080")).expect("a sheet");
    let output = drape(folder, &["report", "b.toml", "--drapes", "drapes", "-o", "c.html"]);
    let noted = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(noted.contains("with other laws than those of this report"), "{noted}");
    let own = text(&page(folder, "c.html"));
    assert!(own.contains("a drape was given, but of other laws than these"), "{own}");
    assert!(!own.contains("drape coefficient"), "{own}");

    // Run by the report, it is the same, and kept.
    let mut arguments = vec!["report", &b, "--drapes", "new", "-o", "d.html", "--csv", "d.csv"];
    arguments.extend(COARSE);
    succeeds(folder, &arguments);
    assert!(folder.join("new/matsudaira-b-drape.json").exists());
    assert_eq!(page(folder, "d.csv"), page(folder, "b.csv"));
}

#[test]
fn mistakes_of_a_report_say_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let [a, b] = ["matsudaira-a", "matsudaira-b"].map(shipped);
    std::fs::create_dir(folder.join("empty")).expect("a folder");
    std::fs::write(folder.join("x-drape.json"), "{}").expect("a file");
    std::fs::write(folder.join("bad.toml"), "name = \"a\"\nW = 12\ndate = \"14.03.2026\"\n")
        .expect("a sheet");
    let cases: [(&[&str], i32, &[&str]); 12] = [
        (&[&a, "-o", "report.pdf"], 2, &["a page of HTML", "print it to PDF"]),
        (&[&a, "--csv", "numbers.xlsx"], 2, &["write report.csv"]),
        (&[&a, "-o", "-", "--json"], 2, &["give one of them"]),
        (&[&a, &b, "--article", "4711"], 2, &["--article is given 1 times for 2 fabrics"]),
        (&[&a, "--date", "14.03.2026"], 2, &["--date: 14.03.2026: is not a date", "2026-03-14"]),
        (&[&a, "--specimens", "0"], 2, &["is not a number of specimens"]),
        (&[&a, "--customer", " "], 2, &["--customer", "is empty"]),
        (&[&a, "--fabric", "twill"], 2, &["takes one of several in tables"]),
        (&[&a, "--starts", "3"], 2, &["--drape"]),
        (&[&a, "--drapes", "empty"], 3, &["empty: holds no results of drapes", "drape test"]),
        (&[&a, "--drapes", "x-drape.json"], 3, &["is no result of drape test --drape"]),
        (&["bad.toml"], 3, &["date: is not a date", "2026-03-14"]),
    ];
    for (arguments, code, parts) in cases {
        let arguments: Vec<&str> = ["report"].iter().chain(arguments).copied().collect();
        let message = fails(folder, &arguments, code);
        for part in parts {
            assert!(message.contains(part), "{arguments:?}: {part} is not in {message}");
        }
    }
    let missing = fails(folder, &["report", "nowhere.toml"], 3);
    assert!(missing.contains("nowhere.toml"), "{missing}");
    let drapes = fails(folder, &["report", &a, "--drapes", "nowhere"], 3);
    assert!(drapes.contains("nowhere") && drapes.contains("drape test"), "{drapes}");
    assert!(!folder.join("report.html").exists(), "nothing is written after a mistake");
}
