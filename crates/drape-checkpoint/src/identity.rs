//! Identity: the program that wrote a checkpoint, and the digests of its input.

use std::path::Path;

use serde::{Deserialize, Serialize};

/// BLAKE3 digest.
pub type Digest = [u8; 32];

/// Program that wrote a checkpoint, and the digests of the sources that it read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    program: String,
    sources: Vec<Source>,
}

/// Source that the program read, such as a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Source {
    name: String,
    digest: Digest,
}

impl Identity {
    /// Creates an identity without sources. `program` is the name of a program with its version.
    #[must_use]
    pub fn new(program: impl Into<String>) -> Self {
        Self { program: program.into(), sources: Vec::new() }
    }

    /// Adds a source with the given `name` and the bytes `content`.
    #[must_use]
    pub fn with(self, name: impl Into<String>, content: &[u8]) -> Self {
        self.with_digest(name, *blake3::hash(content).as_bytes())
    }

    /// Adds a source with the given `name` and the content of `file`, which is read in pieces.
    ///
    /// A file that cannot be read counts as empty.
    #[must_use]
    pub fn with_file(self, name: impl Into<String>, file: &Path) -> Self {
        let hash = hash_file(file).unwrap_or_else(|_| blake3::hash(b""));
        self.with_digest(name, *hash.as_bytes())
    }

    /// Adds a source with the given `name` and `digest`.
    #[must_use]
    pub fn with_digest(mut self, name: impl Into<String>, digest: Digest) -> Self {
        self.sources.push(Source { name: name.into(), digest });
        self
    }

    /// Returns the name of the program with its version, as given to [`Identity::new`].
    #[must_use]
    pub fn program(&self) -> &str {
        &self.program
    }

    /// Returns the names of everything that differs from the identity `earlier`: the program, and
    /// the sources that changed, are new, or are gone.
    #[must_use]
    pub fn changes(&self, earlier: &Self) -> Vec<String> {
        let mut changes = Vec::new();
        if self.program != earlier.program {
            changes.push(format!("the program ({}, now {})", earlier.program, self.program));
        }
        for Source { name, digest } in &self.sources {
            match earlier.digest(name) {
                Some(before) if before == *digest => {}
                Some(_) => changes.push(name.clone()),
                None => changes.push(format!("{name} (new)")),
            }
        }
        let gone = earlier.sources.iter().filter(|source| self.digest(&source.name).is_none());
        changes.extend(gone.map(|source| format!("{} (gone)", source.name)));
        changes
    }

    /// Returns the digest of the first source with the given `name`.
    fn digest(&self, name: &str) -> Option<Digest> {
        self.sources.iter().find(|source| source.name == name).map(|source| source.digest)
    }
}

/// Returns the hash of the content of `file`.
fn hash_file(file: &Path) -> std::io::Result<blake3::Hash> {
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(std::fs::File::open(file)?)?;
    Ok(hasher.finalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_has_changed_is_named() {
        let before = Identity::new("a 1").with("scene", b"x").with("wool", b"y").with("old", b"z");
        assert_eq!(before.program(), "a 1");
        assert!(before.changes(&before.clone()).is_empty());
        let now = Identity::new("a 2").with("scene", b"x").with("wool", b"Y").with("new", b"z");
        let expected = ["the program (a 1, now a 2)", "wool", "new (new)", "old (gone)"];
        assert_eq!(now.changes(&before), expected);
    }
}
