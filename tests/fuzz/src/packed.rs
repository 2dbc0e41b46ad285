//! Files that are archives of texts, such as workbooks: one text is mutated, and packed again.

use std::io::{Cursor, Write};

use zip::write::SimpleFileOptions;

use crate::mutation::{Random, mutated};

/// Members of a workbook with the results of two fabrics.
const WORKBOOK: [(&str, &str); 5] = [
    (
        "[Content_Types].xml",
        r#"<?xml version="1.0"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="xml" ContentType="application/xml"/><Override PartName="/xl/workbook.xml" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml"/><Override PartName="/xl/worksheets/sheet1.xml" ContentType="application/vnd.openxmlformats-officedocument.spreadsheetml.worksheet+xml"/></Types>"#,
    ),
    (
        "_rels/.rels",
        r#"<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="rId1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/officeDocument" Target="xl/workbook.xml"/></Relationships>"#,
    ),
    (
        "xl/workbook.xml",
        r#"<?xml version="1.0"?><workbook xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main" xmlns:r="http://schemas.openxmlformats.org/officeDocument/2006/relationships"><sheets><sheet name="Results" sheetId="1" r:id="rId1"/></sheets></workbook>"#,
    ),
    (
        "xl/_rels/workbook.xml.rels",
        r#"<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship Id="rId1" Type="http://schemas.openxmlformats.org/officeDocument/2006/relationships/worksheet" Target="worksheets/sheet1.xml"/></Relationships>"#,
    ),
    (
        "xl/worksheets/sheet1.xml",
        r#"<?xml version="1.0"?><worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><dimension ref="A1:D7"/><sheetData><row r="1"><c r="A1" t="inlineStr"><is><t>Property</t></is></c><c r="B1" t="inlineStr"><is><t>Unit</t></is></c><c r="C1" t="inlineStr"><is><t>Linen</t></is></c><c r="D1" t="inlineStr"><is><t>Wool</t></is></c></row><row r="2"><c r="A2" t="inlineStr"><is><t>B</t></is></c><c r="B2" t="inlineStr"><is><t>gf.cm2/cm</t></is></c><c r="C2"><v>0.118</v></c><c r="D2"><v>0.09</v></c></row><row r="3"><c r="A3" t="inlineStr"><is><t>2HB</t></is></c><c r="B3" t="inlineStr"><is><t>gf.cm/cm</t></is></c><c r="C3"><v>0.06</v></c><c r="D3"><v>0.04</v></c></row><row r="4"><c r="A4" t="inlineStr"><is><t>G</t></is></c><c r="B4" t="inlineStr"><is><t>gf/cm.degree</t></is></c><c r="C4"><v>1.1</v></c><c r="D4"><v>0.7</v></c></row><row r="5"><c r="A5" t="inlineStr"><is><t>W</t></is></c><c r="B5" t="inlineStr"><is><t>mg/cm2</t></is></c><c r="C5"><v>18.0</v></c><c r="D5"><v>22.5</v></c></row><row r="6"><c r="A6" t="inlineStr"><is><t>T</t></is></c><c r="B6" t="inlineStr"><is><t>mm</t></is></c><c r="C6"><v>0.4</v></c><c r="D6"><v>0.6</v></c></row></sheetData></worksheet>"#,
    ),
];

/// Members of an open document with a bending curve.
const OPEN_DOCUMENT: [(&str, &str); 3] = [
    ("mimetype", "application/vnd.oasis.opendocument.spreadsheet"),
    (
        "META-INF/manifest.xml",
        r#"<?xml version="1.0"?><manifest:manifest xmlns:manifest="urn:oasis:names:tc:opendocument:xmlns:manifest:1.0"><manifest:file-entry manifest:full-path="/" manifest:media-type="application/vnd.oasis.opendocument.spreadsheet"/><manifest:file-entry manifest:full-path="content.xml" manifest:media-type="text/xml"/></manifest:manifest>"#,
    ),
    (
        "content.xml",
        r#"<?xml version="1.0"?><office:document-content xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0" xmlns:table="urn:oasis:names:tc:opendocument:xmlns:table:1.0" xmlns:text="urn:oasis:names:tc:opendocument:xmlns:text:1.0"><office:body><office:spreadsheet><table:table table:name="Bending"><table:table-row><table:table-cell office:value-type="string"><text:p>Curvature (1/cm)</text:p></table:table-cell><table:table-cell office:value-type="string"><text:p>Moment (gf.cm/cm)</text:p></table:table-cell></table:table-row><table:table-row><table:table-cell office:value-type="float" office:value="0"/><table:table-cell office:value-type="float" office:value="0"/></table:table-row><table:table-row><table:table-cell office:value-type="float" office:value="1"/><table:table-cell office:value-type="float" office:value="0.2"/></table:table-row><table:table-row table:number-rows-repeated="2"><table:table-cell table:number-columns-repeated="2" office:value-type="float" office:value="2"/></table:table-row><table:table-row><table:table-cell office:value-type="float" office:value="0"/><table:table-cell office:value-type="float" office:value="-0.05"/></table:table-row></table:table></office:spreadsheet></office:body></office:document-content>"#,
    ),
];

/// Packs `members`, one of which `seed` mutates.
fn packed(members: &[(&str, &str)], seed: u64) -> Vec<u8> {
    // The last member has the cells: it is mutated most often.
    let chosen = Random(seed).below(2 * members.len()).min(members.len() - 1);
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (number, (name, text)) in members.iter().enumerate() {
        archive.start_file(*name, SimpleFileOptions::default()).expect("a member");
        let bytes = text.as_bytes();
        let bytes = if number == chosen { mutated(bytes, seed) } else { bytes.to_vec() };
        archive.write_all(&bytes).expect("written to memory");
    }
    archive.finish().expect("an archive").into_inner()
}

/// Returns a workbook with a mutated member.
pub fn workbook(seed: u64) -> Vec<u8> {
    packed(&WORKBOOK, seed)
}

/// Returns an open document with a mutated member.
pub fn open_document(seed: u64) -> Vec<u8> {
    packed(&OPEN_DOCUMENT, seed)
}
