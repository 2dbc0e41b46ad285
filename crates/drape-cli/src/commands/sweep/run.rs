//! `drape sweep run`: distributes the points of a study to jobs.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use clap::Args;
use drape::input::counted;
use drape::run::file;
use drape::sweep::{Outcome, Point, PointStorage, Record, Shard, Study, manifest};
use indicatif::ProgressBar;
use serde_json::json;

use super::study::StudyArguments;
use super::worker::{PointEnd, TRIES, Worker};
use crate::console::{Console, ProgressKind, print_message, progress, signal};
use crate::failure::Failure;
use crate::say::{say, say_written};

#[derive(Args)]
pub(crate) struct SweepRunArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Number of points that run at once, which share the threads [default: one for each thread].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Runs the point with this key, or with a key that begins so; may be given several times.
    #[arg(long, value_name = "KEY")]
    point: Vec<String>,
    /// Runs part i of n of the points, such as 1/4.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Lists the points with their keys, their outcomes and their values, and runs none.
    #[arg(long)]
    list: bool,
}

/// If this number of points in a row cannot be run, the machine is at fault and the sweep ends.
const FAILED_MAX: usize = 3;

/// Time between two checks for a signal.
const WATCH: Duration = Duration::from_millis(50);

/// Executes `drape sweep run`. A point that fails is a result. The exit code is an error only if a
/// worker failed or a signal was received.
pub(crate) fn run(arguments: &SweepRunArguments) -> Result<(), Failure> {
    let (study, points) = arguments.study.read(arguments.shard)?;
    let mut chosen = choose(arguments, &points)?;
    if arguments.list {
        return chosen.iter().try_for_each(|point| list(&study, point));
    }

    // A part of the points does not know the keys of the others.
    if arguments.shard.is_none() {
        write_manifest(&study, &points)?;
    }

    // Points that could not be run before come last, since they may fail again and end the sweep.
    chosen.sort_by_cached_key(|point| {
        let record = PointStorage::new(&study, point).record();
        record.is_some_and(|record| record.outcome == Outcome::WorkerFailed)
    });

    let again = format!("drape sweep run {}", arguments.study.study.display());
    let SweepEnd { counts, failure } = run_points(&study, &chosen, arguments.jobs, &again)?;
    say_written(counts)?;
    failure.map_or(Ok(()), Err)
}

/// End of a sweep.
pub(super) struct SweepEnd {
    /// Numbers of points by outcome, in words.
    pub(super) counts: String,
    /// Reason why some points were not run.
    pub(super) failure: Option<Failure>,
}

/// Runs `points` by `jobs` at once, by default one for each thread. `again` is the command that
/// continues the sweep.
pub(super) fn run_points(
    study: &Study,
    points: &[&Point],
    jobs: Option<u16>,
    again: &str,
) -> Result<SweepEnd, Failure> {
    signal::watch();
    let threads = rayon::current_num_threads();
    let jobs = jobs.map_or(threads, usize::from).min(points.len().max(1));
    let sweep = Sweep {
        worker: Worker::new(study, (threads / jobs).max(1))?,
        study,
        points,
        next: AtomicUsize::new(0),
        counts: Mutex::default(),
        bar: progress::bar(points.len() as u64, "{pos}/{len} points, {eta} left"),
    };
    let failures = sweep.run(jobs);
    sweep.bar.finish_and_clear();
    let counts = sweep.counts.into_inner().unwrap_or_else(PoisonError::into_inner);
    let failure = failures.into_iter().next().or_else(|| counts.failure(again));
    Ok(SweepEnd { counts: counts.describe(points.len()), failure })
}

/// Writes the list of all `points` unless the file has that text. Sweeps that start at the same
/// time write the same text.
fn write_manifest(study: &Study, points: &[Point]) -> Result<(), Failure> {
    let path = study.output().join("manifest.jsonl");
    let text = manifest(study, points);
    if std::fs::read_to_string(&path).ok().as_ref() == Some(&text) {
        return Ok(());
    }
    let temporary = study.output().join(format!("manifest-{}.jsonl", std::process::id()));
    file::write(&temporary, text)?;
    std::fs::rename(&temporary, &path)
        .map_err(|error| Failure::Output(format!("cannot write {}: {error}", path.display())))
}

/// Returns the `points` that `--point` names, by default all, each key once.
fn choose<'a>(
    arguments: &SweepRunArguments,
    points: &'a [Point],
) -> Result<Vec<&'a Point>, Failure> {
    let keys = &arguments.point;
    if let Some(key) = keys.iter().find(|key| points.iter().all(|point| !has_key(point, key))) {
        return Err(Failure::Usage(format!(
            "--point {key}: the study has no such point; `drape sweep run {} --list` lists them",
            arguments.study.study.display()
        )));
    }
    let mut known = BTreeSet::new();
    let chosen = points
        .iter()
        .filter(|point| keys.is_empty() || keys.iter().any(|key| has_key(point, key)))
        .filter(|point| known.insert(&point.key));
    Ok(chosen.collect())
}

/// Returns whether the key of `point` begins with `key`.
fn has_key(point: &Point, key: &str) -> bool {
    !key.is_empty() && point.key.starts_with(key)
}

