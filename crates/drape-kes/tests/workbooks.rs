//! Workbooks, archives and exports of laboratories, and what cannot be told of them.

use drape_kes::{Sheet, SheetDraft};

#[path = "support/drafted.rs"]
mod support;

use support::{BOTH, WARP, WEFT, assert_values, drafted, get};

/// Returns the bytes of a workbook of [`sheets`].
fn book(texts: &[(&str, &str)]) -> Vec<u8> {
    sheets(texts).save_to_buffer().expect("a workbook")
}

/// Makes a workbook of sheets, each a name and its cells with commas between.
fn sheets(sheets: &[(&str, &str)]) -> rust_xlsxwriter::Workbook {
    let mut book = rust_xlsxwriter::Workbook::new();
    for (name, text) in sheets {
        let sheet = book.add_worksheet().set_name(*name).expect("a name");
        for (row, line) in text.lines().enumerate() {
            for (column, cell) in line.split(',').enumerate() {
                let (row, column) = (row as u32, column as u16);
                match cell.parse::<f64>() {
                    Ok(number) => sheet.write(row, column, number).expect("written"),
                    Err(_) => sheet.write(row, column, cell).expect("written"),
                };
            }
        }
    }
    book
}

const RESULTS: &str = "Property,Unit,Linen\nB,gf.cm2/cm,0.118\n2HB,gf.cm/cm,0.06\nW,mg/cm2,18\n";

#[test]
fn a_stray_cell_in_the_last_row_and_column_takes_nothing_away() {
    let texts = [("Results", RESULTS)];
    let mut stray = sheets(&texts);
    let sheet = stray.worksheet_from_index(0).expect("one sheet");
    sheet.write(1_048_575, 16_383, "stray").expect("written");
    let stray = stray.save_to_buffer().expect("a workbook");
    for bytes in [book(&texts), stray] {
        let (_, sheet) = drafted("results.xlsx", &bytes);
        let values: Vec<(&str, f64)> =
            sheet.listed().iter().map(|value| (value.symbol, value.value)).collect();
        assert!(values.contains(&("B", 0.118)) && values.contains(&("W", 18.0)), "{values:?}");
    }
}

#[test]
fn rows_that_end_far_to_the_right_count_in_all_sheets_of_a_workbook() {
    // Each sheet alone is below the limit: 200 rows of up to 16384 cells.
    let mut wide = sheets(&[("Results", RESULTS), ("Second", RESULTS)]);
    for index in 0..2 {
        let sheet = wide.worksheet_from_index(index).expect("a sheet");
        for row in 10..210 {
            sheet.write(row, 16_383, "stray").expect("written");
        }
    }
    let bytes = wide.save_to_buffer().expect("a workbook");
    let error = SheetDraft::from_bytes("results.xlsx", &bytes).expect_err("too many");
    assert!(error.to_string().contains("\"Second\": it has more than 4000000 cells"), "{error}");
}

#[test]
fn a_workbook_that_unpacks_to_too_much_is_refused() {
    use std::io::Write;

    let whole = book(&[("Results", RESULTS)]);
    let mut archive = zip::ZipWriter::new_append(std::io::Cursor::new(whole)).expect("a workbook");
    let options = zip::write::SimpleFileOptions::default().large_file(true);
    archive.start_file("xl/media/blank.bmp", options).expect("a member");
    let blank = vec![0_u8; 1 << 20];
    for _ in 0..500 {
        archive.write_all(&blank).expect("written to memory");
    }
    let bomb = archive.finish().expect("an archive").into_inner();
    assert!(bomb.len() < 1 << 20, "{} bytes", bomb.len());
    let error = SheetDraft::from_bytes("results.xlsx", &bomb).expect_err("refused").to_string();
    assert!(error.contains("it unpacks to 524 MB, more than 500 MB"), "{error}");
}

