//! Keys of points: digests of everything that a run reads.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use drape_input::Document;

use crate::base::Base;

/// Digests of files. Each file is read once. The digest of a TOML file includes the digests of the
/// files that it names.
#[derive(Debug)]
pub(crate) struct Digests {
    /// Digest of each path, or `None` for a path without a file.
    files: HashMap<PathBuf, Option<blake3::Hash>>,
    /// Name and options of a command other than a simulation.
    command: Vec<String>,
}

impl Digests {
    /// Creates the digests for runs of `base` with `options`.
    pub(crate) fn new(base: Base, options: &[String]) -> Self {
        let name = (base != Base::Scene).then(|| base.key().to_owned());
        let command = name.into_iter().chain(options.iter().cloned()).collect();
        Self { files: HashMap::new(), command }
    }

    /// Returns the key of a run of `base`, with its settings, by the version `program` of the
    /// program.
    ///
    /// Each text in `base` that is the path of a file, relative to the folder of `base`, counts
    /// with the content of the file. Such a file need not be one that the run reads.
    pub(crate) fn key(&mut self, base: &Document, program: &str) -> String {
        let mut hasher = blake3::Hasher::new();
        add_part(&mut hasher, program.as_bytes());
        for word in &self.command {
            add_part(&mut hasher, word.as_bytes());
        }
        add_part(&mut hasher, base.text().as_bytes());
        for setting in base.settings() {
            add_part(&mut hasher, setting.to_string().as_bytes());
        }
        for (name, digest) in self.named_files(base) {
            add_part(&mut hasher, name.as_bytes());
            add_part(&mut hasher, digest.as_bytes());
        }
        hasher.finalize().to_hex().to_string()
    }

    /// Returns the files that `document` names, with their digests.
    fn named_files(&mut self, document: &Document) -> BTreeMap<String, blake3::Hash> {
        /// Longest text that may be the path of a file, in bytes.
        const NAME_MAX: usize = 1024;

        let folder = document.path().parent().unwrap_or(Path::new(""));
        let texts = document.texts().into_iter();
        texts
            .filter(|text| !text.is_empty() && text.len() <= NAME_MAX)
            .filter_map(|name| Some((name.to_owned(), self.digest(&folder.join(name))?)))
            .collect()
    }

    /// Returns the digest of the file `path`, or of the sheet in the folder `path`, or `None` if
    /// there is no such file.
    fn digest(&mut self, path: &Path) -> Option<blake3::Hash> {
        if let Some(known) = self.files.get(path) {
            return *known;
        }
        // The entry ends the recursion of files that name themselves through other files.
        self.files.insert(path.to_owned(), None);
        let digest = self.compute_digest(path);
        self.files.insert(path.to_owned(), digest);
        digest
    }

    /// Reads the file or folder `path` and computes its digest.
    fn compute_digest(&mut self, path: &Path) -> Option<blake3::Hash> {
        let metadata = std::fs::metadata(path).ok()?;
        if metadata.is_dir() {
            return self.digest(&path.join("sheet.toml"));
        }
        if !metadata.is_file() {
            return None;
        }

        let mut hasher = blake3::Hasher::new();
        hasher.update_reader(std::fs::File::open(path).ok()?).ok()?;
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"))
            && let Ok(document) = Document::read(path)
        {
            for (name, digest) in self.named_files(&document) {
                hasher.update(name.as_bytes()).update(digest.as_bytes());
            }
        }
        Some(hasher.finalize())
    }
}

/// Adds the length of `part` and `part` itself to `hasher`, so that different lists of parts never
/// have one digest.
fn add_part(hasher: &mut blake3::Hasher, part: &[u8]) {
    hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_that_is_read_counts_and_the_folder_does_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let begin = |name: &str| {
            let folder = folder.path().join(name);
            std::fs::create_dir_all(folder.join("linen")).expect("made");
            let write = |file: &str, text: &str| std::fs::write(folder.join(file), text);
            write(
                "scene.toml",
                "[fabric.a]\nfile = \"linen\"\n[[collider.mesh]]\nfile = \"b.obj\"",
            )
            .expect("written");
            write("linen/sheet.toml", "[[curve]]\nfile = \"bend.csv\"").expect("written");
            write("linen/bend.csv", "1,2").expect("written");
            write("b.obj", "v 0 0 0").expect("written");
            folder
        };
        let key = |folder: &Path, set: &str, program: &str| {
            let scene = Document::read(folder.join("scene.toml")).expect("read");
            let settings: Vec<_> =
                set.split_terminator(';').map(|s| s.parse().expect("right")).collect();
            let scene = scene.with_settings(&settings).expect("set");
            Digests::new(Base::Scene, &[]).key(&scene, program)
        };
        let [here, there] = ["here", "deep/there"].map(begin);
        let first = key(&here, "", "p 1");
        assert_eq!(first.len(), 64);
        assert_eq!(first, key(&there, "", "p 1"));
        assert_ne!(first, key(&here, "a=1", "p 1"));
        assert_ne!(key(&here, "a=2", "p 1"), key(&here, "a=1", "p 1"));
        assert_ne!(first, key(&here, "", "p 2"));
        let mut last = first;
        for file in ["scene.toml", "linen/sheet.toml", "linen/bend.csv", "b.obj"] {
            let path = here.join(file);
            let text = std::fs::read_to_string(&path).expect("read");
            std::fs::write(&path, text + " ").expect("written");
            let now = key(&here, "", "p 1");
            assert_ne!(now, last, "{file}");
            last = now;
        }
        // The file that a setting names counts, and the file that it replaces does not.
        let set = "collider.mesh.0.file=\"c.obj\"";
        let before = key(&here, set, "p 1");
        std::fs::write(here.join("c.obj"), "v 1 1 1").expect("written");
        let after = key(&here, set, "p 1");
        assert_ne!(after, before);
        std::fs::write(here.join("b.obj"), "other").expect("written");
        assert_eq!(after, key(&here, set, "p 1"));
    }
}
