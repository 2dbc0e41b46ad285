//! Studies: read, checked, and turned into points.

use std::path::{Path, PathBuf};

use drape_input::{
    Diagnostic, Diagnostics, Document, Setting, SettingError, UnitError, closest, excerpt, toml_key,
};

use crate::axes::{Axis, Group, Reader, value_of};
use crate::base::Base;
use crate::error::Error;
use crate::file::{MeasureFile, StudyFile};
use crate::key::Digests;
use crate::measure::Measure;
use crate::point::{Point, Shard};

/// Files that a run that has ended keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    /// All.
    All,
    /// Its summary, and the last state of the cloth or the fabric.
    Last,
    /// Its summary.
    Measures,
}

/// Study: many runs of one base.
#[derive(Debug, Clone)]
pub struct Study {
    file: PathBuf,
    base: Base,
    /// File of the base, with what is set at all points.
    document: Document,
    options: Vec<String>,
    output: PathBuf,
    keep: Keep,
    /// What is set at all points.
    fixed: Vec<Setting>,
    groups: Vec<Group>,
    measures: Vec<Measure>,
}

impl Study {
    /// Reads a study and its base, which may name files below their folders, the working folder
    /// and those that are allowed.
    ///
    /// # Errors
    /// All mistakes of the study, or those of the grammar of its base.
    pub fn read(path: impl AsRef<Path>, allowed: &[PathBuf]) -> Result<Self, Error> {
        Self::from_document(&Document::read(path)?.allowing(allowed))
    }

