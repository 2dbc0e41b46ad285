//! `drape fabric export`: writes a fabric as the material of another program.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use clap::{Args, ValueEnum};
use drape::input::Diagnostic;
use drape::material::{Error, Material};
use drape::run::file;

use super::read::read;
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_written};

/// Contents and limits of the formats. The long help ends with this text.
const PROGRAMS: &str = "\
The numbers are read off the laws by virtual tests. The file says what they lose: friction and \
hysteresis, how the stiffness grows with the load, and for Blender and ppf-contact-solver the difference \
of warp and weft. Settings of Blender depend on the mesh: its file is a script, which sets the cloth \
modifier of the selected meshes. The shear of Browzwear is left empty, since its definition is not \
public. A U3M archive has the fabric itself, too. CLO is left out: what its fabric kit measures, and the \
units of its files, are not described in public.";

#[derive(Args)]
#[command(after_help = PROGRAMS)]
pub(crate) struct MaterialArguments {
    /// A fabric, or a sheet, which is fitted first; - for standard input.
    fabric: PathBuf,
    /// Format [default: by the ending of FILE].
    #[arg(long, value_enum, value_name = "F")]
    format: Option<Format>,
    /// File to write; - for standard output, which is the default for texts.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Load at which the stretch is read, in N/m: the weight of the cloth below, or the pull of a
    /// wearer.
    #[arg(long, value_name = "N/M", default_value_t = Material::LOAD)]
    load: f64,
    /// Replaces a file that is there already.
    #[arg(long)]
    force: bool,
}

/// Format of another program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Blender's cloth: a Python script that sets the cloth modifier of the selected meshes (.py).
    Blender,
    /// ppf-contact-solver: a material profile of its Blender add-on, with the keys of Python
    /// (.toml).
    Ppf,
    /// Browzwear: a table of what is typed into the physics of VStitcher and Lotta (.csv).
    Browzwear,
    /// Unified 3D Material 1.1, of Vizoo and Browzwear, as JSON (.u3m).
    U3m,
    /// The same as an archive, with the fabric itself (.u3ma).
    U3ma,
}

impl Format {
    /// Returns the format that the ending of `path` names.
    fn from_ending(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "py" => Some(Self::Blender),
            "toml" => Some(Self::Ppf),
            "csv" => Some(Self::Browzwear),
            "u3m" => Some(Self::U3m),
            "u3ma" => Some(Self::U3ma),
            _ => None,
        }
    }

    /// Returns the bytes of the file of `material`. `modified` is the time at which the fabric was
    /// written.
    fn encode(self, material: &Material, modified: SystemTime) -> Vec<u8> {
        match self {
            Self::Blender => material.to_blender().into(),
            Self::Ppf => material.to_ppf().into(),
            Self::Browzwear => material.to_browzwear().into(),
            Self::U3m => material.to_u3m(modified).into(),
            Self::U3ma => material.to_u3ma(modified),
        }
    }
}

/// Executes `drape fabric export`.
pub(super) fn export(arguments: &MaterialArguments) -> Result<(), Failure> {
    let MaterialArguments { fabric: path, output, load, force, .. } = arguments;
    let output = output.as_deref().filter(|path| !input::is_standard(path));
    let format = format(arguments, output)?;
    if let Some(output) = output {
        file::refuse_existing(output, *force, "replace it with --force")?;
    }

    // The numbers are read off the laws at the load.
    let material = Material::from_fabric(&read(path)?, *load).map_err(|error| match error {
        Error::Load { .. } => Failure::Usage(format!("--load: {error}")),
        error => {
            Failure::Input(Diagnostic::new(input::message_path(path), error.to_string()).into())
        }
    })?;
    let content = format.encode(&material, modified(path));
    let Some(output) = output else {
        let text = String::from_utf8(content).expect("formats for standard output are texts");
        return say(text.trim_end());
    };
    file::write(output, content)?;
    say_written(format_args!(
        "{} written to {}; what its numbers lose:",
        material.name,
        output.display()
    ))?;
    material.losses.iter().try_for_each(|loss| say_written(format_args!("  {loss}")))
}

/// Returns the format of `--format`, or the format that the ending of `output` names.
fn format(arguments: &MaterialArguments, output: Option<&Path>) -> Result<Format, Failure> {
    let format = arguments.format.or_else(|| Format::from_ending(output?));
    match (format, output) {
        (None, Some(path)) => Err(Failure::Usage(format!(
            "{}: the ending names no format; give --format blender, ppf, browzwear, u3m or u3ma, or a \
             file that ends in .py, .toml, .csv, .u3m or .u3ma",
            path.display()
        ))),
        (None, None) => Err(Failure::Usage(
            "name the program: --format blender, ppf, browzwear, u3m or u3ma, or a file with -o that \
             ends in .py, .toml, .csv, .u3m or .u3ma"
                .into(),
        )),
        (Some(Format::U3ma), None) => {
            Err(Failure::Usage("a U3M archive is no text; give a file with -o".into()))
        }
        (Some(format), _) => Ok(format),
    }
}

/// Returns the time at which the fabric at `path` was written, or the epoch for standard input.
fn modified(path: &Path) -> SystemTime {
    let modified = std::fs::metadata(input::sheet_file(path)).and_then(|file| file.modified());
    modified.unwrap_or(SystemTime::UNIX_EPOCH)
}
