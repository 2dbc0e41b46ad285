//! Keys of points: digests of all that a run reads.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use drape_input::Document;

use crate::base::Base;

/// Longest text of a scene that may be the name of a file, in bytes.
const NAME_MAX: usize = 1024;

/// Digests of files, each read once. A file of TOML includes those that it names.
#[derive(Debug)]
pub(crate) struct Digests {
    files: HashMap<PathBuf, Option<blake3::Hash>>,
    /// Command other than a simulation, with its options.
    command: Vec<String>,
}

impl Digests {
    /// Makes the digests of runs of a base with options.
    pub(crate) fn new(base: Base, options: &[String]) -> Self {
        let name = (base != Base::Scene).then(|| base.key().to_owned());
        let command = name.into_iter().chain(options.iter().cloned()).collect();
        Self { files: HashMap::new(), command }
    }

    /// Returns the key of a run of a base, with the values that are set in it, by a program.
    ///
    /// Every text of the base that is the name of a file, seen from its folder, counts with the
    /// bytes of that file: more than what is read, and never less.
    pub(crate) fn key(&mut self, base: &Document, program: &str) -> String {
        let mut hasher = blake3::Hasher::new();
        let mut add = |part: &[u8]| {
            hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
        };
        add(program.as_bytes());
        self.command.iter().for_each(|word| add(word.as_bytes()));
        add(base.text().as_bytes());
        base.settings().iter().for_each(|setting| add(setting.to_string().as_bytes()));
        for (name, digest) in self.named(base) {
            add(name.as_bytes());
            add(digest.as_bytes());
        }
        hasher.finalize().to_hex().to_string()
    }

    /// Returns the files that a document names, with their digests.
    fn named(&mut self, document: &Document) -> BTreeMap<String, blake3::Hash> {
        let folder = document.path().parent().unwrap_or(Path::new(""));
        let names = document.texts();
        let names = names.into_iter().filter(|name| !name.is_empty() && name.len() <= NAME_MAX);
        let named = names.filter_map(|name| Some((name.to_owned(), self.of(&folder.join(name))?)));
        named.collect()
    }

    /// Returns the digest of a file, or of the sheet in a folder; `None` if there is none.
    fn of(&mut self, path: &Path) -> Option<blake3::Hash> {
        if let Some(known) = self.files.get(path) {
            return *known;
        }
        // A file that names itself, by whatever detour, ends here.
        self.files.insert(path.to_owned(), None);
        let digest = self.read(path);
        self.files.insert(path.to_owned(), digest);
        digest
    }

    fn read(&mut self, path: &Path) -> Option<blake3::Hash> {
        let found = std::fs::metadata(path).ok()?;
        if found.is_dir() {
            return self.of(&path.join("sheet.toml"));
        }
        if !found.is_file() {
            return None;
        }
        let mut hasher = blake3::Hasher::new();
        hasher.update_reader(std::fs::File::open(path).ok()?).ok()?;
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"))
            && let Ok(document) = Document::read(path)
        {
            for (name, digest) in self.named(&document) {
                hasher.update(name.as_bytes()).update(digest.as_bytes());
            }
        }
        Some(hasher.finalize())
    }
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
        // What a value of the point names counts in place of what it replaces.
        let set = "collider.mesh.0.file=\"c.obj\"";
        let before = key(&here, set, "p 1");
        std::fs::write(here.join("c.obj"), "v 1 1 1").expect("written");
        let after = key(&here, set, "p 1");
        assert_ne!(after, before);
        std::fs::write(here.join("b.obj"), "other").expect("written");
        assert_eq!(after, key(&here, set, "p 1"));
    }
}