/// Prints a line for `point`.
fn list(study: &Study, point: &Point) -> Result<(), Failure> {
    let outcome = PointStorage::new(study, point).outcome();
    say(format_args!("{}\t{}\t{outcome}\t{}", point.index, point.key, values(point)))
}

/// Returns the values of `point` as settings.
fn values(point: &Point) -> String {
    let settings: Vec<String> = point.settings.iter().map(ToString::to_string).collect();
    settings.join(" ")
}

/// Points that several jobs run.
struct Sweep<'a> {
    worker: Worker<'a>,
    study: &'a Study,
    points: &'a [&'a Point],
    next: AtomicUsize,
    counts: Mutex<Counts>,
    bar: ProgressBar,
}

/// Numbers of points by outcome.
#[derive(Default)]
struct Counts {
    done: usize,
    /// Points that were done before.
    earlier: usize,
    /// Points whose job was refused or failed.
    failed: usize,
    /// Points that could not be run.
    workers: usize,
    /// Number of points in a row that could not be run.
    in_a_row: usize,
    /// Points that another sweep runs.
    elsewhere: usize,
}

impl Counts {
    /// Returns the counts in words. `total` is the number of all points.
    fn describe(&self, total: usize) -> String {
        let Self { done, earlier, failed, workers, elsewhere, .. } = self;
        let points = counted(total, "point", "points");
        let mut text = format!("{points}: {done} run, {earlier} done before");
        for (count, outcome) in [
            (failed, "refused or failed"),
            (workers, "could not be run"),
            (elsewhere, "left to another sweep"),
        ] {
            if *count > 0 {
                text += &format!(", {count} {outcome}");
            }
        }
        text
    }

    /// Returns the reason why some points were not run, if there are such points. `again` is the
    /// command that continues the sweep.
    fn failure(&self, again: &str) -> Option<Failure> {
        if let Some(signal) = signal::received() {
            let message = format!("interrupted; go on with `{again}`");
            return Some(Failure::Interrupted { signal, message });
        }
        let rest = if self.in_a_row >= FAILED_MAX { ", and the rest is left" } else { "" };
        (self.workers > 0).then(|| {
            Failure::Output(format!(
                "{} could not be run on this machine, though tried {TRIES} times each{rest}; try \
                 again with `{again}`",
                counted(self.workers, "point", "points")
            ))
        })
    }
}

impl Sweep<'_> {
    /// Runs the points by `jobs` threads, and returns failures to write results.
    fn run(&self, jobs: usize) -> Vec<Failure> {
        std::thread::scope(|scope| {
            let jobs: Vec<_> = (0..jobs).map(|_| scope.spawn(|| self.job())).collect();
            while jobs.iter().any(|job| !job.is_finished()) {
                if let Some(signal) = signal::received() {
                    self.worker.end_all(signal);
                    break;
                }
                std::thread::park_timeout(WATCH);
            }
            jobs.into_iter().filter_map(|job| job.join().ok()?.err()).collect()
        })
    }

    /// Runs `points` one after the other until none remains, and returns the first failure to write
    /// a result.
    fn job(&self) -> Result<(), Failure> {
        while signal::received().is_none() && self.counts().in_a_row < FAILED_MAX {
            let Some(point) = self.points.get(self.next.fetch_add(1, Ordering::Relaxed)) else {
                break;
            };
            let end = self.worker.run(&PointStorage::new(self.study, point), point)?;
            self.count(point, &end);
        }
        Ok(())
    }

    fn counts(&self) -> MutexGuard<'_, Counts> {
        self.counts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Counts the end of `point`, and reports it.
    fn count(&self, point: &Point, end: &PointEnd) {
        let mut counts = self.counts();
        match end {
            PointEnd::Interrupted => return,
            PointEnd::Elsewhere => counts.elsewhere += 1,
            PointEnd::Before(Record { outcome: Outcome::JobFailed, .. }) => counts.failed += 1,
            PointEnd::Before(_) => counts.earlier += 1,
            PointEnd::Now(record) => {
                let in_a_row = counts.in_a_row + 1;
                counts.in_a_row = 0;
                match record.outcome {
                    Outcome::Done => counts.done += 1,
                    Outcome::JobFailed => counts.failed += 1,
                    Outcome::WorkerFailed => {
                        counts.workers += 1;
                        counts.in_a_row = in_a_row;
                    }
                }
                self.report(point, record);
            }
        }

        self.bar.inc(1);
    }

    /// Reports the outcome of `point`. Without `--verbose`, only failures are printed.
    fn report(&self, point: &Point, record: &Record) {
        let console = Console::get();
        if console.progress == ProgressKind::Json {
            print_message(json!({
                "point": point.index, "key": point.key, "outcome": record.outcome,
                "exit_code": record.exit_code, "seconds": record.seconds,
            }));
        } else if record.outcome != Outcome::Done {
            let (index, values) = (point.index, values(point));
            let message = record.message.replace('\n', "\n  ");
            self.bar.suspend(|| {
                print_message(format_args!("warning: point {index} ({values}): {message}"))
            });
        } else if console.verbose {
            let (index, values, seconds) = (point.index, values(point), record.seconds);
            print_message(format_args!("point {index} ({values}): done in {seconds:.2} s"));
        }
    }
}
