//! Kinds of files: the kind of a file by its ending, its first bytes or its keys, and what can be
//! done with a file of the kind.

use std::fmt;
use std::path::Path;

use drape_frames::Recording;
use drape_input::{Advice, Diagnostic, Diagnostics, Document, FileAccess, FilePurpose, Remedy};
use drape_pattern::Pattern;
use toml::{Table, Value};

/// Kind of a file or folder that can be given to a program or a function.
///
/// ```
/// use drape_run::file::FileKind;
/// use drape_input::Document;
///
/// let document = Document::new("wool.toml", "name = \"wool\"\ndensity = 0.16\n");
/// assert_eq!(FileKind::of_document(&document), Some(FileKind::Fabric));
/// let mistakes = FileKind::expect_document(&document, &[FileKind::Scene]).expect_err("no scene");
/// assert!(mistakes.to_string().starts_with("wool.toml: this is a fabric, not a scene"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileKind {
    /// Scene, which is simulated.
    Scene,
    /// Fabric: laws in SI.
    Fabric,
    /// Sheet of measurements, or a folder with one.
    Sheet,
    /// Pattern, as TOML.
    Pattern,
    /// Study of many runs.
    Study,
    /// Drawing of a pattern by another program.
    Drawing,
    /// Mesh of a body.
    Body,
    /// Table of numbers.
    Table,
    /// Workbook of a spreadsheet program.
    Workbook,
    /// Archive of files.
    Archive,
    /// Material of other programs, U3M.
    Material,
    /// Folder of a run.
    Run,
    /// Picture.
    Picture,
    /// Page for a browser.
    Page,
}

/// Keys at the top of a sheet. Every sheet with a measurement has one of them.
const SHEET_KEYS: [&str; 19] = [
    "curve", "warp", "weft", "mean", "W", "T", "T0", "TM", "LC", "WC", "RC", "MIU", "MMD", "SMD",
    "B", "2HB", "G", "2HG", "EM",
];

/// Keys that only scenes have. `panel` is a further one if its panels are in a list.
const SCENE_KEYS: [&str; 7] = ["garment", "time", "collider", "pin", "sew", "settle", "solver"];

/// Keys with a text. A study has one of them, in addition to the tables of [`STUDY_TABLES`].
const STUDY_KEYS: [&str; 3] = ["scene", "fit", "test"];

/// Tables of studies.
const STUDY_TABLES: [&str; 4] = ["axis", "sample", "covariance", "measure"];

impl FileKind {
    /// Returns the kind of the file or folder at `path`, which is read with the given `access`.
    /// Returns `None` if it cannot be read or has no known kind.
    #[must_use]
    pub fn of(path: &Path, access: &FileAccess) -> Option<Self> {
        if path.is_dir() {
            return Self::of_folder(path);
        }
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        // Files of a run have the endings of other files.
        let is_of_run = || path.parent().is_some_and(Recording::exists);
        let kind = match ending.as_str() {
            "json" | "npy" if is_of_run() => Self::Run,
            "svg" | "dxf" => Self::Drawing,
            "json" if holds_panels(path, access) => Self::Drawing,
            "json" => return None,
            "obj" | "stl" | "ply" => Self::Body,
            "csv" | "tsv" | "txt" | "dat" | "asc" | "npy" => Self::Table,
            "xlsx" | "xlsm" | "xls" | "xlsb" | "ods" => Self::Workbook,
            "zip" | "tar" | "gz" | "7z" | "rar" => Self::Archive,
            "u3m" | "u3ma" => Self::Material,
            "png" | "jpg" | "jpeg" | "webp" | "gif" => Self::Picture,
            "html" | "htm" | "pdf" => Self::Page,
            _ => return Self::of_document(&Document::read_with(path, access).ok()?),
        };
        path.exists().then_some(kind)
    }

    /// Returns the kind of a `folder`.
    fn of_folder(folder: &Path) -> Option<Self> {
        let has = |name: &str| folder.join(name).exists();
        if has("sheet.toml") {
            return Some(Self::Sheet);
        }
        (Recording::exists(folder) || has("status.json")).then_some(Self::Run)
    }

    /// Returns the kind of a `document`, by its keys. Returns `None` if it has no known kind.
    #[must_use]
    pub fn of_document(document: &Document) -> Option<Self> {
        let path = document.path();
        let is_unnamed = path.extension().is_none();
        if Pattern::is_drawing(path) || is_unnamed && Pattern::is_drawing_text(document) {
            return Some(Self::Drawing);
        }
        let table: Table = document.decode().ok()?;
        let has = |key: &&str| table.contains_key(*key);
        let is_text = |key: &&str| table.get(*key).is_some_and(Value::is_str);
        let are_in_row = |key: &&str| table.get(*key).is_some_and(Value::is_array);

        if STUDY_KEYS.iter().any(is_text) || STUDY_TABLES.iter().any(are_in_row) {
            return Some(Self::Study);
        }
        if has(&"from") || table.get("panel").is_some_and(Value::is_table) {
            return Some(Self::Pattern);
        }
        if has(&"panel") || SCENE_KEYS.iter().any(has) {
            return Some(Self::Scene);
        }

        let has_law =
            |yarns: &&str| table.get(*yarns).is_some_and(|laws| laws.get("traction").is_some());
        if has(&"density") || has(&"shear") || ["warp", "weft"].iter().any(has_law) {
            return Some(Self::Fabric);
        }
        SHEET_KEYS.iter().any(has).then_some(Self::Sheet)
    }

