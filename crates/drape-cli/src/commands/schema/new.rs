//! `drape new`: writes commented files to start from, which run as they are, with their schemas.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use crate::commands::schema::SchemaKind;
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_written};
use drape::run::file;

#[derive(Args)]
pub(crate) struct NewArguments {
    /// Kind of the file.
    #[arg(value_enum)]
    kind: TemplateKind,
    /// The file to write, or - for stdout [default: the kind, with the ending .toml].
    #[arg(short, long, value_name = "FILE.toml")]
    output: Option<PathBuf>,
    /// Replaces a file that is there already.
    #[arg(long)]
    force: bool,
}

/// Kinds of files to start from.
#[derive(Clone, Copy, ValueEnum)]
enum TemplateKind {
    /// A cloth on a ball, with the sheet of its fabric, if none is beside it.
    Scene,
    /// The KES values of a fabric.
    Sheet,
    /// Two panels and their seams.
    Pattern,
}

impl TemplateKind {
    /// Returns the default name of the file.
    fn file_name(self) -> &'static str {
        match self {
            Self::Scene => "scene.toml",
            Self::Sheet => "sheet.toml",
            Self::Pattern => "pattern.toml",
        }
    }

    /// Returns the text of the file, from the folder `templates`.
    fn content(self) -> &'static str {
        match self {
            Self::Scene => include_str!("../../../templates/scene.toml"),
            Self::Sheet => include_str!("../../../templates/sheet.toml"),
            Self::Pattern => include_str!("../../../templates/pattern.toml"),
        }
    }

    /// Returns the name of the schema, which is written beside the file.
    fn schema_name(self) -> &'static str {
        match self {
            Self::Scene => "scene.schema.json",
            Self::Sheet => "sheet.schema.json",
            Self::Pattern => "pattern.schema.json",
        }
    }

    fn schema(self) -> SchemaKind {
        match self {
            Self::Scene => SchemaKind::Scene,
            Self::Sheet => SchemaKind::Sheet,
            Self::Pattern => SchemaKind::Pattern,
        }
    }

    /// Returns the command to run on the file next.
    fn next(self) -> &'static str {
        match self {
            Self::Scene => "drape run",
            Self::Sheet => "drape fit",
            Self::Pattern => "drape check",
        }
    }
}

/// Executes `drape new`.
pub(crate) fn new(arguments: &NewArguments) -> Result<(), Failure> {
    let NewArguments { kind, output, force } = arguments;
    let default = PathBuf::from(kind.file_name());
    let path = output.as_ref().unwrap_or(&default);
    if input::is_standard(path) {
        return say(kind.content().trim_end());
    }
    file::refuse_existing(path, *force, "give -o, or replace it with --force")?;
    write(path, *kind)?;
    let sheet = path.with_file_name(TemplateKind::Sheet.file_name());
    if matches!(kind, TemplateKind::Scene) && !sheet.exists() {
        write(&sheet, TemplateKind::Sheet)?;
    }
    say_written(format_args!("next: {} {}", kind.next(), path.display()))
}

/// Writes the file at `path`, with a first line that names its schema to editors, and the schema
/// beside it if it does not exist.
fn write(path: &Path, kind: TemplateKind) -> Result<(), Failure> {
    let name = kind.schema_name();
    file::write(path, format!("#:schema ./{name}\n{}", kind.content()))?;
    say_written(format_args!("{} written", path.display()))?;
    let schema = path.with_file_name(name);
    if schema.exists() {
        return Ok(());
    }
    file::write(&schema, kind.schema().text())?;
    say_written(format_args!("{} written, by which editors check it", schema.display()))
}
