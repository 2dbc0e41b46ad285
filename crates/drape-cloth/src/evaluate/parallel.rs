use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};

use crate::scratch::Scratch;

/// A scratch for each thread that can be of use.
#[derive(Debug)]
pub(crate) struct Scratches(Vec<Mutex<Scratch>>);

impl Scratches {
    /// So many, at least one.
    pub(crate) fn new(scratch: &Scratch, threads: usize) -> Self {
        Self((0..threads.max(1)).map(|_| Mutex::new(scratch.clone())).collect())
    }

    /// One of them, for whoever has all.
    pub(crate) fn any(&mut self) -> &mut Scratch {
        self.0[0].get_mut().unwrap_or_else(PoisonError::into_inner)
    }

    /// One for the thread that asks. Nothing is read from a scratch that was not written before for the same strip, so
    /// a panic in the middle of one leaves nothing wrong in it.
    fn own(&self) -> MutexGuard<'_, Scratch> {
        self.free().unwrap_or_else(|| self.0[0].lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// One that nobody uses, the same for the same thread if it can be: a pool may have more threads than there are
    /// scratches, whose numbers then say nothing.
    fn free(&self) -> Option<MutexGuard<'_, Scratch>> {
        let thread = rayon::current_thread_index().unwrap_or(0) % self.0.len();
        let (before, after) = self.0.split_at(thread);
        after.iter().chain(before).find_map(|scratch| match scratch.try_lock() {
            Ok(scratch) => Some(scratch),
            Err(TryLockError::Poisoned(poisoned)) => Some(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => None,
        })
    }
}

impl Clone for Scratches {
    fn clone(&self) -> Self {
        Self::new(&self.own(), self.0.len())
    }
}

/// Works through strips or rims, on as many threads as there are scratches, each on its own part of the output: `split`
/// cuts the output that begins with one of them where another begins. A thread that is done takes over from others.
///
/// What a strip writes depends on nothing but the strip, so neither the number of threads nor their
/// pace can change a number.
pub(crate) fn share<P: Sync, O: Send>(
    (strips, scratches): (&[P], &Scratches),
    mut output: O,
    split: &(impl Fn(O, &P, &P) -> (O, O) + Sync),
    work: &(impl Fn(&P, &mut Scratch, O) + Sync),
) {
    let [.., last] = strips else { return };
    if scratches.0.len() > 1 && strips.len() > 1 {
        let (here, there) = strips.split_at(strips.len().div_ceil(2));
        let (output, rest) = split(output, &here[0], &there[0]);
        rayon::join(
            || share((here, scratches), output, split, work),
            || share((there, scratches), rest, split, work),
        );
        return;
    }
    let mut scratch = scratches.own();
    for pair in strips.windows(2) {
        let (own, rest) = split(output, &pair[0], &pair[1]);
        work(&pair[0], &mut scratch, own);
        output = rest;
    }
    work(last, &mut scratch, output);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scratch_in_use_is_passed_over() {
        let scratches = Scratches::new(&Scratch::new(1), 2);
        let (first, second) = (scratches.free(), scratches.free());
        assert!(first.is_some() && second.is_some() && scratches.free().is_none());
        drop(first);
        assert!(scratches.free().is_some());
    }
}
