//! Remedies that a program offers in words of its own: an action, with the values that it needs.
//!
//! A library does not know how its user reaches the action: by a call of a function, by a command,
//! or by a button. It states the action, and the program around it writes the sentence.

use std::fmt;
use std::path::PathBuf;

/// Action that corrects a mistake, with the values that it needs.
///
/// `Display` writes the action for a program that uses the libraries. A program with other words
/// for it replaces them by [`Diagnostic::in_words`](crate::Diagnostic::in_words). The list is
/// exhaustive, so that a program which translates remedies is not built without words for a new
/// one.
///
/// ```
/// use drape_input::{Diagnostic, Remedy};
///
/// let remedy = Remedy::StateUnit { file: "skirt.svg".into(), units: &["mm", "cm"] };
/// let mistake = Diagnostic::new("skirt.svg", "the unit is unknown").help(remedy);
/// let in_words = mistake.in_words(|remedy| match remedy {
///     Remedy::StateUnit { units, .. } => format!("press the button {}", units.join(" or ")),
///     other => other.to_string(),
/// });
/// assert_eq!(in_words.help.as_deref(), Some("press the button mm or cm"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Remedy {
    /// The file of a pattern states no unit: state it.
    StateUnit {
        /// File of the pattern.
        file: PathBuf,
        /// Units that are accepted, of which the first is the most usual.
        units: &'static [&'static str],
    },
    /// The unit in which the file of a pattern was read may be wrong: state the right one.
    CorrectUnit {
        /// File of the pattern.
        file: PathBuf,
        /// Units that are accepted, of which the first is the most usual.
        units: &'static [&'static str],
    },
    /// In the unit that was taken, a pattern has an unusual size: state which unit is right.
    ConfirmUnit {
        /// File of the pattern.
        file: PathBuf,
        /// Unit in which the size would be usual.
        likely: &'static str,
        /// Unit that was taken.
        taken: &'static str,
    },
    /// The file of a pattern holds several sizes: choose one.
    ChooseSize {
        /// File of the pattern.
        file: PathBuf,
        /// One of the sizes.
        size: String,
    },
    /// A laboratory's file holds several fabrics: choose one.
    ChooseFabric {
        /// Names of the fabrics.
        names: Vec<String>,
    },
    /// A file has no laws of a fabric. If it is a sheet of measurements, fit a fabric to it.
    FitSheet {
        /// The file.
        sheet: PathBuf,
    },
    /// A fabric has no standard errors: fit it to a sheet that determines them.
    FitWithErrors {
        /// File of the fabric.
        fabric: PathBuf,
    },
    /// The mesh of a body is not one closed surface: repair it.
    RepairMesh {
        /// File of the mesh.
        mesh: PathBuf,
        /// File for the repaired mesh.
        repaired: PathBuf,
        /// The file `repaired`, as the scene names it.
        named: PathBuf,
    },
    /// The mesh of a body passes through itself: list the places.
    ListCrossings {
        /// File of the mesh.
        mesh: PathBuf,
    },
    /// The triangles of a body are finer than cloth can see: thin them.
    ThinMesh {
        /// File of the mesh.
        mesh: PathBuf,
        /// Length of a unit of the file, in m.
        scale: f64,
        /// Spacing of the cloth, in m.
        spacing: f64,
        /// File for the mesh with fewer triangles.
        thinned: PathBuf,
    },
    /// Panels are in the way of a seam: look at the start of the scene.
    ShowStart {
        /// File of the scene.
        scene: PathBuf,
    },
    /// A grading needs a run of the scene without grading: make that run.
    RunWithoutGrading,
    /// A path leads out of the allowed folders: allow it.
    AllowPath {
        /// File or folder to which the path leads.
        place: PathBuf,
    },
    /// A file is larger than the limit of its kind: raise the limits.
    RaiseLimits {
        /// Smallest factor of the usual limit with which the file is read.
        factor: u64,
    },
    /// The input of a run has changed since the run was begun: run it from its start.
    RunAnew,
    /// A file or folder is of another kind than the kind that is needed: use it as what it is.
    UseFile {
        /// The file or the folder.
        path: PathBuf,
        /// The file, as a scene names it.
        named: PathBuf,
        /// What it is used as.
        purpose: FilePurpose,
    },
}

