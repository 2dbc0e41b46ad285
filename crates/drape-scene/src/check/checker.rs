//! Checker: the file of a scene and the mistakes that have been found in it.

pub(crate) mod ranges;

use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use drape_collide::{MESH_BYTES_MAX, Triangulation, parse_mesh, read_mesh_within};
use drape_input::{
    Advice, Diagnostic, Diagnostics, Document, Faults, SizeLimit, Subject, closest, excerpt,
    figure, missing_file_help, similar_file, tidy, toml_key, toml_string,
};

use crate::check::body::mesh_remedy::mesh_remedy;
use crate::check::documents::Documents;
use crate::check::memory::particles_max;
use crate::spec::SceneSpec;

/// Limit of meshes and of their motions.
pub const MESH_LIMIT: SizeLimit = SizeLimit::new("meshes", MESH_BYTES_MAX);

/// File of a scene that is being checked, with the mistakes found so far.
pub(crate) struct Checker<'a> {
    /// Scene as it is described.
    pub(crate) spec: &'a SceneSpec,
    /// Folder of the file.
    pub(crate) folder: &'a Path,
    /// Fabrics, patterns and meshes given along with the scene, by the paths by which it names
    /// them.
    pub(crate) documents: &'a [Document],
    /// Number of particles for which there is memory.
    pub(crate) particles_max: usize,
    document: &'a Document,
    /// Mistakes of spelling and type, and what they leave unknown.
    faults: Faults,
    mistakes: Vec<Diagnostic>,
    /// Mistakes in spite of which the scene can be made.
    late: Vec<Diagnostic>,
    /// Keys of the mistakes.
    keys: BTreeSet<String>,
}

/// Name that is not among those that there are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UnknownName<'a> {
    pub(crate) name: &'a str,
    pub(crate) known: &'a [&'a str],
    /// Kind of the names, in the plural.
    pub(crate) kind: &'a str,
}

impl<'a> Checker<'a> {
    /// Begins to check `spec`, whose text has `faults`.
    pub(crate) fn new(documents: &Documents<'a>, spec: &'a SceneSpec, faults: Faults) -> Self {
        let document = documents.scene;
        Self {
            spec,
            folder: document.path().parent().unwrap_or(Path::new("")),
            documents: documents.others,
            particles_max: particles_max(),
            document,
            faults,
            mistakes: Vec::new(),
            late: Vec::new(),
            keys: BTreeSet::new(),
        }
    }

