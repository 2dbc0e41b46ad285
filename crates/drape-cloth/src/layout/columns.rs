//! Columns of numbers and vectors, read and written a batch at a time.
//!
//! A batch is read as an array of known length and written from a local one. In the loops between,
//! the compiler then sees neither bounds nor aliases.

use drape_fabric::{LANES, Lanes};
use serde::{Deserialize, Serialize};

use crate::measure::vector::Vector;

/// Columns that belong together, such as the coordinates of vectors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "Vec<Vec<f64>>", try_from = "Vec<Vec<f64>>")]
pub(crate) struct Columns<const N: usize>(pub(crate) [Vec<f64>; N]);

impl<const N: usize> From<Columns<N>> for Vec<Vec<f64>> {
    fn from(columns: Columns<N>) -> Self {
        columns.0.into()
    }
}

impl<const N: usize> TryFrom<Vec<Vec<f64>>> for Columns<N> {
    type Error = &'static str;

    fn try_from(columns: Vec<Vec<f64>>) -> Result<Self, Self::Error> {
        columns.try_into().map(Self).map_err(|_| "another number of columns")
    }
}

impl<const N: usize> Columns<N> {
    /// Returns whether the columns of `other` have equal lengths.
    pub(crate) fn has_lengths_of(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(column, others)| column.len() == others.len())
    }
}

/// Columns of the coordinates of vectors.
pub(crate) type VectorColumns = Columns<3>;

/// Batch of [`Columns`].
#[derive(Clone, Copy)]
pub(crate) struct ColumnBatch<'a, const N: usize>(pub(crate) [&'a Lanes; N]);

/// Batch of vectors in local arrays.
#[derive(Clone, Copy)]
pub(crate) struct VectorLanes(pub(crate) [Lanes; 3]);

/// Returns the batch of `column` that begins at `start`.
#[inline(always)]
pub(crate) fn lanes(column: &[f64], start: usize) -> &Lanes {
    column[start..].first_chunk().expect("columns are padded by a batch beyond the last index")
}

/// Returns the batch of `column` that begins at `start`, or `None` if `column` is empty.
#[inline(always)]
pub(crate) fn lanes_if_any(column: &[f64], start: usize) -> Option<&Lanes> {
    (!column.is_empty()).then(|| lanes(column, start))
}

/// Returns whether a batch has no connector: all `areas` are zero.
#[inline(always)]
pub(crate) fn is_vacant(areas: &Lanes) -> bool {
    areas.iter().all(|area| *area == 0.0)
}

/// Writes `values` to the batch of `column` that begins at `start`.
#[inline(always)]
pub(crate) fn put(column: &mut [f64], start: usize, values: &Lanes) {
    column[start..start + LANES].copy_from_slice(values);
}

impl<const N: usize> Columns<N> {
    pub(crate) fn new(length: usize) -> Self {
        Self([(); N].map(|()| vec![0.0; length]))
    }

    #[inline(always)]
    pub(crate) fn batch(&self, start: usize) -> ColumnBatch<'_, N> {
        ColumnBatch(std::array::from_fn(|k| lanes(&self.0[k], start)))
    }

    #[inline(always)]
    pub(crate) fn put(&mut self, start: usize, values: &[Lanes; N]) {
        for (column, values) in self.0.iter_mut().zip(values) {
            put(column, start, values);
        }
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, index: usize, values: [f64; N]) {
        for (column, value) in self.0.iter_mut().zip(values) {
            column[index] = value;
        }
    }
}

impl ColumnBatch<'_, 3> {
    #[inline(always)]
    pub(crate) fn vector(&self, lane: usize) -> Vector {
        [self.0[0][lane], self.0[1][lane], self.0[2][lane]]
    }
}

impl VectorLanes {
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Self([[0.0; LANES]; 3])
    }

    #[inline(always)]
    pub(crate) fn vector(&self, lane: usize) -> Vector {
        [self.0[0][lane], self.0[1][lane], self.0[2][lane]]
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, vector: Vector) {
        self.0[0][lane] = vector[0];
        self.0[1][lane] = vector[1];
        self.0[2][lane] = vector[2];
    }
}
