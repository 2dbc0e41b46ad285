//! Specs of scenes made of Python objects, without a text.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use drape::collide::Triangulation;
use drape::input::Document;
use drape::pattern::Pattern;
use drape::scene::{FileOr, MeshMotion, SceneSpec};
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString};
use toml::{Table, Value};

use crate::array::rows;
use crate::error::{Kind, failure, input};
use crate::fit::{Fabric, restorer};
use crate::threads::compute;

/// Surface of a body, copied from arrays.
#[pyclass(frozen, module = "drape._drape")]
pub(crate) struct Mesh(Arc<Triangulation>);

/// Positions of the vertices of a body from frame to frame, copied from an array.
#[pyclass(frozen, module = "drape._drape")]
pub(crate) struct MeshFrames(Arc<Vec<Vec<[f64; 3]>>>);

/// Function that makes a thing again, and its two arguments.
type Pickled<'py> = (Bound<'py, PyAny>, (Bound<'py, PyAny>, Bound<'py, PyAny>));

#[pymethods]
impl Mesh {
    /// Copies `vertices`, (k, 3), and `faces`, (m, 3), in rows one after the other.
    #[new]
    fn new(
        vertices: PyReadonlyArrayDyn<'_, f64>,
        faces: PyReadonlyArrayDyn<'_, i64>,
    ) -> PyResult<Self> {
        let corner = |corner: i64| u32::try_from(corner).unwrap_or(u32::MAX);
        let (faces, _) = faces.as_slice()?.as_chunks::<3>();
        let triangles = faces.iter().map(|face| face.map(corner)).collect();
        Ok(Self(Arc::new(Triangulation { vertices: points(vertices.as_slice()?), triangles })))
    }

    /// Returns the mesh in the format of Wavefront.
    fn to_obj(&self) -> String {
        self.0.to_obj()
    }

    /// Returns the mesh with the vertices of the frame `number` of `frames` in this format.
    fn frame_to_obj(&self, frames: &MeshFrames, number: usize) -> PyResult<String> {
        let vertices = frames.0.get(number).ok_or_else(|| failure(Kind::Usage, "no such frame"))?;
        let triangles = self.0.triangles.clone();
        Ok(Triangulation { vertices: vertices.clone(), triangles }.to_obj())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Pickled<'py>> {
        let vertices = rows(py, self.0.vertices.as_flattened(), 3)?;
        let triangles = rows(py, self.0.triangles.as_flattened(), 3)?;
        Ok((restorer(py, "mesh")?, (vertices, triangles)))
    }
}

#[pymethods]
impl MeshFrames {
    /// Copies `frames`, (f, k, 3), in rows one after the other, of a mesh with `count` vertices.
    #[new]
    fn new(frames: PyReadonlyArrayDyn<'_, f64>, count: usize) -> PyResult<Self> {
        let frames = frames.as_slice()?.chunks_exact(3 * count.max(1));
        Ok(Self(Arc::new(frames.map(points).collect())))
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Pickled<'py>> {
        let count = self.0.first().map_or(0, Vec::len);
        let numbers = self.0.concat();
        let frames = rows(py, numbers.as_flattened(), 3 * count.max(1))?;
        Ok((restorer(py, "mesh_frames")?, (frames, count.into_pyobject(py)?.into_any())))
    }
}

/// Returns `numbers`, three for each point, as points.
fn points(numbers: &[f64]) -> Vec<[f64; 3]> {
    numbers.as_chunks::<3>().0.to_vec()
}

/// Things that a scene holds in memory, by the names that its keys have for them.
pub(crate) type Held = HashMap<String, Py<PyAny>>;

/// Returns `table`, the keys of a scene, as a document without a text.
pub(crate) fn document(path: &Path, table: &Bound<'_, PyDict>) -> PyResult<Document> {
    Ok(Document::from_table(path, &to_table(table)?))
}

/// Puts the things of `held` into `spec` where their names stand.
pub(crate) fn hold(py: Python<'_>, spec: &mut SceneSpec, held: &Held) -> PyResult<()> {
    for fabric in spec.fabric.values_mut() {
        let Some(value) = fabric.file.file().and_then(|name| held.get(name)) else { continue };
        let value = held_as::<Fabric>(value.bind(py), "a fabric")?;
        fabric.file = FileOr::Value(Arc::new(value.get().0.clone()));
    }
    for garment in &mut spec.garment {
        let name = garment.pattern.file().unwrap_or_default().to_owned();
        let Some(value) = held.get(&name) else { continue };
        let keys = document(Path::new(&name), held_as(value.bind(py), "a pattern")?)?;
        let pattern = compute(py, || Pattern::parse(&keys))?;
        let pattern = pattern.map_err(|mistakes| input(&mistakes))?;
        garment.pattern = FileOr::Value(Arc::new(pattern));
    }
    for mesh in &mut spec.collider.mesh {
        let Some(value) = mesh.file.file().and_then(|name| held.get(name)) else { continue };
        let value = held_as::<Mesh>(value.bind(py), "a mesh")?;
        mesh.file = FileOr::Value(Arc::clone(&value.get().0));
        let frames = mesh.frames.as_deref().and_then(|name| held.get(name));
        let Some(frames) = frames else { continue };
        let value = held_as::<MeshFrames>(frames.bind(py), "frames of a mesh")?;
        let frames = Arc::clone(&value.get().0);
        (mesh.frames, mesh.motion) = (None, Some(MeshMotion::Frames(frames)));
    }
    Ok(())
}

/// Returns what a scene holds as a `T`. The words `wanted` name it.
fn held_as<'a, 'py, T: pyo3::PyTypeCheck>(
    value: &'a Bound<'py, PyAny>,
    wanted: &str,
) -> PyResult<&'a Bound<'py, T>> {
    let of_other_kind = |_| failure(Kind::Usage, format!("{value} stands where {wanted} belongs"));
    value.cast::<T>().map_err(of_other_kind)
}

/// Returns a dictionary as a table.
fn to_table(dictionary: &Bound<'_, PyDict>) -> PyResult<Table> {
    let entries = dictionary.iter();
    entries.map(|(key, value)| Ok((key.extract()?, to_value(&value)?))).collect()
}

/// Returns a number, a text, a list or a dictionary as a value.
fn to_value(value: &Bound<'_, PyAny>) -> PyResult<Value> {
    // A truth value is a number to Python too.
    if let Ok(flag) = value.cast::<PyBool>() {
        Ok(Value::Boolean(flag.is_true()))
    } else if value.is_instance_of::<PyInt>() {
        // A number beyond 64 bits is a number of the other kind.
        let whole = value.extract().map(Value::Integer);
        whole.or_else(|_| value.extract().map(Value::Float))
    } else if value.is_instance_of::<PyFloat>() {
        value.extract().map(Value::Float)
    } else if value.is_instance_of::<PyString>() {
        value.extract().map(Value::String)
    } else if let Ok(list) = value.cast::<PyList>() {
        list.iter().map(|entry| to_value(&entry)).collect::<PyResult<_>>().map(Value::Array)
    } else if let Ok(dictionary) = value.cast::<PyDict>() {
        to_table(dictionary).map(Value::Table)
    } else {
        Err(failure(Kind::Usage, format!("{value} is no value of a scene")))
    }
}