/// What a file or a folder is used as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilePurpose {
    /// A scene, which is simulated.
    Scene,
    /// A fabric, which is shown, tested, and named by a scene.
    Fabric,
    /// A sheet of measurements, to which a fabric is fitted.
    Sheet,
    /// A pattern, which is sewn in a scene.
    Pattern,
    /// A study, whose points are run.
    Study,
    /// A drawing of a pattern, which is converted.
    Drawing,
    /// The mesh of a body, which a scene names.
    Body,
    /// A table of a laboratory, from which a sheet is drafted.
    Table,
    /// The folder of a run, which is shown and verified.
    Run,
}

/// The numbers of a remedy are lengths of files and scenes, which are finite.
impl Eq for Remedy {}

impl fmt::Display for Remedy {
    /// Writes the action to `f` in words for a program that uses the libraries.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::StateUnit { units, .. } => {
                write!(f, "state the unit: {}", unit_keys(units))
            }
            Self::CorrectUnit { units, .. } => {
                write!(f, "if the unit is wrong, state it: {}", unit_keys(units))
            }
            Self::ConfirmUnit { likely, taken, .. } => write!(
                f,
                "state the unit: {}; \"{taken}\" if the size is meant",
                unit_keys(&[likely])
            ),
            Self::ChooseSize { size, .. } => write!(
                f,
                "choose one: size = \"{size}\" in the [from] of a pattern, or the `size` of a `Request`"
            ),
            Self::ChooseFabric { names } => write!(f, "name one of {}", quoted(names)),
            Self::FitSheet { .. } => f.write_str(
                "if it is a sheet of measurements, fit a fabric to it with the crate drape-fit, and \
                 name the file of that fabric here",
            ),
            Self::FitWithErrors { .. } => f.write_str(
                "fit it with the crate drape-fit, from a sheet with curves or with standard deviations",
            ),
            Self::RepairMesh { named, .. } => write!(
                f,
                "`MeshInspection` of the crate drape-collide has all faults, and `repair` mends what is \
                 safe; write the repaired mesh and give file = {:?}",
                named.display().to_string()
            ),
            Self::ListCrossings { .. } => {
                f.write_str("`MeshInspection` of the crate drape-collide lists them")
            }
            Self::ThinMesh { spacing, .. } => write!(
                f,
                "`repair` of the crate drape-collide thins them, with `RepairSettings` for a spacing \
                 of {spacing} m"
            ),
            Self::ShowStart { .. } => {
                f.write_str("a picture of the positions at the start shows them")
            }
            Self::RunWithoutGrading => f.write_str(
                "run the scene without [grading] first, at a larger spacing and with a folder of its own",
            ),
            Self::AllowPath { place } => write!(
                f,
                "move it there, or add {:?} to the `allowed` paths of its `FileAccess`",
                place.display().to_string()
            ),
            Self::RaiseLimits { factor } => {
                write!(f, "a `FileAccess` with the `size_factor` {factor} reads it")
            }
            Self::RunAnew => f.write_str(
                "or run the scene anew, with `RunOptions` that replace the results of the folder",
            ),
            Self::UseFile { named, purpose, .. } => {
                let named = named.display();
                match purpose {
                    FilePurpose::Scene => f.write_str("read it as a scene and simulate it"),
                    FilePurpose::Fabric => {
                        write!(f, "a scene names it: fabric.NAME.file = \"{named}\"")
                    }
                    FilePurpose::Sheet => write!(
                        f,
                        "fit a fabric to it with the crate drape-fit; a scene names it: \
                         fabric.NAME.file = \"{named}\""
                    ),
                    FilePurpose::Pattern => {
                        write!(f, "a scene sews it: [[garment]] pattern = \"{named}\"")
                    }
                    FilePurpose::Study => f.write_str("read it with the crate drape-sweep"),
                    FilePurpose::Drawing => {
                        f.write_str("convert it to a pattern with the crate drape-pattern")
                    }
                    FilePurpose::Body => {
                        write!(f, "a scene names it: [[collider.mesh]] file = \"{named}\"")
                    }
                    FilePurpose::Table => {
                        f.write_str("draft a sheet of it with `SheetDraft` of the crate drape-kes")
                    }
                    FilePurpose::Run => {
                        f.write_str("read its frames with `Recording` of the crate drape-frames")
                    }
                }
            }
        }
    }
}

/// Returns the keys and fields that state one of `units`, of which the first is the example.
fn unit_keys(units: &[&str]) -> String {
    let (first, others) = units.split_first().unwrap_or((&"mm", &[]));
    let others =
        if others.is_empty() { String::new() } else { format!(" (or {})", others.join(", ")) };
    format!("unit = \"{first}\"{others} in the [from] of a pattern, or the `unit` of a `Request`")
}

/// Returns `names` in quotes, with commas between them.
fn quoted(names: &[String]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    names.join(", ")
}
