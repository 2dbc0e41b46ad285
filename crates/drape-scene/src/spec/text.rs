//! Spec as a text, and what a spec holds in memory beside the text.

use std::path::Path;
use std::sync::Arc;

use drape_collide::Triangulation;
use drape_fabric::Fabric;
use drape_input::{Diagnostic, Diagnostics, Document, Faults, Setting, toml_key};
use drape_pattern::Pattern;
use toml::Value;

use crate::spec::body::MeshMotion;
use crate::spec::file_or::FileOr;
use crate::spec::{LengthUnit, SceneSpec};

/// Heading of the texts that are written.
const HEADING: &str = "# Scene of drape. Lengths are in m, y is up.\n\n";

/// Keys and words by which a text could once ask for a scheme that is there to check the others. No
/// words stand for all.
const REFERENCE_SCHEMES: [(&str, &[&str]); 3] = [
    ("solver.integrator", &["explicit"]),
    ("solver.method", &["textbook-mass", "textbook-diagonal"]),
    ("solver.linear", &[]),
];

/// Answer to these keys.
const IS_REFERENCE: &str = "a scheme for comparison is no part of a scene; \
                            `Simulation::with_reference_scheme` reaches it from Rust";

/// Error of writing a spec.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// A file cannot be written.
    #[error("cannot write {}: {source}", .path.display())]
    File {
        /// The file.
        path: std::path::PathBuf,
        /// Reason.
        source: std::io::Error,
    },
    /// The spec holds what has no file; [`SceneSpec::save`] writes it.
    #[error("the scene holds {what} in memory: save it into a folder")]
    InMemory {
        /// What is held, in words.
        what: String,
    },
}

/// Positions of the vertices of a mesh in each frame, in the unit of the mesh.
type Frames = Vec<Vec<[f64; 3]>>;

/// Name of a file, or of a folder, in a spec.
pub(crate) struct NamedFile<'a> {
    /// Key path of the name.
    pub(crate) key: String,
    pub(crate) name: &'a mut String,
}

/// Returns the file at `key` whose name is `name`, if there is one.
fn named(key: String, name: Option<&mut String>) -> Option<NamedFile<'_>> {
    name.map(|name| NamedFile { key, name })
}

/// Things that a spec holds itself, by the names that stand for them in a text.
#[derive(Debug, Default)]
pub(crate) struct Held {
    fabrics: Vec<(String, Arc<Fabric>)>,
    patterns: Vec<(String, Arc<Pattern>)>,
    meshes: Vec<(String, Arc<Triangulation>)>,
    motions: Vec<(String, Arc<Frames>)>,
}

impl Held {
    /// Takes what `spec` holds out of it. In its place stand names that no file has.
    fn take_from(spec: &mut SceneSpec) -> Self {
        let mut held = Self::default();
        for fabric in spec.fabric.values_mut() {
            take(&mut fabric.file, &mut held.fabrics, "fabric");
        }
        for garment in &mut spec.garment {
            take(&mut garment.pattern, &mut held.patterns, "pattern");
        }
        for mesh in &mut spec.collider.mesh {
            take(&mut mesh.file, &mut held.meshes, "mesh");
            if let Some(MeshMotion::Frames(frames)) = &mesh.motion {
                let name = placeholder("motion", held.motions.len());
                held.motions.push((name.clone(), Arc::clone(frames)));
                mesh.motion = Some(MeshMotion::File(name));
            }
        }
        held
    }

    /// Puts what was taken back into `spec`, where its names stand.
    fn put_into(&self, spec: &mut SceneSpec) {
        spec.fabric.values_mut().for_each(|fabric| put(&mut fabric.file, &self.fabrics));
        spec.garment.iter_mut().for_each(|garment| put(&mut garment.pattern, &self.patterns));
        for mesh in &mut spec.collider.mesh {
            put(&mut mesh.file, &self.meshes);
            let Some(MeshMotion::File(named)) = &mesh.motion else { continue };
            if let Some((_, frames)) = self.motions.iter().find(|(name, _)| name == named) {
                mesh.motion = Some(MeshMotion::Frames(Arc::clone(frames)));
            }
        }
    }
}

/// Returns the name that stands for the thing with the number `number` of its `kind`.
fn placeholder(kind: &str, number: usize) -> String {
    format!("<{kind} {}>", number + 1)
}

/// Moves the thing that `place` holds, if it holds one, to `things`.
fn take<T>(place: &mut FileOr<T>, things: &mut Vec<(String, Arc<T>)>, kind: &str) {
    if let FileOr::Value(value) = place {
        let name = placeholder(kind, things.len());
        things.push((name.clone(), Arc::clone(value)));
        *place = FileOr::File(name);
    }
}

