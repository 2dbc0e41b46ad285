//! Work on several threads with the feature `rayon`, and on one thread without it.

/// Returns the results of `work` for `items`, in the order of `items`.
pub(crate) fn map<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Send + Sync) -> Vec<R> {
    #[cfg(feature = "rayon")]
    {
        use rayon::prelude::*;
        items.par_iter().map(work).collect()
    }
    #[cfg(not(feature = "rayon"))]
    items.iter().map(work).collect()
}

/// Calls `work` once on each thread of the pool.
pub(crate) fn on_each_thread(work: impl Fn() + Sync) {
    #[cfg(feature = "rayon")]
    rayon::broadcast(|_| work());
    #[cfg(not(feature = "rayon"))]
    work();
}
