use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use drape::fit::{FrictionOrder, Intervals, LoopModel, Settings, TractionModel};

use crate::bench::BenchArguments;
use crate::failure::Failure;
use crate::{bench, check, fabric, fit, run, test, validate};

/// From measured fabric to moving cloth.
#[derive(Parser)]
#[command(name = "drape", version, propagate_version = true)]
pub(crate) enum Command {
    /// Identifies a fabric from KES curves or values and writes fabric.toml.
    Fit(FitArguments),
    /// Lists fabrics, shows one, compares two.
    #[command(subcommand)]
    Fabric(FabricCommand),
    /// Simulates a scene: frames, a picture and summary.json.
    Run(RunArguments),
    /// Holds simulations against exact solutions and measurements.
    Validate(ValidateArguments),
    /// Puts specimens of a fabric into simulated KES instruments and compares the loops with its laws.
    Test(TestArguments),
    /// Checks scenes, fabrics and sheets without simulating, and the frames of a run for surfaces that cross.
    Check(CheckArguments),
    /// Times the solver on this machine: a square metre, as a curtain and in a violent swing.
    Bench(BenchArguments),
}

#[derive(Args)]
pub(crate) struct FitArguments {
    /// Sheets, TOML files, or folders: one with a sheet.toml, or one with such folders inside.
    #[arg(required = true, value_name = "SHEET")]
    pub(crate) sheets: Vec<PathBuf>,
    /// The fabric to write, or the folder for several [default: fabric.toml beside each sheet].
    #[arg(short, long, value_name = "FABRIC.toml")]
    pub(crate) output: Option<PathBuf>,
    /// Folder for a report with plots, one HTML page per sheet.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) report: Option<PathBuf>,
    /// Replaces fabrics that are there already.
    #[arg(long)]
    pub(crate) force: bool,
    /// Prints the fit as JSON, in SI.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) laws: LawArguments,
}

#[derive(Subcommand)]
pub(crate) enum FabricCommand {
    /// Lists the sheets in folders: mass, thickness, what was measured.
    List {
        /// Folders to search.
        #[arg(default_value = "fabrics", value_name = "FOLDER")]
        folders: Vec<PathBuf>,
    },
    /// Shows a fabric: its parameters, the loops an instrument would draw, its KES values.
    Show {
        /// A fabric, or a sheet, which is fitted on the way.
        fabric: PathBuf,
        /// Folder for a page with plots.
        #[arg(long, value_name = "FOLDER")]
        report: Option<PathBuf>,
    },
    /// Compares two fabrics: their loops overlaid, a table of their values.
    Compare {
        /// Fabrics, or sheets, which are fitted on the way.
        #[arg(required = true, num_args = 2, value_names = ["FIRST", "SECOND"])]
        fabrics: Vec<PathBuf>,
        /// Folder for a page with plots.
        #[arg(long, value_name = "FOLDER")]
        report: Option<PathBuf>,
    },
}

