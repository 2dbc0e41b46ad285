//! Guard of a sweep: every case ends by itself, within a time, and without a panic.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// Longest time that a case may take.
const TIME_MAX: Duration = Duration::from_secs(10);

/// Number of faults after which a sweep ends.
const FAULTS_MAX: usize = 20;

/// Sweep of cases, each of which is tried under guard.
pub struct Sweep {
    name: &'static str,
    pub cases: usize,
    pub accepted: usize,
    faults: Vec<String>,
}

/// Returns whether the whole sweep is asked for, by `FAULTS=full`.
pub fn is_full() -> bool {
    std::env::var_os("FAULTS").is_some_and(|value| value == "full")
}

impl Sweep {
    pub fn new(name: &'static str) -> Self {
        Self { name, cases: 0, accepted: 0, faults: Vec::new() }
    }

    /// Tries a case, which returns whether the input is accepted.
    pub fn case(
        &mut self,
        what: impl FnOnce() -> String,
        tried: impl FnOnce() -> bool + Send + 'static,
    ) {
        if self.faults.len() >= FAULTS_MAX {
            return;
        }
        self.cases += 1;
        let (sender, receiver) = mpsc::channel();
        let work = move || {
            let result = catch_unwind(AssertUnwindSafe(tried));
            // The sweep may have given up waiting.
            let _ = sender.send(result.map_err(|panic| {
                let text = panic.downcast_ref::<String>().cloned();
                let text = text.or_else(|| panic.downcast_ref::<&str>().map(|t| (*t).to_owned()));
                text.unwrap_or_default()
            }));
        };
        thread::spawn(work);
        match receiver.recv_timeout(TIME_MAX) {
            Ok(Ok(accepted)) => self.accepted += usize::from(accepted),
            Ok(Err(panic)) => self.faults.push(format!("{}: panic: {panic}", what())),
            Err(_) => self.faults.push(format!("{}: it takes over {TIME_MAX:?}", what())),
        }
    }

    /// Ends the sweep, in which nothing may have failed.
    #[expect(clippy::print_stderr, reason = "figures of the sweep are for whoever runs it")]
    pub fn end(self) {
        let Self { name, cases, accepted, faults } = self;
        eprintln!("{name}: {cases} cases, {accepted} accepted, {} faults", faults.len());
        assert!(cases > 0);
        assert!(faults.is_empty(), "{name}: of {cases} cases\n{}", faults.join("\n"));
    }
}