/// Puts the thing of `things` whose name stands in `place` there.
fn put<T>(place: &mut FileOr<T>, things: &[(String, Arc<T>)]) {
    let FileOr::File(named) = place else { return };
    if let Some((_, value)) = things.iter().find(|(name, _)| name == named) {
        *place = FileOr::Value(Arc::clone(value));
    }
}

impl SceneSpec {
    /// Reads the spec of the scene `document`, with the units of its numbers resolved.
    ///
    /// # Errors
    /// All mistakes of grammar, spelling and type, with their places.
    pub fn from_document(document: &Document) -> Result<Self, Diagnostics> {
        let (spec, faults) = Self::with_faults(document)?;
        Diagnostics::check(faults.into_mistakes())?;
        Ok(spec)
    }

    /// Reads the spec of the scene `document` in spite of mistakes of spelling and type, which
    /// [`build_or_refused`](Self::build_or_refused) reports together with all others.
    ///
    /// # Errors
    /// Mistakes of grammar, and mistakes that leave no spec.
    pub fn with_faults(document: &Document) -> Result<(Self, Faults), Diagnostics> {
        let (spec, mut faults) = document.decode_with_faults()?;
        for (key, words) in REFERENCE_SCHEMES {
            let word = document.text_at(key);
            if word.is_some_and(|word| words.is_empty() || words.contains(&word.as_str())) {
                let answer = document.at(key, IS_REFERENCE).help("leave it out");
                faults.explain(key, &answer.with_edits(document.edit(key, None)));
            }
        }
        Ok((spec, faults))
    }

    /// Returns the spec as TOML, with lengths in m.
    ///
    /// [`SceneSpec::from_document`] reads an equal spec from it, if `length` of this spec is the
    /// metre.
    ///
    /// # Errors
    /// [`SaveError::InMemory`] if the spec holds a fabric, a pattern, a mesh or a motion itself.
    pub fn to_toml(&self) -> Result<String, SaveError> {
        let mut spec = self.in_metres();
        let held = Held::take_from(&mut spec);
        let kinds = [
            ("a fabric", held.fabrics.is_empty()),
            ("a pattern", held.patterns.is_empty()),
            ("a mesh", held.meshes.is_empty()),
            ("a motion", held.motions.is_empty()),
        ];
        if let Some((what, _)) = kinds.iter().find(|(_, is_empty)| !is_empty) {
            return Err(SaveError::InMemory { what: (*what).into() });
        }
        Ok(format!("{HEADING}{}", spec.text()))
    }

    /// Sets the value at `key` to `value`, which is TOML: `spec.set("time.end", "2.5")`.
    ///
    /// Bare lengths are in m.
    ///
    /// # Errors
    /// The mistake of the key or of the value, with a remedy.
    pub fn set(&mut self, key: &str, value: &str) -> Result<(), Diagnostics> {
        let setting = Setting::new(key, value)
            .map_err(|error| Diagnostic::new("", error.message).help(error.help))?
            .with_origin("set");
        let mut spec = self.in_metres();
        let held = Held::take_from(&mut spec);
        let document = Document::new("", spec.text()).with_settings(&[setting])?;
        let mut spec = Self::from_document(&document)?;
        held.put_into(&mut spec);
        *self = spec;
        Ok(())
    }

