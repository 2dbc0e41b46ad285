//! Studies: read, checked, and turned into points.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape_input::{
    Diagnostic, Diagnostics, Document, Setting, SettingError, TextOr, closest, excerpt, toml_string,
};

use crate::axis::{Axis, Group, Range};
use crate::design::Method;
use crate::error::Error;
use crate::file::{AxisFile, SampleFile, StudyFile};
use crate::key::Digests;
use crate::point::Point;

/// Largest number of points of a study. Each takes memory and files.
const POINTS_MAX: usize = 100_000;

/// Files that a run that has ended keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keep {
    /// All.
    All,
    /// Its summary and the last state of the cloth.
    Last,
    /// Its summary.
    Measures,
}

/// Study: many runs of one scene.
#[derive(Debug, Clone)]
pub struct Study {
    file: PathBuf,
    scene: Document,
    output: PathBuf,
    keep: Keep,
    groups: Vec<Group>,
}

impl Study {
    /// Reads a study and its scene, which may name files below their folders, the working folder
    /// and those that are allowed.
    ///
    /// # Errors
    /// All mistakes of the study, or those of the grammar of its scene.
    pub fn read(path: impl AsRef<Path>, allowed: &[PathBuf]) -> Result<Self, Error> {
        Self::from_document(&Document::read(path)?.allowing(allowed))
    }

    /// Makes a study of a document; the files that it names are seen from the folder of its path.
    ///
    /// # Errors
    /// As for [`read`](Self::read).
    pub fn from_document(document: &Document) -> Result<Self, Error> {
        let file: StudyFile = document.decode()?;
        let scene = document.beside(&file.scene).map_err(|misplaced| {
            document.at("scene", misplaced.to_string()).help(misplaced.help())
        })?;
        let scene = Document::read(&scene).map_err(|Diagnostics(mistakes)| {
            let message = mistakes.into_iter().map(|mistake| mistake.message).collect::<String>();
            document.at("scene", message).help("name a scene, relative to the study")
        })?;
        let scene = scene.allowing(document.allowed());
        scene.decode::<toml::Table>()?;
        let mut reader = Reader { document, scene: &scene, mistakes: Vec::new() };
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
        Diagnostics::check(reader.mistakes)?;
        let output = match file.output {
            Some(folder) => document.beside(&folder).map_err(|misplaced| {
                document.at("output", misplaced.to_string()).help(misplaced.help())
            })?,
            None => Path::new("out").join(document.path().file_stem().unwrap_or_default()),
        };
        let file = document.path().to_owned();
        Ok(Self { file, scene, output, keep, groups })
    }

    /// File of the study.
    #[must_use]
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// File of its scene.
    #[must_use]
    pub fn scene(&self) -> &Path {
        self.scene.path()
    }

    /// Folder for the results.
    #[must_use]
    pub fn output(&self) -> &Path {
        &self.output
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

    /// Returns all points, with their keys for a version of a program, in the order of the plan: the
    /// last axis changes first.
    ///
    /// # Errors
    /// A key of an axis leads nowhere at one of the points.
    pub fn points(&self, program: &str) -> Result<Vec<Point>, Error> {
        let count = self.groups.iter().map(Group::len).product();
        let mut digests = Digests::default();
        (0..count).map(|index| self.point(index, program, &mut digests)).collect()
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
        for (axis, level) in chosen {
            let setting = Setting::new(&axis.key, level);
            let wrong = |error| Diagnostic::new(&self.file, format!("{}: {error}", axis.key));
            settings.push(setting.map_err(wrong)?);
            levels.push(level.clone());
        }
        let scene = self.scene.clone().with_settings(&settings)?;
        Ok(Point { index, key: digests.key(&scene, program), levels, settings })
    }
}

/// Reader of the axes of a study, with the mistakes found so far.
struct Reader<'a> {
    document: &'a Document,
    scene: &'a Document,
    mistakes: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn fail(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.mistakes.push(self.document.at(key, message).help(help));
    }

