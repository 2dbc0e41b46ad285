//! Loops over slices on several threads with the feature `rayon`, and on one thread without it.

#[cfg(feature = "rayon")]
pub(crate) use rayon::prelude::*;
#[cfg(not(feature = "rayon"))]
pub(crate) use serial::*;

/// Methods with the names of rayon's methods, which work on one thread.
#[cfg(not(feature = "rayon"))]
mod serial {
    use std::slice::{Chunks, ChunksMut, Iter, IterMut};

    /// Loops over the items or chunks of a slice.
    pub(crate) trait SerialSlice<T> {
        fn par_iter(&self) -> Iter<'_, T>;
        fn par_iter_mut(&mut self) -> IterMut<'_, T>;
        fn par_chunks(&self, length: usize) -> Chunks<'_, T>;
        fn par_chunks_mut(&mut self, length: usize) -> ChunksMut<'_, T>;
    }

    impl<T> SerialSlice<T> for [T] {
        fn par_iter(&self) -> Iter<'_, T> {
            self.iter()
        }

        fn par_iter_mut(&mut self) -> IterMut<'_, T> {
            self.iter_mut()
        }

        fn par_chunks(&self, length: usize) -> Chunks<'_, T> {
            self.chunks(length)
        }

        fn par_chunks_mut(&mut self, length: usize) -> ChunksMut<'_, T> {
            self.chunks_mut(length)
        }
    }

    /// Hints for the division of a loop among threads.
    pub(crate) trait SerialLoop: Sized {
        fn with_max_len(self, _length: usize) -> Self {
            self
        }
    }

    impl<I: Iterator> SerialLoop for I {}
}
