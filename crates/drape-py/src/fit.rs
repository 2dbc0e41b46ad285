//! Sheets, fabrics, and fits of fabrics to sheets.

use std::ffi::CString;
use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use drape::fit::{
    FitSettings, FittedSheet, Intervals, LoopModel, TractionModel, identify_all, identify_with,
    parameter_key,
};
use drape::input::{Diagnostic, Document};
use drape::kes::{Model, SheetDraft};
use drape::material::Material;
use drape::report::FitPage;
use drape::run::file::FileKind;
use drape::run::reports::fit_page;
use pyo3::exceptions::PyFutureWarning;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array::row;
use crate::detached::Detached;
use crate::error::{Kind, failure, input, mistake};
use crate::threads::compute;

/// Kinds of files that are read as sheets; of exports the reader says what is wrong.
const SHEETS: [FileKind; 4] =
    [FileKind::Sheet, FileKind::Table, FileKind::Workbook, FileKind::Archive];

/// Latest time that an archive can have, since 1970.
const LATEST: Duration = Duration::from_secs(1 << 32);

/// Tables of `fabric.toml` that hold laws.
const LAWS: [&str; 3] = ["warp", "weft", "shear"];

/// Sheet of a laboratory.
#[pyclass(frozen, module = "drape._drape")]
pub(crate) struct Sheet(drape::kes::Sheet);

/// Fabric: laws in SI.
#[pyclass(frozen, module = "drape._drape")]
pub(crate) struct Fabric(pub(crate) drape::fabric::Fabric);

/// Fit of a fabric to a sheet.
#[pyclass(frozen, module = "drape._drape")]
pub(crate) struct Fit {
    fit: drape::fit::Fit,
    page: FitPage,
}

/// Laws that a fit is asked for, by the names of the command line.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Laws {
    traction: Option<String>,
    bending: Option<String>,
    shear: Option<String>,
    profile: bool,
}

impl Laws {
    /// Returns the settings that the laws name. Warns about former names.
    fn settings(&self, py: Python<'_>) -> PyResult<FitSettings> {
        Ok(FitSettings {
            traction: traction_model(self.traction.as_deref())?,
            bending: loop_model(py, "bending", self.bending.as_deref())?,
            shear: loop_model(py, "shear", self.shear.as_deref())?,
            intervals: if self.profile { Intervals::Profile } else { Intervals::Wald },
            ..FitSettings::default()
        })
    }
}

/// Returns the traction law with the `name`.
fn traction_model(name: Option<&str>) -> PyResult<Option<TractionModel>> {
    let Some(name) = name else { return Ok(None) };
    match TractionModel::named(name) {
        Some(model) => Ok(Some(model)),
        None => Err(unknown("traction", name, &TractionModel::ALL.map(TractionModel::name))),
    }
}

/// Returns the law of the loops of `test` with the `name`. Warns about a former name.
fn loop_model(py: Python<'_>, test: &str, name: Option<&str>) -> PyResult<Option<LoopModel>> {
    let Some(name) = name else { return Ok(None) };
    let Some(law) = Model::named(name) else {
        return Err(unknown(test, name, &Model::ALL.map(Model::name)));
    };

    // The warning names the line that calls `drape.fit` or `drape.fit_all`.
    if let Some(note) = Model::note_on(name) {
        let note = CString::new(format!("{test}: {note}"))?;
        PyErr::warn(py, &py.get_type::<PyFutureWarning>(), &note, 2)?;
    }
    Ok(Some(law.into()))
}

fn unknown(test: &str, law: &str, known: &[&str]) -> PyErr {
    let known = known.join(", ");
    failure(Kind::Usage, format!("{test}={law:?} is no law; give one of {known}"))
}

/// Adds the numbers in a value of TOML, each with its key.
fn flatten(key: String, value: toml::Value, to: &mut Vec<(String, f64)>) {
    match value {
        toml::Value::Float(number) => to.push((key, number)),
        toml::Value::Integer(number) => to.push((key, number as f64)),
        toml::Value::Table(table) => {
            table.into_iter().for_each(|(name, value)| flatten(format!("{key}.{name}"), value, to));
        }
        toml::Value::Array(values) => {
            let values = values.into_iter().enumerate();
            values.for_each(|(index, value)| flatten(format!("{key}[{index}]"), value, to));
        }
        _ => {}
    }
}

/// Returns the function of `drape._pickled` with the `name`, which makes a thing again.
pub(crate) fn restorer<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("drape._pickled")?.getattr(name)
}

