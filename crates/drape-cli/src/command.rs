//! The command line: the list of commands, and the options that every command has. The arguments of
//! a command stand in the command's module of [`commands`](crate::commands).

use std::path::{Path, PathBuf};

use clap::{Args, CommandFactory, Parser, Subcommand};
use drape::run::file::FileKind;

use crate::commands::bench::{self, BenchArguments};
use crate::commands::check::{self, CheckArguments};
use crate::commands::convert::{self, ConvertArguments};
use crate::commands::export::{self, ExportArguments};
use crate::commands::fabric::report::{self, ReportArguments};
use crate::commands::fabric::{self, FabricCommand};
use crate::commands::fit::{self, FitArguments};
use crate::commands::run::resume::{self, ResumeArguments};
use crate::commands::run::{self, RunArguments};
use crate::commands::schema::new::{self, NewArguments};
use crate::commands::schema::{self, SchemaArguments};
use crate::commands::shell::{self, CompletionsArguments, ManArguments};
use crate::commands::show::picture::{self, PictureArguments};
use crate::commands::show::view::{self, ViewArguments};
use crate::commands::sweep::converge::{self, ConvergeArguments};
use crate::commands::sweep::{self, SweepCommand};
use crate::commands::test::{self, TestArguments};
use crate::commands::validate::{self, ValidateArguments};
use crate::console::{Console, ProgressKind};
use crate::failure::Failure;
use crate::input;
use drape::input::FileAccess;

/// Exit codes of the program. The long help ends with this text.
const EXIT_CODES: &str = "\
Exit codes:
  0    done
  2    usage: arguments that do not fit together, or results that are there already
  3    wrong input: files with mistakes
  4    surfaces intersect
  5    the solver failed, the cloth did not come to rest, or the balance of energy does not close
  6    a file could not be read or written
  7    a figure of the validation is beyond its limit
  8    a run came to --max-wall, --max-memory or --max-disk; `drape resume` goes on
  70   the program failed in a way that it should not
  130  interrupted; `drape resume` goes on. The code is 128 and the number of the signal: 130 after
       SIGINT, 143 after SIGTERM, 129 after SIGHUP, 138 after SIGUSR1, 152 after SIGXCPU
  134  no memory was left; `drape resume` goes on from the last checkpoint

Results that are there already, of a run, a fit, an export or `new`, are replaced with --force
only; pages and figures are replaced always. Data go to stdout, messages and progress to stderr;
NO_COLOR=1 turns colours off.";

/// From measured fabric to moving cloth.
#[derive(Parser)]
#[command(name = "drape", version, propagate_version = true, after_long_help = EXIT_CODES)]
pub(crate) struct CommandLine {
    #[command(flatten)]
    options: Options,
    #[command(subcommand)]
    command: Command,
}

/// Options of every command.
#[derive(Args)]
#[command(next_help_heading = "Options of every command")]
struct Options {
    /// Number of threads [default: all; 1 for bench].
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Prints results, warnings and errors only.
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Prints a line for every step of a simulation, with what makes it slow.
    #[arg(short, long, global = true)]
    verbose: bool,
    /// Progress on stderr.
    #[arg(long, global = true, value_enum, default_value = "auto", value_name = "KIND")]
    progress: ProgressKind,
    /// Lets scenes and sheets name this file, or those in this folder, too; may be given several
    /// times [default: those in their own folder and in the working folder].
    #[arg(long, global = true, value_name = "PATH")]
    allow_path: Vec<PathBuf>,
    /// Reads files up to N times as large as usual: TOML of 1 MiB, patterns and standard input of
    /// 16, tables of 32, meshes and their motions of 256.
    #[arg(long, global = true, value_name = "N", default_value_t = 1, hide_default_value = true)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    raise_limits: u32,
}

