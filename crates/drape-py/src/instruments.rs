//! Simulated drapemeters, and the cases of the validation.

use drape::validate::drapemeter::{Drapemeter, Sampling, Shake, spacing_bound};
use drape::validate::{CASES, Outcome};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array::row;
use crate::detached::Detached;
use crate::error::{Kind, failure};
use crate::fit::Fabric;
use crate::threads::compute;

/// Largest default spacing, in m.
const SPACING_MAX: f64 = 0.005;

/// Settings of a drapemeter.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct MeterSettings {
    meter: String,
    starts: u64,
    spacing: Option<f64>,
    shake: bool,
}

/// Drapes specimens of a fabric; returns what came out, a dictionary.
#[pyfunction]
pub(crate) fn drapemeter<'py>(
    py: Python<'py>,
    fabric: &Bound<'py, Fabric>,
    settings: MeterSettings,
) -> PyResult<Bound<'py, PyDict>> {
    let mut meter = match settings.meter.as_str() {
        "frl" => Drapemeter::frl(),
        "cusick-24" => Drapemeter::cusick(0.24),
        "cusick-30" => Drapemeter::cusick(0.3),
        "cusick-36" => Drapemeter::cusick(0.36),
        other => {
            let known = "give one of frl, cusick-24, cusick-30, cusick-36";
            return Err(failure(Kind::Usage, format!("meter={other:?} is none; {known}")));
        }
    };
    meter.protocol.shake = settings.shake.then_some(Shake::BOUNCE);
    let fabric = &fabric.get().0;
    let bound = compute(py, || spacing_bound(fabric))?;
    let spacing = settings.spacing.unwrap_or(bound.min(SPACING_MAX));
    if !(spacing > 0.0) {
        return Err(failure(
            Kind::Usage,
            format!("spacing={spacing}: give a length above 0, in m"),
        ));
    }
    let sampling = Sampling { spacing, starts: settings.starts };
    let fabric = fabric.clone();
    let work = move || meter.study(&fabric, sampling, &|| ());
    let study = Detached::new(None)?.leave(py, work)?;
    let study = study.map_err(|error| failure(Kind::Solver, error))?;
    let found = PyDict::new(py);
    found.set_item("coefficient", study.mean())?;
    found.set_item("deviation", study.deviation())?;
    found.set_item("spacing", spacing)?;
    found.set_item("spacing_bound", bound)?;
    let coefficients: Vec<f64> = study.drapes.iter().map(|drape| drape.coefficient).collect();
    found.set_item("coefficients", row(py, &coefficients)?)?;
    let nodes: Vec<usize> = study.drapes.iter().map(|drape| drape.nodes).collect();
    found.set_item("nodes", nodes)?;
    Ok(found)
}

/// Returns the names of the cases, with whether they take minutes.
#[pyfunction]
pub(crate) fn case_names() -> Vec<(&'static str, bool)> {
    CASES.iter().map(|case| (case.name, case.is_long())).collect()
}

/// Runs a case of the validation; returns its outcome as JSON.
#[pyfunction]
pub(crate) fn validate(py: Python<'_>, name: &str) -> PyResult<String> {
    let Some(case) = CASES.iter().find(|case| case.name == name) else {
        let names: Vec<&str> = CASES.iter().map(|case| case.name).collect();
        let message = format!("{name:?} is no case; give one of {}", names.join(", "));
        return Err(failure(Kind::Usage, message));
    };
    let outcome = Detached::new(None)?.leave(py, || Outcome::run(case, &|_| ()))?;
    let mut value = serde_json::to_value(&outcome).unwrap_or_default();
    value["passes"] = outcome.passes().into();
    Ok(value.to_string())
}
