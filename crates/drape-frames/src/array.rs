//! Array: a table of numbers in NumPy's format (`.npy`).

use std::io::Read;
use std::path::Path;

use npyz::half::f16;
use npyz::{DType, Deserialize, NpyFile, NpyHeader, Order};

use crate::error::Error;
use crate::frame_hash;
use crate::text::open;

/// Longest header that is read, in bytes. A run writes a header of 128 bytes.
const HEADER_MAX: usize = 1024;

/// Largest magnitude of a coordinate, in m.
pub(crate) const COORDINATE_MAX: f64 = 1e6;

/// Rows of an array, with the hash of its file.
pub(crate) struct HashedRows<T> {
    pub(crate) rows: Vec<T>,
    pub(crate) hash: [u8; 32],
}

/// File and expected content of an array.
struct ExpectedArray<'a> {
    path: &'a Path,
    /// Items that the rows describe, in words.
    what: &'static str,
    /// Number of rows.
    row_count: usize,
    /// NumPy's name of the type of the numbers.
    number_type: &'static str,
}

impl ExpectedArray<'_> {
    /// Returns the error of an array with the fault `reason`.
    fn malformed(&self, reason: impl Into<String>) -> Error {
        Error::BadArray { path: self.path.to_owned(), reason: reason.into() }
    }

    /// Reads the bytes of the file, whose numbers take `number_bytes`.
    ///
    /// If the file grows meanwhile, at most one byte more than the longest valid file is read.
    fn read_bytes(&self, number_bytes: usize) -> Result<Vec<u8>, Error> {
        let limit = (HEADER_MAX + number_bytes) as u64;
        let file = open(self.path).map_err(|error| Error::unreadable(self.path, &error))?;
        let metadata = file.metadata().map_err(|error| Error::unreadable(self.path, &error))?;
        let bytes = metadata.len();
        if bytes > limit {
            return Err(Error::TooLarge { path: self.path.to_owned(), bytes, limit });
        }
        let mut content = Vec::new();
        file.take(limit + 1)
            .read_to_end(&mut content)
            .map_err(|error| Error::unreadable(self.path, &error))?;
        Ok(content)
    }

    /// Returns the header of a file with the given `content`, and the position of the first number.
    ///
    /// # Errors
    /// The header is invalid, or does not describe `row_count` rows of `N` numbers.
    fn header<const N: usize>(&self, content: &[u8]) -> Result<(NpyHeader, usize), Error> {
        /// Bytes before the text of a header: the magic string, the version and the length of the
        /// text.
        const PREAMBLE: usize = 10;
        /// Largest number of digits in a header, so that the product of its dimensions does not
        /// overflow.
        const DIGITS_MAX: usize = 16;

        let no_header = "it has no header of NumPy, or is cut off in it";
        let Some([low, high]) = content.get(8..PREAMBLE) else {
            return Err(self.malformed(no_header));
        };
        let start = PREAMBLE + usize::from(u16::from_le_bytes([*low, *high]));
        let Some(header) = content.get(..start).filter(|_| start <= HEADER_MAX) else {
            return Err(self.malformed(no_header));
        };
        let digits = header[PREAMBLE..].iter().filter(|byte| byte.is_ascii_digit()).count();
        if digits > DIGITS_MAX {
            return Err(self.malformed("its header has dimensions that no run has"));
        }
        let header =
            NpyHeader::from_reader(header).map_err(|error| self.malformed(error.to_string()))?;

        // Rows of one number may be stored as a list. A table must be stored row by row.
        let is_expected_type = match header.dtype() {
            DType::Plain(number_type) => format!("{number_type}") == self.number_type,
            _ => false,
        };
        let [rows, columns] = match (header.order(), header.shape()) {
            (Order::C, &[rows, columns]) if is_expected_type => [rows, columns],
            (_, &[rows]) if is_expected_type => [rows, 1],
            _ => {
                let number_type = self.number_type;
                let reason = format!("it is no table of numbers {number_type}, row by row");
                return Err(self.malformed(reason));
            }
        };

        if columns != N as u64 {
            return Err(self.malformed(format!("it has {columns} columns, and needs {N}")));
        }
        let found = usize::try_from(rows).unwrap_or(usize::MAX);
        if rows != self.row_count as u64 {
            let (path, what, needed) = (self.path.to_owned(), self.what, self.row_count);
            return Err(Error::WrongCount { path, what, found, needed });
        }
        Ok((header, start))
    }

    /// Reads the rows of the array.
    ///
    /// # Errors
    /// The file cannot be read, or is not an array of `row_count` rows of `N` numbers.
    fn read<T: Deserialize + Copy, const N: usize>(&self) -> Result<HashedRows<[T; N]>, Error> {
        let number_bytes = self.row_count * N * size_of::<T>();
        let content = self.read_bytes(number_bytes)?;
        let (header, start) = self.header::<N>(&content)?;
        let encoded = &content[start..];
        if encoded.len() != number_bytes {
            let found = encoded.len();
            return Err(self.malformed(format!(
                "its numbers take {found} bytes, and {} {} need {number_bytes}: it is cut off, or something follows",
                self.row_count, self.what
            )));
        }
        let numbers = NpyFile::with_header(header, encoded)
            .into_vec::<T>()
            .map_err(|error| self.malformed(error.to_string()))?;
        let rows = numbers.as_chunks::<N>().0.to_vec();
        Ok(HashedRows { rows, hash: frame_hash::hash(&content) })
    }

    /// Returns `numbers` if all are pressures, which are finite and not below 0.
    fn check_pressures(&self, numbers: Vec<f64>) -> Result<Vec<f64>, Error> {
        match numbers.iter().position(|number| !(number.is_finite() && *number >= 0.0)) {
            None => Ok(numbers),
            Some(row) => Err(self.malformed(format!(
                "row {row} (from 0) is {}, which is no pressure",
                numbers[row]
            ))),
        }
    }
}

