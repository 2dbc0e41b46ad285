use drape_fabric::Fabric;
use drape_input::{Diagnostic, Diagnostics, Document, closest};

use crate::material::FabricRequest;

/// Makes the fabric that a scene asks for.
pub type FabricReader<'a> = &'a dyn Fn(FabricRequest<'_>) -> Result<Fabric, Diagnostics>;

/// Turns a file into a scene, collecting mistakes. Each part of a scene has its methods in the file
/// named after it.
pub(crate) struct Reader<'a> {
    pub(crate) document: &'a Document,
    /// Fabrics given along with the scene, by the paths that it names them by.
    pub(crate) fabrics: &'a [Document],
    /// Reads the other fabrics.
    pub(crate) fabric: FabricReader<'a>,
    pub(crate) mistakes: Vec<Diagnostic>,
}

impl<'a> Reader<'a> {
    pub(crate) fn new(
        document: &'a Document,
        fabrics: &'a [Document],
        fabric: FabricReader<'a>,
    ) -> Self {
        Self { document, fabrics, fabric, mistakes: Vec::new() }
    }

    pub(crate) fn fail(&mut self, key: &str, message: String, help: &str) {
        self.mistakes.push(self.document.at(key, message).help(help));
    }

    /// Reports a name that is not among those that there are, with the nearest of them or else all.
    pub(crate) fn unknown(
        &mut self,
        key: &str,
        message: String,
        (name, known): (&str, &[&str]),
        what: &str,
    ) {
        let help = match closest(name, known.iter().copied()) {
            Some(near) => format!("did you mean \"{near}\"?"),
            None => format!("the {what} are: {}", known.join(", ")),
        };
        self.fail(key, message, &help);
    }

    /// Whether a number is within its inclusive bounds; if not, that is reported.
    pub(crate) fn within(
        &mut self,
        key: &str,
        value: f64,
        (low, high): (f64, f64),
        help: &str,
    ) -> bool {
        let sound = value >= low && value <= high;
        if !sound {
            self.fail(key, format!("{value} is not between {low} and {high}"), help);
        }
        sound
    }

    /// One of several words, or the first of them when none is given.
    pub(crate) fn choice<T: Copy>(
        &mut self,
        key: &str,
        word: Option<&str>,
        choices: &[(&str, T)],
    ) -> T {
        let found = choices.iter().find(|(name, _)| word.is_none_or(|word| word == *name));
        if let (None, Some(word)) = (found, word) {
            let names: Vec<&str> = choices.iter().map(|c| c.0).collect();
            let help = format!("one of {}", names.join(", "));
            self.fail(key, format!("there is no \"{word}\""), &help);
        }
        found.unwrap_or(&choices[0]).1
    }

    pub(crate) fn unit(&mut self, word: Option<&str>) -> f64 {
        self.choice("length", word, &[("m", 1.0), ("cm", 0.01), ("mm", 0.001)])
    }
}
