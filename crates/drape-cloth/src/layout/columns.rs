//! Columns of numbers and vectors, read and written a batch at a time.
//!
//! A batch is read as an array of known length and written from a local one, so that the compiler
//! sees neither bounds nor aliases in the loops between.

use drape_fabric::{LANES, Lanes};

/// A vector in three dimensions.
pub(crate) type Vector = [f64; 3];

/// Columns that belong together, such as the coordinates of vectors.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Columns<const N: usize>(pub(crate) [Vec<f64>; N]);

/// A column of vectors.
pub(crate) type Field = Columns<3>;

/// A batch of [`Columns`].
#[derive(Clone, Copy)]
pub(crate) struct Batch<'a, const N: usize>(pub(crate) [&'a Lanes; N]);

/// The numbers of a column from `start` on.
#[inline(always)]
pub(crate) fn lanes(column: &[f64], start: usize) -> &Lanes {
    column[start..]
        .first_chunk()
        .expect("columns end a batch after the last place that is asked for")
}

/// The numbers of a column from `start` on, if there are any.
#[inline(always)]
pub(crate) fn some_lanes(column: &[f64], start: usize) -> Option<&Lanes> {
    (!column.is_empty()).then(|| lanes(column, start))
}

/// Writes numbers into a column from `start` on.
#[inline(always)]
pub(crate) fn put(column: &mut [f64], start: usize, values: &Lanes) {
    column[start..start + LANES].copy_from_slice(values);
}

impl<const N: usize> Columns<N> {
    pub(crate) fn new(length: usize) -> Self {
        Self([(); N].map(|()| vec![0.0; length]))
    }

    #[inline(always)]
    pub(crate) fn from(&self, start: usize) -> Batch<'_, N> {
        Batch(std::array::from_fn(|k| lanes(&self.0[k], start)))
    }

    #[inline(always)]
    pub(crate) fn put(&mut self, start: usize, values: &[Lanes; N]) {
        for (column, values) in self.0.iter_mut().zip(values) {
            put(column, start, values);
        }
    }

    #[inline(always)]
    pub(crate) fn set(&mut self, place: usize, values: [f64; N]) {
        for (column, value) in self.0.iter_mut().zip(values) {
            column[place] = value;
        }
    }
}

impl Batch<'_, 3> {
    #[inline(always)]
    pub(crate) fn at(&self, lane: usize) -> Vector {
        [self.0[0][lane], self.0[1][lane], self.0[2][lane]]
    }
}

/// Writes a vector into a lane.
#[inline(always)]
pub(crate) fn set(values: &mut [Lanes; 3], lane: usize, vector: Vector) {
    values[0][lane] = vector[0];
    values[1][lane] = vector[1];
    values[2][lane] = vector[2];
}

#[inline(always)]
pub(crate) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn scale(a: Vector, by: f64) -> Vector {
    [a[0] * by, a[1] * by, a[2] * by]
}

#[inline(always)]
pub(crate) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn subtract(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
