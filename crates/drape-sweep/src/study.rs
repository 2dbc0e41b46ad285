//! Study: a study that has been read and checked, and its points.

use std::path::{Path, PathBuf};

use drape_input::{
    Diagnostic, Diagnostics, Document, FileAccess, Setting, SettingError, ValueError, closest,
    excerpt, toml_key,
};

use crate::axes::{Axis, Group, Reader, level_value};
use crate::base::Base;
use crate::error::Error;
use crate::file::{MeasureFile, StudyFile};
use crate::key::Digests;
use crate::measure::Measure;
use crate::point::{Point, Shard};

/// Files of a finished run that a study keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    /// All files.
    All,
    /// The summary, and the last state of the cloth or the fabric.
    Last,
    /// The summary.
    Measures,
}

/// Study: many runs of one base.
#[derive(Debug, Clone)]
pub struct Study {
    file: PathBuf,
    base: Base,
    /// File of the base, with the settings of all points.
    document: Document,
    options: Vec<String>,
    output: PathBuf,
    keep: Keep,
    /// Settings of all points.
    fixed: Vec<Setting>,
    groups: Vec<Group>,
    measures: Vec<Measure>,
}

impl Study {
    /// Reads the study in the file `path` and its base. Both may name files in their folders, the
    /// working folder, and the files and folders `allowed`.
    ///
    /// # Errors
    /// All mistakes of the study, or the mistakes of grammar of its base.
    pub fn read(path: impl AsRef<Path>, access: &FileAccess) -> Result<Self, Error> {
        Self::from_document(&Document::read_with(path, access)?)
    }

    /// Reads the study in `document`. The names of files are relative to the folder of its path.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read).
    pub fn from_document(document: &Document) -> Result<Self, Error> {
        let file: StudyFile = document.decode()?;
        let (base, name) = Base::from_file(document, &file)?;
        base.check(document, &file.options)?;
        let base_document = read_base(document, base, Path::new(name))?;

        // The settings of all points apply before the levels of the axes are checked.
        let mut fixed = Vec::new();
        add_settings("", &file.set, &mut fixed)
            .map_err(|SettingError { message, help }| document.at("set", message).help(help))?;
        let base_document = base_document.with_settings(&fixed)?;

        let mistakes = Vec::new();
        let mut reader = Reader { document, base, base_document: &base_document, mistakes };
        let keep = match file.keep.as_deref() {
            None | Some("all") => Keep::All,
            Some("last") => Keep::Last,
            Some("measures") => Keep::Measures,
            Some(unknown) => {
                let near = closest(unknown, ["all", "last", "measures"]).unwrap_or("measures");
                let message = format!("there is no \"{}\"", excerpt(unknown));
                let help =
                    format!("write \"all\", \"last\" or \"measures\"; did you mean \"{near}\"?");
                reader.mistakes.push(document.at("keep", message).help(help));
                Keep::All
            }
        };
        let groups = reader.groups(&file);
        let measures = measures(&mut reader, &file.measure);
        Diagnostics::check(reader.mistakes)?;

        let output = match file.output {
            Some(folder) => document.beside(&folder).map_err(|misplaced| {
                document.at("output", misplaced.to_string()).help(misplaced.help())
            })?,
            None => Path::new("out").join(document.path().file_stem().unwrap_or_default()),
        };
        let (options, file) = (file.options, document.path().to_owned());
        Ok(Self {
            file,
            base,
            document: base_document,
            options,
            output,
            keep,
            fixed,
            groups,
            measures,
        })
    }

    /// Returns the path of the study, as given.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// Returns the [`Base`] of all points.
    #[must_use]
    pub fn base(&self) -> Base {
        self.base
    }

    /// Returns the file of the base.
    #[must_use]
    pub fn base_file(&self) -> &Path {
        self.document.path()
    }

    /// Returns the options of the fits or tests, such as `--drape`.
    #[must_use]
    pub fn options(&self) -> &[String] {
        &self.options
    }

    /// Returns the folder for the results.
    #[must_use]
    pub fn output(&self) -> &Path {
        &self.output
    }

    /// Returns the study with `folder` as the folder for the results.
    #[must_use]
    pub fn with_output(mut self, folder: PathBuf) -> Self {
        self.output = folder;
        self
    }

    /// Returns which files of a finished run the study keeps.
    #[must_use]
    pub fn keep(&self) -> Keep {
        self.keep
    }

    /// Returns the axes in the order of their columns.
    pub fn axes(&self) -> impl Iterator<Item = &Axis> {
        self.groups.iter().flat_map(|group| &group.axes)
    }

    /// Returns the measures that have columns in the table. If there are none, all values of the
    /// summaries have columns.
    #[must_use]
    pub fn measures(&self) -> &[Measure] {
        &self.measures
    }

