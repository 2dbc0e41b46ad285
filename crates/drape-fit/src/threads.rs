//! Loops over slices on several threads with the feature `rayon`, and on one thread without it.

#[cfg(feature = "rayon")]
pub(crate) use rayon::prelude::*;
#[cfg(not(feature = "rayon"))]
pub(crate) use serial::*;

/// The methods of rayon that this crate uses, on one thread.
#[cfg(not(feature = "rayon"))]
mod serial {
    use std::slice::Iter;

    /// Loops over the items of a slice.
    pub(crate) trait SerialSlice<T> {
        fn par_iter(&self) -> Iter<'_, T>;
    }

    impl<T> SerialSlice<T> for [T] {
        fn par_iter(&self) -> Iter<'_, T> {
            self.iter()
        }
    }
}

/// Calls `work` once on each thread of the pool.
pub(crate) fn on_each_thread(work: impl Fn() + Sync) {
    #[cfg(feature = "rayon")]
    rayon::broadcast(|_| work());
    #[cfg(not(feature = "rayon"))]
    work();
}
