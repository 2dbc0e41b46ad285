//! Bases of studies: what their points are runs of.

use drape_input::{Diagnostic, Diagnostics, Document, excerpt};

use crate::file::StudyFile;

/// Base of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// Scene, which is simulated.
    Scene,
    /// Sheet, of which a fabric is fitted.
    Fit,
    /// Fabric or sheet, of which specimens are tested.
    Test,
}

impl Base {
    /// Key by which a study names its base.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Scene => "scene",
            Self::Fit => "fit",
            Self::Test => "test",
        }
    }

    /// Options that a study may give.
    fn options(self) -> &'static [&'static str] {
        match self {
            Self::Scene => &[],
            Self::Fit => &["--traction", "--bending", "--shear", "--profile"],
            Self::Test => &["--spacing", "--drape", "--meter", "--shake", "--starts"],
        }
    }

    /// Returns the base of a study and the name of its file.
    pub(crate) fn of<'a>(
        document: &Document,
        file: &'a StudyFile,
    ) -> Result<(Self, &'a str), Diagnostics> {
        let StudyFile { scene, fit, test, .. } = file;
        let named = [(Self::Scene, scene), (Self::Fit, fit), (Self::Test, test)];
        let named = named.map(|(base, name)| name.as_deref().map(|name| (base, name)));
        let mut named = named.into_iter().flatten();
        match (named.next(), named.next()) {
            (Some(base), None) => Ok(base),
            (None, _) => Err(Diagnostic::new(document.path(), "the study has no base")
                .help("name one with scene, fit or test, such as scene = \"scene.toml\"")
                .into()),
            (_, Some((other, _))) => {
                let message = "the study has two bases";
                Err(document
                    .at(other.key(), message)
                    .help("name one of scene, fit and test")
                    .into())
            }
        }
    }

    /// Checks the options of a study.
    pub(crate) fn check(self, document: &Document, options: &[String]) -> Result<(), Diagnostics> {
        let own = self.options();
        let is_known = |word: &str| own.contains(&word.split('=').next().unwrap_or_default());
        let is_wrong = |word: &&String| own.is_empty() || word.starts_with('-') && !is_known(word);
        let Some(wrong) = options.iter().find(is_wrong) else { return Ok(()) };
        let message = format!("a {} has no option {}", self.key(), excerpt(wrong));
        let help = match self {
            Self::Scene => "set keys of the scene by [set] or by axes".to_owned(),
            _ => format!("its options are: {}", own.join(", ")),
        };
        Err(document.at("options", message).help(help).into())
    }
}