/// Reads `row_count` rows of `N` finite coordinates, in m, from the file `path`. `what` is a word
/// for the rows.
pub(crate) fn coordinates<const N: usize>(
    path: &Path,
    what: &'static str,
    row_count: usize,
) -> Result<HashedRows<[f64; N]>, Error> {
    let expected = ExpectedArray { path, what, row_count, number_type: "<f8" };
    let HashedRows { rows, hash } = expected.read::<f64, N>()?;
    // The comparison is written so that NaN fails.
    match rows.iter().position(|row| !row.iter().all(|value| value.abs() <= COORDINATE_MAX)) {
        None => Ok(HashedRows { rows, hash }),
        Some(row) => Err(expected.malformed(format!(
            "row {row} (from 0) is {:?}, and coordinates are at most {COORDINATE_MAX} m",
            rows[row]
        ))),
    }
}

/// Reads the pressures of `vertex_count` vertices, in Pa, which the file `path` has in half
/// precision.
pub(crate) fn pressures(path: &Path, vertex_count: usize) -> Result<HashedRows<f64>, Error> {
    let expected = vertex_array(path, vertex_count, "<f2");
    let HashedRows { rows, hash } = expected.read::<f16, 1>()?;
    let rows = expected.check_pressures(rows.into_iter().flatten().map(f64::from).collect())?;
    Ok(HashedRows { rows, hash })
}

/// Reads the pressures of `vertex_count` vertices, in Pa, which the file `path` has in double
/// precision.
pub(crate) fn exact_pressures(path: &Path, vertex_count: usize) -> Result<Vec<f64>, Error> {
    let expected = vertex_array(path, vertex_count, "<f8");
    let HashedRows { rows, .. } = expected.read::<f64, 1>()?;
    expected.check_pressures(rows.into_iter().flatten().collect())
}

/// Returns the array in the file `path` that has one number for each of `vertex_count` vertices.
fn vertex_array<'a>(
    path: &'a Path,
    vertex_count: usize,
    number_type: &'static str,
) -> ExpectedArray<'a> {
    ExpectedArray { path, what: "vertices", row_count: vertex_count, number_type }
}

/// Reads the corners of `triangle_count` triangles from the file `path`, without comparing them
/// with the number of vertices.
pub(crate) fn corners(path: &Path, triangle_count: usize) -> Result<Vec<[u32; 3]>, Error> {
    let (what, row_count) = ("triangles", triangle_count);
    let array = ExpectedArray { path, what, row_count, number_type: "<u4" }.read()?;
    Ok(array.rows)
}
