//! The command line: which commands there are. Their arguments stand with them, in the modules of
//! [`commands`](crate::commands).

use clap::Parser;

use crate::commands::bench::{self, BenchArguments};
use crate::commands::check::{self, CheckArguments};
use crate::commands::convert::{self, ConvertArguments};
use crate::commands::fabric::{self, FabricCommand};
use crate::commands::fit::{self, FitArguments};
use crate::commands::run::{self, RunArguments};
use crate::commands::test::{self, TestArguments};
use crate::commands::validate::{self, ValidateArguments};
use crate::failure::Failure;

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
    /// Compares simulations with exact solutions and measurements.
    Validate(ValidateArguments),
    /// Tests specimens of a fabric in simulated KES instruments and compares the loops with its
    /// laws.
    Test(TestArguments),
    /// Checks scenes, fabrics, sheets and patterns without simulating, and the frames of a run for
    /// intersections.
    Check(CheckArguments),
    /// Converts patterns: GarmentCode, FreeSewing, SVG and DXF to TOML, and patterns to SVG at true
    /// scale, for a plotter or on pages of paper.
    Convert(ConvertArguments),
    /// Times the solver on this machine: a square metre, as a curtain and in a violent swing.
    Bench(BenchArguments),
}

impl Command {
    /// Executes the command on a thread of the pool: work that comes from another thread is handed
    /// over each time.
    pub(crate) fn execute(&self) -> Result<(), Failure> {
        if let Some(threads) = self.threads() {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
            pool.map_err(|error| Failure::Usage(format!("--threads {threads}: {error}")))?;
        }
        rayon::scope(|_| self.dispatch())
    }

    /// Number of threads that the arguments ask for.
    fn threads(&self) -> Option<usize> {
        match self {
            Self::Run(arguments) => arguments.threads,
            Self::Bench(arguments) => Some(arguments.threads),
            _ => None,
        }
    }

    fn dispatch(&self) -> Result<(), Failure> {
        match self {
            Self::Fit(arguments) => fit::fit(arguments),
            Self::Fabric(command) => fabric::fabric(command),
            Self::Run(arguments) => run::run(arguments),
            Self::Validate(arguments) => validate::validate(arguments),
            Self::Test(arguments) => test::test(arguments),
            Self::Check(arguments) => check::check(arguments),
            Self::Convert(arguments) => convert::convert(arguments),
            Self::Bench(arguments) => bench::bench(arguments),
        }
    }
}
