//! `drape schema`: JSON Schema of the files. Editors complete and check files by these schemas. The
//! schemas are generated from the types that read the files. [`new`] writes files to start from,
//! with their schemas.

pub(crate) mod new;

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::Value;

use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_written};
use drape::run::file;

#[derive(Args)]
pub(crate) struct SchemaArguments {
    /// Kind of the files.
    #[arg(value_enum)]
    kind: SchemaKind,
    /// File to write, or - for stdout [default: stdout].
    #[arg(short, long, value_name = "FILE.json")]
    output: Option<PathBuf>,
    /// Replaces a file that is there already.
    #[arg(long)]
    force: bool,
}

/// Kinds of files.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum SchemaKind {
    /// Cloth, bodies, contact, time.
    Scene,
    /// What was measured of a fabric.
    Sheet,
    /// The laws of a fabric.
    Fabric,
    /// Panels and seams.
    Pattern,
    /// Many runs of a scene.
    Study,
}

impl SchemaKind {
    /// Returns the schema as the text of a JSON file.
    pub(crate) fn text(self) -> String {
        let schema: Value = match self {
            Self::Scene => drape::scene::scene_schema(),
            Self::Sheet => drape::kes::sheet_schema(),
            Self::Fabric => drape::fabric::fabric_schema(),
            Self::Pattern => drape::pattern::pattern_schema(),
            Self::Study => drape::sweep::study_schema(),
        };
        let text = serde_json::to_string_pretty(&schema);
        text.expect("a value always has a JSON form") + "\n"
    }
}

/// Executes `drape schema`.
pub(crate) fn schema(arguments: &SchemaArguments) -> Result<(), Failure> {
    let SchemaArguments { kind, output, force } = arguments;
    let Some(path) = output.as_ref().filter(|path| !input::is_standard(path)) else {
        return say(kind.text().trim_end());
    };
    file::refuse_existing(path, *force, "replace it with --force")?;
    file::write(path, kind.text())?;
    say_written(format_args!("{} written", path.display()))
}
