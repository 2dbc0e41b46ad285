//! Array: a table of numbers in the format of NumPy (`.npy`).

use std::io::Read;
use std::path::Path;

use npyz::half::f16;
use npyz::{DType, Deserialize, NpyFile, NpyHeader, Order};

use crate::error::Error;
use crate::text::open;

/// Bytes before the text of a header: the magic string, the version and the length of the text.
const PREAMBLE: usize = 10;

/// Longest header that is read, in bytes; a run writes 128.
const HEADER_MAX: usize = 1024;

/// Largest number of digits in a header, so that the product of its dimensions is a number.
const DIGITS_MAX: usize = 16;

/// Largest coordinate that a run can have, in m.
pub(crate) const COORDINATE_MAX: f64 = 1e6;

/// Array that is expected: `rows` rows of `N` numbers.
struct Expected<'a> {
    path: &'a Path,
    /// Rows, in words.
    what: &'static str,
    rows: usize,
    /// Type of the numbers as NumPy writes it.
    number: &'static str,
}

impl Expected<'_> {
    fn malformed(&self, reason: impl Into<String>) -> Error {
        Error::BadArray { path: self.path.to_owned(), reason: reason.into() }
    }

    /// Reads the bytes of the file, at most one more than it can have.
    fn bytes(&self, of_numbers: usize) -> Result<Vec<u8>, Error> {
        let unreadable = |error: std::io::Error| {
            let reason = error.to_string();
            Error::Unreadable { path: self.path.to_owned(), reason }
        };
        let file = open(self.path).map_err(unreadable)?;
        let limit = (HEADER_MAX + of_numbers) as u64;
        let bytes = file.metadata().map_err(unreadable)?.len();
        if bytes > limit {
            return Err(Error::TooLarge { path: self.path.to_owned(), bytes, limit });
        }
        let mut content = Vec::new();
        file.take(limit + 1).read_to_end(&mut content).map_err(unreadable)?;
        Ok(content)
    }

    /// Returns the header, and where the numbers begin.
    fn header<const N: usize>(&self, content: &[u8]) -> Result<(NpyHeader, usize), Error> {
        let no_header = || self.malformed("it has no header of NumPy, or is cut off in it");
        let [low, high] = content.get(8..PREAMBLE).ok_or_else(no_header)? else {
            return Err(no_header());
        };
        let start = PREAMBLE + usize::from(u16::from_le_bytes([*low, *high]));
        let header = content.get(..start).filter(|_| start <= HEADER_MAX).ok_or_else(no_header)?;
        let digits = header[PREAMBLE..].iter().filter(|byte| byte.is_ascii_digit()).count();
        if digits > DIGITS_MAX {
            return Err(self.malformed("its header has dimensions that no run has"));
        }
        let header =
            NpyHeader::from_reader(header).map_err(|error| self.malformed(error.to_string()))?;
        let plain = match header.dtype() {
            DType::Plain(number) => format!("{number}") == self.number,
            _ => false,
        };
        let [found, columns] = match (plain, header.order(), header.shape()) {
            (true, Order::C, &[rows, columns]) => [rows, columns],
            (true, _, &[rows]) => [rows, 1],
            _ => {
                let number = self.number;
                let reason = format!("it is no table of numbers {number}, row by row");
                return Err(self.malformed(reason));
            }
        };
        if columns != N as u64 {
            return Err(self.malformed(format!("it has {columns} columns, and needs {N}")));
        }
        match usize::try_from(found) {
            Ok(rows) if rows == self.rows => Ok((header, start)),
            _ => Err(Error::WrongCount {
                path: self.path.to_owned(),
                what: self.what,
                found: usize::try_from(found).unwrap_or(usize::MAX),
                needed: self.rows,
            }),
        }
    }

    fn read<T: Deserialize + Copy, const N: usize>(&self) -> Result<Vec<[T; N]>, Error> {
        let of_numbers = self.rows * N * size_of::<T>();
        let content = self.bytes(of_numbers)?;
        let (header, start) = self.header::<N>(&content)?;
        let numbers = &content[start..];
        if numbers.len() != of_numbers {
            let found = numbers.len();
            return Err(self.malformed(format!(
                "its numbers take {found} bytes, and {} {} need {of_numbers}: it is cut off, or something follows",
                self.rows, self.what
            )));
        }
        let read = NpyFile::with_header(header, numbers).into_vec::<T>();
        let read = read.map_err(|error| self.malformed(error.to_string()))?;
        Ok(read.as_chunks::<N>().0.to_vec())
    }

    /// Returns numbers that are pressures: finite, and not below 0.
    fn as_pressures(&self, numbers: Vec<f64>) -> Result<Vec<f64>, Error> {
        let sound = |number: &f64| number.is_finite() && *number >= 0.0;
        match numbers.iter().position(|number| !sound(number)) {
            None => Ok(numbers),
            Some(row) => Err(self.malformed(format!(
                "row {row} (from 0) is {}, which is no pressure",
                numbers[row]
            ))),
        }
    }
}

/// Reads coordinates in m, which are finite.
pub(crate) fn coordinates<const N: usize>(
    path: &Path,
    what: &'static str,
    rows: usize,
) -> Result<Vec<[f64; N]>, Error> {
    let expected = Expected { path, what, rows, number: "<f8" };
    let all = expected.read::<f64, N>()?;
    // Written so that NaN fails.
    let wrong = |row: &[f64; N]| !row.iter().all(|value| value.abs() <= COORDINATE_MAX);
    match all.iter().position(wrong) {
        None => Ok(all),
        Some(row) => Err(expected.malformed(format!(
            "row {row} (from 0) is {:?}, and coordinates are at most {COORDINATE_MAX} m",
            all[row]
        ))),
    }
}

/// Reads a pressure in Pa for each vertex, in half precision.
pub(crate) fn pressures(path: &Path, rows: usize) -> Result<Vec<f64>, Error> {
    let expected = Expected { path, what: "vertices", rows, number: "<f2" };
    let all = expected.read::<f16, 1>()?;
    expected.as_pressures(all.into_iter().flatten().map(f64::from).collect())
}

/// Reads a pressure in Pa for each vertex, in double precision.
pub(crate) fn exact_pressures(path: &Path, rows: usize) -> Result<Vec<f64>, Error> {
    let expected = Expected { path, what: "vertices", rows, number: "<f8" };
    let all = expected.read::<f64, 1>()?;
    expected.as_pressures(all.into_iter().flatten().collect())
}

/// Reads the corners of triangles, not yet checked against their vertices.
pub(crate) fn corners(path: &Path, rows: usize) -> Result<Vec<[u32; 3]>, Error> {
    Expected { path, what: "triangles", rows, number: "<u4" }.read()
}
