//! Files of a laboratory, drafted as sheets.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Document, toml_string};

use crate::error::Error;
use crate::exports::curve_draft::{CurveDraft, plain};
use crate::exports::fabrics::{OfFabric, by_fabric};
use crate::exports::files::{Files, is_of_tables, relative};
use crate::exports::found::OpenDraft;
use crate::exports::parts::Parts;
use crate::exports::value_lines::value_lines;
use crate::results::converted::converted;
use crate::sheets::sheet::Sheet;

/// Sheet of one fabric drafted from the files of a laboratory.
///
/// ```
/// use drape_kes::SheetDraft;
///
/// # let folder = std::env::temp_dir().join(format!("drape-kes-draft-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder).expect("a folder");
/// let text = "Curvature (1/cm),Moment (gf.cm/cm)\n-2,-0.2\n0,0.01\n2,0.22\n0,-0.01\n-2,-0.2\n";
/// std::fs::write(folder.join("bending-warp.csv"), text).expect("written");
/// let draft = SheetDraft::of_folder(&folder, &folder)?;
/// assert_eq!((draft.curves, draft.open), (1, 0));
/// assert!(draft.text.contains("test = \"bending\""));
/// assert!(draft.text.contains("direction = \"warp\""));
/// assert_eq!(draft.read(&folder)?.curves.len(), 1);
/// # std::fs::remove_dir_all(&folder).expect("it was just made");
/// # Ok::<(), drape_kes::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetDraft {
    /// Name of the fabric: in the files, else of the folder or the file.
    pub name: String,
    /// Text of the sheet, as TOML with comments.
    pub text: String,
    /// Curves of the sheet.
    pub curves: usize,
    /// KES values of the sheet.
    pub values: usize,
    /// Sections that need a word, written as comments.
    pub open: usize,
    /// What each value was taken for, and where it stands, a line each.
    pub readings: Vec<String>,
    /// What was assumed, what needs a word, and what was left out, a line each.
    pub notes: Vec<String>,
    /// Folder of the files, which the sheet may name.
    folder: PathBuf,
}

/// Folder of the files, and the way to it from the folder of the sheet.
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

impl SheetDraft {
    /// Drafts the sheets of a workbook, a table, a zip archive, or all exports in a folder and the
    /// folders below: one for each fabric. `beside` is the folder where the sheets will lie.
    ///
    /// # Errors
    /// The file or the folder cannot be read, or nothing in it is a curve or a value: each file is
    /// named with the reason.
    pub fn of(path: &Path, beside: &Path) -> Result<Vec<Self>, Error> {
        let files = Files::of(path)?;
        let parts = Parts::of(&files);
        if parts.is_empty() {
            return Err(parts.nothing(path).into());
        }
        let places = Places { folder: &files.folder, way: relative(&files.folder, beside) };
        let fabrics = by_fabric(parts);
        Ok(fabrics.into_iter().map(|fabric| Self::of_fabric(fabric, &files, &places)).collect())
    }

    /// Drafts the sheet of all exports of one fabric in a folder and the folders below, as
    /// [`of`](Self::of) does.
    ///
    /// # Errors
    /// As for [`of`](Self::of); or the folder holds several fabrics.
    pub fn of_folder(folder: &Path, beside: &Path) -> Result<Self, Error> {
        let mut drafts = Self::of(folder, beside)?;
        if drafts.len() > 1 {
            let names: Vec<&str> = drafts.iter().map(|draft| draft.name.as_str()).collect();
            let message = format!("the folder holds several fabrics: {}", names.join(", "));
            let finding = Diagnostic::new(folder, message).help("draft each of them");
            return Err(Error::Input(finding.into()));
        }
        Ok(drafts.swap_remove(0))
    }

    /// Reads a sheet, a file or the `sheet.toml` of a folder; or drafts and reads the sheet of a
    /// workbook, a table, an archive or a folder of exports, that of one `fabric` where they hold
    /// several.
    ///
    /// # Errors
    /// As for [`Sheet::read`] and [`of`](Self::of); or there are several fabrics, and none of them
    /// is named.
    pub fn sheet(path: &Path, fabric: Option<&str>) -> Result<Sheet, Error> {
        let is_folder = path.is_dir() && !path.join("sheet.toml").exists();
        if !is_folder && !Self::reads(path) {
            return Sheet::read(path);
        }
        let beside = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
        let drafts = Self::of(path, beside)?;
        Self::chosen(drafts, path, fabric)?.read(beside)
    }

    /// Returns the draft of a fabric, or the only one.
    ///
    /// # Errors
    /// There is no such fabric; or there are several, and none of them is named.
    pub fn chosen(drafts: Vec<Self>, path: &Path, fabric: Option<&str>) -> Result<Self, Error> {
        let names: Vec<String> = drafts.iter().map(|draft| draft.name.clone()).collect();
        let found = match fabric {
            None if drafts.len() == 1 => drafts.into_iter().next(),
            None => None,
            Some(wanted) => drafts.into_iter().find(|draft| draft.name == wanted),
        };
        found.ok_or_else(|| {
            let message = match fabric {
                Some(wanted) => format!("there is no fabric \"{wanted}\" in it"),
                None => "it holds several fabrics".to_owned(),
            };
            let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
            let help = format!("name one of {} by --fabric (in Python fabric=)", names.join(", "));
            Error::Input(Diagnostic::new(path, message).help(help).into())
        })
    }