    /// Refuses a file or folder at `path` whose kind is not `wanted`. The message names its kind,
    /// and the remedy says what can be done with it. A file without a known kind is not refused.
    ///
    /// # Errors
    /// The file has another kind.
    pub fn expect(path: &Path, wanted: &[Self]) -> Result<(), Diagnostics> {
        match Self::of(path, FileAccess::usual()) {
            Some(Self::Run) if path.is_file() => Err(Self::Run.refused(path, wanted).into()),
            Some(kind) if !wanted.contains(&kind) => Err(kind.refused(path, wanted).into()),
            _ => Ok(()),
        }
    }

    /// Refuses a `document` whose kind is not `wanted`, as [`FileKind::expect`] does.
    ///
    /// # Errors
    /// The document has another kind.
    pub fn expect_document(document: &Document, wanted: &[Self]) -> Result<(), Diagnostics> {
        match Self::of_document(document) {
            Some(kind) if !wanted.contains(&kind) => {
                Err(kind.refused(document.path(), wanted).into())
            }
            _ => Ok(()),
        }
    }

    /// Returns the mistake that the file at `path` has this kind and none of `wanted`.
    #[must_use]
    pub fn refused(self, path: &Path, wanted: &[Self]) -> Diagnostic {
        let wanted = listed(wanted);
        match path.parent() {
            Some(folder) if self == Self::Run && path.is_file() => {
                let message = format!("this is a file in the folder of a run, not {wanted}");
                Diagnostic::new(path, message).help(self.advice(folder))
            }
            _ => Diagnostic::new(path, format!("this is {self}, not {wanted}"))
                .help(self.advice(path)),
        }
    }

    /// Returns what can be done with the file or folder at `path` of this kind.
    #[must_use]
    pub fn advice(self, path: &Path) -> Advice {
        let purpose = match self {
            Self::Scene => FilePurpose::Scene,
            Self::Fabric => FilePurpose::Fabric,
            Self::Sheet => FilePurpose::Sheet,
            Self::Pattern => FilePurpose::Pattern,
            Self::Study => FilePurpose::Study,
            Self::Drawing => FilePurpose::Drawing,
            Self::Body => FilePurpose::Body,
            Self::Table | Self::Workbook | Self::Archive => FilePurpose::Table,
            Self::Run => FilePurpose::Run,
            Self::Material => return "name the fabric.toml that it was written from".into(),
            Self::Picture | Self::Page => return "name the file that it shows".into(),
        };

        // A scene names the file of a sheet, not its folder.
        let named = if self == Self::Sheet && path.is_dir() {
            path.join("sheet.toml")
        } else {
            path.to_owned()
        };
        Remedy::UseFile { path: path.to_owned(), named, purpose }.into()
    }
}

impl fmt::Display for FileKind {
    /// Writes the kind with its article to `f`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scene => "a scene",
            Self::Fabric => "a fabric",
            Self::Sheet => "a sheet of measurements",
            Self::Pattern => "a pattern",
            Self::Study => "a study",
            Self::Drawing => "a drawing of a pattern",
            Self::Body => "a mesh of a body",
            Self::Table => "a table",
            Self::Workbook => "a workbook",
            Self::Archive => "an archive",
            Self::Material => "a U3M material",
            Self::Run => "a run",
            Self::Picture => "a picture",
            Self::Page => "a page",
        })
    }
}

/// Returns `kinds` as a list of words.
fn listed(kinds: &[FileKind]) -> String {
    let words: Vec<String> = kinds.iter().map(FileKind::to_string).collect();
    match words.split_last() {
        Some((last, others)) if !others.is_empty() => format!("{} or {last}", others.join(", ")),
        _ => words.concat(),
    }
}

/// Returns whether the JSON file at `path` is a pattern of GarmentCode or FreeSewing, by its keys.
fn holds_panels(path: &Path, access: &FileAccess) -> bool {
    let text = Document::read_with(path, access).ok();
    let value = text.and_then(|document| serde_json::from_str(document.text()).ok());
    value.is_some_and(|value: serde_json::Value| {
        ["pattern", "parts", "stacks"].iter().any(|key| value.get(key).is_some())
    })
}
