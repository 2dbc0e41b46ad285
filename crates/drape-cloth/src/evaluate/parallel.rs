//! Work on strips or rims on several threads, each with its buffers.

use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};

use crate::kernel::buffers::StripBuffers;
use crate::threads::{join, thread_number};

/// Buffers for each available thread.
#[derive(Debug)]
pub(crate) struct BufferPool(Vec<Mutex<StripBuffers>>);

impl BufferPool {
    /// Returns a pool with copies of `buffers` for a number of `threads`, at least one.
    pub(crate) fn new(buffers: &StripBuffers, threads: usize) -> Self {
        Self((0..threads.max(1)).map(|_| Mutex::new(buffers.clone())).collect())
    }

    /// Returns [`StripBuffers`] for a caller that has the whole pool.
    pub(crate) fn exclusive(&mut self) -> &mut StripBuffers {
        self.0[0].get_mut().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns buffers for the calling thread. A panic in the middle of a strip leaves nothing
    /// wrong in them, because a kernel reads only what it wrote before for its strip.
    fn acquire(&self) -> MutexGuard<'_, StripBuffers> {
        self.try_acquire()
            .unwrap_or_else(|| self.0[0].lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Returns buffers that are not in use, if possible those that the thread used before. A pool
    /// of threads may have more threads than there are buffers, so the number of a thread is a
    /// hint.
    fn try_acquire(&self) -> Option<MutexGuard<'_, StripBuffers>> {
        let thread = thread_number() % self.0.len();
        let (before, after) = self.0.split_at(thread);
        after.iter().chain(before).find_map(|buffers| match buffers.try_lock() {
            Ok(buffers) => Some(buffers),
            Err(TryLockError::Poisoned(poisoned)) => Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => None,
        })
    }
}

impl Clone for BufferPool {
    fn clone(&self) -> Self {
        Self::new(&self.acquire(), self.0.len())
    }
}

/// Strips or rims to work on, and the buffers of the threads.
pub(crate) struct Parts<'a, P> {
    pub(crate) parts: &'a [P],
    pub(crate) pool: &'a BufferPool,
}

/// Calls `work` for all `parts`, which are strips or rims, on as many threads as there are buffers.
/// Each call gets its part of `output`.
///
/// `split` divides the output of consecutive parts before one of them; it gets the output, the
/// first of the parts and the part at which to divide. A thread that has finished takes over parts
/// from others. The output of a part depends on this part alone, so neither the number of threads
/// nor their speed changes a number.
pub(crate) fn for_each<P: Sync, O: Send>(
    parts: Parts<'_, P>,
    mut output: O,
    split: &(impl Fn(O, &P, &P) -> (O, O) + Sync),
    work: &(impl Fn(&P, &mut StripBuffers, O) + Sync),
) {
    let Parts { parts, pool } = parts;
    let [.., last] = parts else { return };
    // Halves go to two threads, which take them apart further.
    if pool.0.len() > 1 && parts.len() > 1 {
        let (here, there) = parts.split_at(parts.len().div_ceil(2));
        let (output, later_output) = split(output, &here[0], &there[0]);
        join(
            || for_each(Parts { parts: here, pool }, output, split, work),
            || for_each(Parts { parts: there, pool }, later_output, split, work),
        );
        return;
    }

    let mut buffers = pool.acquire();
    for pair in parts.windows(2) {
        let (part_output, remaining) = split(output, &pair[0], &pair[1]);
        work(&pair[0], &mut buffers, part_output);
        output = remaining;
    }
    work(last, &mut buffers, output);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buffers_in_use_are_passed_over() {
        let pool = BufferPool::new(&StripBuffers::new(1), 2);
        let (first, second) = (pool.try_acquire(), pool.try_acquire());
        assert!(first.is_some() && second.is_some() && pool.try_acquire().is_none());
        drop(first);
        assert!(pool.try_acquire().is_some());
    }
}
