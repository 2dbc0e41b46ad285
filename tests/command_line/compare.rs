//! Fabrics compared: what was measured, the laws beside it, the differences.

use std::path::Path;

use serde_json::Value;
use tempfile::TempDir;

use crate::{drape, fails, succeeds};

/// Returns a folder with sheets of these values, each in a folder of its own.
fn sheets(texts: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in texts {
        std::fs::create_dir(folder.path().join(name)).expect("a folder");
        let text = format!("name = \"{name}\"\nW = 12\nT0 = 0.5\n{text}");
        std::fs::write(folder.path().join(name).join("sheet.toml"), text).expect("a sheet");
    }
    folder
}

/// Returns the cells of the row of a value, behind its unit.
fn row(text: &str, symbol: &str, direction: &str) -> Vec<String> {
    let is_row = |line: &&str| line.split_whitespace().take(2).eq([symbol, direction]);
    let line = text.lines().find(is_row).unwrap_or_else(|| panic!("no {symbol} in {text}"));
    let cells = line.split("  ").map(str::trim).filter(|cell| !cell.is_empty());
    cells.skip(4).map(str::to_owned).collect()
}

#[test]
fn measured_values_stand_with_their_scatter_beside_the_laws() {
    let folder = sheets(&[
        ("a", "[warp]\nB = \"0.100 ± 0.005\"\n2HB = 0.05\n[weft]\nB = 0.1\n"),
        ("b", "[warp]\nB = \"0.108 ± 0.005\"\n2HB = 0.1\n[weft]\nB = 0.1\n"),
        ("c", "[warp]\nB = \"0.140 ± 0.005\"\nG = 0.6\n[weft]\nB = 0.13\n"),
    ]);
    let folder = folder.path();
    let text = succeeds(folder, &["fabric", "compare", "a", "b", "c"]);
    // 0.008 is 1.13 of the standard deviation of the difference, 0.0071; 0.04 is 5.7 of them.
    assert_eq!(
        row(&text, "B", "warp"),
        [
            "0.1000 ± 0.0050",
            "0.1000",
            "0.1080 ± 0.0050",
            "0.1080",
            "+8.00 %",
            "≈",
            "0.1400 ± 0.0050",
            "0.1400",
            "+40.0 %",
            "!"
        ]
    );
    assert_eq!(
        row(&text, "2HB", "warp")[..5],
        ["0.05000", "0.05000", "0.1000", "0.1000", "+100 %"]
    );
    // Measured on the last alone: the others' laws are assumed, and no difference is told.
    let shear = row(&text, "G", "warp");
    assert_eq!((shear.len(), shear[2].as_str()), (4, "0.6000"), "{shear:?}");
    assert!(shear[0].starts_with('(') && shear[1].starts_with('('), "{shear:?}");
    assert!(text.contains("in brackets: assumed, not measured"), "{text}");
    assert!(text.contains("- a, b: shear stiffness: not measured"), "{text}");

    let page: Value =
        serde_json::from_str(&succeeds(folder, &["fabric", "compare", "a", "b", "c", "--json"]))
            .expect("JSON");
    assert_eq!(page["fabrics"].as_array().map(Vec::len), Some(3));
    let values = page["values"].as_array().expect("values");
    let is_rigidity = |value: &&Value| value["symbol"] == "B" && value["direction"] == "warp";
    let rigidity = values.iter().find(is_rigidity).expect("B");
    let measured = rigidity["numbers"][1]["measured"].as_f64().expect("a number");
    assert!((measured / (0.108 * 9.80665e-5) - 1.0).abs() < 1e-12, "{measured}");
    assert_eq!(rigidity["differences"][1]["is_within_scatter"], true);

    succeeds(folder, &["fabric", "compare", "a", "b", "c", "--report", "pages"]);
    assert!(folder.join("pages/a-and-b-and-c.html").exists());
}

#[test]
fn a_fabric_is_compared_with_the_sheet_beside_it_while_that_is_as_it_was() {
    let folder = sheets(&[("a", "[warp]\nB = 0.1\n"), ("b", "[warp]\nB = 0.2\n")]);
    let folder = folder.path();
    succeeds(folder, &["fit", "a", "b"]);
    let arguments = ["fabric", "compare", "a/fabric.toml", "b/fabric.toml"];
    let text = succeeds(folder, &arguments);
    assert_eq!(row(&text, "B", "warp"), ["0.1000", "0.1000", "0.2000", "0.2000", "+100 %", "!"]);

    let sheet = folder.join("b/sheet.toml");
    let changed = std::fs::read_to_string(&sheet).expect("a sheet").replace("0.2", "0.3");
    std::fs::write(&sheet, changed).expect("a sheet");
    let output = drape(folder, &arguments);
    let (said, text) =
        (String::from_utf8_lossy(&output.stderr), String::from_utf8_lossy(&output.stdout));
    assert!(
        said.contains("b/sheet.toml has changed since b/fabric.toml was fitted to it"),
        "{said}"
    );
    assert_eq!(row(&text, "B", "warp"), ["0.1000", "0.1000", "0.2000", "+100 %", "!"]);

    // The remedy.
    succeeds(folder, &["fit", "b/sheet.toml", "--force"]);
    let text = succeeds(folder, &arguments);
    assert_eq!(row(&text, "B", "warp")[2], "0.3000");
}

#[test]
fn curves_are_overlaid_and_their_values_are_measured() {
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let fabrics = Path::new(env!("CARGO_MANIFEST_DIR")).join("fabrics");
    let [tagawa, wool] =
        ["tagawa-2003", "matsudaira-b"].map(|name| fabrics.join(name).display().to_string());
    let text = succeeds(folder, &["fabric", "compare", &tagawa, &wool, "--report", "."]);
    // The curve's value, and that of the sheet.
    assert_eq!(row(&text, "B", "warp")[0], "0.1227");
    assert_eq!(row(&text, "B", "warp")[2], "0.06700");
    let page =
        std::fs::read_to_string(folder.join("tagawa-2003-and-matsudaira-b.html")).expect("a page");
    for title in
        ["tensile, measured", "bending, measured", "tensile, laws", "bending, laws", "shear, laws"]
    {
        assert!(page.contains(&format!("<h2>{title}</h2>")), "{title}");
    }
}

#[test]
fn tensile_values_of_different_loads_have_no_difference() {
    let values = "[warp]\nEM = 4\nLT = 0.7\nRT = 60\n";
    let folder = sheets(&[("a", values), ("b", values)]);
    let folder = folder.path();
    let sheet = folder.join("b/sheet.toml");
    let text = std::fs::read_to_string(&sheet).expect("a sheet");
    std::fs::write(&sheet, text.replace("T0 = 0.5", "T0 = 0.5\nFM = 50")).expect("a sheet");
    let text = succeeds(folder, &["fabric", "compare", "a", "b"]);
    assert!(
        text.contains(
            "- LT, WT, RT and EM are of different loads, and not compared: a 490.3 N/m, b 49.0"
        ),
        "{text}"
    );
    assert_eq!(row(&text, "RT", "warp").len(), 4, "{text}");
}

#[test]
fn one_fabric_is_not_compared() {
    let folder = sheets(&[("a", "[warp]\nB = 0.1\n")]);
    let message = fails(folder.path(), &["fabric", "compare", "a"], 2);
    assert!(message.contains("2"), "{message}");
}
