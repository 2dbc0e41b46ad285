//! NumPy arrays of numbers, which nothing writes to: each is a view of a copy of its own. NumPy makes
//! a view writable only if what it shows is writable, and the copy is not.

use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Returns `numbers` as a read-only array with rows of `width` numbers.
pub(crate) fn rows<'py, T: numpy::Element>(
    py: Python<'py>,
    numbers: &[T],
    columns: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let array = PyArray1::from_slice(py, numbers).reshape([numbers.len() / columns, columns])?;
    read_only(array.into_any())
}

/// Returns numbers as a read-only array.
pub(crate) fn row<'py, T: numpy::Element>(
    py: Python<'py>,
    numbers: &[T],
) -> PyResult<Bound<'py, PyAny>> {
    read_only(PyArray1::from_slice(py, numbers).into_any())
}

fn read_only(array: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    let flags = PyDict::new(array.py());
    flags.set_item("write", false)?;
    array.call_method("setflags", (), Some(&flags))?;
    array.call_method0("view")
}
