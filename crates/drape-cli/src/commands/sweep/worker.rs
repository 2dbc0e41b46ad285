//! Worker: runs one point as a process of this program, and records what came of it.

use std::collections::BTreeSet;
use std::fs::File;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use drape::sweep::{Base, Error, Outcome, Point, PointStorage, Record, Study};
use rustix::io::Errno;
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, waitid};

use crate::console::signal;
use crate::failure::Failure;
use crate::input;

/// Number of times that a point is tried where what runs it fails.
pub(super) const TRIES: u32 = 3;

/// Time between two looks at a run that outlived its sweep.
const BUSY: Duration = Duration::from_millis(200);

/// Longest message of a record, in bytes.
const MESSAGE_MAX: usize = 2000;

/// Worker of a study.
pub(super) struct Worker<'a> {
    study: &'a Study,
    program: PathBuf,
    threads: usize,
    /// Processes that run and have not been waited for.
    running: Mutex<BTreeSet<i32>>,
}

/// How a point ended.
pub(super) enum Ended {
    /// It has a record from before.
    Before(Record),
    /// It has one now.
    Now(Record),
    /// Another sweep runs it.
    Elsewhere,
    /// A signal ended it before it had one.
    Interrupted,
}

/// How a process ended.
struct Exit {
    code: Option<i32>,
    message: String,
}

impl<'a> Worker<'a> {
    /// Makes the worker of a study, whose processes have so many threads each.
    pub(super) fn new(study: &'a Study, threads: usize) -> Result<Self, Failure> {
        let program = std::env::current_exe()
            .map_err(|error| Failure::Output(format!("cannot find the program: {error}")))?;
        Ok(Self { study, program, threads, running: Mutex::default() })
    }

    /// Runs a point, unless it has a record or another sweep runs it.
    pub(super) fn run(&self, place: &PointStorage, point: &Point) -> Result<Ended, Failure> {
        let earlier = || place.record().filter(|own| own.outcome != Outcome::WorkerFailed);
        if let Some(record) = earlier() {
            return Ok(Ended::Before(record));
        }
        let Some(lock) = place.lock()? else { return Ok(Ended::Elsewhere) };
        if let Some(record) = earlier() {
            lock.remove();
            return Ok(Ended::Before(record));
        }
        while place.is_busy() {
            if signal::received().is_some() {
                return Ok(Ended::Interrupted);
            }
            std::thread::sleep(BUSY);
        }
        let begin = Instant::now();
        let mut retries = 0;
        let Exit { code, message } = loop {
            let exit = self.attempt(place, point)?;
            let is_worker = Outcome::from_exit_code(exit.code) == Outcome::WorkerFailed;
            if is_worker && signal::received().is_some() {
                return Ok(Ended::Interrupted);
            }
            if !is_worker || retries + 1 == TRIES {
                break exit;
            }
            retries += 1;
        };
        let record = Record {
            key: point.key.clone(),
            outcome: Outcome::from_exit_code(code),
            exit_code: code,
            retries,
            seconds: begin.elapsed().as_secs_f64(),
            message,
            summary: None,
        };
        place.finish(&record, self.study.keep())?;
        if record.outcome != Outcome::WorkerFailed {
            lock.remove();
        }
        Ok(Ended::Now(record))
    }

    /// Runs the process of a point once, from its checkpoint if there is one.
    fn attempt(&self, place: &PointStorage, point: &Point) -> Result<Exit, Failure> {
        if self.study.base() != Base::Scene {
            return self.report(place, point);
        }
        if place.is_finished() {
            return Ok(Exit { code: Some(0), message: String::new() });
        }
        if place.is_interrupted() {
            let exit = self.process(place, Stdio::null(), |command| {
                command.arg("resume").arg(place.folder()).arg("--no-picture");
            })?;
            // A checkpoint of another program, or of which nothing is left, is of no use.
            if !matches!(exit.code, Some(2 | 3)) {
                return Ok(exit);
            }
        }
        self.process(place, Stdio::null(), |command| {
            command.arg("run").arg(&point.file).arg("-o").arg(place.folder());
            command.args(["--force", "--no-picture"]);
            set(command, point);
        })
    }