    /// Returns whether a file holds tables, or is an archive of them: a workbook, a text file of
    /// one of the usual endings, a zip.
    #[must_use]
    pub fn reads(file: &Path) -> bool {
        is_of_tables(file)
    }

    /// Reads the sheet as if it were a file in the folder for which it was drafted; its readings
    /// say what each value was taken for.
    ///
    /// # Errors
    /// As for [`Sheet::from_document`].
    pub fn read(&self, beside: &Path) -> Result<Sheet, Error> {
        let document = Document::new(beside.join("sheet.toml"), self.text.clone());
        self.read_document(document)
    }

    /// Reads a document with the text of the draft, perhaps with values that were set, as
    /// [`read`](Self::read) does.
    ///
    /// # Errors
    /// As for [`Sheet::from_document`].
    pub fn read_document(&self, document: Document) -> Result<Sheet, Error> {
        let allowed: Vec<PathBuf> =
            document.allowed().iter().cloned().chain([self.whole_folder()]).collect();
        let mut sheet = Sheet::from_document(&document.allowing(&allowed))?;
        sheet.add_readings(&self.readings, &self.notes);
        Ok(sheet)
    }

    fn whole_folder(&self) -> PathBuf {
        let here = self.folder.as_os_str().is_empty();
        if here { PathBuf::from(".") } else { self.folder.clone() }
    }

    /// Writes the sheet of one fabric.
    fn of_fabric(fabric: OfFabric, files: &Files, places: &Places<'_>) -> Self {
        let OfFabric { name, values, parts } = fabric;
        let name = name.unwrap_or_else(|| files.name.clone());
        let mut draft = Self { folder: files.folder.clone(), ..Self::default() };
        let lines = value_lines(&converted(values), places.folder);
        let head = format!(
            "# Sheet of {}, drafted by drape. Everything detected is a key\n\
             # with its reason: correct what is wrong. `drape check` reads it, `drape fit` fits it.\n\
             name = {}\n# source = \"who measured it, when, under which licence\"\n",
            plain(&files.title),
            toml_string(&name)
        );
        draft.name = name;
        draft.text = head + &lines.text;
        (draft.values, draft.readings) = (lines.values, lines.readings);
        draft.notes.extend(lines.notes);
        draft.add_curves(&parts, places);
        draft.notes.extend(parts.notes.iter().cloned());
        if !parts.notes.is_empty() {
            draft.text += "\n# What else the files hold:\n";
            parts.notes.iter().for_each(|note| draft.text += &format!("#   {}\n", plain(note)));
        }
        if !parts.unread.is_empty() {
            draft.text += "\n# Files that are not in the sheet:\n";
        }
        for (file, reason) in &parts.unread {
            let reason = plain(reason);
            draft.text += &format!("#   {}: {reason}\n", plain(file));
            draft.notes.push(format!("{file} is left out: {reason}"));
        }
        draft
    }

    /// Adds the remarks on a curve to the notes.
    fn add_remarks(&mut self, curve: &CurveDraft) {
        let files = curve.files.join(", ");
        self.notes.extend(curve.remarks.iter().map(|remark| format!("{files}: {remark}")));
    }

    /// Writes the curves; those that need a word, and those on the bias, as comments.
    fn add_curves(&mut self, parts: &Parts, places: &Places<'_>) {
        for curve in &parts.curves {
            self.text += &format!("\n{}", places.placed(curve).to_toml());
            let keys = curve.layout.iter().chain(curve.axes.iter().flatten());
            let file = curve.files.join(", ");
            let assumed = keys.map(|key| &key.why).chain([&curve.test.why]);
            let assumed = assumed.filter(|why| why.contains("ASSUMED"));
            self.notes.extend(assumed.map(|why| format!("{file}: {why}")));
            if curve.files.len() > 1 {
                self.notes.push(format!("{file}: taken for repeats of one test"));
            }
            self.add_remarks(curve);
        }
        (self.curves, self.open) = (parts.curves.len(), parts.open.len());
        for OpenDraft { draft: curve, reason } in &parts.open {
            let reason = plain(reason);
            self.text += &format!("\n# Not taken: {reason}.\n# Correct and uncomment:\n");
            self.text += &places.placed(curve).to_comment();
            self.notes.push(format!("{} is not taken: {reason}", curve.files.join(", ")));
            self.add_remarks(curve);
        }
        for OpenDraft { draft: curve, reason } in &parts.bias {
            let (reason, files) = (plain(reason), curve.files.join(", "));
            self.text += &format!(
                "\n# Left out: {files}, since {reason}.\n# If it was cut along a yarn, correct and uncomment:\n"
            );
            self.text += &places.placed(curve).to_comment();
            self.notes.push(format!("{files} is left out: {reason}"));
        }
    }
}
