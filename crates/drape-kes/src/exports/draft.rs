//! Folder of exports, drafted as one sheet.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Diagnostics, figure, toml_string};

use crate::error::Error;
use crate::exports::compression;
use crate::exports::curve_draft::{CurveDraft, Key, commented, line, plain, read};
use crate::exports::evidence::Evidence;
use crate::exports::found::{Export, OpenDraft, in_words};
use crate::exports::value_table::{FoundValue, values};
use crate::tables::block::{Lines, blocks};
use crate::tables::columns::Pair;
use crate::tables::file::{self, TableFile};
use crate::tables::grid::Grid;
use crate::tables::layout::Layout;
use crate::tables::number::Decimal;
use crate::tables::series::Series;
use crate::tables::stated::Around;
use crate::test::{Direction, Test};

/// Endings of files that hold no tables.
const OTHER_FILES: [&str; 26] = [
    "toml", "md", "pdf", "doc", "docx", "rtf", "odt", "ppt", "pptx", "png", "jpg", "jpeg", "gif",
    "bmp", "tif", "tiff", "svg", "html", "htm", "xml", "json", "zip", "gz", "exe", "dll", "lnk",
];
/// Deepest folder below the one that is named.
const DEEPEST: usize = 3;
/// Relative difference of the gauges of two curves from which on they are no repeats.
const REPEAT_GAUGE: f64 = 0.1;
/// Most files of a folder: more are no exports of one fabric.
const MOST_FILES: usize = 500;

/// Sheet drafted from a folder of exports.
///
/// ```
/// use drape_kes::SheetDraft;
///
/// # let folder = std::env::temp_dir().join(format!("drape-kes-draft-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder).expect("a folder");
/// let text = "Curvature (1/cm),Moment (gf.cm/cm)\n-2,-0.2\n0,0.01\n2,0.22\n0,-0.01\n-2,-0.2\n";
/// std::fs::write(folder.join("bending-warp.csv"), text).expect("written");
/// let draft = SheetDraft::of_folder(&folder, &folder)?;
/// # std::fs::remove_dir_all(&folder).expect("it was just made");
/// assert_eq!((draft.curves, draft.open), (1, 0));
/// assert!(draft.text.contains("test = \"bending\""));
/// assert!(draft.text.contains("direction = \"warp\""));
/// # Ok::<(), drape_kes::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetDraft {
    /// Text of the sheet, as TOML with comments.
    pub text: String,
    /// Curves of the sheet.
    pub curves: usize,
    /// KES values of the sheet.
    pub values: usize,
    /// Sections that need a word, written as comments.
    pub open: usize,
    /// What was assumed, what needs a word, and what was left out, a line each.
    pub notes: Vec<String>,
}

/// Parts of a draft while the files are read.
#[derive(Default)]
struct Parts {
    curves: Vec<CurveDraft>,
    open: Vec<OpenDraft>,
    values: Vec<SourcedValue>,
    /// Files that gave nothing, with the reason.
    unread: Vec<(String, String)>,
}

/// Folder of the exports, and the way to it from the folder of the sheet.
struct Places<'a> {
    folder: &'a Path,
    way: String,
}

impl Places<'_> {
    /// Returns a draft with the names of its files from the folder of the sheet.
    fn placed(&self, draft: &CurveDraft) -> CurveDraft {
        let mut draft = draft.clone();
        if !self.way.is_empty() {
            draft.files.iter_mut().for_each(|file| *file = format!("{}/{file}", self.way));
        }
        draft
    }
}

/// Value with its file.
struct SourcedValue {
    value: FoundValue,
    source: String,
}

impl SheetDraft {
    /// Drafts a sheet of all exports in a folder and the folders below; `beside` is the folder where
    /// the sheet will lie.
    ///
    /// # Errors
    /// The folder cannot be read, or nothing in it is a curve or a value of a KES test: each file is
    /// named with the reason.
    pub fn of_folder(folder: &Path, beside: &Path) -> Result<Self, Error> {
        let mut paths = Vec::new();
        search(folder, DEEPEST, &mut paths)?;
        paths.sort();
        let mut parts = Parts::default();
        for path in &paths {
            parts.add(path, &relative(path, folder), folder);
        }
        if parts.curves.is_empty() && parts.values.is_empty() && parts.open.is_empty() {
            return Err(parts.nothing(folder).into());
        }
        let name = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        let name = name.file_name().map_or("fabric".into(), |name| name.to_string_lossy());
        Ok(parts.draft(&name, &Places { folder, way: relative(folder, beside) }))
    }
}