    /// Runs the process of a fit or of a test once; what it prints becomes the summary.
    fn report(&self, place: &PointStorage, point: &Point) -> Result<Exit, Failure> {
        let folder = place.folder();
        let failed = |what: &'static str, path: &Path| {
            let path = path.to_owned();
            move |source| Failure::from(Error::Io { what, path, source })
        };
        std::fs::create_dir_all(folder).map_err(failed("create", folder))?;
        let path = folder.join("report.json");
        let file = File::create(&path).map_err(failed("write", &path))?;
        let exit = self.process(place, file.into(), |command| {
            command.arg(self.study.base().key()).arg(&point.file).arg("--json");
            if self.study.base() == Base::Fit {
                command.arg("-o").arg(folder.join("fabric.toml")).arg("--force");
            }
            command.args(self.study.options());
            set(command, point);
        })?;
        if exit.code == Some(0) {
            let text = std::fs::read(&path).map_err(failed("read", &path))?;
            place.write_summary(&text)?;
        }
        std::fs::remove_file(&path).map_err(failed("remove", &path))?;
        Ok(exit)
    }

    /// Runs a process of this program to its end.
    fn process(
        &self,
        place: &PointStorage,
        output: Stdio,
        arguments: impl FnOnce(&mut Command),
    ) -> Result<Exit, Failure> {
        let log = place.log();
        let failed = |what: &str, error: &dyn std::fmt::Display| {
            Failure::Output(format!("cannot {what}: {error}"))
        };
        // The process has the lock of its log as long as it goes, even where this program is killed
        // as soon as it has started it.
        let file = File::create(&log).and_then(|file| file.lock().map(|()| file));
        let file = file.map_err(|error| failed(&format!("write {}", log.display()), &error))?;
        let mut command = Command::new(&self.program);
        arguments(&mut command);
        command.args(["--quiet", "--progress", "none", "--threads"]);
        command.arg(self.threads.to_string());
        command.args(input::options());
        command.stdin(Stdio::null()).stdout(output).stderr(file);
        // No process starts after the others were ended.
        let mut running = self.running();
        if let Some(signal) = signal::received() {
            return Ok(Exit { code: Some(128 + i32::from(signal)), message: String::new() });
        }
        let mut child = command.spawn().map_err(|error| failed("start a process", &error))?;
        let number = i32::try_from(child.id()).unwrap_or_default();
        running.insert(number);
        drop(running);
        // The number stays that of the child until it is waited for below, which takes it from those
        // that signals go to.
        if let Some(pid) = Pid::from_raw(number) {
            let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT;
            while matches!(waitid(WaitId::Pid(pid), options), Err(Errno::INTR)) {}
        }
        let mut running = self.running();
        running.remove(&number);
        let status = child.wait().map_err(|error| failed("wait for a process", &error))?;
        drop(running);
        let text = std::fs::read(&log).unwrap_or_default();
        Ok(Exit { code: status.code(), message: message(status, &String::from_utf8_lossy(&text)) })
    }

    /// Sends a signal to all processes that run.
    pub(super) fn end_all(&self, signal: u8) {
        let signal = if signal == 2 { Signal::INT } else { Signal::TERM };
        for pid in self.running().iter().filter_map(|number| Pid::from_raw(*number)) {
            // It may have ended by itself.
            let _ = kill_process(pid, signal);
        }
    }

    fn running(&self) -> MutexGuard<'_, BTreeSet<i32>> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Adds the values of a point to a command.
fn set(command: &mut Command, point: &Point) {
    for setting in &point.settings {
        command.arg("--set").arg(setting.to_string());
    }
}

/// Returns the message of a process that failed: its text from the first error on.
fn message(status: ExitStatus, text: &str) -> String {
    if status.success() {
        return String::new();
    }
    if let Some(signal) = status.signal() {
        return format!("a signal ended it: {signal}");
    }
    let start = text.find("error").unwrap_or_default();
    let own = text[start..].trim();
    let end = (0..=own.len().min(MESSAGE_MAX)).rev().find(|end| own.is_char_boundary(*end));
    own[..end.unwrap_or_default()].to_owned()
}
