//! OpenDocument spreadsheets, whose cells and rows may be repeated.

use std::io::Write;
use std::path::Path;

use drape_kes::{Sheet, SheetDraft};

/// Returns a spreadsheet with the `tables` of its content.
fn document(tables: &str) -> Vec<u8> {
    let content = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?><office:document-content \
         xmlns:office=\"urn:oasis:names:tc:opendocument:xmlns:office:1.0\" \
         xmlns:table=\"urn:oasis:names:tc:opendocument:xmlns:table:1.0\" \
         xmlns:text=\"urn:oasis:names:tc:opendocument:xmlns:text:1.0\" office:version=\"1.2\">\
         <office:body><office:spreadsheet>{tables}</office:spreadsheet></office:body></office:document-content>"
    );
    packed(&[
        ("mimetype", "application/vnd.oasis.opendocument.spreadsheet"),
        ("META-INF/manifest.xml", "<manifest:manifest/>"),
        ("content.xml", &content),
    ])
}

/// Returns an archive of `members`, each a name and a text.
fn packed(members: &[(&str, &str)]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, text) in members {
        zip.start_file(*name, zip::write::SimpleFileOptions::default()).expect("a member");
        zip.write_all(text.as_bytes()).expect("written to memory");
    }
    zip.finish().expect("an archive").into_inner()
}

/// Returns a row with some `cells` and further `attributes`.
fn row(attributes: &str, cells: &[String]) -> String {
    format!("<table:table-row {attributes}>{}</table:table-row>", cells.concat())
}

/// Returns a cell with a `text` and further `attributes`.
fn text(attributes: &str, text: &str) -> String {
    format!(
        "<table:table-cell {attributes} office:value-type=\"string\"><text:p>{text}</text:p></table:table-cell>"
    )
}

/// Returns a cell with a number of a `kind` and further `attributes`.
fn number(kind: &str, attributes: &str, value: f64) -> String {
    format!(
        "<table:table-cell {attributes} office:value-type=\"{kind}\" office:value=\"{value}\"><text:p>{value}</text:p></table:table-cell>"
    )
}

/// Returns the rows of a table of results of one fabric.
fn results() -> String {
    let values = [("B", "gf.cm2/cm", 0.118), ("2HB", "gf.cm/cm", 0.06), ("W", "mg/cm2", 18.0)];
    let head = row("", &["Property", "Unit", "Linen"].map(|word| text("", word)));
    let rows = values.map(|(symbol, unit, value)| {
        row("", &[text("", symbol), text("", unit), number("float", "", value)])
    });
    head + &rows.concat()
}

/// Returns the sheet that is drafted from a spreadsheet with `tables`.
fn drafted(tables: &str) -> Sheet {
    let drafts = SheetDraft::from_bytes("results.ods", &document(tables));
    let drafts = drafts.unwrap_or_else(|error| panic!("{error}"));
    let [draft] = &drafts[..] else { panic!("{} fabrics", drafts.len()) };
    draft.read(Path::new("")).unwrap_or_else(|error| panic!("{error}\n{}", draft.text))
}

/// Returns the values of the sheet that is drafted from a spreadsheet with `tables`.
fn values(tables: &str) -> Vec<(String, f64)> {
    let values = drafted(tables).listed().into_iter();
    values.map(|value| (value.symbol.to_string(), value.value)).collect()
}

/// Returns the reason for which a spreadsheet with these `bytes` is refused.
fn refusal(bytes: &[u8]) -> String {
    SheetDraft::from_bytes("results.ods", bytes).expect_err("it is refused").to_string()
}

/// Returns a table called `name` with some `rows`.
fn table(name: &str, rows: &str) -> String {
    format!("<table:table table:name=\"{name}\">{rows}</table:table>")
}

#[test]
fn the_empty_cells_that_end_every_file_take_nothing_away() {
    let empty = "<table:table-cell table:number-columns-repeated=\"16384\"/>".to_owned();
    let filled = row("table:number-rows-repeated=\"1048572\"", &[empty]);
    let stray = "<table:table-cell table:number-columns-repeated=\"16383\"/>".to_owned();
    let last = row("", &[stray, text("", "stray")]);
    let plain = values(&table("Results", &results()));
    assert!(plain.contains(&("B".into(), 0.118)) && plain.contains(&("W".into(), 18.0)));
    assert_eq!(values(&table("Results", &(results() + &filled))), plain);
    assert_eq!(values(&table("Results", &(results() + &filled + &last))), plain);
}

