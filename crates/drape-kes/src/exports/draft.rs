//! Sheets drafted from a laboratory's files.

use std::path::{Path, PathBuf};

use drape_input::{Diagnostic, Document, FileAccess, Remedy, toml_string};

use crate::error::Error;
use crate::exports::contents::FileContents;
use crate::exports::curve_draft::{CurveDraft, single_line};
use crate::exports::fabrics::{FabricContents, by_fabric};
use crate::exports::file_curves::OpenDraft;
use crate::exports::files::{Files, holds_tables, relative};
use crate::exports::value_lines::value_lines;
use crate::results::converted::convert;
use crate::sheets::sheet::Sheet;

/// Sheet of one fabric, drafted from a laboratory's files.
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
    /// Name of the fabric in the files. Files without a name give the name of the folder or the
    /// file.
    pub name: String,
    /// Text of the sheet, as TOML with comments.
    pub text: String,
    /// Number of curves of the sheet.
    pub curves: usize,
    /// Number of KES values of the sheet.
    pub values: usize,
    /// Number of sections that a person has to complete, written as comments.
    pub open: usize,
    /// Source and interpretation of each value, one line per value.
    pub readings: Vec<String>,
    /// Assumptions, questions and omissions, one line each.
    pub notes: Vec<String>,
    /// Folder of the files, which the sheet may name.
    folder: PathBuf,
    /// Access to the files.
    access: FileAccess,
}

/// Returns `draft` with the names of its files relative to the folder of the sheet. `folder` is the
/// path from there to the files.
fn with_paths(draft: &CurveDraft, folder: &str) -> CurveDraft {
    let mut draft = draft.clone();
    if !folder.is_empty() {
        draft.files.iter_mut().for_each(|file| *file = format!("{folder}/{file}"));
    }
    draft
}

impl SheetDraft {
    /// Drafts the sheets of the files at `path`, one sheet per fabric. The `path` is a workbook, a
    /// table, a zip archive, or a folder whose exports and subfolders are read. `beside` is the
    /// folder of the sheets. Archives need the feature `archives`, workbooks the feature
    /// `spreadsheets`.
    ///
    /// # Errors
    /// The file or the folder cannot be read, or no file holds a curve or a value. The error names
    /// each file with the reason, such as a feature that the crate was built without.
    pub fn of(path: &Path, beside: &Path) -> Result<Vec<Self>, Error> {
        Self::of_with(path, beside, FileAccess::usual())
    }

    /// Drafts the sheets of the files at `path` as [`of`](Self::of) does. The files are read with
    /// the given `access`, and may be in memory.
    ///
    /// # Errors
    /// The errors of [`of`](Self::of).
    pub fn of_with(path: &Path, beside: &Path, access: &FileAccess) -> Result<Vec<Self>, Error> {
        let files = Files::from_path(path, access)?;
        let contents = FileContents::from_files(&files);
        if contents.is_empty() {
            return Err(contents.nothing(path).into());
        }
        let folder = relative(&files.folder, beside);
        let fabrics = by_fabric(contents);
        Ok(fabrics.into_iter().map(|fabric| Self::draft_fabric(fabric, &files, &folder)).collect())
    }

    /// Drafts the sheets of the file `name` with the content `bytes`, as [`of`](Self::of) does for
    /// a file: a workbook, a table or a zip archive. The ending of `name` may say which.
    ///
    /// # Errors
    /// The errors of [`of`](Self::of).
    ///
    /// ```
    /// use drape_kes::SheetDraft;
    /// use std::path::Path;
    ///
    /// let text = "Curvature (1/cm),Moment (gf.cm/cm)\n-2,-0.2\n0,0.01\n2,0.22\n0,-0.01\n-2,-0.2\n";
    /// let drafts = SheetDraft::from_bytes("bending-warp.csv", text.as_bytes())?;
    /// let sheet = drafts[0].read(Path::new(""))?;
    /// assert_eq!(sheet.curves[0].load().len(), 5);
    /// # Ok::<(), drape_kes::Error>(())
    /// ```
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Vec<Self>, Error> {
        let access = FileAccess::default().holding(name, bytes);
        Self::of_with(Path::new(name), Path::new(""), &access)
    }

    /// Drafts the sheet of the exports of one fabric in `folder` and its subfolders, in the manner
    /// of [`of`](Self::of).
    ///
    /// # Errors
    /// The errors of [`of`](Self::of), or the folder holds several fabrics.
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

    /// Reads the sheet at `path`, a file or a folder with a `sheet.toml`. For other files the sheet
    /// is drafted and read: a workbook, a table, an archive or a folder of exports. `fabric` names
    /// the fabric where the files hold several.
    ///
    /// # Errors
    /// The errors of [`Sheet::read`] and [`of`](Self::of), or the files hold several fabrics and
    /// `fabric` names none of them.
    pub fn sheet(path: &Path, fabric: Option<&str>) -> Result<Sheet, Error> {
        let is_folder = path.is_dir() && !path.join("sheet.toml").exists();
        if !is_folder && !Self::reads(path) {
            return Sheet::read(path);
        }
        let beside = if path.is_dir() { path } else { path.parent().unwrap_or(Path::new("")) };
        let drafts = Self::of(path, beside)?;
        Self::chosen(drafts, path, fabric)?.read(beside)
    }

