//! Work on two threads with the feature `rayon`, and on one thread without it.

#[cfg(feature = "rayon")]
pub(crate) use rayon::join;

/// Calls `first` and then `second`, and returns both results.
#[cfg(not(feature = "rayon"))]
pub(crate) fn join<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}

/// Calls `work` for the chunks of `length` items of `items`.
pub(crate) fn for_each_chunk<T: Send>(
    items: &mut [T],
    length: usize,
    work: impl Fn(&mut [T]) + Send + Sync,
) {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        items.par_chunks_mut(length).for_each(work);
    }
    #[cfg(not(feature = "rayon"))]
    items.chunks_mut(length).for_each(work);
}