fn of_sheet(error: drape::kes::Error, file: &str) -> PyErr {
    match error {
        drape::kes::Error::Input(mistakes) => input(&mistakes),
        other => mistake(Diagnostic::new(file, other.to_string())),
    }
}

#[pymethods]
impl Sheet {
    #[staticmethod]
    #[pyo3(signature = (path, fabric=None))]
    fn read(py: Python<'_>, path: PathBuf, fabric: Option<&str>) -> PyResult<Self> {
        let sheet = compute(py, || {
            FileKind::expect(&path, &SHEETS)?;
            SheetDraft::sheet(&path, fabric)
        })?;
        sheet.map(Self).map_err(|error| of_sheet(error, &path.display().to_string()))
    }

    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str, folder: PathBuf) -> PyResult<Self> {
        let document = Document::new(folder.join("<text>"), text);
        let sheet = compute(py, || drape::kes::Sheet::from_document(&document))?;
        sheet.map(Self).map_err(|error| of_sheet(error, "<text>"))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    #[getter]
    fn source(&self) -> &str {
        &self.0.source
    }

    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        compute(py, || self.0.warnings().iter().map(ToString::to_string).collect())
    }

    fn readings(&self) -> Vec<String> {
        self.0.readings().to_vec()
    }

    fn fit(&self, py: Python<'_>, laws: Laws) -> PyResult<Fit> {
        let (settings, sheet) = (laws.settings(py)?, self.0.clone());
        let work = move || {
            let fit = identify_with(&sheet, &settings).map_err(|error| error.to_string())?;
            Fit::new(&sheet, fit, &settings)
        };
        let fit = Detached::new(None)?.leave(py, work)?;
        fit.map_err(|error| mistake(Diagnostic::new(&self.0.name, error)))
    }
}

impl Fit {
    /// Returns a fit with its page.
    fn new(
        sheet: &drape::kes::Sheet,
        fit: drape::fit::Fit,
        settings: &FitSettings,
    ) -> Result<Self, String> {
        let page = fit_page(sheet, &fit, settings);
        page.check().map_err(|error| error.to_string())?;
        Ok(Self { fit, page })
    }
}

/// Reason why a sheet of many has no fit.
enum NoFit {
    Sheet(drape::kes::Error),
    Fit(String),
}

impl From<drape::fit::Error> for NoFit {
    fn from(error: drape::fit::Error) -> Self {
        Self::Fit(error.to_string())
    }
}

/// Fits the sheets of some paths on all threads; returns the fit of each, or its exception.
#[pyfunction]
pub(crate) fn fit_all(py: Python<'_>, paths: Vec<PathBuf>, laws: Laws) -> PyResult<Vec<Py<PyAny>>> {
    let settings = laws.settings(py)?;
    let work = move || {
        let read = |path: &PathBuf| SheetDraft::sheet(path, None).map_err(NoFit::Sheet);
        identify_all(&paths, &settings, read, |path, found| {
            let fit = found.and_then(|FittedSheet { sheet, fit }| {
                Fit::new(sheet, fit.clone(), &settings).map_err(NoFit::Fit)
            });
            (path.clone(), fit)
        })
    };
    let fits = Detached::new(None)?.leave(py, work)?;
    let result = |(path, fit): (PathBuf, Result<Fit, NoFit>)| match fit {
        Ok(fit) => Ok(Py::new(py, fit)?.into_any()),
        Err(NoFit::Sheet(error)) => {
            Ok(of_sheet(error, &path.display().to_string()).into_value(py).into_any())
        }
        Err(NoFit::Fit(error)) => {
            Ok(mistake(Diagnostic::new(&path, error)).into_value(py).into_any())
        }
    };
    fits.into_iter().map(result).collect()
}

