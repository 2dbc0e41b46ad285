//! Work on threads of its own, without the lock of the interpreter, which Ctrl-C ends.
//!
//! The thread that asked for the work waits for it: it looks for signals, and it alone calls what
//! is written in Python, so that a callback may draw or print as any other code of its thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::{Kind, failure};

/// Time between two looks for signals.
const POLL: Duration = Duration::from_millis(50);

/// Time after a signal until which the step in hand may end; then it is given up.
const PATIENCE: Duration = Duration::from_millis(500);

/// Thread pool for work, and the flags that end the work.
pub(crate) struct Detached {
    pool: ThreadPool,
    /// Whether the work is to end after the step in hand.
    stop: AtomicBool,
    /// Whether the step in hand is to be given up.
    pub(crate) give_up: Arc<AtomicBool>,
}

/// Channel from the work to the thread that waits for it.
pub(crate) struct Outbox<E>(mpsc::Sender<(E, mpsc::Sender<()>)>);

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
    /// Makes `threads` threads, or one for each processor of the machine.
    pub(crate) fn new(threads: Option<usize>) -> PyResult<Self> {
        if threads == Some(0) {
            return Err(failure(Kind::Usage, "threads=0: give 1 or more, or None for all"));
        }
        let pool = ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
        let pool = pool.map_err(|error| failure(Kind::Usage, format!("threads: {error}")))?;
        Ok(Self { pool, stop: AtomicBool::new(false), give_up: Arc::default() })
    }

    /// Returns the result of short work that is done on the threads.
    pub(crate) fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        self.pool.install(work)
    }

    /// Returns whether the work is to end.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Runs work that cannot be interrupted. After a signal the call returns at once; the work then
    /// ends by itself, and its result is dropped.
    pub(crate) fn leave<T: Send + 'static>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> PyResult<T> {
        let (sender, inbox) = mpsc::channel();
        self.pool.spawn(move || {
            // Nobody listens any more once a signal has come.
            let _ = sender.send(work());
        });
        py.detach(move || {
            loop {
                match inbox.recv_timeout(POLL) {
                    Ok(result) => return Ok(result),
                    Err(RecvTimeoutError::Timeout) => Python::attach(|py| py.check_signals())?,
                    Err(RecvTimeoutError::Disconnected) => {
                        return Err(PyRuntimeError::new_err("the work ended without a result"));
                    }
                }
            }
        })
    }

    /// Has work done, and events of it handled; returns its result with what a signal or a handler
    /// raised, after which the work was asked to end.
    pub(crate) fn run<E: Send, T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&Outbox<E>) -> T + Send,
        mut handle: impl FnMut(Python<'_>, E) -> PyResult<()> + Send,
    ) -> (T, PyResult<()>) {
        self.stop.store(false, Ordering::Relaxed);
        self.give_up.store(false, Ordering::Relaxed);
        py.detach(|| {
            let mut result = None;
            let mut raised = None;
            self.pool.in_place_scope(|scope| {
                let (sender, inbox) = mpsc::channel();
                let result = &mut result;
                scope.spawn(move |_| *result = Some(work(&Outbox(sender))));
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
                    if let Err(error) = found {
                        raised = Some(error);
                        stopped = Some(Instant::now());
                        self.stop.store(true, Ordering::Relaxed);
                    }
                    if stopped.is_some_and(|since| since.elapsed() >= PATIENCE) {
                        self.give_up.store(true, Ordering::Relaxed);
                    }
                }
            });
            (result.expect("the scope ends after its work"), raised.map_or(Ok(()), Err))
        })
    }
}
