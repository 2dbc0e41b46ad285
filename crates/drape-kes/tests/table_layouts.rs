//! Layouts in which laboratories keep the values of one fabric, each as `.csv` and as a workbook,
//! alone and in a folder, under names that say something else. All of them give the same sheet, and
//! several fabrics across give one each.
//!
//! The tables are made here from one list of values; those of FAST are in `fast.rs`.

use std::path::Path;

use drape_kes::{Direction, SheetDraft, Symbol, Test};

#[path = "support/table.rs"]
mod table;

use table::{Cell, Table, n, t};

/// Value of both directions: symbol, test, unit, warp, weft.
type Directed = (&'static str, &'static str, &'static str, f64, f64);

/// Values with directions.
const DIRECTED: [Directed; 9] = [
    ("B", "Bending", "gf.cm2/cm", 0.112, 0.061),
    ("2HB", "Bending", "gf.cm/cm", 0.045, 0.030),
    ("G", "Shear", "gf/(cm.deg)", 0.75, 0.73),
    ("2HG", "Shear", "gf/cm", 1.0, 1.1),
    ("2HG5", "Shear", "gf/cm", 2.2, 2.1),
    ("LT", "Tensile", "-", 0.62, 0.58),
    ("WT", "Tensile", "gf.cm/cm2", 9.8, 14.2),
    ("RT", "Tensile", "%", 58.0, 55.0),
    ("EM", "Tensile", "%", 4.1, 7.9),
];

/// Values without a direction: symbol, test, unit, value.
const WHOLE: [(&str, &str, &str, f64); 6] = [
    ("W", "Weight", "mg/cm2", 21.3),
    ("T0", "Compression", "mm", 0.61),
    ("TM", "Compression", "mm", 0.45),
    ("LC", "Compression", "-", 0.33),
    ("WC", "Compression", "gf.cm/cm2", 0.14),
    ("RC", "Compression", "%", 48.0),
];

/// Standard deviation over mean of the layouts that have one.
const SCATTER: f64 = 0.03;

/// What a layout says besides the values.
#[derive(Clone, Copy, PartialEq)]
enum Says {
    Values,
    /// Standard deviations of all values.
    Scatter,
    /// Standard deviations of the values with directions.
    DirectedScatter,
    /// A curve of the tensile test along the warp.
    Curve,
}

/// Three specimens with a standard deviation of 3 % of the mean.
fn specimens(mean: f64) -> [Cell; 3] {
    [1.0 - SCATTER, 1.0, 1.0 + SCATTER].map(|part| n((1e6 * part * mean).round() / 1e6))
}

/// Rows of a table: a heading, the values with directions, the others.
fn rows(
    head: &[&str],
    directed: impl Fn(&Directed) -> Vec<Cell>,
    whole: impl Fn(&(&'static str, &'static str, &'static str, f64)) -> Vec<Cell>,
) -> Table {
    let head = head.iter().map(|text| t(text)).collect();
    let rows = DIRECTED.iter().map(directed).chain(WHOLE.iter().map(whole));
    Table(std::iter::once(head).chain(rows).collect())
}

/// The layouts, each with what it says.
fn layouts() -> Vec<(&'static str, Table, Says)> {
    let comma = |number: f64| t(&number.to_string().replace('.', ","));
    vec![
        // Parameter | Unit | Warp | Weft | Mean
        // B         | …    | 0.112| 0.061|
        // W         | …    |      |      | 21.3
        (
            "a column of means",
            rows(
                &["Parameter", "Unit", "Warp", "Weft", "Mean"],
                |&(k, _, u, a, b)| vec![t(k), t(u), n(a), n(b), t("")],
                |&(k, _, u, v)| vec![t(k), t(u), t(""), t(""), n(v)],
            ),
            Says::Values,
        ),
        // Test    | Parameter | Unit | Warp  | Weft
        // Bending | B         | …    | 0.112 | 0.061
        (
            "a column of tests",
            rows(
                &["Test", "Parameter", "Unit", "Warp", "Weft"],
                |&(k, test, u, a, b)| vec![t(test), t(k), t(u), n(a), n(b)],
                |&(k, test, u, v)| vec![t(test), t(k), t(u), n(v), t("")],
            ),
            Says::Values,
        ),
        // Parameter | Unit | Warp 1 | Warp 2 | Warp 3 | Weft 1 | Weft 2 | Weft 3
        (
            "specimens",
            rows(
                &["Parameter", "Unit", "Warp 1", "Warp 2", "Warp 3", "Weft 1", "Weft 2", "Weft 3"],
                |&(k, _, u, a, b)| [&[t(k), t(u)][..], &specimens(a), &specimens(b)].concat(),
                |&(k, _, u, v)| [&[t(k), t(u)][..], &specimens(v), &[t(""), t(""), t("")]].concat(),
            ),
            Says::Scatter,
        ),
        // Test | Parameter | Unit | Warp |   |   |      | Weft |   |   |
        //      |           |      | 1    | 2 | 3 | mean | 1    | 2 | 3 | mean
        ("specimens and their means", specimens_and_means(), Says::Scatter),
        // Parameter     | Warp            | Weft
        // B (gf.cm2/cm) | 0.112 ± 0.00336 | 0.061 (0.00183)
        (
            "plus and minus in the cells",
            rows(
                &["Parameter", "Warp", "Weft"],
                |&(k, _, u, a, b)| {
                    let [da, db] = [a, b].map(|value| (1e6 * SCATTER * value).round() / 1e6);
                    vec![
                        t(&format!("{k} ({u})")),
                        t(&format!("{a} ± {da}")),
                        t(&format!("{b} ({db})")),
                    ]
                },
                |&(k, _, u, v)| vec![t(&format!("{k} ({u})")), n(v), t("")],
            ),
            Says::DirectedScatter,
        ),
        // Sample | B warp    | B weft    | … | W
        //        | gf.cm2/cm | gf.cm2/cm | … | mg/cm2
        // S1     | 0.112     | 0.061     | … | 21.3
        ("across", across(), Says::Values),
        // Textile laboratory |        | Report 17
        // Fabric:            | sateen |
        // …
        // Property | Symbol | Unit | Warp | Weft
        ("below a block of titles", below_titles(), Says::Values),
        // Parameter | Unit | Weft | Warp
        (
            "the weft first",
            rows(
                &["Parameter", "Unit", "Weft", "Warp"],
                |&(k, _, u, a, b)| vec![t(k), t(u), n(b), n(a)],
                |&(k, _, u, v)| vec![t(k), t(u), n(v), t("")],
            ),
            Says::Values,
        ),
        // Parameter | Einheit | Kette | Schuss
        // B         | …       | 0,112 | 0,061
        (
            "decimal commas and German headings",
            rows(
                &["Parameter", "Einheit", "Kette", "Schuss"],
                |&(k, _, u, a, b)| vec![t(k), t(u), comma(a), comma(b)],
                |&(k, _, u, v)| vec![t(k), t(u), comma(v), t("")],
            ),
            Says::Values,
        ),
        //               | Warp direction | Weft direction
        // B, gf.cm2/cm  | 0.112          | 0.061
        (
            "units behind the symbols",
            rows(
                &["", "Warp direction", "Weft direction"],
                |&(k, _, u, a, b)| vec![t(&format!("{k}, {u}")), n(a), n(b)],
                |&(k, _, u, v)| vec![t(&format!("{k}, {u}")), n(v), n(v)],
            ),
            Says::Values,
        ),
        // Parameter | Unit | Warp face | Warp back | Weft face | Weft back
        (
            "face and back",
            rows(
                &["Parameter", "Unit", "Warp face", "Warp back", "Weft face", "Weft back"],
                |&(k, test, u, a, b)| {
                    let part = if test == "Bending" { 0.02 } else { 0.0 };
                    let both = [a, b].map(|v| [n(v * (1.0 - part)), n(v * (1.0 + part))]).concat();
                    [vec![t(k), t(u)], both].concat()
                },
                |&(k, _, u, v)| vec![t(k), t(u), n(v), n(v), t(""), t("")],
            ),
            Says::Values,
        ),
        // Parameter | Unit | Warp | Weft |  | Strain (%) | Force (gf/cm)
        // B         | …    | …    | …    |  | 0.00       | 0.0
        ("values beside a curve", beside_a_curve(), Says::Curve),
        // KES-FB results of sateen 11          (over all columns)
        // Property | Symbol | Unit | Direction (over two columns)
        //          |        |      | Warp | Weft
        ("merged heading cells", merged_headings(), Says::Values),
        // 項目       | 記号 | 単位           | たて | よこ
        // 曲げ剛性   | Ｂ   | ｇｆ・ｃｍ²／ｃｍ | ０．１１２ | …
        ("Japanese headings", japanese(), Says::Values),
    ]
}

fn specimens_and_means() -> Table {
    let mut table = rows(
        &["Test", "Parameter", "Unit", "Warp", "", "", "", "Weft", "", "", ""],
        |&(k, test, u, a, b)| {
            let parts =
                [specimens(a).to_vec(), vec![n(a)], specimens(b).to_vec(), vec![n(b)]].concat();
            [vec![t(test), t(k), t(u)], parts].concat()
        },
        |&(k, test, u, v)| {
            [vec![t(test), t(k), t(u)], specimens(v).to_vec(), vec![n(v)], vec![t(""); 4]].concat()
        },
    );
    let heads = ["", "", "", "1", "2", "3", "mean", "1", "2", "3", "mean"];
    let head = |text: &str| text.parse().map_or_else(|_| t(text), n);
    table.0.insert(1, heads.into_iter().map(head).collect());
    table
}

fn across() -> Table {
    let (mut heads, mut units, mut values) = (vec![t("Sample")], vec![t("")], vec![t("S1")]);
    for (k, _, u, a, b) in DIRECTED {
        heads.extend([t(&format!("{k} warp")), t(&format!("{k} weft"))]);
        units.extend([t(u), t(u)]);
        values.extend([n(a), n(b)]);
    }
    for (k, _, u, v) in WHOLE {
        heads.push(t(k));
        units.push(t(u));
        values.push(n(v));
    }
    Table(vec![heads, units, values])
}

fn below_titles() -> Table {
    let table = rows(
        &["Property", "Symbol", "Unit", "Warp", "Weft"],
        |&(k, test, u, a, b)| vec![t(test), t(k), t(u), n(a), n(b)],
        |&(k, test, u, v)| vec![t(test), t(k), t(u), n(v), n(v)],
    );
    let titles = [
        vec![t("Textile laboratory"), t(""), t("Report 17")],
        vec![t("Fabric:"), t("sateen 11"), t("")],
        vec![t("Conditions"), t("20 C"), t("65 %")],
        vec![],
    ];
    Table(titles.into_iter().chain(table.0).collect())
}

fn beside_a_curve() -> Table {
    let table = rows(
        &["Parameter", "Unit", "Warp", "Weft", ""],
        |&(k, _, u, a, b)| vec![t(k), t(u), n(a), n(b), t("")],
        |&(k, _, u, v)| vec![t(k), t(u), n(v), t(""), t("")],
    );
    let mut lines = table.0;
    lines[0].extend([t("Strain, warp (%)"), t("Force, warp (gf/cm)")]);
    for (index, [strain, force]) in curve().into_iter().enumerate() {
        if lines.len() == index + 1 {
            lines.push(vec![t(""); 5]);
        }
        lines[index + 1].extend([n(strain), n(force)]);
    }
    Table(lines)
}

/// Tensile curve to 4 % and back: percent, gf/cm.
fn curve() -> Vec<[f64; 2]> {
    let up = (0..=40).map(|i| 0.1 * f64::from(i)).map(|e| [e, 31.25 * e * e]);
    let down = (0..40).rev().map(|i| 0.1 * f64::from(i)).map(|e| [e, 7.8125 * e * e * e]);
    let tidy = |[e, f]: [f64; 2]| [(1e4 * e).round() / 1e4, (1e4 * f).round() / 1e4];
    up.chain(down).map(tidy).collect()
}

fn merged_headings() -> Table {
    let table = rows(
        &["Property", "Symbol", "Unit", "Direction", ""],
        |&(k, test, u, a, b)| vec![t(test), t(k), t(u), n(a), n(b)],
        |&(k, test, u, v)| vec![t(test), t(k), t(u), n(v), t("")],
    );
    let mut lines = table.0;
    lines.insert(1, ["", "", "", "Warp", "Weft"].map(t).to_vec());
    lines.insert(0, vec![t("KES-FB results")]);
    // The name of a test stands once, beside all of its values.
    for line in (4..lines.len()).rev() {
        if lines[line][0] == lines[line - 1][0] {
            lines[line][0] = t("");
        }
    }
    Table(lines)
}

fn japanese() -> Table {
    let names = [
        ("B", "曲げ剛性", "ｇｆ・ｃｍ²／ｃｍ"),
        ("2HB", "曲げヒステリシス", "gf･cm/cm"),
        ("G", "せん断剛性", "g/cm・deg"),
        ("2HG", "せん断ヒステリシス", "g/cm"),
        ("2HG5", "せん断ヒステリシス", "g/cm"),
        ("LT", "引張線形性", "－"),
        ("WT", "引張仕事量", "gf・cm/cm²"),
        ("RT", "引張レジリエンス", "％"),
        ("EM", "最大伸長率", "％"),
        ("W", "目付", "mg/㎠"),
        ("T0", "初期厚さ", "㎜"),
        ("TM", "厚さ", "㎜"),
        ("LC", "圧縮線形性", "－"),
        ("WC", "圧縮仕事量", "gf･cm/cm²"),
        ("RC", "圧縮レジリエンス", "％"),
    ];
    let full = |text: &str| -> Cell {
        let letter = |c: char| char::from_u32(c as u32 + 0xfee0).filter(|_| c.is_ascii_graphic());
        t(&text.chars().map(|c| letter(c).unwrap_or(c)).collect::<String>())
    };
    let named = |key: &str| names.into_iter().find(|(k, ..)| *k == key).expect("a name");
    let line = |key: &str, values: Vec<Cell>| {
        let (_, name, unit) = named(key);
        [vec![t(name), full(key), t(unit)], values].concat()
    };
    rows(
        &["項目", "記号", "単位", "たて", "よこ"],
        |&(k, _, _, a, b)| line(k, [a, b].map(|v| full(&v.to_string())).to_vec()),
        |&(k, _, _, v)| line(k, vec![full(&v.to_string()), t("")]),
    )
}

/// Names of files that say nothing of the table in them.
const NAMES: [&str; 5] = ["results", "weft 2", "warp-values", "pattern of a shirt", "Schuss_45"];

#[test]
fn fourteen_layouts_of_one_fabric_give_one_sheet() {
    for (layout, table, says) in layouts() {
        for (place, name) in NAMES.iter().enumerate() {
            let files = [
                (format!("{name}.csv"), table.csv()),
                (format!("{name}.xlsx"), table.workbook("Summary")),
            ];
            for (file, bytes) in files {
                let folder = tempfile::tempdir().expect("a folder");
                let path = folder.path().join(&file);
                std::fs::write(&path, bytes).expect("written");
                // Alone, and in a folder with a file that is none.
                let drafted = if place % 2 == 0 { path } else { folder.path().to_owned() };
                std::fs::write(folder.path().join("readme.pdf"), b"%PDF").expect("written");
                let what = format!("{layout}, {file}");
                assert_sheet(&what, &drafted, folder.path(), says);
            }
        }
    }
}

/// Holds the sheet of a layout against the values.
fn assert_sheet(what: &str, path: &Path, folder: &Path, says: Says) {
    let drafts = SheetDraft::of(path, folder).unwrap_or_else(|error| panic!("{what}: {error}"));
    let [draft] = &drafts[..] else { panic!("{what}: {} fabrics", drafts.len()) };
    let sheet = draft.read(folder).unwrap_or_else(|error| panic!("{what}: {error}"));
    assert!(!draft.text.contains("none was read"), "{what}: {}", draft.text);
    let near = |found: Option<f64>, wanted: f64, of: &str| {
        let found = found.unwrap_or(f64::NAN);
        assert!(
            (found / wanted - 1.0).abs() < 1e-6,
            "{what}, {of}: {found}, not {wanted}\n{}",
            draft.text
        );
    };
    for symbol in Symbol::ALL {
        let (_, _, _, warp, weft) =
            DIRECTED.into_iter().find(|v| v.0 == symbol.name()).expect("a value");
        near(sheet.warp.get(symbol), warp, symbol.name());
        near(sheet.weft.get(symbol), weft, symbol.name());
        for (direction, value) in [(Direction::Warp, warp), (Direction::Weft, weft)] {
            let is_it = |s: &&drape_kes::Scatter| s.symbol == symbol && s.direction == direction;
            let scatter = sheet.scatter.iter().find(is_it).map(|s| s.deviation);
            match says {
                Says::Values | Says::Curve => {
                    assert_eq!(scatter, None, "{what}, {}", symbol.name())
                }
                Says::Scatter | Says::DirectedScatter => {
                    let part = scatter.unwrap_or(f64::NAN) / value;
                    assert!(
                        (part / SCATTER - 1.0).abs() < 1e-3,
                        "{what}, {}: {part}",
                        symbol.name()
                    );
                }
            }
        }
    }
    let found = [sheet.w, sheet.t0, sheet.tm, sheet.lc, sheet.wc, sheet.rc];
    for (found, (key, _, _, wanted)) in found.into_iter().zip(WHOLE) {
        near(found, wanted, key);
        let line =
            draft.text.lines().find(|line| line.starts_with(&format!("{key} ="))).expect(key);
        assert_eq!(line.contains('±'), says == Says::Scatter, "{what}: {line}");
    }
    let curves: Vec<(Test, Direction, usize)> =
        sheet.curves.iter().map(|c| (c.test, c.direction, c.load().len())).collect();
    if says == Says::Curve {
        assert_eq!(
            curves,
            [(Test::Tensile, Direction::Warp, curve().len())],
            "{what}: {}",
            draft.text
        );
        let largest = sheet.curves[0].load().iter().fold(0.0, |m: f64, f| m.max(*f));
        assert!((largest / (500.0 * 0.980_665) - 1.0).abs() < 1e-6, "{what}: {largest}");
    } else {
        assert_eq!(curves, [], "{what}: {}", draft.text);
    }
}

#[test]
fn several_fabrics_across_are_a_sheet_each() {
    let head = |texts: &[&str]| texts.iter().map(|text| t(text)).collect::<Vec<Cell>>();
    let mut lines = vec![
        head(&["Parameter", "Unit", "poplin", "", "serge 2/1", ""]),
        head(&["", "", "Warp", "Weft", "Warp", "Weft"]),
    ];
    lines.extend(
        DIRECTED.map(|(k, _, u, a, b)| vec![t(k), t(u), n(a), n(b), n(1.2 * a), n(1.2 * b)]),
    );
    lines.extend(WHOLE.map(|(k, _, u, v)| vec![t(k), t(u), n(v), t(""), n(1.4 * v)]));
    let table = Table(lines);
    for (file, bytes) in [("fabrics.csv", table.csv()), ("fabrics.xlsx", table.workbook("all"))] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join(file);
        std::fs::write(&path, bytes).expect("written");
        let drafts = SheetDraft::of(&path, folder.path()).expect("they are drafted");
        let names: Vec<&str> = drafts.iter().map(|draft| draft.name.as_str()).collect();
        assert_eq!(names, ["poplin", "serge 2/1"], "{file}");
        for (draft, [factor, of_whole]) in drafts.iter().zip([[1.0, 1.0], [1.2, 1.4]]) {
            assert_eq!(draft.values, 24, "{}", draft.text);
            let sheet = draft.read(folder.path()).unwrap_or_else(|e| panic!("{e}\n{}", draft.text));
            let near = |found: Option<f64>, wanted: f64| {
                assert!(
                    found.is_some_and(|f| (f / wanted - 1.0).abs() < 1e-9),
                    "{found:?}, {wanted}"
                );
            };
            near(sheet.warp.b, 0.112 * factor);
            near(sheet.weft.wt, 14.2 * factor);
            near(sheet.w, 21.3 * of_whole);
        }
        // The remedy of the refusal works.
        let error = SheetDraft::sheet(&path, None).expect_err("there are two");
        assert!(error.to_string().contains("\"poplin\", \"serge 2/1\""), "{error}");
        let chosen = SheetDraft::sheet(&path, Some("serge 2/1")).expect("it is there");
        assert_eq!(chosen.name, "serge 2/1");
    }
}