#[pymethods]
impl Fabric {
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let fabric = compute(py, || {
            FileKind::expect(&path, &[FileKind::Fabric])?;
            drape::fabric::Fabric::from_document(&Document::read(&path)?)
        })?;
        fabric.map(Self).map_err(|mistakes| input(&mistakes))
    }

    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        let document = Document::new("<text>", text);
        let fabric = compute(py, || drape::fabric::Fabric::from_document(&document))?;
        fabric.map(Self).map_err(|mistakes| input(&mistakes))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    #[getter]
    fn density(&self) -> f64 {
        self.0.density
    }

    #[getter]
    fn thickness(&self) -> f64 {
        self.0.thickness
    }

    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        compute(py, || self.0.to_toml())
    }

    /// Pickles the fabric as its text, which has all bits of its numbers.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        Ok((restorer(py, "fabric")?, (self.to_toml(py)?,)))
    }

    /// Bytes of the fabric as the material of another program, and what its numbers lose.
    ///
    /// `load`, in N/m, is that at which the stretch is read; `modified` is the time of the fabric,
    /// in s since 1970.
    fn material(
        &self,
        py: Python<'_>,
        program: &str,
        load: f64,
        modified: f64,
    ) -> PyResult<(Vec<u8>, Vec<String>)> {
        let material = compute(py, || Material::from_fabric(&self.0, load))?;
        let material = material.map_err(|error| failure(Kind::Usage, error))?;
        let since = Duration::try_from_secs_f64(modified).unwrap_or_default();
        let modified = SystemTime::UNIX_EPOCH + since.min(LATEST);
        let bytes = match program {
            "blender" => material.to_blender().into(),
            "ppf" => material.to_ppf().into(),
            "browzwear" => material.to_browzwear().into(),
            "u3m" => material.to_u3m(modified).into(),
            "u3ma" => material.to_u3ma(modified),
            other => {
                let known = "blender, ppf, browzwear, u3m, u3ma";
                let message = format!("program={other:?} is not known; give one of {known}");
                return Err(failure(Kind::Usage, message));
            }
        };
        Ok((bytes, material.losses))
    }

    /// Numbers of the laws, with their keys in `fabric.toml`.
    fn numbers(&self, py: Python<'_>) -> PyResult<Vec<(String, f64)>> {
        let parsed = compute(py, || self.0.to_toml().parse::<toml::Table>())?;
        let table = parsed.map_err(|error| failure(Kind::Fault, error))?;
        let laws = table.into_iter().filter(|(key, _)| LAWS.contains(&key.as_str()));
        let mut numbers = Vec::new();
        laws.for_each(|(key, value)| flatten(key, value, &mut numbers));
        Ok(numbers)
    }
}

#[pymethods]
impl Fit {
    #[getter]
    fn fabric(&self) -> Fabric {
        Fabric(self.fit.fabric.clone())
    }

    fn assumed(&self) -> Vec<String> {
        self.fit.assumed.clone()
    }

    fn warnings(&self) -> Vec<String> {
        self.page.warnings.clone()
    }

    fn text(&self, py: Python<'_>) -> PyResult<String> {
        compute(py, || self.page.to_text())?.map_err(|error| failure(Kind::Output, error))
    }

    fn html(&self, py: Python<'_>) -> PyResult<String> {
        compute(py, || self.page.to_html())?.map_err(|error| failure(Kind::Output, error))
    }

    /// Curves with their laws, a dictionary each.
    fn curves<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let laws = self.fit.curves.iter().zip(&self.page.laws);
        laws.map(|(curve, law)| {
            let (test, direction) = (curve.test, curve.direction);
            let entry = PyDict::new(py);
            entry.set_item("name", &law.title)?;
            entry.set_item("test", format!("{test:?}").to_lowercase())?;
            entry.set_item("direction", format!("{direction:?}").to_lowercase())?;
            entry.set_item("model", &law.model)?;
            entry.set_item("misfit", curve.misfit)?;
            entry.set_item("r_squared", curve.r_squared)?;
            for (key, numbers) in [
                ("deformation", &curve.deformation),
                ("measured", &curve.measured),
                ("fitted", &curve.load),
                ("band", &curve.band),
            ] {
                entry.set_item(key, row(py, numbers)?)?;
            }
            let shown = curve.parameters.iter().zip(&law.parameters).enumerate();
            let parameters: PyResult<Vec<_>> = shown
                .map(|(index, (estimate, shown))| {
                    let parameter = PyDict::new(py);
                    parameter.set_item("name", estimate.name)?;
                    parameter.set_item("symbol", &shown.symbol)?;
                    parameter.set_item("unit", &shown.units.si)?;
                    parameter.set_item("key", parameter_key(test, direction, estimate.name))?;
                    parameter.set_item("value", estimate.value)?;
                    parameter.set_item("stderr", estimate.standard_error.as_ref().ok())?;
                    parameter.set_item("interval", estimate.interval.as_ref().ok())?;
                    let reason = estimate.standard_error.as_ref().err().map(ToString::to_string);
                    parameter.set_item("reason", reason)?;
                    parameter.set_item("correl", curve.correlations.get(index))?;
                    Ok(parameter)
                })
                .collect();
            entry.set_item("parameters", parameters?)?;
            Ok(entry)
        })
        .collect()
    }
}
