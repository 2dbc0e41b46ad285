//! Runs that were stored, frame by frame.

use std::path::PathBuf;

use drape::run::reports::{VIEWER_SIZE_MAX, ViewerPage};
use drape::verify::Verifier;
use pyo3::prelude::*;

use crate::array::{row, rows};
use crate::error::of_frames;
use crate::threads::compute;

/// Run in a folder.
#[pyclass(frozen, module = "drape._drape")]
pub(crate) struct Recording(drape::frames::Recording);

#[pymethods]
impl Recording {
    #[new]
    fn new(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        let recording = compute(py, || drape::frames::Recording::open(folder))?;
        recording.map(Self).map_err(of_frames)
    }

    #[getter]
    fn frames(&self) -> usize {
        self.0.frame_count()
    }

    #[getter]
    fn ended(&self) -> bool {
        self.0.ended()
    }

    fn times<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let times: Result<Vec<f64>, _> =
            compute(py, || (0..self.0.frame_count()).map(|number| self.0.time(number)).collect())?;
        row(py, &times.map_err(of_frames)?)
    }

    fn frame<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyAny>> {
        let frame = compute(py, || self.0.frame(number))?.map_err(of_frames)?;
        rows(py, frame.cloth.as_flattened(), 3)
    }

    fn bodies<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyAny>> {
        let frame = compute(py, || self.0.frame(number))?.map_err(of_frames)?;
        rows(py, frame.bodies.as_flattened(), 3)
    }

    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.0.topology().cloth.as_flattened(), 3)
    }

    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.0.topology().material.as_flattened(), 2)
    }

    fn panels(&self) -> Vec<(String, usize, usize)> {
        let mut first = 0;
        let panels = self.0.manifest().panels.iter().map(|panel| {
            let start = first;
            first += panel.vertices;
            (panel.name.clone(), start, first)
        });
        panels.collect()
    }

    /// Verdicts on all frames, as JSON.
    fn check(&self, py: Python<'_>) -> PyResult<String> {
        let verdicts = compute(py, || {
            let verifier = Verifier::new(self.0.clone());
            let verdict = |number| {
                let verdict = verifier.verify(number)?;
                let mut value = serde_json::to_value(&verdict).unwrap_or_default();
                value["holds"] = verdict.holds().into();
                Ok(value)
            };
            (0..self.0.frame_count()).map(verdict).collect::<Result<Vec<_>, drape::verify::Error>>()
        })?;
        let verdicts = verdicts.map_err(of_frames)?;
        Ok(serde_json::Value::from(verdicts).to_string())
    }
}

/// Returns the page that shows the runs in `folders`, of at most `megabytes`.
#[pyfunction]
#[pyo3(signature = (folders, megabytes=None))]
pub(crate) fn view_html(
    py: Python<'_>,
    folders: Vec<PathBuf>,
    megabytes: Option<f64>,
) -> PyResult<String> {
    let page = compute(py, || {
        let recordings = folders.iter().map(drape::frames::Recording::open);
        let recordings: Result<Vec<_>, _> = recordings.collect();
        ViewerPage::new(&recordings?, megabytes.unwrap_or(VIEWER_SIZE_MAX))
    })?;
    page.map(|page| page.html).map_err(of_frames)
}