#[test]
fn repeated_cells_and_rows_are_read_as_if_each_was_written() {
    let draft = |rows: &str| {
        let bytes = document(&table("Results", rows));
        let drafts = SheetDraft::from_bytes("results.ods", &bytes);
        drafts.expect("a table of results").remove(0).text
    };
    let twice = "table:number-columns-repeated=\"2\"";
    let rows = [("B", "gf.cm2/cm", 0.118), ("2HB", "gf.cm/cm", 0.06)];
    let head = row("", &["Property", "Unit", "Linen", "Linen"].map(|word| text("", word)));
    let repeated = rows.map(|(symbol, unit, value)| {
        row("", &[text("", symbol), text("", unit), number("float", twice, value)])
    });
    let written = rows.map(|(symbol, unit, value)| {
        let value = number("float", "", value);
        row("", &[text("", symbol), text("", unit), value.clone(), value])
    });

    // Rows above the table move its lines, which a draft states.
    let above = row("table:number-rows-repeated=\"3\"", &[text(twice, "note")]);
    let each = row("", &[text("", "note"), text("", "note")]).repeat(3);
    let found = draft(&(above + &head + &repeated.concat()));
    assert_eq!(found, draft(&(each + &head + &written.concat())));
    assert!(found.contains("0.118 gf.cm2/cm") && found.contains("line 6"), "{found}");
}

#[test]
fn more_repetitions_than_a_table_has_cells_are_refused_before_they_are_laid_out() {
    let refused =
        "it has more than 4000000 cells: delete the stray ones, or save the results alone";
    let wide = [number("float", "table:number-columns-repeated=\"16384\"", 1.0)];
    for repeats in ["1048576", "4294967295", "245"] {
        let rows = row(&format!("table:number-rows-repeated=\"{repeats}\""), &wide);
        let error = refusal(&document(&table("Results", &rows)));
        assert!(error.contains(refused), "{repeats}: {error}");
    }

    // Tables that are each below the limit, and rows whose last cell is far to the right.
    let some = table("Results", &row("table:number-rows-repeated=\"200\"", &wide));
    assert!(refusal(&document(&some.repeat(2))).contains(refused));
    let far = "<table:table-cell table:number-columns-repeated=\"16383\"/>".to_owned();
    let far = row("table:number-rows-repeated=\"300\"", &[far, number("float", "", 1.0)]);
    assert!(refusal(&document(&table("Results", &far))).contains(refused));

    // A cell that is repeated no times may be so in any number of rows.
    let none = [number("float", "table:number-columns-repeated=\"0\"", 1.0)];
    let none = row("table:number-rows-repeated=\"4294967295\"", &none);
    assert!(values(&table("Results", &(results() + &none))).contains(&("B".into(), 0.118)));

    let long = [text("table:number-columns-repeated=\"1000\"", &"x".repeat(200_000))];
    let error = refusal(&document(&table("Results", &row("", &long))));
    assert!(error.contains("its texts have more than 100 MB"), "{error}");
}

#[test]
fn cells_are_read_with_entities_annotations_and_percent() {
    let noted = "<table:table-cell office:value-type=\"string\">\
                 <office:annotation><text:p>doubtful</text:p></office:annotation>\
                 <text:p>2HB<text:s text:c=\"4000000000\"/></text:p></table:table-cell>";
    let rows = row("", &["Property", "Unit", "Linen"].map(|word| text("", word)))
        + &row("", &[noted.to_owned(), text("", "gf.cm/cm"), number("float", "", 0.06)])
        + &row("", &[text("", "RT"), text("", ""), number("percentage", "", 0.625)]);
    let values = values(&table("Results &amp; more", &rows));
    assert!(
        values.contains(&("2HB".into(), 0.06)) && values.contains(&("RT".into(), 62.5)),
        "{values:?}"
    );
}

#[test]
fn damaged_documents_are_refused_with_the_reason() {
    let cell = number("float", "table:number-columns-repeated=\"two\"", 1.0);
    let error = refusal(&document(&table("Results", &row("", &[cell]))));
    assert!(error.contains("table:number-columns-repeated is \"two\""), "{error}");

    let cell = "<table:table-cell office:value-type=\"float\" office:value=\"much\"/>".to_owned();
    let error = refusal(&document(&table("Results", &row("", &[cell]))));
    assert!(error.contains("\"much\" is no number"), "{error}");

    let mimetype = ("mimetype", "application/vnd.oasis.opendocument.spreadsheet");
    let open = "<a><table:table table:name=\"t\">";
    let error = refusal(&packed(&[mimetype, ("content.xml", open)]));
    assert!(error.contains("its text ends within a table"), "{error}");
    let manifest = "<manifest:file-entry><manifest:encryption-data/></manifest:file-entry>";
    let error = refusal(&packed(&[mimetype, ("META-INF/manifest.xml", manifest)]));
    assert!(error.contains("protected by a password"), "{error}");
}