/// Laws to take instead of those that the curves bear out.
#[derive(Args, Clone, Copy)]
pub(crate) struct LawArguments {
    /// Elastic load of the traction laws.
    #[arg(long, value_enum, value_name = "LAW")]
    traction: Option<Traction>,
    /// Bending laws.
    #[arg(long, value_enum, value_name = "LAW")]
    bending: Option<Loop>,
    /// Shear law.
    #[arg(long, value_enum, value_name = "LAW")]
    shear: Option<Loop>,
    /// Intervals from the residuals themselves, for curved laws and parameters at bounds; slower.
    #[arg(long)]
    profile: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum Traction {
    /// A priming zone that runs into a line (Ngo Ngoc & Boivin 2004).
    Primed,
    /// An even polynomial (Tagawa et al. 2003).
    Polynomial,
}

#[derive(Clone, Copy, ValueEnum)]
enum Loop {
    /// A line with one friction element.
    FirstOrder,
    /// A line with two friction elements side by side: nested loops that grow.
    Parallel,
    /// A line with friction of second order (Bliman & Sorine 1995).
    SecondOrder,
    /// A quadratic and a line without friction (Breen et al. 1994).
    #[value(name = "breen-1994")]
    Breen,
}

impl Loop {
    fn model(self) -> LoopModel {
        match self {
            Self::FirstOrder => LoopModel::Linear(FrictionOrder::First),
            Self::Parallel => LoopModel::Linear(FrictionOrder::Parallel),
            Self::SecondOrder => LoopModel::Linear(FrictionOrder::Second),
            Self::Breen => LoopModel::Piecewise,
        }
    }
}

impl LawArguments {
    pub(crate) fn settings(self) -> Settings {
        Settings {
            traction: self.traction.map(|traction| match traction {
                Traction::Primed => TractionModel::Primed,
                Traction::Polynomial => TractionModel::Polynomial,
            }),
            bending: self.bending.map(Loop::model),
            shear: self.shear.map(Loop::model),
            intervals: if self.profile { Intervals::Profile } else { Intervals::Wald },
            ..Settings::default()
        }
    }
}

#[derive(Args)]
pub(crate) struct RunArguments {
    /// The scene, a TOML file.
    pub(crate) scene: PathBuf,
    /// Folder for the results [default: the scene's, or out/NAME].
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// Number of threads [default: all].
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Ends the simulation at this time, in seconds.
    #[arg(long, value_name = "SECONDS")]
    pub(crate) until: Option<f64>,
    /// Replaces the results of an earlier run.
    #[arg(long)]
    pub(crate) force: bool,
    /// Prints the summary as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct ValidateArguments {
    /// Cases to run [default: all that take seconds].
    #[arg(value_name = "CASE")]
    pub(crate) cases: Vec<String>,
    /// Runs the cases that take minutes too.
    #[arg(long, conflicts_with = "cases")]
    pub(crate) full: bool,
    /// Outcomes that `--json` printed earlier, to be shown with those of this run; of a case in both, this run's.
    #[arg(long, value_name = "FILE")]
    pub(crate) earlier: Vec<PathBuf>,
    /// Folder for a page with plots and pictures, and each of them as a file.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) report: Option<PathBuf>,
    /// Writes the outcomes as a page in Markdown.
    #[arg(long, value_name = "FILE")]
    pub(crate) markdown: Option<PathBuf>,
    /// Prints the outcomes as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct TestArguments {
    /// A fabric, or a sheet, which is fitted on the way.
    pub(crate) fabric: PathBuf,
    /// Spacing of the particles [default: 5; for a drape what the fabric asks for, at most 5].
    #[arg(long, value_name = "MM")]
    pub(crate) spacing: Option<f64>,
    /// Puts the fabric on a drapemeter instead: drape coefficient, nodes, harmonics.
    #[arg(long)]
    pub(crate) drape: bool,
    /// The drapemeter.
    #[arg(long, value_enum, default_value = "frl", requires = "drape")]
    pub(crate) meter: Meter,
    /// Shakes the specimen after it was let down.
    #[arg(long, value_enum, requires = "drape")]
    pub(crate) shake: Option<ShakeName>,
    /// Specimens draped, each from another start.
    #[arg(long, value_name = "N", default_value_t = 10, requires = "drape")]
    pub(crate) starts: u64,
    /// Folder for a page with the loops overlaid.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) report: Option<PathBuf>,
    /// Prints the loops and values as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Drapemeters, by the diameters of specimen and disc.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Meter {
    /// 254 mm on 127 mm.
    Frl,
    /// Cusick's, 24 cm on 18 cm.
    #[value(name = "cusick-24")]
    Cusick24,
    /// Cusick's, 30 cm on 18 cm.
    #[value(name = "cusick-30")]
    Cusick30,
    /// Cusick's, 36 cm on 18 cm.
    #[value(name = "cusick-36")]
    Cusick36,
}

/// Ways to shake a draped specimen.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum ShakeName {
    /// The disc goes up and down three times by 10 mm to either side, twice a second.
    Bounce,
}

#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Scenes, fabrics, sheets, patterns, or folders of runs.
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Draws the cut panels of a pattern, with seams in pairs of one colour, as an SVG file.
    #[arg(long, value_name = "SVG")]
    pub(crate) figure: Option<PathBuf>,
    /// Distance between the particles of a cut pattern, in mm.
    #[arg(long, value_name = "MM", default_value_t = 10.0)]
    pub(crate) spacing: f64,
    /// Prints what was found in folders of runs as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

impl Command {
    /// Carries the command out, on a thread of the pool: work that comes from outside takes a switch of threads each time.
    pub(crate) fn execute(&self) -> Result<(), Failure> {
        if let Some(threads) = self.threads() {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
            pool.map_err(|error| Failure::Usage(format!("--threads {threads}: {error}")))?;
        }
        rayon::scope(|_| self.carry_out())
    }

    /// How many threads are asked for.
    fn threads(&self) -> Option<usize> {
        match self {
            Self::Run(arguments) => arguments.threads,
            Self::Bench(arguments) => Some(arguments.threads),
            _ => None,
        }
    }

    fn carry_out(&self) -> Result<(), Failure> {
        match self {
            Self::Fit(arguments) => fit::fit(arguments),
            Self::Fabric(command) => fabric::fabric(command),
            Self::Run(arguments) => run::run(arguments),
            Self::Validate(arguments) => validate::validate(arguments),
            Self::Test(arguments) => test::test(arguments),
            Self::Check(arguments) => check::check(arguments),
            Self::Bench(arguments) => bench::bench(arguments),
        }
    }
}