/// Collects the files of a folder and of those below it.
fn search(folder: &Path, depth: usize, paths: &mut Vec<PathBuf>) -> Result<(), Diagnostics> {
    let unreadable = |error: std::io::Error| {
        Diagnostic::new(folder, format!("cannot read the folder: {error}"))
            .help("name the folder of the exported files")
    };
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned());
        let name = name.unwrap_or_default();
        // Hidden files, and the locks of spreadsheet programs.
        if name.starts_with('.') || name.starts_with("~$") {
            continue;
        }
        if path.is_dir() && depth > 0 {
            search(&path, depth - 1, paths)?;
        } else if path.is_file() {
            paths.push(path);
        }
        if paths.len() > MOST_FILES {
            let message = format!("the folder holds more than {MOST_FILES} files");
            let help = "name the folder of the exports of one fabric";
            return Err(Diagnostic::new(folder, message).help(help).into());
        }
    }
    Ok(())
}

/// Returns a path as it is written in a sheet of a folder, with slashes.
fn relative(path: &Path, beside: &Path) -> String {
    let whole = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    // The folder of the sheet may not be there yet.
    let base = match beside.as_os_str().is_empty() {
        true => whole(Path::new(".")),
        false => std::path::absolute(beside).map_or_else(|_| beside.to_owned(), |p| whole(&p)),
    };
    let path = whole(path);
    let (mut of_path, mut of_base) = (path.components().peekable(), base.components().peekable());
    while of_path.peek().is_some() && of_path.peek() == of_base.peek() {
        of_path.next();
        of_base.next();
    }
    let up = of_base.map(|_| "..".to_owned());
    let down = of_path.map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

impl Parts {
    /// Adds what a file holds.
    fn add(&mut self, path: &Path, name: &str, folder: &Path) {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        if ending.is_some_and(|ending| OTHER_FILES.contains(&ending.as_str())) {
            self.unread.push((name.to_owned(), "no table, by its ending".into()));
            return;
        }
        let file = match file::read(path, &Layout::default()) {
            Ok(file) => file,
            Err(mistakes) => {
                let words: Vec<String> = mistakes.0.iter().map(in_words).collect();
                self.unread.push((name.to_owned(), words.join("; ")));
                return;
            }
        };
        let export = Export { path, name: name.to_owned(), file: &file, folder };
        let drafts = export.drafts();
        let before = self.curves.len() + self.open.len() + self.values.len();
        self.curves.extend(drafts.good);
        self.open.extend(drafts.open);
        let mut reasons = Vec::new();
        for grid in &file.grids {
            self.add_values(grid, &export, &mut reasons);
        }
        if self.curves.len() + self.open.len() + self.values.len() == before {
            reasons.extend(why_nothing(path, &file));
            self.unread.push((name.to_owned(), reasons.join("; ")));
        }
    }

    /// Adds the values of a sheet of a file: of its tables of results, and of a compression curve.
    fn add_values(&mut self, grid: &Grid, export: &Export<'_>, reasons: &mut Vec<String>) {
        let found = blocks(grid, Lines::default());
        let is_curve = found.blocks.iter().any(|block| block.rows.len() > 30);
        let evidence = Evidence::of_rows(&grid.sheet, &[], export.path);
        let direction = evidence.direction().ok().map(|told| told.value);
        let mut all = if is_curve { Vec::new() } else { values(grid, direction) };
        for block in found.blocks {
            let Some(columns) = compression::columns(&block) else { continue };
            let [deformation, load] = columns;
            let line = block.first_line();
            let series = Series {
                path: export.path.to_owned(),
                pair: Pair { deformation, load, label: String::new() },
                decimal: Decimal::Point,
                label: String::new(),
                around: Around::default(),
                several: false,
                block,
            };
            match compression::values(&series, columns) {
                Ok(c) => {
                    let values = [
                        ("T0", Some(c.t0)),
                        ("TM", Some(c.tm)),
                        ("LC", Some(c.lc)),
                        ("WC", Some(c.wc)),
                        ("RC", c.rc),
                    ];
                    all.extend(values.into_iter().filter_map(|(key, number)| {
                        // The digits of the curve, not those of the sum.
                        let number = format!("{:.5e}", number?).parse().ok()?;
                        Some(FoundValue { key, direction: None, number, unit: None, line })
                    }));
                }
                Err(reason) => reasons.push(format!("compression, line {line}: {reason}")),
            }
        }
        let source = |value: &FoundValue| {
            let sheet = match grid.sheet.as_str() {
                "" => String::new(),
                sheet => format!(", sheet \"{sheet}\""),
            };
            format!("{}{sheet}, line {}", export.name, value.line)
        };
        self.values.extend(all.into_iter().map(|value| {
            let source = source(&value);
            SourcedValue { value, source }
        }));
    }

    /// Returns the mistake of a folder without anything to read.
    fn nothing(&self, folder: &Path) -> Diagnostics {
        if self.unread.is_empty() {
            let finding = Diagnostic::new(folder, "the folder holds no files");
            return finding.help("export the curves from the instrument's program into it").into();
        }
        let one = |(name, reason): &(String, String)| format!("{name}: {reason}");
        let files: Vec<String> = self.unread.iter().take(10).map(one).collect();
        let message = format!("no file of the folder is a curve or a value: {}", files.join("; "));
        let help = "a curve has a line of names above columns of deformation and load, such as \
                    \"Strain (%),Force (gf/cm)\"";
        Diagnostic::new(folder, message).help(help).into()
    }

    /// Writes the sheet.
    fn draft(mut self, name: &str, places: &Places<'_>) -> SheetDraft {
        self.join_repeats(places.folder);
        let mut draft = SheetDraft::default();
        let head = format!(
            "# Sheet of the exports in the folder {}, drafted by drape. Everything detected is a key\n\
             # with its reason: correct what is wrong. `drape check` reads it, `drape fit` fits it.\n\
             name = {}\n# source = \"who measured it, when, under which licence\"\n",
            plain(name),
            toml_string(name)
        );
        let values = self.value_keys(places.folder, &mut draft);
        draft.text = head + &values;
        for curve in &self.curves {
            draft.text += &format!("\n{}", places.placed(curve).to_toml());
            let keys = curve.layout.iter().chain(curve.axes.iter().flatten());
            let file = curve.files.join(", ");
            let assumed = keys.map(|key| &key.why).chain([&curve.test.why]);
            let assumed = assumed.filter(|why| why.contains("ASSUMED"));
            draft.notes.extend(assumed.map(|why| format!("{file}: {why}")));
            if curve.files.len() > 1 {
                draft.notes.push(format!("{file}: taken for repeats of one test"));
            }
        }
        draft.curves = self.curves.len();
        draft.open = self.open.len();
        for OpenDraft { draft: curve, reason } in &self.open {
            let reason = plain(reason);
            draft.text += &format!("\n# Not taken: {reason}.\n# Correct and uncomment:\n");
            draft.text += &places.placed(curve).to_comment();
            draft.notes.push(format!("{} is not taken: {reason}", curve.files.join(", ")));
        }
        if !self.unread.is_empty() {
            draft.text += "\n# Files that are not in the sheet:\n";
        }
        for (file, reason) in &self.unread {
            let reason = plain(reason);
            draft.text += &format!("#   {}: {reason}\n", plain(file));
            draft.notes.push(format!("{file} is left out: {reason}"));
        }
        draft
    }

    /// Joins curves of several files that are alike: the repeats of a laboratory. Arches are no repeats: they
    /// buckle up or down.
    fn join_repeats(&mut self, folder: &Path) {
        let mut joined: Vec<CurveDraft> = Vec::new();
        for curve in std::mem::take(&mut self.curves) {
            let direction = |curve: &CurveDraft| curve.direction.as_ref().ok().map(|d| d.value);
            let plain = |keys: &[Key]| -> Vec<(&'static str, String)> {
                let told = keys.iter().filter(|key| !["header", "decimal"].contains(&key.name));
                told.map(|key| (key.name, key.value.clone())).collect()
            };
            let alike = |other: &&mut CurveDraft| {
                curve.test.value != Test::LoopBending
                    && other.test.value == curve.test.value
                    && direction(other) == direction(&curve)
                    && plain(&other.layout) == plain(&curve.layout)
                    && (0..2).all(|axis| plain(&other.axes[axis]) == plain(&curve.axes[axis]))
            };
            let gauge = |draft: &CurveDraft| draft.read(folder).ok()?.first()?.gauge;
            let is_as_long = |other: &CurveDraft| {
                let lengths = gauge(other).zip(gauge(&curve));
                lengths.is_none_or(|(a, b)| (a / b - 1.0).abs() < REPEAT_GAUGE)
            };
            let is_repeat = |other: &&mut CurveDraft| alike(other) && is_as_long(other);
            if let Some(other) = joined.iter_mut().find(is_repeat) {
                let mut both = other.clone();
                both.files.extend(curve.files.clone());
                if both.layout != curve.layout {
                    both.layout.retain(|key| !["header", "decimal"].contains(&key.name));
                }
                if both.read(folder).is_ok() {
                    *other = both;
                    continue;
                }
            }
            joined.push(curve);
        }
        self.curves = joined;
    }

    /// Returns the lines of the values, at the top and by direction; what the reader of sheets refuses
    /// is a comment.
    fn value_keys(&self, folder: &Path, draft: &mut SheetDraft) -> String {
        let mut groups: BTreeMap<Option<Direction>, Vec<&SourcedValue>> = BTreeMap::new();
        self.values.iter().for_each(|v| groups.entry(v.value.direction).or_default().push(v));
        let whole = groups.get(&None).map_or(&[][..], Vec::as_slice);
        let has = |keys: &[&str]| whole.iter().any(|v| keys.contains(&v.value.key));
        let mut text = String::new();
        if !has(&["W"]) {
            text += "# W = 12.0      # mg/cm2, the mass per area: not in the files\n";
        }
        if !has(&["T", "T0"]) {
            text += "# T = 0.40      # mm, the thickness: not in the files\n";
        }
        for (direction, values) in groups {
            let head = direction.map_or(String::new(), |d| format!("\n[{}]\n", d.name()));
            let mut taken: Vec<&FoundValue> = Vec::new();
            text += &head;
            for sourced in values {
                text += &sourced.key(&head, folder, &mut taken, &mut draft.notes);
            }
            draft.values += taken.len();
        }
        text
    }
}

impl SourcedValue {
    /// Returns the line of the value below a head; a comment where it is there already or refused.
    fn key<'v>(
        &'v self,
        head: &str,
        folder: &Path,
        taken: &mut Vec<&'v FoundValue>,
        notes: &mut Vec<String>,
    ) -> String {
        let Self { value, source } = self;
        let one = line(value.key, &written(value), source);
        if let Some(first) = taken.iter().find(|first| first.key == value.key) {
            if first.number == value.number {
                return String::new();
            }
            notes.push(format!("{} is there twice; {source} is not taken", value.key));
            return format!("# {} again: {one}", value.key);
        }
        match read(&format!("{head}{one}"), folder) {
            Ok(_) => {
                taken.push(value);
                one
            }
            Err(mistakes) => {
                let words: Vec<String> = mistakes.0.iter().map(in_words).collect();
                let words = plain(&words.join("; "));
                notes.push(format!("{source}: {} is not taken: {words}", value.key));
                format!("{}#   not taken: {words}\n", commented(&one))
            }
        }
    }
}

