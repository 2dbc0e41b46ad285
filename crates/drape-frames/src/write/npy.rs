//! Arrays of numbers in the format of NumPy (`.npy`).

use std::io::{Result, Write};

use npyz::half::f16;
use npyz::{AutoSerialize, WriterBuilder};

/// Writes `rows` of `N` numbers each to `to`.
pub(crate) fn write<T: AutoSerialize + Copy, const N: usize>(
    to: &mut dyn Write,
    rows: &[[T; N]],
) -> Result<()> {
    write_shape(to, &[rows.len() as u64, N as u64], rows.as_flattened())
}

/// Writes a column of `numbers` in half precision to `to`.
pub(crate) fn write_half(to: &mut dyn Write, numbers: &[f16]) -> Result<()> {
    write_shape(to, &[numbers.len() as u64], numbers)
}

fn write_shape<T: AutoSerialize + Copy>(
    to: &mut dyn Write,
    shape: &[u64],
    numbers: &[T],
) -> Result<()> {
    let options = npyz::WriteOptions::new().default_dtype().shape(shape);
    let mut array = options.writer(to).begin_nd()?;
    array.extend(numbers.iter().copied())?;
    array.finish()
}
