#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! The extension module `drape._drape`, which the Python sources in `python/drape` wrap:
//!
//! * `error`: mistakes and failures as exceptions; `remedy`: remedies in the words of Python;
//! * `threads`: threads of a process, which a child of a fork makes anew; `detached`: work on them
//!   without the lock of the interpreter, which Ctrl-C ends;
//! * `fit`: sheets, fabrics and their fits; `convert`: patterns and exports of other programs;
//! * `spec`: specs of scenes made of Python objects; `scene`: scenes and their runs; `stepping`: a
//!   simulation step by step; `recording`: runs that were stored; `instruments`: drapemeters and
//!   the validation; `array`: NumPy arrays of numbers.

mod array;
mod convert;
mod detached;
mod error;
mod fit;
mod instruments;
mod recording;
mod remedy;
mod scene;
mod spec;
mod stepping;
mod threads;

/// Extension module.
#[pyo3::pymodule]
mod _drape {
    #[pymodule_export]
    use crate::convert::{convert_pattern, draft_sheet};
    #[pymodule_export]
    use crate::fit::{Fabric, Fit, Sheet, fit_all};
    #[pymodule_export]
    use crate::instruments::{case_names, drapemeter, validate};
    #[pymodule_export]
    use crate::recording::{Recording, view_html};
    #[pymodule_export]
    use crate::scene::{Scene, resume};
    #[pymodule_export]
    use crate::spec::{Mesh, MeshFrames};
    #[pymodule_export]
    use crate::stepping::Simulation;
}
