//! Sheets drafted from single files, and their values.

use std::path::Path;

use drape_kes::{Direction, Sheet, SheetDraft};

pub const WARP: Option<Direction> = Some(Direction::Warp);
pub const WEFT: Option<Direction> = Some(Direction::Weft);

/// Values of most tables: key, direction, value in the laboratory's unit.
pub const BOTH: [(&str, Option<Direction>, f64); 6] = [
    ("B", WARP, 0.112),
    ("B", WEFT, 0.061),
    ("2HB", WARP, 0.045),
    ("2HB", WEFT, 0.030),
    ("G", WARP, 0.75),
    ("G", WEFT, 0.73),
];

/// Drafts and reads the sheet of one file.
pub fn drafted(file: &str, bytes: &[u8]) -> (SheetDraft, Sheet) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(file);
    std::fs::write(&path, bytes).expect("written");
    let drafts = SheetDraft::of(&path, folder.path()).unwrap_or_else(|e| panic!("{file}: {e}"));
    let [draft] = &drafts[..] else { panic!("{file}: {} fabrics", drafts.len()) };
    let sheet = draft.read(folder.path()).unwrap_or_else(|e| panic!("{e}\n{}", draft.text));

    // The same bytes in memory give the same draft and the same sheet.
    let in_memory = SheetDraft::from_bytes(file, bytes).unwrap_or_else(|e| panic!("{file}: {e}"));
    let [held] = &in_memory[..] else { panic!("{file}: {} fabrics", in_memory.len()) };
    assert_eq!(held.text, draft.text);
    let read = held.read(Path::new("")).unwrap_or_else(|e| panic!("{e}\n{}", held.text));
    assert_eq!((read.listed(), &read.curves), (sheet.listed(), &sheet.curves), "{file}");
    (draft.clone(), sheet)
}

/// Returns a value of a sheet in the laboratory's unit, and its standard deviation as the draft
/// writes it.
pub fn get(
    draft: &SheetDraft,
    sheet: &Sheet,
    key: &str,
    direction: Option<Direction>,
) -> (f64, f64) {
    let listed = sheet.listed();
    let is_it =
        |value: &&drape_kes::SheetValue| value.symbol == key && value.direction == direction;
    let value =
        listed.iter().find(is_it).unwrap_or_else(|| panic!("no {key}\n{}", draft.text)).value;
    // A sheet has no place for the deviation of W and the like: it stands in the draft.
    let direction = direction.map_or(String::new(), |direction| format!(" {}", direction.name()));
    let start = format!("{key}{direction} = ");
    let reading = draft.readings.iter().find(|reading| reading.starts_with(&start));
    let deviation = reading.and_then(|reading| reading.split_once('±')).and_then(|(_, rest)| {
        rest.trim().split([' ', ':']).next().and_then(|number| number.parse().ok())
    });
    (value, deviation.unwrap_or(0.0))
}

/// Holds values of a file against what they should be: key, direction, value in the laboratory's
/// unit.
pub fn assert_values(
    file: &str,
    bytes: &[u8],
    wanted: &[(&str, Option<Direction>, f64)],
) -> SheetDraft {
    let (draft, sheet) = drafted(file, bytes);
    for (key, direction, value) in wanted {
        let (found, _) = get(&draft, &sheet, key, *direction);
        let off = (found / value - 1.0).abs();
        assert!(off < 1e-4, "{file}, {key} {direction:?}: {found}, not {value}\n{}", draft.text);
    }
    draft
}
