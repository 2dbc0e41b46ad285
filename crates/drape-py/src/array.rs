//! NumPy arrays of numbers, which nothing writes to: each is a view of a copy of its own. NumPy
//! makes a view writable only if what it shows is writable, and the copy is not.

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Returns `numbers` as a read-only array with rows of `columns` numbers.
pub(crate) fn rows<'py, T: numpy::Element>(
    py: Python<'py>,
    numbers: &[T],
    columns: usize,
) -> PyResult<Bound<'py, PyAny>> {
    read_only(py, numbers)?.call_method1("reshape", (numbers.len() / columns, columns))
}

/// Returns numbers as a read-only array.
pub(crate) fn row<'py, T: numpy::Element>(
    py: Python<'py>,
    numbers: &[T],
) -> PyResult<Bound<'py, PyAny>> {
    read_only(py, numbers)?.call_method0("view")
}

/// Returns a copy of `numbers` that is read-only until its own flag is changed.
fn read_only<'py, T: numpy::Element>(
    py: Python<'py>,
    numbers: &[T],
) -> PyResult<Bound<'py, PyAny>> {
    let array = PyArray1::from_slice(py, numbers).into_any();
    let flags = PyDict::new(py);
    flags.set_item("write", false)?;
    array.call_method("setflags", (), Some(&flags))?;
    Ok(array)
}
