//! Work on strips or rims on several threads, each with buffers of its own.

use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};

use crate::kernel::buffers::StripBuffers;

/// Buffers for each thread that can be used.
#[derive(Debug)]
pub(crate) struct BufferPool(Vec<Mutex<StripBuffers>>);

impl BufferPool {
    /// Returns buffers for the given number of threads, at least one.
    pub(crate) fn new(buffers: &StripBuffers, threads: usize) -> Self {
        Self((0..threads.max(1)).map(|_| Mutex::new(buffers.clone())).collect())
    }

    /// Returns buffers for a caller that has the whole pool.
    pub(crate) fn exclusive(&mut self) -> &mut StripBuffers {
        self.0[0].get_mut().unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns buffers for the calling thread. Nothing is read from buffers that was not written
    /// before for the same strip, so a panic in the middle of one leaves nothing wrong in them.
    fn own(&self) -> MutexGuard<'_, StripBuffers> {
        self.free().unwrap_or_else(|| self.0[0].lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Returns buffers that are not in use, the same for the same thread if possible: a pool may
    /// have more threads than there are buffers, and the number of a thread is then only a hint.
    fn free(&self) -> Option<MutexGuard<'_, StripBuffers>> {
        let thread = rayon::current_thread_index().unwrap_or(0) % self.0.len();
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
        Self::new(&self.own(), self.0.len())
    }
}

/// Strips or rims to work on, and the buffers of the threads.
pub(crate) struct Parts<'a, P> {
    pub(crate) parts: &'a [P],
    pub(crate) pool: &'a BufferPool,
}

/// Works on strips or rims, on as many threads as there are buffers, each on its own part of the
/// output: `split` splits the output of consecutive parts, of which the first is given, before
/// another one. A thread that has finished takes over parts from others.
///
/// What a part writes depends on nothing but the part, so neither the number of threads nor their
/// speed changes a number.
pub(crate) fn for_each<P: Sync, O: Send>(
    parts: Parts<'_, P>,
    mut output: O,
    split: &(impl Fn(O, &P, &P) -> (O, O) + Sync),
    work: &(impl Fn(&P, &mut StripBuffers, O) + Sync),
) {
    let Parts { parts, pool } = parts;
    let [.., last] = parts else { return };
    if pool.0.len() > 1 && parts.len() > 1 {
        let (here, there) = parts.split_at(parts.len().div_ceil(2));
        let (output, rest) = split(output, &here[0], &there[0]);
        rayon::join(
            || for_each(Parts { parts: here, pool }, output, split, work),
            || for_each(Parts { parts: there, pool }, rest, split, work),
        );
        return;
    }
    let mut buffers = pool.own();
    for pair in parts.windows(2) {
        let (own, rest) = split(output, &pair[0], &pair[1]);
        work(&pair[0], &mut buffers, own);
        output = rest;
    }
    work(last, &mut buffers, output);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buffers_in_use_are_passed_over() {
        let pool = BufferPool::new(&StripBuffers::new(1), 2);
        let (first, second) = (pool.free(), pool.free());
        assert!(first.is_some() && second.is_some() && pool.free().is_none());
        drop(first);
        assert!(pool.free().is_some());
    }
}