#[test]
fn a_workbook_of_numbers_as_text_percent_cells_dates_and_errors() {
    let mut book = rust_xlsxwriter::Workbook::new();
    let percent = rust_xlsxwriter::Format::new().set_num_format("0.0%");
    let date = rust_xlsxwriter::Format::new().set_num_format("yyyy-mm-dd");
    let sheet = book.add_worksheet().set_name("Résultats").expect("a name");
    let title = rust_xlsxwriter::Format::new();
    sheet.merge_range(0, 0, 0, 3, "KES-FB report", &title).expect("merged");
    sheet
        .write(1, 0, "Date")
        .expect("written")
        .write_with_format(1, 1, 45_325, &date)
        .expect("written");
    for (column, head) in ["Kennwert", "Einheit", "Kette", "Schuss"].into_iter().enumerate() {
        sheet.write(3, column as u16, head).expect("written");
    }
    let names = [
        ("B", "gf.cm²/cm"),
        ("RT", ""),
        ("EM", "%"),
        ("LT", "-"),
        ("G", "gf/cm·deg"),
        ("2HG", "gf/cm"),
    ];
    for (row, (name, unit)) in names.into_iter().enumerate() {
        let row = row as u32 + 4;
        sheet.write(row, 0, name).expect("written").write(row, 1, unit).expect("written");
    }
    sheet.write(4, 2, "0,112").expect("written").write(4, 3, "0,061").expect("written");
    for (row, values) in [(5, [0.58, 0.55]), (6, [0.041, 0.079])] {
        for (place, value) in values.into_iter().enumerate() {
            sheet.write_with_format(row, place as u16 + 2, value, &percent).expect("written");
        }
    }
    sheet.write(7, 2, 0.62).expect("written").write(7, 3, 0.58).expect("written");
    // A spreadsheet program has made a date of 0.73.
    sheet
        .write(8, 2, 0.75)
        .expect("written")
        .write_with_format(8, 3, 45_476, &date)
        .expect("written");
    sheet.write(9, 2, "#DIV/0!").expect("written").write(9, 3, 1.1).expect("written");
    let bytes = book.save_to_buffer().expect("a workbook");
    let draft = assert_values(
        "book.xlsx",
        &bytes,
        &[
            BOTH[0],
            BOTH[1],
            ("RT", WARP, 58.0),
            ("EM", WARP, 4.1),
            ("EM", WEFT, 7.9),
            ("LT", WEFT, 0.58),
            BOTH[4],
            ("2HG", WEFT, 1.1),
        ],
    );
    let notes = draft.notes.join("\n");
    for words in [
        "line 9: \"2024-07-03\" is no number, so that G is not read there",
        "line 10: \"#DIV/0!\" is no number",
    ] {
        assert!(notes.contains(words), "{words} is missing in {notes}");
    }
    assert!(!draft.text.contains("ASSUMED"), "a percent cell is no guess: {}", draft.text);
}

#[test]
fn a_workbook_with_a_test_a_direction_or_a_specimen_a_sheet() {
    let tests = book(&[
        ("Bending", ",Warp,Weft\nB (gf.cm2/cm),0.112,0.061\n2HB (gf.cm/cm),0.045,0.03"),
        ("Shear", ",Warp,Weft\nG (gf/cm.deg),0.75,0.73"),
        ("Others", "W (mg/cm2),21.3\nT0 (mm),0.61\nMIU,0.18"),
        ("Warp", "LT,0.62\nRT,58"),
        ("Weft", "LT,0.58\nRT,55"),
    ]);
    let wanted = [&BOTH[..], &[("W", None, 21.3), ("LT", WARP, 0.62), ("LT", WEFT, 0.58)]].concat();
    assert_values("tests.xlsx", &tests, &wanted);
    let table = |factor: f64| {
        let row = |name: &str, a: f64, b: f64| format!("\n{name},{},{}", factor * a, factor * b);
        let rows = [row("B", 0.112, 0.061), row("G", 0.75, 0.73), row("2HB", 0.045, 0.03)];
        format!(",Warp,Weft{}", rows.concat())
    };
    let [low, middle, high, twice, third] = [0.97, 1.0, 1.03, 2.2, 0.3].map(table);
    let specimens = book(&[("Specimen 1", &low), ("Specimen 2", &middle), ("Specimen 3", &high)]);
    let (draft, sheet) = drafted("specimens.xlsx", &specimens);
    let (value, deviation) = get(&draft, &sheet, "B", WARP);
    assert!(
        (value - 0.112).abs() < 1e-9 && (deviation / 0.112 - 0.03).abs() < 1e-5,
        "{}",
        draft.text
    );
    let fabrics = book(&[("poplin", &middle), ("twill", &twice), ("gauze", &third)]);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("fabrics.xlsx");
    std::fs::write(&path, fabrics).expect("written");
    let drafts = SheetDraft::of(&path, folder.path()).expect("drafted");
    let names: Vec<&str> = drafts.iter().map(|draft| draft.name.as_str()).collect();
    assert_eq!(names, ["poplin", "twill", "gauze"]);
    assert!(drafts[0].notes.iter().any(|note| note.starts_with("ASSUMED: poplin, twill, gauze")));
}