    /// Writes the spec to `scene.toml` in `folder`, and what it holds itself into files beside it.
    /// [`Scene::read`](crate::Scene::read) reads an equal scene from there: the positions of meshes
    /// and of their motions have the same bits.
    ///
    /// Files that the spec names are named relative to its old folder; they are not copied. Frames
    /// of a body with which an earlier spec was saved are removed from `folder`.
    ///
    /// # Errors
    /// [`SaveError::File`] if a file cannot be written or removed.
    pub fn save(&self, folder: impl AsRef<Path>) -> Result<(), SaveError> {
        let folder = folder.as_ref();
        let mut spec = self.in_metres();
        let write = |name: &str, text: &str| {
            let path = folder.join(name);
            std::fs::write(&path, text).map_err(|source| SaveError::File { path, source })
        };
        std::fs::create_dir_all(folder)
            .map_err(|source| SaveError::File { path: folder.to_owned(), source })?;

        for (number, fabric) in spec.fabric.values_mut().enumerate() {
            if let FileOr::Value(value) = &fabric.file {
                let name = format!("fabric-{}.toml", number + 1);
                write(&name, &value.to_toml())?;
                fabric.file = name.into();
            }
        }
        for (number, garment) in spec.garment.iter_mut().enumerate() {
            if let FileOr::Value(pattern) = &garment.pattern {
                let name = format!("pattern-{}.toml", number + 1);
                write(&name, &pattern.to_toml("Pattern of drape."))?;
                garment.pattern = name.into();
            }
        }
        for (number, mesh) in spec.collider.mesh.iter_mut().enumerate() {
            let name = format!("body-{}.obj", number + 1);
            let FileOr::Value(outline) = mesh.file.clone() else { continue };
            write(&name, &outline.to_obj())?;
            mesh.file = name.into();
            if let Some(MeshMotion::Frames(frames)) = &mesh.motion {
                remove_frames(folder, number + 1)
                    .map_err(|source| SaveError::File { path: folder.to_owned(), source })?;
                for (frame, vertices) in frames.iter().enumerate() {
                    let name = format!("body-{}-frame-{frame:05}.obj", number + 1);
                    let triangles = outline.triangles.clone();
                    let posed = Triangulation { vertices: vertices.clone(), triangles };
                    write(&name, &posed.to_obj())?;
                }
                mesh.frames = Some(format!("body-{}-frame-*.obj", number + 1));
                mesh.motion = None;
            }
        }
        write("scene.toml", &format!("{HEADING}{}", spec.text()))
    }

    /// Returns the spec with the names of its files, which are seen from `folder`, as paths from
    /// the root of the file system.
    #[must_use]
    pub fn with_whole_paths(&self, folder: &Path) -> Self {
        let mut spec = self.clone();
        for NamedFile { name, .. } in spec.files_mut() {
            *name = whole_path(name, folder);
        }
        spec
    }

    /// Returns all names of files in the spec, with the keys that name them.
    pub(crate) fn files_mut(&mut self) -> Vec<NamedFile<'_>> {
        let mut files = Vec::new();
        for (name, fabric) in &mut self.fabric {
            files.extend(named(format!("fabric.{}.file", toml_key(name)), fabric.file.file_mut()));
        }
        for (index, garment) in self.garment.iter_mut().enumerate() {
            files.extend(named(format!("garment[{index}].pattern"), garment.pattern.file_mut()));
        }
        for (index, mesh) in self.collider.mesh.iter_mut().enumerate() {
            let key = format!("collider.mesh[{index}]");
            files.extend(named(format!("{key}.file"), mesh.file.file_mut()));
            files.extend(named(format!("{key}.frames"), mesh.frames.as_mut()));
            if let Some(MeshMotion::File(name)) = &mut mesh.motion {
                files.extend(named(format!("{key}.motion"), Some(name)));
            }
        }
        files.extend(named(
            "grading.run".into(),
            self.grading.as_mut().map(|grading| &mut grading.run),
        ));
        files
    }

    /// Returns the spec with what it holds itself replaced by names that no file has.
    pub(crate) fn without_held(&self) -> Self {
        let mut spec = self.clone();
        Held::take_from(&mut spec);
        spec
    }

    /// Returns the spec as a file in m says it: meshes without a `scale` have the unit of this
    /// spec.
    #[must_use]
    pub fn in_metres(&self) -> Self {
        let mut spec = self.clone();
        if spec.length != LengthUnit::M {
            let unit = spec.length.metres();
            let meshes = spec.collider.mesh.iter_mut();
            meshes.for_each(|mesh| _ = mesh.scale.get_or_insert(unit));
            spec.length = LengthUnit::M;
        }
        spec
    }

    /// Returns the spec, which holds nothing itself, as TOML.
    pub(crate) fn text(&self) -> String {
        // A table of TOML values is a text: there is nothing in it that TOML cannot say.
        Value::try_from(self)
            .ok()
            .and_then(|value| toml::to_string(&value).ok())
            .unwrap_or_default()
    }
}

/// Removes the frames of the body with the `number` from `folder`, which would be read as frames of
/// the one that is saved.
fn remove_frames(folder: &Path, number: usize) -> std::io::Result<()> {
    let before = format!("body-{number}-frame-");
    for entry in std::fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let frame = name.strip_prefix(&before).and_then(|rest| rest.strip_suffix(".obj"));
        if frame.is_some_and(|frame| frame.parse::<u64>().is_ok()) {
            std::fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

/// Returns the path of the file `name`, which is seen from `folder`, from the root of the file
/// system.
fn whole_path(name: &str, folder: &Path) -> String {
    let path = folder.join(name);
    let whole = std::path::absolute(&path).unwrap_or(path);
    whole.to_string_lossy().replace('\\', "/")
}
