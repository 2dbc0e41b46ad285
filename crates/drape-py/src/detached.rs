//! Work on threads of its own, without the lock of the interpreter, which Ctrl-C ends.
//!
//! The thread that asked for the work waits for it: it looks for signals, and it alone calls what
//! is written in Python, so that a callback may draw or print as any other code of its thread.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

use pyo3::prelude::*;

use crate::error::{Kind, failure};
use crate::threads::{Threads, fault};

/// Time between two looks for signals.
const POLL: Duration = Duration::from_millis(50);

/// Time after a signal until which the step in hand may end; then it is given up.
const PATIENCE: Duration = Duration::from_millis(500);

/// Threads for work, and the flags that end the work.
pub(crate) struct Detached {
    pub(crate) threads: Threads,
    /// Whether the work is to end after the step in hand.
    pub(crate) stop: Arc<AtomicBool>,
    /// Whether the step in hand is to be given up.
    pub(crate) give_up: Arc<AtomicBool>,
}

/// Event of the work, and the channel that tells the work that it was taken care of.
type Letter<E> = (E, mpsc::Sender<()>);

/// Channel from the work to the thread that waits for it.
pub(crate) struct Outbox<E>(mpsc::Sender<Letter<E>>);

impl<E> Outbox<E> {
    /// Hands over an event, and waits until it was taken care of.
    pub(crate) fn send(&self, event: E) {
        let (done, wait) = mpsc::channel();
        if self.0.send((event, done)).is_ok() {
            // An error says that nobody answers any more: then the work is to end.
            let _ = wait.recv();
        }
    }
}

impl Detached {
    /// Makes work possible on `threads` threads, or on one for each processor of the machine.
    pub(crate) fn new(threads: Option<usize>) -> PyResult<Self> {
        let threads = Threads::new(threads)?;
        Ok(Self { threads, stop: Arc::default(), give_up: Arc::default() })
    }

    /// Runs work that cannot be interrupted. After a signal the call returns at once; the work then
    /// ends by itself, and its result is dropped.
    pub(crate) fn leave<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> PyResult<T> {
        let (sender, inbox) = mpsc::channel();
        self.threads.pool(py)?.spawn(move || {
            // Nobody listens any more once a signal has come.
            let _ = sender.send(catch_unwind(AssertUnwindSafe(work)));
        });
        let process = process::id();
        py.detach(move || {
            loop {
                match inbox.recv_timeout(POLL) {
                    Ok(result) => return result.map_err(fault),
                    Err(RecvTimeoutError::Timeout) => {
                        Python::attach(|py| py.check_signals())?;
                        if process::id() != process {
                            return Err(forked());
                        }
                    }
                    Err(RecvTimeoutError::Disconnected) => return Err(lost()),
                }
            }
        })
    }

    /// Has work done, and events of it handled; returns its result with what a signal or a handler
    /// raised, after which the work was asked to end.
    ///
    /// # Errors
    /// The work panicked, or this is a child that a handler has forked from the process of the
    /// work. Then there is no result.
    pub(crate) fn run<E: Send + 'static, T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(Outbox<E>) -> T + Send + 'static,
        mut handle: impl FnMut(Python<'_>, E) -> PyResult<()> + Send,
    ) -> PyResult<(T, PyResult<()>)> {
        self.stop.store(false, Ordering::Relaxed);
        self.give_up.store(false, Ordering::Relaxed);
        let (sender, inbox) = mpsc::channel();
        let (deliver, result) = mpsc::channel();
        self.threads.pool(py)?.spawn(move || {
            let outbox = Outbox(sender.clone());
            let _ = deliver.send(catch_unwind(AssertUnwindSafe(|| work(outbox))));
            // The result is there before the inbox closes.
            drop(sender);
        });

        let process = process::id();
        py.detach(move || {
            let mut raised = None;
            let mut looked = Instant::now();
            let mut stopped: Option<Instant> = None;
            loop {
                let event = match inbox.recv_timeout(POLL) {
                    Ok(event) => Some(event),
                    Err(RecvTimeoutError::Timeout) => None,
                    Err(RecvTimeoutError::Disconnected) => break,
                };
                let mut found = Ok(());
                if let Some((event, done)) = event {
                    if raised.is_none() {
                        found = Python::attach(|py| handle(py, event));
                    }
                    let _ = done.send(());
                }
                if found.is_ok() && raised.is_none() && looked.elapsed() >= POLL {
                    looked = Instant::now();
                    found = Python::attach(|py| py.check_signals());
                }
                if process::id() != process {
                    return Err(found.err().unwrap_or_else(forked));
                }
                if let Err(error) = found {
                    raised = Some(error);
                    stopped = Some(Instant::now());
                    self.stop.store(true, Ordering::Relaxed);
                }
                if stopped.is_some_and(|since| since.elapsed() >= PATIENCE) {
                    self.give_up.store(true, Ordering::Relaxed);
                }
            }
            let result = result.recv().map_err(|_| lost())?.map_err(fault)?;
            Ok((result, raised.map_or(Ok(()), Err)))
        })
    }
}

/// Returns the exception of a call that has returned in a child, which was forked meanwhile.
fn forked() -> PyErr {
    let message = "the process was forked during this call, and the work goes on in the parent \
                   alone; end the child where it was made, with os._exit, or fork after the call";
    failure(Kind::Usage, message)
}

/// Returns the exception of work that ended without a result.
fn lost() -> PyErr {
    failure(Kind::Fault, "a fault of drape: the work ended without a result; please report it")
}