#[test]
fn what_cannot_be_told_is_refused_with_the_remedy() {
    let cases = [
        ("Item;Warp;Weft\nWT;9,811;1,402\n", "\"9,811\" on line 2 may be 9.811 or 9811"),
        ("Item;Warp;Weft\nB;0,112;0.061\n", "write all numbers with one sign"),
        ("Item,Value\nB warp,n.d.\n", "it has no rows of numbers"),
        (
            "Item,Unit,Warp\nB,Ohm/sq,0.112\nG,gf.cm2,0.7\n",
            "\"gf.cm2\" is no known unit of shear stiffness",
        ),
    ];
    for (text, words) in cases {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("table.csv");
        std::fs::write(&path, text).expect("written");
        let error = SheetDraft::of(&path, folder.path()).expect_err(text);
        assert!(error.to_string().contains(words), "{words:?} is missing in: {error}");
    }
    // A value that no fabric has is a comment with the reason, and costs nothing else.
    let (draft, sheet) = drafted("wrong.csv", b"Item,Warp,Weft\nB,0,0.061\nW (mg/cm2),21.3,\n");
    assert_eq!((sheet.warp.b, sheet.weft.b, sheet.w), (None, Some(0.061), Some(21.3)));
    assert!(draft.text.contains("# B = 0") && draft.text.contains("not taken"), "{}", draft.text);
    // A ratio in place of a percentage is told.
    let (draft, sheet) = drafted("ratio.csv", b"Item,Warp,Weft\nRT,0.58,0.55\nEMT,0.041,0.079\n");
    assert_eq!((sheet.warp.rt, sheet.weft.em), (Some(58.0), Some(7.9)));
    assert!(draft.notes[0].starts_with("ASSUMED: RT of 0.58"), "{:?}", draft.notes);
}

#[test]
fn an_archive_is_read_as_its_folder_would_be() {
    use std::io::Write as _;
    let rows: String =
        (0..=40).chain((0..40).rev()).map(|i| format!("{};{}\n", i, i * i)).collect();
    let curve = format!("Dehnung (‰);Kraft (gf/cm)\n{rows}").replace("‰", "%");
    let values = "Kennwert;Kette;Schuss\nB;0,112;0,061\nW;21,3;\n";
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("labor.zip");
    let mut archive = zip::ZipWriter::new(std::fs::File::create(&path).expect("made"));
    let plain = zip::write::SimpleFileOptions::default();
    for (name, text) in [
        ("Zug Kette.csv", curve.as_str()),
        ("werte/ergebnis.csv", values),
        ("__MACOSX/._x.csv", "x"),
    ] {
        archive.start_file(name, plain).expect("started");
        archive.write_all(text.as_bytes()).expect("written");
    }
    archive.finish().expect("finished");
    let drafts = SheetDraft::of(&path, folder.path()).expect("drafted");
    let sheet = drafts[0].read(folder.path()).unwrap_or_else(|e| panic!("{e}\n{}", drafts[0].text));
    assert_eq!((sheet.warp.b, sheet.w, sheet.curves.len()), (Some(0.112), Some(21.3), 1));
    assert!(drafts[0].text.contains("file = \"labor.zip/Zug Kette.csv\""), "{}", drafts[0].text);
    // The sheet is read again as it was written.
    std::fs::write(folder.path().join("labor.sheet.toml"), &drafts[0].text).expect("written");
    let again = Sheet::read(folder.path().join("labor.sheet.toml")).expect("it is read");
    assert_eq!(again.digest(), sheet.digest());
    // The archive is read from memory as well.
    let bytes = std::fs::read(&path).expect("read");
    let held = SheetDraft::from_bytes("labor.zip", &bytes).expect("drafted");
    assert_eq!(held[0].text, drafts[0].text);
    let of_memory = held[0].read(std::path::Path::new("")).expect("a sheet");
    assert_eq!(of_memory.digest(), sheet.digest());
    let empty = folder.path().join("empty.zip");
    std::fs::write(&empty, b"PK\x05\x06\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0").expect("written");
    assert!(
        SheetDraft::of(&empty, folder.path())
            .expect_err("empty")
            .to_string()
            .contains("holds no files")
    );
    std::fs::write(&empty, b"PK\x03\x04 broken").expect("written");
    assert!(
        SheetDraft::of(&empty, folder.path())
            .expect_err("broken")
            .to_string()
            .contains("cannot be read")
    );
}

