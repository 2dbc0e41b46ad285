//! `drape sweep`: plans, runs, collects and exports many runs of one scene, fit or test.
//!
//! The study, its points, their keys and their table come from `drape::sweep`. [`run`] distributes
//! the points to jobs, and [`worker`] runs each point as a process of this program. [`study`] reads
//! the study. [`converge`] is a separate command whose study varies the spacing.

mod collect;
pub(crate) mod converge;
mod run;
mod study;
mod worker;

use std::path::PathBuf;

use clap::{Args, Subcommand};
use drape::input::counted;
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

/// Least duration of a task, in s, because engines need some seconds to start a task.
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
    let points = counted(points.len(), "point", "points");
    say_written(format_args!("{points} in {}", path.display()))
}

fn export(arguments: &SweepExportArguments) -> Result<(), Failure> {
    let (study, points) = arguments.study.read(None)?;
    let EngineArguments { slurm, hyperqueue, .. } = arguments.engine;
    let (engine, name) = if slurm {
        (Engine::Slurm, "slurm.sh")
    } else if hyperqueue {
        (Engine::HyperQueue, "hyperqueue.toml")
    } else {
        (Engine::Dask, "dask_sweep.py")
    };
    let chunk =
        arguments.chunk.map_or_else(|| points_per_task(&study, &points), |chunk| chunk as usize);

    // The batch may run in another folder, so all its paths are absolute.
    let options = input::options();
    let output = std::path::absolute(study.output())
        .map_err(|error| Failure::Output(format!("{}: {error}", study.output().display())))?;
    let [program, folder] = [std::env::current_exe(), std::env::current_dir()]
        .map(|path| path.map_err(|error| Failure::Output(format!("the current folder: {error}"))));
    let batch = Batch {
        program: program?,
        folder: folder?,
        study: arguments.study.study.clone(),
        is_elsewhere: arguments.study.results.is_some(),
        output,
        options: options.iter().map(|option| option.to_string_lossy().into_owned()).collect(),
        tasks: points.len().div_ceil(chunk),
    };

    let text = batch.file(engine);
    let default = study.output().join(name);
    let path = arguments.output.as_ref().unwrap_or(&default);
    if input::is_standard(path) {
        return say(text.trim_end());
    }
    file::write(path, text)?;
    let tasks = counted(batch.tasks, "task", "tasks");
    say_written(format_args!("{tasks} in {}", path.display()))
}

/// Returns the number of points that take [`TASK_SECONDS`] together, from the mean time of the
/// points that are done. Without such points a task has one point.
fn points_per_task(study: &Study, points: &[Point]) -> usize {
    let records = points.iter().filter_map(|point| PointStorage::new(study, point).record());
    let done = records.filter(|record| record.outcome == Outcome::Done);
    let times: Vec<f64> = done.map(|record| record.seconds).collect();
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    if mean > 0.0 { ((TASK_SECONDS / mean).ceil() as usize).clamp(1, points.len()) } else { 1 }
}