/// Returns a value as TOML, with its unit where the file gives one.
fn written(value: &FoundValue) -> String {
    let number = figure(value.number);
    match &value.unit {
        Some(unit) => toml_string(&format!("{number} {unit}")),
        None => number,
    }
}

/// Returns why a file has no curve and no value.
fn why_nothing(path: &Path, file: &TableFile) -> Vec<String> {
    let mut rows = 0;
    for grid in &file.grids {
        let found = blocks(grid, Lines::default());
        if let Some(block) = found.blocks.iter().max_by_key(|block| block.rows.len()) {
            rows += block.rows.len();
        }
        let evidence = Evidence::of_rows(&grid.sheet, &grid.rows, path);
        if let Some(other) = evidence.other_test().filter(|_| rows > 0) {
            let help = match other.value {
                "surface" => "write MIU, MMD, SMD of its program",
                _ => "write T0, TM, LC, WC, RC of its program",
            };
            return vec![format!("{} it is a {} test: {help} as values", other.why, other.value)];
        }
    }
    if rows == 0 {
        return vec!["it has no rows of numbers".to_owned()];
    }
    vec![
        "no two of its columns are deformation and load by their headings; name them: \
         deformation = { column = 1, unit = \"%\" }, load = { column = 2, unit = \"gf/cm\" }"
            .to_owned(),
    ]
}
