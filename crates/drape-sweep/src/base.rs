//! Bases of studies: the scene, sheet or fabric of which all points are runs.

use drape_input::{Diagnostic, Diagnostics, Document, excerpt};

use crate::file::StudyFile;

/// Base of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// Scene that is simulated.
    Scene,
    /// Sheet to which a fabric is fitted.
    Fit,
    /// Fabric or sheet whose specimens are tested.
    Test,
}

impl Base {
    /// Returns the key with which a study names this base, such as `scene`.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Fit => "fit",
            Self::Test => "test",
        }
    }

    /// Returns the options that a study of this base may give, such as `--spacing`.
    fn options(self) -> &'static [&'static str] {
        match self {
            Self::Scene => &[],
            Self::Fit => &["--traction", "--bending", "--shear", "--profile"],
            Self::Test => &["--spacing", "--drape", "--meter", "--shake", "--starts"],
        }
    }

    /// Returns the base of the study `file`, read from `document`, and the name of its file.
    ///
    /// # Errors
    /// A mistake if the study names no base, or more than one base.
    pub(crate) fn from_file<'a>(
        document: &Document,
        file: &'a StudyFile,
    ) -> Result<(Self, &'a str), Diagnostics> {
        let StudyFile { scene, fit, test, .. } = file;
        let mut named = [(Self::Scene, scene), (Self::Fit, fit), (Self::Test, test)]
            .into_iter()
            .filter_map(|(base, name)| Some((base, name.as_deref()?)));
        match (named.next(), named.next()) {
            (Some(base), None) => Ok(base),
            (None, _) => Err(Diagnostic::new(document.path(), "the study has no base")
                .help("name one with scene, fit or test, such as scene = \"scene.toml\"")
                .into()),
            (_, Some((second, _))) => {
                let message = "the study has two bases";
                Err(document
                    .at(second.key(), message)
                    .help("name one of scene, fit and test")
                    .into())
            }
        }
    }

    /// Checks that `options`, which the study `document` gives, are options of this base.
    ///
    /// # Errors
    /// A mistake that names the first unknown option.
    pub(crate) fn check(self, document: &Document, options: &[String]) -> Result<(), Diagnostics> {
        // A word that does not begin with a dash is the value of an option.
        let known = self.options();
        let wrong = options.iter().find(|word| {
            let option = word.split('=').next().unwrap_or_default();
            known.is_empty() || word.starts_with('-') && !known.contains(&option)
        });
        let Some(wrong) = wrong else { return Ok(()) };

        let message = format!("a {} has no option {}", self.key(), excerpt(wrong));
        let help = match self {
            Self::Scene => "set keys of the scene by [set] or by axes".to_owned(),
            _ => format!("its options are: {}", known.join(", ")),
        };
        Err(document.at("options", message).help(help).into())
    }
}
