//! Worker: runs one point as a process of this program, and records the outcome.

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

/// Number of attempts at a point if its process crashes.
pub(super) const TRIES: u32 = 3;

/// Time between two checks of a run that continued after its sweep had ended.
const BUSY_INTERVAL: Duration = Duration::from_millis(200);

/// Longest message of a record, in bytes.
const MESSAGE_MAX: usize = 2000;

/// Worker of a study.
pub(super) struct Worker<'a> {
    study: &'a Study,
    program: PathBuf,
    /// Number of threads of each process.
    threads: usize,
    /// Numbers of the processes that run and have not been waited for.
    running: Mutex<BTreeSet<i32>>,
}

/// End of a point.
pub(super) enum PointEnd {
    /// The point had a record before.
    Before(Record),
    /// The point has been run and has a record now.
    Now(Record),
    /// Another sweep runs the point.
    Elsewhere,
    /// A signal ended the point before it had a record.
    Interrupted,
}

/// End of a process.
struct ProcessEnd {
    code: Option<i32>,
    message: String,
}

impl<'a> Worker<'a> {
    /// Returns the worker of `study`, whose processes have the given number of `threads` each.
    pub(super) fn new(study: &'a Study, threads: usize) -> Result<Self, Failure> {
        let program = std::env::current_exe()
            .map_err(|error| Failure::Output(format!("cannot find the program: {error}")))?;
        Ok(Self { study, program, threads, running: Mutex::default() })
    }