    /// Makes a study of a document; the files that it names are seen from the folder of its path.
    ///
    /// # Errors
    /// As for [`read`](Self::read).
    pub fn from_document(document: &Document) -> Result<Self, Error> {
        let file: StudyFile = document.decode()?;
        let (base, name) = Base::of(document, &file)?;
        base.check(document, &file.options)?;
        let own = read(document, base, Path::new(name))?;
        let mut fixed = Vec::new();
        settings("", &file.set, &mut fixed)
            .map_err(|SettingError { message, help }| document.at("set", message).help(help))?;
        let own = own.with_settings(&fixed)?;
        let mut reader = Reader { document, base, own: &own, mistakes: Vec::new() };
        let keep = match file.keep.as_deref() {
            None | Some("all") => Keep::All,
            Some("last") => Keep::Last,
            Some("measures") => Keep::Measures,
            Some(other) => {
                let near = closest(other, ["all", "last", "measures"]).unwrap_or("measures");
                let message = format!("there is no \"{}\"", excerpt(other));
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
        Ok(Self { file, base, document: own, options, output, keep, fixed, groups, measures })
    }

    /// File of the study.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// What its points are runs of.
    #[must_use]
    pub fn base(&self) -> Base {
        self.base
    }

    /// File of its base.
    #[must_use]
    pub fn base_file(&self) -> &Path {
        self.document.path()
    }

    /// Options of the fits or tests.
    #[must_use]
    pub fn options(&self) -> &[String] {
        &self.options
    }

    /// Folder for the results.
    #[must_use]
    pub fn output(&self) -> &Path {
        &self.output
    }

    /// Returns the study with another folder for the results.
    #[must_use]
    pub fn with_output(mut self, folder: PathBuf) -> Self {
        self.output = folder;
        self
    }

    /// Files that a run that has ended keeps.
    #[must_use]
    pub fn keep(&self) -> Keep {
        self.keep
    }

    /// Axes in the order of their columns.
    pub fn axes(&self) -> impl Iterator<Item = &Axis> {
        self.groups.iter().flat_map(|group| &group.axes)
    }

    /// Values of the summaries that have columns in the table; all of them if there are none.
    #[must_use]
    pub fn measures(&self) -> &[Measure] {
        &self.measures
    }

    /// Returns the number of all points.
    #[must_use]
    pub fn point_count(&self) -> usize {
        self.groups.iter().map(Group::len).product()
    }

    /// Returns all points, or those of a part, with their keys for a version of a program, in the
    /// order of the plan: the last axis changes first.
    ///
    /// # Errors
    /// A key of an axis leads nowhere at one of the points.
    pub fn points(&self, program: &str, shard: Option<Shard>) -> Result<Vec<Point>, Error> {
        let mut digests = Digests::new(self.base, &self.options);
        let is_asked = |index: &usize| shard.is_none_or(|shard| shard.contains(*index));
        let indices = (0..self.point_count()).filter(is_asked);
        indices.map(|index| self.point(index, program, &mut digests)).collect()
    }

    fn point(&self, index: usize, program: &str, digests: &mut Digests) -> Result<Point, Error> {
        let mut rest = index;
        let mut rows = vec![0; self.groups.len()];
        for (row, group) in rows.iter_mut().zip(&self.groups).rev() {
            *row = rest % group.len();
            rest /= group.len();
        }
        let groups = self.groups.iter().zip(rows);
        let chosen = groups
            .flat_map(|(group, row)| group.axes.iter().map(move |axis| (axis, &axis.levels[row])));
        let (mut levels, mut settings) = (Vec::new(), Vec::new());
        let mut document = self.document.clone();
        for (axis, level) in chosen {
            levels.push(level.clone());
            if axis.key == self.base.key() {
                document = self.other(level)?;
                continue;
            }
            let setting = Setting::new(&axis.key, level);
            let wrong = |error| Diagnostic::new(&self.file, format!("{}: {error}", axis.key));
            settings.push(setting.map_err(wrong)?);
        }
        let document = document.with_settings(&settings)?;
        let settings = self.fixed.iter().cloned().chain(settings).collect();
        let file = document.path().to_owned();
        Ok(Point { index, key: digests.key(&document, program), levels, file, settings })
    }

    /// Reads another file in place of that of the base, which a level names as seen from the study.
    fn other(&self, level: &str) -> Result<Document, Error> {
        let name = value_of(level).as_str().map(str::to_owned).unwrap_or_default();
        let folder = self.file.parent().unwrap_or(Path::new(""));
        let document = Document::read(folder.join(name))?.allowing(self.document.allowed());
        Ok(document.with_settings(&self.fixed)?)
    }
}

/// Reads the base of a study.
fn read(document: &Document, base: Base, name: &Path) -> Result<Document, Error> {
    let path = document.beside(name).map_err(|misplaced| {
        document.at(base.key(), misplaced.to_string()).help(misplaced.help())
    })?;
    let own = Document::read(&path).map_err(|Diagnostics(mistakes)| {
        let message = mistakes.into_iter().map(|mistake| mistake.message).collect::<String>();
        document.at(base.key(), message).help("name a file of TOML, relative to the study")
    })?;
    let own = own.allowing(document.allowed());
    own.decode::<toml::Table>()?;
    Ok(own)
}

/// Adds the values of a table, with the paths of their keys.
fn settings(path: &str, table: &toml::Table, found: &mut Vec<Setting>) -> Result<(), SettingError> {
    for (name, value) in table {
        let name = toml_key(name);
        let path = if path.is_empty() { name } else { format!("{path}.{name}") };
        match value {
            toml::Value::Table(table) => settings(&path, table, found)?,
            value => found.push(Setting::new(&path, &value.to_string())?),
        }
    }
    Ok(())
}

/// Returns the measures of a study, each name once.
fn measures(reader: &mut Reader<'_>, files: &[MeasureFile]) -> Vec<Measure> {
    let mut measures: Vec<Measure> = Vec::new();
    for (index, MeasureFile { key, name, unit }) in files.iter().enumerate() {
        let place = format!("measure[{index}]");
        match Measure::new(key, name.as_deref(), unit.as_deref()) {
            Err(UnitError { message, help, .. }) => {
                reader.fail(&format!("{place}.unit"), message, help)
            }
            Ok(own) if measures.iter().any(|other| other.name == own.name) => {
                let message = format!("two measures have the name \"{}\"", excerpt(&own.name));
                reader.fail(&place, message, "give each measure its own name");
            }
            Ok(own) => measures.push(own),
        }
    }
    measures
}