    /// Returns the number of all points.
    #[must_use]
    pub fn point_count(&self) -> usize {
        self.groups.iter().map(Group::level_count).product()
    }

    /// Returns all points, or the points of `shard`, in the order of the plan: the last axis
    /// changes first. The keys of the points depend on `program`, the version of the program.
    ///
    /// # Errors
    /// [`Error::Input`] if a key of an axis leads nowhere at one of the points.
    pub fn points(&self, program: &str, shard: Option<Shard>) -> Result<Vec<Point>, Error> {
        let mut digests = Digests::new(self.base, &self.options);
        (0..self.point_count())
            .filter(|index| shard.is_none_or(|shard| shard.contains(*index)))
            .map(|index| self.point(index, program, &mut digests))
            .collect()
    }

    /// Returns the point with the number `index` in the order of the plan.
    fn point(&self, index: usize, program: &str, digests: &mut Digests) -> Result<Point, Error> {
        // The number is written in a mixed radix, with one digit for the levels of each group.
        let mut remainder = index;
        let mut rows = vec![0; self.groups.len()];
        for (row, group) in rows.iter_mut().zip(&self.groups).rev() {
            *row = remainder % group.level_count();
            remainder /= group.level_count();
        }

        let groups = self.groups.iter().zip(rows);
        let chosen_levels = groups
            .flat_map(|(group, row)| group.axes.iter().map(move |axis| (axis, &axis.levels[row])));
        let (mut levels, mut settings) = (Vec::new(), Vec::new());
        let mut document = self.document.clone();
        for (axis, level) in chosen_levels {
            levels.push(level.clone());
            if axis.key == self.base.key() {
                document = self.read_other_base(level)?;
                continue;
            }
            let setting = Setting::new(&axis.key, level)
                .map_err(|error| Diagnostic::new(&self.file, format!("{}: {error}", axis.key)))?;
            settings.push(setting);
        }

        let document = document.with_settings(&settings)?;
        let settings = self.fixed.iter().cloned().chain(settings).collect();
        let file = document.path().to_owned();
        Ok(Point { index, key: digests.key(&document, program), levels, file, settings })
    }

    /// Reads the file that `level` names, relative to the study, as the base of a point.
    fn read_other_base(&self, level: &str) -> Result<Document, Error> {
        let name = level_value(level).as_str().map(str::to_owned).unwrap_or_default();
        let folder = self.file.parent().unwrap_or(Path::new(""));
        let document = Document::read_with(folder.join(name), self.document.access())?;
        Ok(document.with_settings(&self.fixed)?)
    }
}

/// Reads the file `name` as the base of the study `document`.
fn read_base(document: &Document, base: Base, name: &Path) -> Result<Document, Error> {
    let path = document.beside(name).map_err(|misplaced| {
        document.at(base.key(), misplaced.to_string()).help(misplaced.help())
    })?;
    let read = Document::read_with(&path, document.access());
    let base_document = read.map_err(|Diagnostics(mistakes)| {
        let message = mistakes.into_iter().map(|mistake| mistake.message).collect::<String>();
        document.at(base.key(), message).help("name a file of TOML, relative to the study")
    })?;
    base_document.decode::<toml::Table>()?;
    Ok(base_document)
}

/// Adds a setting to `settings` for each value of `table`, which is at the key path `path`.
fn add_settings(
    path: &str,
    table: &toml::Table,
    settings: &mut Vec<Setting>,
) -> Result<(), SettingError> {
    for (name, value) in table {
        let name = toml_key(name);
        let path = if path.is_empty() { name } else { format!("{path}.{name}") };
        match value {
            toml::Value::Table(table) => add_settings(&path, table, settings)?,
            value => settings.push(Setting::new(&path, &value.to_string())?),
        }
    }
    Ok(())
}

/// Returns the measures in `files`. A measure with the name of an earlier one is a mistake.
fn measures(reader: &mut Reader<'_>, files: &[MeasureFile]) -> Vec<Measure> {
    let mut measures: Vec<Measure> = Vec::new();
    for (index, MeasureFile { key, name, unit }) in files.iter().enumerate() {
        let key_path = format!("measure[{index}]");
        match Measure::new(key, name.as_deref(), unit.as_deref()) {
            Err(ValueError { message, help, .. }) => {
                reader.fail(&format!("{key_path}.unit"), message, help)
            }
            Ok(measure) if measures.iter().any(|earlier| earlier.name == measure.name) => {
                let message = format!("two measures have the name \"{}\"", excerpt(&measure.name));
                reader.fail(&key_path, message, "give each measure its own name");
            }
            Ok(measure) => measures.push(measure),
        }
    }
    measures
}