    /// Runs `point`, unless it has a record or another sweep runs it.
    pub(super) fn run(&self, storage: &PointStorage, point: &Point) -> Result<PointEnd, Failure> {
        if let Some(record) = final_record(storage) {
            return Ok(PointEnd::Before(record));
        }
        let Some(lock) = storage.lock()? else { return Ok(PointEnd::Elsewhere) };
        // Another sweep may have finished the point before the lock was free.
        if let Some(record) = final_record(storage) {
            lock.remove();
            return Ok(PointEnd::Before(record));
        }
        while storage.is_busy() {
            if signal::received().is_some() {
                return Ok(PointEnd::Interrupted);
            }
            std::thread::sleep(BUSY_INTERVAL);
        }

        let begin = Instant::now();
        let mut retries = 0;
        let ProcessEnd { code, message } = loop {
            let exit = self.attempt(storage, point)?;
            let is_worker = Outcome::from_exit_code(exit.code) == Outcome::WorkerFailed;
            if is_worker && signal::received().is_some() {
                return Ok(PointEnd::Interrupted);
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

        storage.finish(&record, self.study.keep())?;
        if record.outcome != Outcome::WorkerFailed {
            lock.remove();
        }
        Ok(PointEnd::Now(record))
    }

    /// Runs the process of `point` once, from its checkpoint if there is one.
    fn attempt(&self, storage: &PointStorage, point: &Point) -> Result<ProcessEnd, Failure> {
        if self.study.base() != Base::Scene {
            return self.report(storage, point);
        }
        if storage.is_finished() {
            return Ok(ProcessEnd { code: Some(0), message: String::new() });
        }
        if storage.is_interrupted() {
            let exit = self.process(storage, Stdio::null(), |command| {
                command.arg("resume").arg(storage.folder()).arg("--no-picture");
            })?;
            // The checkpoint is damaged or of another version, so the run starts again.
            if !matches!(exit.code, Some(2 | 3)) {
                return Ok(exit);
            }
        }
        self.process(storage, Stdio::null(), |command| {
            command.arg("run").arg(&point.file).arg("-o").arg(storage.folder());
            command.args(["--force", "--no-picture"]);
            add_settings(command, point);
        })
    }

    /// Runs the process of a fit or a test once. Its output becomes the summary of the point.
    fn report(&self, storage: &PointStorage, point: &Point) -> Result<ProcessEnd, Failure> {
        let folder = storage.folder();
        std::fs::create_dir_all(folder).map_err(io_failure("create", folder))?;
        let path = folder.join("report.json");
        let file = File::create(&path).map_err(io_failure("write", &path))?;
        let exit = self.process(storage, file.into(), |command| {
            command.arg(self.study.base().key()).arg(&point.file).arg("--json");
            if self.study.base() == Base::Fit {
                command.arg("-o").arg(folder.join("fabric.toml")).arg("--force");
            }
            command.args(self.study.options());
            add_settings(command, point);
        })?;

        if exit.code == Some(0) {
            let text = std::fs::read(&path).map_err(io_failure("read", &path))?;
            storage.write_summary(&text)?;
        }
        std::fs::remove_file(&path).map_err(io_failure("remove", &path))?;
        Ok(exit)
    }

    /// Runs a process of this program to its end. `arguments` adds the arguments of the command,
    /// and stdout goes to `output`.
    fn process(
        &self,
        storage: &PointStorage,
        output: Stdio,
        arguments: impl FnOnce(&mut Command),
    ) -> Result<ProcessEnd, Failure> {
        let log = storage.log();
        // The process inherits the lock of its log and keeps the lock until it ends, even if this
        // program is killed right after the start.
        let file = File::create(&log).and_then(|file| file.lock().map(|()| file));
        let file =
            file.map_err(|error| process_failure(&format!("write {}", log.display()), &error))?;

        let mut command = Command::new(&self.program);
        arguments(&mut command);
        command.args(["--quiet", "--progress", "none", "--threads"]);
        command.arg(self.threads.to_string());
        command.args(input::options());
        command.stdin(Stdio::null()).stdout(output).stderr(file);

        // The lock of `running` is held, so that no process starts after `end_all` has ended the
        // others.
        let mut running = self.running();
        if let Some(signal) = signal::received() {
            return Ok(ProcessEnd { code: Some(128 + i32::from(signal)), message: String::new() });
        }
        let mut child =
            command.spawn().map_err(|error| process_failure("start a process", &error))?;
        let number = i32::try_from(child.id()).unwrap_or_default();
        running.insert(number);
        drop(running);

        // `waitid` leaves the child as a zombie, so its number is not given to another process
        // before it is removed from `running`.
        if let Some(pid) = Pid::from_raw(number) {
            let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT;
            while matches!(waitid(WaitId::Pid(pid), options), Err(Errno::INTR)) {}
        }
        let mut running = self.running();
        running.remove(&number);
        let status = child.wait().map_err(|error| process_failure("wait for a process", &error))?;
        drop(running);

        let text = std::fs::read(&log).unwrap_or_default();
        Ok(ProcessEnd {
            code: status.code(),
            message: message(status, &String::from_utf8_lossy(&text)),
        })
    }

    /// Sends `signal` to all processes that run.
    pub(super) fn end_all(&self, signal: u8) {
        let signal = if signal == 2 { Signal::INT } else { Signal::TERM };
        for pid in self.running().iter().filter_map(|number| Pid::from_raw(*number)) {
            // The process may have ended by itself.
            let _ = kill_process(pid, signal);
        }
    }

    fn running(&self) -> MutexGuard<'_, BTreeSet<i32>> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Returns the record of a point, unless the point could not be run and is to be tried again.
fn final_record(storage: &PointStorage) -> Option<Record> {
    storage.record().filter(|record| record.outcome != Outcome::WorkerFailed)
}

/// Returns the conversion of an error at the file or folder `path`; `verb` is what failed.
fn io_failure(verb: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Failure {
    let path = path.to_owned();
    move |source| Failure::from(Error::Io { what: verb, path, source })
}

/// Returns the failure to run a process; `action` is what failed.
fn process_failure(action: &str, error: &std::io::Error) -> Failure {
    Failure::Output(format!("cannot {action}: {error}"))
}

/// Adds the values of `point` to `command`.
fn add_settings(command: &mut Command, point: &Point) {
    for setting in &point.settings {
        command.arg("--set").arg(setting.to_string());
    }
}

/// Returns the message of a failed process: its `text` from the first error on.
fn message(status: ExitStatus, text: &str) -> String {
    if status.success() {
        return String::new();
    }
    if let Some(signal) = status.signal() {
        return format!("a signal ended it: {signal}");
    }
    let start = text.find("error").unwrap_or_default();
    let message = text[start..].trim();
    let end = (0..=message.len().min(MESSAGE_MAX)).rev().find(|end| message.is_char_boundary(*end));
    message[..end.unwrap_or_default()].to_owned()
}
