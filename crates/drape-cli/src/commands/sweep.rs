//! `drape sweep`: many runs of one scene, fits or tests, planned, run, collected and exported.
//!
//! The study, its points, their keys and their table are those of `drape::sweep`. [`run`] shares the
//! points out to jobs, each of which is a process of this program, started by [`worker`]. [`study`]
//! reads the study. [`converge`] is a command of its own, whose study is that of the spacing.

mod collect;
pub(crate) mod converge;
mod run;
mod study;
mod worker;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use drape::run::file;
use drape::sweep::{Batch, Engine, Outcome, Point, PointStorage, Study, manifest};

use self::collect::SweepCollectArguments;
use self::run::SweepRunArguments;
use self::study::StudyArguments;
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_written};

#[derive(Subcommand)]
pub(crate) enum SweepCommand {
    /// Lists the points of a study with their keys in manifest.jsonl, without running any.
    Plan(StudyArguments),
    /// Runs the points that have no result yet; what was interrupted goes on from its checkpoint.
    Run(SweepRunArguments),
    /// Collects inputs, measures and failures of all points in table.csv and a page of effects.
    Collect(SweepCollectArguments),
    /// Writes the file by which Slurm, HyperQueue or Dask run a study on many machines.
    Export(SweepExportArguments),
}

#[derive(Args)]
pub(crate) struct SweepExportArguments {
    #[command(flatten)]
    study: StudyArguments,
    #[command(flatten)]
    engine: EngineArguments,
    /// Number of points of a task [default: as many as take a minute, by the points that have been
    /// run; 1 without any].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    chunk: Option<u32>,
    /// File to write, or - for stdout [default: in the study's folder of results].
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Args)]
#[group(required = true, multiple = false)]
struct EngineArguments {
    /// A script of an array of jobs, for `sbatch`.
    #[arg(long)]
    slurm: bool,
    /// A job file, for `hq job submit-file`.
    #[arg(long)]
    hyperqueue: bool,
    /// A program in Python, for Dask.
    #[arg(long)]
    dask: bool,
}

/// Least time of a task, in s: engines need some to start one.
const TASK_SECONDS: f64 = 60.0;

/// Executes `drape sweep`.
pub(crate) fn sweep(command: &SweepCommand) -> Result<(), Failure> {
    match command {
        SweepCommand::Plan(arguments) => plan(arguments),
        SweepCommand::Run(arguments) => run::run(arguments),
        SweepCommand::Collect(arguments) => collect::collect(arguments),
        SweepCommand::Export(arguments) => export(arguments),
    }
}

fn plan(arguments: &StudyArguments) -> Result<(), Failure> {
    let (study, points) = arguments.read(None)?;
    let path = study.output().join("manifest.jsonl");
    file::write(&path, manifest(&study, &points))?;
    say_written(format_args!("{} points in {}", points.len(), path.display()))
}

fn export(arguments: &SweepExportArguments) -> Result<(), Failure> {
    let (study, points) = arguments.study.read(None)?;
    let EngineArguments { slurm, hyperqueue, .. } = arguments.engine;
    let (engine, name) = match (slurm, hyperqueue) {
        (true, _) => (Engine::Slurm, "slurm.sh"),
        (_, true) => (Engine::HyperQueue, "hyperqueue.toml"),
        _ => (Engine::Dask, "dask_sweep.py"),
    };
    let chunk = arguments.chunk.map_or_else(|| chunk(&study, &points), |chunk| chunk as usize);
    let here = |error| Failure::Output(format!("the current folder: {error}"));
    let options = input::options();
    let output = std::path::absolute(study.output())
        .map_err(|error| Failure::Output(format!("{}: {error}", study.output().display())))?;
    let batch = Batch {
        program: std::env::current_exe().map_err(here)?,
        folder: std::env::current_dir().map_err(here)?,
        study: arguments.study.study.clone(),
        is_elsewhere: arguments.study.results.is_some(),
        output,
        options: options.iter().map(|own| own.to_string_lossy().into_owned()).collect(),
        tasks: points.len().div_ceil(chunk),
    };
    let text = batch.file(engine);
    let default = study.output().join(name);
    let path = arguments.output.as_ref().unwrap_or(&default);
    if input::is_standard(path) {
        return say(text.trim_end());
    }
    file::write(path, text)?;
    say_written(format_args!("{} tasks in {}", batch.tasks, path.display()))
}

/// Returns how many points take a minute, by those that have been run.
fn chunk(study: &Study, points: &[Point]) -> usize {
    let records = points.iter().filter_map(|point| PointStorage::new(study, point).record());
    let times = records.filter(|record| record.outcome == Outcome::Done);
    let times: Vec<f64> = times.map(|record| record.seconds).collect();
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    if mean > 0.0 { ((TASK_SECONDS / mean).ceil() as usize).clamp(1, points.len()) } else { 1 }
}
