//! Identity: which program wrote a checkpoint, and from what.

use std::path::Path;

use serde::{Deserialize, Serialize};

/// BLAKE3 digest.
pub type Digest = [u8; 32];

/// Program that wrote a checkpoint, and the digests of what it read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Identity {
    program: String,
    sources: Vec<Source>,
}

/// Something that the program read, such as a file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Source {
    name: String,
    digest: Digest,
}

impl Identity {
    /// Makes the identity of a program with its version.
    #[must_use]
    pub fn new(program: impl Into<String>) -> Self {
        Self { program: program.into(), sources: Vec::new() }
    }

    /// Adds something that the program read, by its name and its bytes.
    #[must_use]
    pub fn with(self, name: impl Into<String>, content: &[u8]) -> Self {
        self.with_digest(name, *blake3::hash(content).as_bytes())
    }

    /// Adds a file by its content, which is read in pieces; one that cannot be read counts as empty.
    #[must_use]
    pub fn with_file(self, name: impl Into<String>, file: &Path) -> Self {
        let digest = || {
            let mut hasher = blake3::Hasher::new();
            hasher.update_reader(std::fs::File::open(file)?)?;
            Ok::<_, std::io::Error>(hasher.finalize())
        };
        let digest = digest().unwrap_or_else(|_| blake3::hash(b""));
        self.with_digest(name, *digest.as_bytes())
    }

    /// Adds the same by its digest.
    #[must_use]
    pub fn with_digest(mut self, name: impl Into<String>, digest: Digest) -> Self {
        self.sources.push(Source { name: name.into(), digest });
        self
    }

    /// Program with its version.
    #[must_use]
    pub fn program(&self) -> &str {
        &self.program
    }

    /// Returns the names of all that differs from an earlier identity: the program, what has
    /// changed, what is new, and what is gone.
    #[must_use]
    pub fn changes(&self, earlier: &Self) -> Vec<String> {
        let mut changes = Vec::new();
        if self.program != earlier.program {
            changes.push(format!("the program ({}, now {})", earlier.program, self.program));
        }
        let of = |identity: &Self, name: &str| {
            identity.sources.iter().find(|own| own.name == name).map(|own| own.digest)
        };
        for Source { name, digest } in &self.sources {
            match of(earlier, name) {
                Some(before) if before == *digest => {}
                Some(_) => changes.push(name.clone()),
                None => changes.push(format!("{name} (new)")),
            }
        }
        let gone = earlier.sources.iter().filter(|own| of(self, &own.name).is_none());
        changes.extend(gone.map(|own| format!("{} (gone)", own.name)));
        changes
    }
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