#[derive(Subcommand)]
enum Command {
    /// Writes a commented file to start from: a scene, a sheet or a pattern.
    New(NewArguments),
    /// Identifies a fabric from KES curves or values and writes fabric.toml.
    Fit(FitArguments),
    /// Lists fabrics, shows one, compares several, writes one for other programs.
    #[command(subcommand)]
    Fabric(FabricCommand),
    /// Writes the report on fabrics that a laboratory sends to its customer: head, values, loops,
    /// drape.
    Report(ReportArguments),
    /// Simulates scenes: frames, a picture and summary.json of each.
    Run(RunArguments),
    /// Goes on with a run that was interrupted, from its last checkpoint, to the results that it
    /// would have had; or with one that has ended, beyond its end.
    Resume(ResumeArguments),
    /// Runs a scene, a fit or a test many times, with values from a study, and makes one table of
    /// all.
    #[command(subcommand)]
    Sweep(SweepCommand),
    /// Runs a scene at several spacings and extrapolates its measures to a spacing of 0.
    Converge(ConvergeArguments),
    /// Compares simulations with exact solutions and measurements.
    Validate(ValidateArguments),
    /// Tests specimens of a fabric in simulated KES instruments and compares the loops with its
    /// laws.
    Test(TestArguments),
    /// Checks scenes, fabrics, sheets, patterns and bodies without simulating, and the frames of a
    /// run for intersections.
    Check(CheckArguments),
    /// Converts patterns: GarmentCode, FreeSewing, SVG and DXF to TOML, and patterns to SVG at true
    /// scale, for a plotter or on pages of paper.
    Convert(ConvertArguments),
    /// Shows runs in a page of HTML that turns, plays and measures them, and needs nothing else.
    View(ViewArguments),
    /// Draws pictures of a run: any frame, from any side, with a colour map, as a strip or turning.
    Picture(PictureArguments),
    /// Writes the frames of a run for other programs: OBJ, glTF, USD, point caches, VTK, NumPy,
    /// CSV, pictures.
    Export(ExportArguments),
    /// Times the solver on this machine: a square metre, as a curtain and in a violent swing.
    Bench(BenchArguments),
    /// Prints the JSON Schema of a kind of file, by which editors complete and check it.
    Schema(SchemaArguments),
    /// Prints the completions of a shell.
    Completions(CompletionsArguments),
    /// Prints the manual page, or writes one for each command.
    Man(ManArguments),
}

impl CommandLine {
    /// Applies the options and executes the command on a thread of rayon's pool. A call of a
    /// parallel function from any other thread would be handed over to the pool each time.
    pub(crate) fn execute(&self) -> Result<(), Failure> {
        let Options { threads, quiet, verbose, progress, ref allow_path, raise_limits } =
            self.options;
        input::set_access(FileAccess {
            allowed: allow_path.clone(),
            size_factor: raise_limits,
            ..FileAccess::default()
        });
        Console { quiet, verbose, progress }.install();

        // A benchmark is timed on one thread unless the user asks for another number.
        let bench = matches!(self.command, Command::Bench(_)).then_some(1);
        if let Some(threads) = threads.or(bench) {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
            pool.map_err(|error| Failure::Usage(format!("--threads {threads}: {error}")))?;
        }
        rayon::scope(|_| self.command.execute())
    }
}

impl Command {
    /// Calls the function of the command.
    fn execute(&self) -> Result<(), Failure> {
        match self {
            Self::New(arguments) => new::new(arguments),
            Self::Fit(arguments) => fit::fit(arguments),
            Self::Fabric(command) => fabric::fabric(command),
            Self::Report(arguments) => report::report(arguments),
            Self::Run(arguments) => run::run(arguments),
            Self::Resume(arguments) => resume::resume(arguments),
            Self::Sweep(command) => sweep::sweep(command),
            Self::Converge(arguments) => converge::converge(arguments),
            Self::Validate(arguments) => validate::validate(arguments),
            Self::Test(arguments) => test::test(arguments),
            Self::Check(arguments) => check::check(arguments),
            Self::Convert(arguments) => {
                // A file that `drape` reads as it is needs no conversion.
                arguments.from.iter().try_for_each(|from| expect_convertible(from))?;
                convert::convert(arguments)
            }
            Self::View(arguments) => view::view(arguments),
            Self::Picture(arguments) => picture::picture(arguments),
            Self::Export(arguments) => export::export(arguments),
            Self::Bench(arguments) => bench::bench(arguments),
            Self::Schema(arguments) => schema::schema(arguments),
            Self::Completions(arguments) => shell::completions(arguments, CommandLine::command()),
            Self::Man(arguments) => shell::man(arguments, CommandLine::command()),
        }
    }
}

/// Refuses a file `from` that `drape convert` cannot convert because `drape` reads the file as it
/// is.
fn expect_convertible(from: &Path) -> Result<(), Failure> {
    let convertible = [
        FileKind::Drawing,
        FileKind::Pattern,
        FileKind::Table,
        FileKind::Workbook,
        FileKind::Archive,
    ];
    match input::kind(from) {
        // A folder of exports may have its sheet already.
        Some(FileKind::Sheet) if from.is_dir() => Ok(()),
        _ => Ok(input::expect(from, &convertible)?),
    }
}