#[test]
fn a_table_of_sizes_and_of_a_strip_on_the_bias_are_told_from_values_and_from_the_warp() {
    let rows: String = (0..40)
        .map(|i| format!("{:.2},{:.4}\n", 0.5 * f64::from(i), 0.01 * f64::from(i * i)))
        .collect();
    let text = format!("Gauge length,200,mm\nWidth,50,mm\nExtension (mm),Load (N)\n{rows}");
    for name in ["warp_bias_45deg.csv", "Kette schräg.csv", "経 バイアス.csv", "warp +45.csv"]
    {
        let (draft, sheet) = drafted(name, text.as_bytes());
        assert_eq!((sheet.curves.len(), draft.open), (0, 0), "{name}: {}", draft.text);
        for words in [
            "# Left out:",
            "a strip at 45° to the yarns, on the bias",
            "none is fitted to the bias",
        ] {
            assert!(draft.text.contains(words), "{name}, {words}: {}", draft.text);
        }
    }
    let (draft, sheet) = drafted("warp 45.csv", text.as_bytes());
    assert_eq!(sheet.curves.len(), 1, "{}", draft.text);
    let rows: String = (0..40).map(|i| format!("{i},{},{}\n", 2 * i, 3 * i)).collect();
    let text = format!(
        "試験名,試験日\n織物たて引張,2024/5/1\n\n名前,厚さ,幅,ゲージ長\n,mm,mm,mm\n1 _ 1,0.4,50.0,200.0\n\n1 _ 1,,\n\
         時間,試験力,ストローク\nsec,N,mm\n{rows}"
    );
    let bytes = encoding_rs::SHIFT_JIS.encode(&text).0.into_owned();
    let (draft, sheet) = drafted("export.csv", &bytes);
    assert_eq!((sheet.t, sheet.curves.len()), (Some(0.4), 1), "{}", draft.text);
    assert_eq!(sheet.curves[0].gauge, Some(0.2), "{}", draft.text);
    assert!(draft.text.contains("width = \"50 mm\""), "{}", draft.text);
}

#[test]
fn columns_whose_units_are_not_known_cost_nothing_else() {
    let rows: String = (0..40)
        .map(|i| {
            format!("{i},{},{},1.5,20.1,0.7,3,9\n", 0.1 * f64::from(i), 0.01 * f64::from(i * i))
        })
        .collect();
    let heads = "Time,Extension,Load,Work,Chamber,Signal,Rate,Sheet";
    let in_row = format!("{heads}\ns,mm,N,Nmm,°C,V,1/s,Ohm/sq\n{rows}");
    let in_heads = format!(
        "Time (s),Extension (mm),Load (N),Work (Nmm),Chamber [°C],Signal (V),Rate (1/s),Sheet (Ohm/sq)\n{rows}"
    );
    for text in [in_row, in_heads] {
        let text = format!("Gauge length,200,mm\nWidth,50,mm\n\n{text}");
        let (draft, sheet) = drafted("warp tensile.csv", text.as_bytes());
        assert_eq!((sheet.curves.len(), draft.open), (1, 0), "{}", draft.text);
        assert_eq!(sheet.curves[0].gauge, Some(0.2), "{}", draft.text);
        let note = draft.notes.iter().find(|note| note.contains("columns without a use"));
        let note = note.unwrap_or_else(|| panic!("{:?}", draft.notes));
        for column in ["\"Work\" (Nmm)", "\"Signal\" (V)", "\"Rate\" (1/s)", "\"Sheet\" (Ohm/sq)"] {
            assert!(note.contains(column), "{column} is missing in {note}");
        }
    }
}

#[test]
fn a_text_of_more_cells_than_a_spreadsheet_has_is_refused() {
    for text in ["1,".repeat(4_000_001), "1 ".repeat(4_000_001)] {
        let error = SheetDraft::from_bytes("line.csv", text.as_bytes()).expect_err("too many");
        let error = error.to_string();
        assert!(error.contains("it has more than 4000000 cells"), "{error}");
    }
}