    /// Returns the draft of the `fabric` among `drafts`, or the only draft. `path` is named in the
    /// error.
    ///
    /// # Errors
    /// There is no such fabric, or `fabric` is `None` and there are several.
    pub fn chosen(drafts: Vec<Self>, path: &Path, fabric: Option<&str>) -> Result<Self, Error> {
        let names: Vec<String> = drafts.iter().map(|draft| draft.name.clone()).collect();
        let chosen = match fabric {
            None if drafts.len() == 1 => drafts.into_iter().next(),
            None => None,
            Some(fabric) => drafts.into_iter().find(|draft| draft.name == fabric),
        };
        chosen.ok_or_else(|| {
            let message = match fabric {
                Some(fabric) => format!("there is no fabric \"{fabric}\" in it"),
                None => "it holds several fabrics".to_owned(),
            };
            let remedy = Remedy::ChooseFabric { names };
            Error::Input(Diagnostic::new(path, message).help(remedy).into())
        })
    }

    /// Returns whether `file` holds tables, or is an archive of such files: a workbook, a text file
    /// with a usual ending, or a zip archive.
    #[must_use]
    pub fn reads(file: &Path) -> bool {
        holds_tables(file)
    }

    /// Reads the sheet as a file in the folder `beside`, for which it was drafted. The readings of
    /// the sheet name the source of each value.
    ///
    /// # Errors
    /// The errors of [`Sheet::from_document`].
    pub fn read(&self, beside: &Path) -> Result<Sheet, Error> {
        let document = Document::new(beside.join("sheet.toml"), self.text.clone());
        self.read_document(document.with_access(&self.access))
    }

    /// Reads a `document` with the text of the draft, in the manner of [`read`](Self::read). Values
    /// of the document may have been changed.
    ///
    /// # Errors
    /// The errors of [`Sheet::from_document`].
    pub fn read_document(&self, document: Document) -> Result<Sheet, Error> {
        let mut access = document.access().clone();
        access.allowed.push(self.whole_folder());
        let mut sheet = Sheet::from_document(&document.with_access(&access))?;
        sheet.add_readings(&self.readings, &self.notes);
        Ok(sheet)
    }

    /// Returns the folder of the files, `.` for the current folder.
    fn whole_folder(&self) -> PathBuf {
        if self.folder.as_os_str().is_empty() { PathBuf::from(".") } else { self.folder.clone() }
    }

    /// Drafts the sheet of one `fabric` from `files`. `folder` is the path from the folder of the
    /// sheet to the files.
    fn draft_fabric(fabric: FabricContents, files: &Files, folder: &str) -> Self {
        let FabricContents { name, values, contents } = fabric;
        let name = name.unwrap_or_else(|| files.name.clone());
        let mut draft =
            Self { folder: files.folder.clone(), access: files.access.clone(), ..Self::default() };

        let value_lines = value_lines(&convert(values), files);
        let head = format!(
            "# Sheet of {}, drafted by drape. Everything detected is a key\n\
             # with its reason: correct what is wrong, then fit a fabric to it.\n\
             name = {}\n# source = \"who measured it, when, under which licence\"\n",
            single_line(&files.title),
            toml_string(&name)
        );
        draft.name = name;
        draft.text = head + &value_lines.text;
        (draft.values, draft.readings) = (value_lines.values, value_lines.readings);
        draft.notes.extend(value_lines.notes);
        draft.add_curves(&contents, folder);

        draft.notes.extend(contents.notes.iter().cloned());
        if !contents.notes.is_empty() {
            draft.text += "\n# What else the files hold:\n";
            contents
                .notes
                .iter()
                .for_each(|note| draft.text += &format!("#   {}\n", single_line(note)));
        }
        if !contents.unread.is_empty() {
            draft.text += "\n# Files that are not in the sheet:\n";
        }
        for (file, reason) in &contents.unread {
            let reason = single_line(reason);
            draft.text += &format!("#   {}: {reason}\n", single_line(file));
            draft.notes.push(format!("{file} is left out: {reason}"));
        }
        draft
    }

    /// Adds the remarks on `curve` to the notes.
    fn add_remarks(&mut self, curve: &CurveDraft) {
        let files = curve.files.join(", ");
        self.notes.extend(curve.remarks.iter().map(|remark| format!("{files}: {remark}")));
    }

    /// Writes the curves of `contents`. Curves that a person has to complete, and curves on the
    /// bias, are written as comments.
    fn add_curves(&mut self, contents: &FileContents, folder: &str) {
        for curve in &contents.curves {
            self.text += &format!("\n{}", with_paths(curve, folder).to_toml());
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

        (self.curves, self.open) = (contents.curves.len(), contents.open.len());
        for OpenDraft { draft: curve, reason } in &contents.open {
            let reason = single_line(reason);
            self.text += &format!("\n# Not taken: {reason}.\n# Correct and uncomment:\n");
            self.text += &with_paths(curve, folder).to_comment();
            self.notes.push(format!("{} is not taken: {reason}", curve.files.join(", ")));
            self.add_remarks(curve);
        }

        for OpenDraft { draft: curve, reason } in &contents.bias {
            let (reason, files) = (single_line(reason), curve.files.join(", "));
            self.text += &format!(
                "\n# Left out: {files}, since {reason}.\n# If it was cut along a yarn, correct and uncomment:\n"
            );
            self.text += &with_paths(curve, folder).to_comment();
            self.notes.push(format!("{files} is left out: {reason}"));
        }
    }
}