    /// Document of the file.
    pub(crate) fn document(&self) -> &'a Document {
        self.document
    }

    /// Returns the path of a file that the scene names at a key; adds a mistake where the path
    /// leads out of the folders of the scene.
    pub(crate) fn locate(&mut self, key: &str, name: &str) -> Option<PathBuf> {
        if !self.is_sound(key) {
            return None;
        }
        let path = self.folder.join(name);
        if self.given(&path).is_some() {
            return Some(path);
        }
        let located = self.document.beside(name);
        located.map_err(|misplaced| self.fail(key, misplaced.to_string(), misplaced.help())).ok()
    }

    /// Document given along with the scene for a path.
    pub(crate) fn given(&self, path: &Path) -> Option<&'a Document> {
        self.documents.iter().find(|given| given.path() == path)
    }

    /// Reads the mesh of a path: from the document that is given for it, or from its file.
    pub(crate) fn mesh(&self, path: &Path) -> Result<Triangulation, drape_collide::Error> {
        let access = self.document().access();
        match self.given(path).map(|document| document.text().as_bytes()).or(access.held(path)) {
            Some(bytes) => parse_mesh(path, bytes),
            None => read_mesh_within(path, MESH_LIMIT.bytes(access)),
        }
    }

    /// Adds a mistake at a key, with a remedy, and returns its index. Of a value that could not be
    /// read nothing more is said.
    pub(crate) fn fail(
        &mut self,
        key: &str,
        message: impl Into<String>,
        help: impl Into<Advice>,
    ) -> usize {
        let index = self.mistakes.len();
        self.add(key, message.into(), |mistake| mistake.help(help));
        index
    }

    /// Gives a mistake, by its index, the part of the input that it speaks of.
    pub(crate) fn about(&mut self, index: usize, subject: Subject) {
        if let Some(mistake) = self.mistakes.get_mut(index) {
            mistake.subject = Some(subject);
        }
    }

    /// Gives a mistake, by its index, a value of a key, in TOML, that remedies it; `None` to remove
    /// the key.
    pub(crate) fn remedy(&mut self, index: usize, key: &str, new: Option<&str>) {
        let edit = self.document.edit(key, new);
        if let Some(mistake) = self.mistakes.get_mut(index) {
            mistake.edits.extend(edit);
        }
    }

    /// Adds the mistake that there is no file of a path, which the value of a key names.
    pub(crate) fn no_file(&mut self, key: &str, name: &str, path: &Path) {
        let message = format!("there is no file {}", path.display());
        let index = self.fail(key, message, missing_file_help(path));
        if let Some(near) = similar_file(path) {
            let near = Path::new(name).with_file_name(near);
            self.remedy(index, key, Some(&toml_string(&near.to_string_lossy())));
        }
    }

    /// Adds a mistake at a key whose mesh cannot be read.
    pub(crate) fn fail_mesh(&mut self, key: &str, error: &drape_collide::Error) {
        self.add(key, tidy(&error.to_string()), |mistake| match mesh_remedy(error) {
            Some(remedy) => mistake.help(remedy),
            None => mistake,
        });
    }

    fn add(&mut self, key: &str, message: String, finish: impl FnOnce(Diagnostic) -> Diagnostic) {
        self.keys.insert(key.to_owned());
        if !self.faults.cover(key) {
            self.mistakes.push(finish(self.document.at(key, message)));
        }
    }

    /// Returns whether the value of a key, or its default, can be used.
    pub(crate) fn is_sound(&self, key: &str) -> bool {
        !self.keys.contains(key) && !self.faults.cover(key)
    }

    /// Adds a mistake of the whole file, with a remedy.
    pub(crate) fn fail_file(&mut self, message: impl Into<String>, help: &str) {
        let mistake = Diagnostic::new(self.document.path(), message.into());
        self.mistakes.push(mistake.help(help));
    }

    /// Adds mistakes of another file.
    pub(crate) fn extend(&mut self, mistakes: Diagnostics) {
        self.mistakes.extend(mistakes.0);
    }

    /// Adds mistakes in spite of which the scene can be made, to be shown.
    pub(crate) fn extend_late(&mut self, mistakes: Vec<Diagnostic>) {
        self.late.extend(mistakes);
    }

    /// Returns the mistakes that have been found, if there are some.
    pub(crate) fn finish(&mut self) -> Result<(), Diagnostics> {
        let faults = std::mem::take(&mut self.faults).into_mistakes();
        self.mistakes.extend(faults);
        self.mistakes.append(&mut self.late);
        Diagnostics::check(std::mem::take(&mut self.mistakes))
    }

    /// Returns all mistakes, if there are some in spite of which the scene cannot be made.
    pub(crate) fn finish_parts(&mut self) -> Result<(), Diagnostics> {
        let can_be_made = self.mistakes.is_empty() && self.faults.is_empty();
        if can_be_made { Ok(()) } else { self.finish() }
    }

    /// Adds a mistake about an unknown name, with the nearest of those that there are or else all.
    pub(crate) fn unknown(
        &mut self,
        key: &str,
        message: impl Into<String>,
        unknown: UnknownName<'_>,
    ) {
        let UnknownName { name, known, kind } = unknown;
        let near = closest(name, known.iter().copied());
        let help = match near {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => format!("the {kind} are: {}", known.join(", ")),
        };
        let index = self.fail(key, message, &help);
        let Some(near) = near else { return };
        // The name is the value of the key, or the key itself.
        match key.strip_suffix(&format!(".{}", toml_key(name))) {
            Some(table) => {
                let edits = self.document.renamed(key, &format!("{table}.{}", toml_key(near)));
                self.mistakes
                    .get_mut(index)
                    .into_iter()
                    .for_each(|mistake| mistake.edits.clone_from(&edits));
            }
            None => self.remedy(index, key, Some(&toml_string(near))),
        }
    }

    /// Returns whether a number is within a range; if not, adds a mistake.
    pub(crate) fn within(
        &mut self,
        key: &str,
        value: f64,
        range: RangeInclusive<f64>,
        help: &str,
    ) -> bool {
        let sound = range.contains(&value);
        if !sound {
            let (low, high) = range.into_inner();
            self.fail(
                key,
                format!("{} is not between {} and {}", figure(value), figure(low), figure(high)),
                help,
            );
        }
        sound
    }

    /// Returns the choice that `word` names, or adds a mistake at `key`.
    pub(crate) fn choice<T: Copy>(
        &mut self,
        key: &str,
        word: &str,
        choices: &[(&str, T)],
    ) -> Option<T> {
        let choice = choices.iter().find(|(name, _)| word == *name);
        if choice.is_none() {
            let names: Vec<String> =
                choices.iter().map(|choice| format!("\"{}\"", choice.0)).collect();
            let near = closest(word, choices.iter().map(|choice| choice.0));
            let help = match near {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => format!("one of {}", names.join(", ")),
            };
            let mistake = self.fail(key, format!("there is no \"{}\"", excerpt(word)), &help);
            if let Some(near) = near {
                self.remedy(mistake, key, Some(&toml_string(near)));
            }
        }
        choice.map(|(_, choice)| *choice)
    }

    /// Returns the value at `key` as the text of the scene gives it, if there is a text.
    pub(crate) fn written(&self, key: &str) -> Option<String> {
        self.document.written(key).map(str::to_owned)
    }
}