    fn groups(&mut self, file: &StudyFile) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for (index, axis) in file.axis.iter().enumerate() {
            let place = format!("axis[{index}]");
            let Some(levels) = self.levels(&place, axis) else { continue };
            let name = axis.together.clone();
            let own = Axis {
                name: axis.name.clone().unwrap_or_else(|| axis.key.clone()),
                key: axis.key.clone(),
                levels,
                is_sample: false,
            };
            let group = groups.iter_mut().find(|group| name.is_some() && group.name == name);
            match group {
                None => groups.push(Group { name, axes: vec![own] }),
                Some(group) if group.len() == own.levels.len() => group.axes.push(own),
                Some(group) => {
                    let (first, count) = (&group.axes[0], own.levels.len());
                    let message =
                        format!("{count} levels in step with {} of {}", group.len(), first.name);
                    let help = "give axes that go together as many levels each";
                    self.fail(&format!("{place}.together"), message, help);
                }
            }
        }
        for (index, sample) in file.sample.iter().enumerate() {
            let axes = self.sample(&format!("sample[{index}]"), sample);
            groups.extend((!axes.is_empty()).then_some(Group { name: None, axes }));
        }
        self.check_names(&groups);
        let count = groups.iter().map(Group::len).try_fold(1_usize, usize::checked_mul);
        if file.axis.is_empty() && file.sample.is_empty() {
            let help = "add an [[axis]] with a key and its values, or a [[sample]]";
            let mistake = Diagnostic::new(self.document.path(), "the study has no axis");
            self.mistakes.push(mistake.help(help));
        } else if count.is_none_or(|count| count > POINTS_MAX) {
            let message = format!("the study has more than {POINTS_MAX} points");
            let help = "take fewer levels, or a [[sample]] in place of axes";
            self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
        }
        groups
    }

    /// Checks a key of the scene with a level.
    fn check_key(&mut self, place: &str, key: &str, level: &str) {
        let set = Setting::new(key, level).and_then(|setting| self.scene.accepts(&setting));
        if let Err(SettingError { message, help }) = set {
            self.fail(&format!("{place}.key"), message, help);
        }
    }

    /// Returns the levels of an axis.
    fn levels(&mut self, place: &str, axis: &AxisFile) -> Option<Vec<String>> {
        let AxisFile { key, values, range, files, starts, .. } = axis;
        let given = [values.is_some(), range.is_some(), files.is_some(), starts.is_some()];
        if given.iter().filter(|given| **given).count() != 1 {
            let help = "give one of values, range, files and starts";
            self.fail(place, format!("\"{}\" has not one kind of levels", excerpt(key)), help);
            return None;
        }
        let levels = if let Some(values) = values {
            values.iter().map(ToString::to_string).collect()
        } else if let Some(file) = range {
            let document = self.document;
            let fail = |own: &str, message: String, help: &str| {
                document.at(&format!("{place}.range.{own}"), message).help(help)
            };
            if !(2..=POINTS_MAX as u32).contains(&file.count) {
                let message = format!("{} levels are no range", file.count);
                let help = format!("write 2 to {POINTS_MAX}; one value stands in values = [...]");
                self.fail(&format!("{place}.range.count"), message, help);
                return None;
            }
            let range = Range::new([file.start, file.end], file.scale.as_deref(), fail);
            range.map_err(|found| self.mistakes.extend(found.0)).ok()?.levels(file)
        } else if let Some(files) = files {
            self.files(&format!("{place}.files"), files)?
        } else {
            self.starts(place, key, starts.unwrap_or_default())?
        };
        let mut known = BTreeSet::new();
        if let Some(twice) = levels.iter().find(|level| !known.insert(*level)) {
            let message = format!("{} is there twice", excerpt(twice));
            self.fail(place, message, "name each level once");
            return None;
        }
        let Some(first) = levels.first() else {
            self.fail(place, "there are no levels", "give one or more");
            return None;
        };
        self.check_key(place, key, first);
        Some(levels)
    }

    /// Returns the levels of random starts: seeds of the noise of a panel.
    fn starts(&mut self, place: &str, key: &str, count: u32) -> Option<Vec<String>> {
        let noise = key.strip_suffix(".noise.seed");
        let noise = noise.map(|panel| format!("{panel}.noise.amplitude"));
        let has = noise.is_some_and(|noise| self.scene.has(&with_brackets(&noise)));
        if !has {
            let help = "give the panel noise = { amplitude = …, length = … } in the scene, and the \
                        axis key = \"panel.0.noise.seed\"";
            let message = format!("\"{}\" is not the seed of a panel's noise", excerpt(key));
            self.fail(&format!("{place}.key"), message, help);
            return None;
        }
        if !(1..=POINTS_MAX as u32).contains(&count) {
            let help = format!("write 1 to {POINTS_MAX}");
            self.fail(&format!("{place}.starts"), format!("{count} starts"), help);
            return None;
        }
        Some((1..=count).map(|seed| seed.to_string()).collect())
    }

    /// Returns the levels of files, as the scene names them: seen from its folder.
    fn files(&mut self, place: &str, files: &TextOr<Vec<String>>) -> Option<Vec<String>> {
        let folder = self.document.path().parent().unwrap_or(Path::new(""));
        let paths = match files {
            TextOr::Other(names) => names.iter().map(|name| folder.join(name)).collect(),
            TextOr::Text(pattern) => {
                let folder = glob::Pattern::escape(&folder.to_string_lossy());
                let whole = Path::new(&folder).join(pattern);
                let found = match glob::glob(&whole.to_string_lossy()) {
                    Ok(found) => found.flatten().collect::<Vec<PathBuf>>(),
                    Err(error) => {
                        let help = "write a pattern such as \"fabrics/*/sheet.toml\"";
                        self.fail(place, format!("this is no pattern: {}", error.msg), help);
                        return None;
                    }
                };
                if found.is_empty() {
                    let help = "write a pattern that files match, seen from the study's folder";
                    self.fail(place, format!("no file matches \"{}\"", excerpt(pattern)), help);
                    return None;
                }
                found
            }
        };
        let from = std::path::absolute(self.scene.path()).ok()?;
        let from = from.parent().unwrap_or(Path::new(""));
        let mut levels = Vec::new();
        for path in paths {
            if !path.exists() {
                let message = format!("there is no {}", path.display());
                self.fail(place, message, drape_input::nearest_file(&path));
                return None;
            }
            let whole = plain(&std::path::absolute(&path).ok()?);
            let seen = pathdiff::diff_paths(&whole, plain(from)).unwrap_or(whole);
            levels.push(toml_string(&seen.to_string_lossy()));
        }
        Some(levels)
    }

    /// Returns the axes of a sample.
    fn sample(&mut self, place: &str, sample: &SampleFile) -> Vec<Axis> {
        let method = match sample.method.as_str() {
            "sobol" => Method::Sobol,
            "latin-hypercube" => Method::LatinHypercube,
            other => {
                let message = format!("there is no method \"{}\"", excerpt(other));
                let help = "write \"sobol\" or \"latin-hypercube\"";
                self.fail(&format!("{place}.method"), message, help);
                return Vec::new();
            }
        };
        let count_max = method.points_max().min(POINTS_MAX as u32);
        if !(1..=count_max).contains(&sample.count) {
            let message = format!("a sample of {}", sample.count);
            self.fail(&format!("{place}.count"), message, format!("write 1 to {count_max}"));
            return Vec::new();
        }
        let dimensions = sample.range.len();
        if !(1..=method.dimensions_max()).contains(&dimensions) {
            let message = format!("a sample of {dimensions} ranges");
            let help = format!("give 1 to {} [[sample.range]]", method.dimensions_max());
            self.fail(place, message, help);
            return Vec::new();
        }
        let coordinates = method.coordinates(dimensions, sample.count, sample.seed);
        let mut axes = Vec::new();
        for (index, (own, coordinates)) in sample.range.iter().zip(coordinates).enumerate() {
            let place = format!("{place}.range[{index}]");
            let document = self.document;
            let fail = |own: &str, message: String, help: &str| {
                document.at(&format!("{place}.{own}"), message).help(help)
            };
            match Range::new([own.start, own.end], own.scale.as_deref(), fail) {
                Ok(range) => {
                    let levels: Vec<String> =
                        coordinates.into_iter().map(|x| range.at(x)).collect();
                    self.check_key(&place, &own.key, &levels[0]);
                    let name = own.name.clone().unwrap_or_else(|| own.key.clone());
                    axes.push(Axis { name, key: own.key.clone(), levels, is_sample: true });
                }
                Err(found) => self.mistakes.extend(found.0),
            }
        }
        axes
    }

    /// Checks that each key and each name is there once.
    fn check_names(&mut self, groups: &[Group]) {
        let (mut keys, mut names) = (BTreeSet::new(), BTreeSet::new());
        for axis in groups.iter().flat_map(|group| &group.axes) {
            let what = match (keys.insert(&axis.key), names.insert(&axis.name)) {
                (false, _) => format!("the key \"{}\" is set by two axes", excerpt(&axis.key)),
                (_, false) => format!("two axes have the name \"{}\"", excerpt(&axis.name)),
                _ => continue,
            };
            let help = "give each axis its own key and its own name";
            self.mistakes.push(Diagnostic::new(self.document.path(), what).help(help));
        }
    }
}

/// Returns a key with the numbers of elements in brackets, as documents look them up.
fn with_brackets(key: &str) -> String {
    let mut text = String::new();
    for part in key.split('.') {
        match part.parse::<usize>() {
            Ok(number) if !text.is_empty() => text += &format!("[{number}]"),
            _ if text.is_empty() => text += part,
            _ => text += &format!(".{part}"),
        }
    }
    text
}

/// Returns a whole path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::ParentDir => _ = plain.pop(),
            std::path::Component::CurDir => {}
            part => plain.push(part),
        }
    }
    plain
}
