//! Work on several threads with the feature `rayon`, and on one thread without it.

#[cfg(feature = "rayon")]
pub(crate) use rayon::join;

/// Calls `first` and then `second`, and returns both results.
#[cfg(not(feature = "rayon"))]
pub(crate) fn join<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}

/// Returns the number of threads among which work may be divided.
pub(crate) fn thread_count() -> usize {
    #[cfg(feature = "rayon")]
    let count = rayon::current_num_threads();
    #[cfg(not(feature = "rayon"))]
    let count = 1;
    count
}

/// Returns the number of the calling thread, which is below [`thread_count`]. The number is 0
/// outside a pool of threads.
pub(crate) fn thread_number() -> usize {
    #[cfg(feature = "rayon")]
    let number = rayon::current_thread_index().unwrap_or(0);
    #[cfg(not(feature = "rayon"))]
    let number = 0;
    number
}
