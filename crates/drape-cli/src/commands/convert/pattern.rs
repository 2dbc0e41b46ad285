//! Conversion of patterns.

use std::path::{Path, PathBuf};

use drape::input::{Diagnostic, Diagnostics};
use drape::pattern::{Error, Paper, Pattern, PatternNote, Request, Unit};

use super::arguments::ConvertArguments;
use crate::console::print_message;
use crate::failure::Failure;
use crate::input;
use crate::say::say;
use drape::run::file;

/// Converts the pattern at `from`, and prints its notes: what the result lacks, and what was
/// assumed.
pub(crate) fn convert(from: &Path, arguments: &ConvertArguments) -> Result<(), Failure> {
    let target = ConversionTarget::new(arguments)?;
    let (unit, size) = (unit(arguments)?, arguments.size.clone());
    let request = Request { unit, size, access: input::access().clone(), ..Request::new(from) };
    let pattern = if input::is_standard(from) {
        Pattern::parse_as(&input::document(from)?, &request)?
    } else {
        Pattern::read_as(&request).map_err(|error| match error {
            Error::Input(mistakes) => Failure::Input(mistakes),
            error => Failure::Input(Diagnostics::from(Diagnostic::new(from, error.to_string()))),
        })?
    };

    let files = target.files(from, &pattern);
    if let ConversionTarget::Text(None) = target {
        print_notes(pattern.notes());
        return say(files.iter().map(|file| file.content.trim_end()).collect::<String>());
    }

    let existing: Vec<String> = files
        .iter()
        .filter(|file| file.path.exists())
        .map(|file| file.path.display().to_string())
        .collect();
    if !existing.is_empty() && !arguments.force {
        let message = format!("{} exists; replace it with --force", existing.join(", "));
        return Err(Failure::Usage(message));
    }

    print_notes(pattern.notes());
    for file in &files {
        print_notes(&file.notes);
        file::write(&file.path, &file.content)?;
        say(format_args!("written to {}", file.path.display()))?;
    }
    Ok(())
}

/// Format and files of the result.
enum ConversionTarget {
    /// TOML, in a file, or on stdout if there is no path.
    Text(Option<PathBuf>),
    /// A drawing, at most as wide as the given width in mm.
    Drawing(PathBuf, Option<f64>),
    /// Drawings on pages of paper.
    Pages(PathBuf, Paper),
    /// DXF for programs of pattern makers.
    Dxf(PathBuf),
}

/// File to be written.
struct OutputFile {
    path: PathBuf,
    content: String,
    /// Notes on the parts of the pattern that this file does not contain.
    notes: Vec<PatternNote>,
}

impl OutputFile {
    /// Returns the file at `path` with `content`. The file contains the whole pattern.
    fn new(path: PathBuf, content: String) -> Self {
        Self { path, content, notes: Vec::new() }
    }
}

impl ConversionTarget {
    /// Returns the target that `arguments` name.
    fn new(arguments: &ConvertArguments) -> Result<Self, Failure> {
        let output = arguments.output.as_ref().filter(|path| !input::is_standard(path));
        let ending = output.and_then(|path| path.extension()).map(|e| e.to_ascii_lowercase());
        let is = |known: &str| ending.as_ref().is_some_and(|ending| ending == known);

        let Some(path) = output.filter(|_| is("svg")) else {
            if arguments.paper.is_some() || arguments.width.is_some() {
                let message = "--paper and --width are for a drawing: write it with -o NAME.svg";
                return Err(Failure::Usage(message.into()));
            }
            return match output {
                Some(path) if is("dxf") => Ok(Self::Dxf(path.clone())),
                Some(path) if !is("toml") => Err(Failure::Usage(format!(
                    "-o {}: patterns are written as *.toml, *.svg or *.dxf",
                    path.display()
                ))),
                output => Ok(Self::Text(output.cloned())),
            };
        };

        if let Some(word) = &arguments.paper {
            let paper = Paper::parse(word).ok_or_else(|| {
                Failure::Usage(format!(
                    "--paper {word}: it is a4, a3, a2, a1, a0, letter, legal, tabloid, or a size in mm from \
                     100x100 on, such as 210x297"
                ))
            })?;
            return Ok(Self::Pages(path.clone(), paper));
        }
        match arguments.width {
            Some(width) if !(100.0..=100_000.0).contains(&width) => Err(Failure::Usage(format!(
                "--width {width}: a width in mm from 100 to 100000, such as 900"
            ))),
            width => Ok(Self::Drawing(path.clone(), width)),
        }
    }

    /// Returns the files of `pattern`, which was read from `from`.
    fn files(&self, from: &Path, pattern: &Pattern) -> Vec<OutputFile> {
        match self {
            Self::Text(path) => {
                let name = input::message_path(from)
                    .file_name()
                    .unwrap_or_default()
                    .to_string_lossy()
                    .into_owned();
                let heading = format!(
                    "Pattern converted from {name} by drape {}. Lengths are in mm, angles in degrees.",
                    env!("CARGO_PKG_VERSION")
                );
                let path = path.clone().unwrap_or_default();
                vec![OutputFile::new(path, pattern.to_toml(&heading))]
            }

            Self::Dxf(path) => {
                let style = path.file_stem().unwrap_or_default().to_string_lossy();
                let drawing = pattern.to_dxf(&style);
                let (content, notes) = (drawing.text, drawing.notes);
                vec![OutputFile { path: path.clone(), content, notes }]
            }

            Self::Drawing(path, width) => {
                vec![OutputFile::new(path.clone(), pattern.to_svg(*width))]
            }

            Self::Pages(path, paper) => {
                let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                let pages = pattern.to_pages(*paper).into_iter();
                pages
                    .map(|page| {
                        let name = format!("{stem}-{}.svg", page.name);
                        OutputFile::new(path.with_file_name(name), page.svg)
                    })
                    .collect()
            }
        }
    }
}

/// Returns the unit of `--unit`.
fn unit(arguments: &ConvertArguments) -> Result<Option<Unit>, Failure> {
    let Some(word) = &arguments.unit else { return Ok(None) };
    match Unit::parse(word) {
        Some(unit) => Ok(Some(unit)),
        None => Err(Failure::Usage(format!("--unit {word}: it is mm, cm, m, in, pt or px"))),
    }
}

/// Prints the `notes` of a pattern or of an [`OutputFile`].
fn print_notes(notes: &[PatternNote]) {
    notes.iter().for_each(|note| print_message(format_args!("note: {note}")));
}
