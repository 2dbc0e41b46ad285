//! Threads of a process. A child of a fork has no thread of its parent, and makes new ones.
//!
//! All work of the libraries is done on such threads and never on those that rayon shares, for
//! which a child would wait without end. The bits of results do not depend on the threads.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process;
use std::sync::{Arc, Mutex, PoisonError};

use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::error::{Kind, failure};

/// Largest number of threads.
const COUNT_MAX: usize = 1024;

/// Threads for short work of all kinds, one for each processor of the machine.
static SHARED: Threads = Threads { count: 0, pool: Mutex::new(None) };

/// Number of threads, and the pool of them once it was used.
pub(crate) struct Threads {
    /// Number of threads. 0 means one for each processor of the machine.
    count: usize,
    /// Only a thread with the lock of the interpreter holds this lock. A fork needs the lock of
    /// the interpreter too, so that a child never finds this one held.
    pool: Mutex<Option<OwnedPool>>,
}

/// Pool, and the process that made it.
struct OwnedPool {
    pool: Arc<ThreadPool>,
    process: u32,
}

/// What a panic left.
pub(crate) type Panic = Box<dyn Any + Send>;

impl Threads {
    /// Returns `count` threads, or one for each processor of the machine.
    pub(crate) fn new(count: Option<usize>) -> PyResult<Self> {
        match count {
            Some(count) if !(1..=COUNT_MAX).contains(&count) => Err(failure(
                Kind::Usage,
                format!("threads={count}: give 1 to {COUNT_MAX}, or None for all"),
            )),
            _ => Ok(Self { count: count.unwrap_or(0), pool: Mutex::new(None) }),
        }
    }

    /// Returns the pool of this process, which is made at the first call.
    pub(crate) fn pool(&self, _py: Python<'_>) -> PyResult<Arc<ThreadPool>> {
        let mut kept = self.pool.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some(owned) if owned.process == process::id() => Ok(owned.pool.clone()),
            _ => {
                let pool = ThreadPoolBuilder::new().num_threads(self.count).build();
                let pool = pool.map_err(|error| failure(Kind::Usage, format!("threads: {error}")));
                let pool = Arc::new(pool?);
                *kept = Some(OwnedPool { pool: pool.clone(), process: process::id() });
                Ok(pool)
            }
        }
    }

    /// Returns the result of short work, which is done without the lock of the interpreter.
    pub(crate) fn compute<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce() -> T + Send,
    ) -> PyResult<T> {
        let pool = self.pool(py)?;
        py.detach(|| pool.install(|| catch_unwind(AssertUnwindSafe(work)))).map_err(fault)
    }
}

impl Drop for OwnedPool {
    /// Leaves the pool of another process alone: its end would wait for locks of threads that this
    /// process does not have.
    fn drop(&mut self) {
        if self.process != process::id() {
            std::mem::forget(self.pool.clone());
        }
    }
}

/// Returns the result of short work on threads that all such work shares.
pub(crate) fn compute<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    SHARED.compute(py, work)
}

/// Returns the exception of a panic, which is a fault of a library.
pub(crate) fn fault(panic: Panic) -> PyErr {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
    let text = text.unwrap_or_else(|| "a panic".to_owned());
    failure(
        Kind::Fault,
        format!("a fault of drape: {text}; please report it with the input that leads to it"),
    )
}
