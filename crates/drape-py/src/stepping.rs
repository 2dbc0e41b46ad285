//! Simulation step by step.

use std::time::{Duration, Instant};

use drape::collide::Triangulation;
use drape::dynamics::{self, BodyTarget, Displacement};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::array::rows;
use crate::detached::{Detached, Outbox};
use crate::error::{Kind, failure, of_dynamics};
use crate::scene::Scene;

/// Duration of a step above which the state is copied before the next one, which then can be taken
/// back when it is given up.
const LONG_STEP: Duration = Duration::from_millis(200);

/// Simulation of a scene. One thread steps or reads it at a time.
#[pyclass(module = "drape._drape")]
pub(crate) struct Simulation {
    simulation: dynamics::Simulation,
    detached: Detached,
    is_long: bool,
    /// Whether a step was given up that could not be taken back.
    is_broken: bool,
}

/// Step, as the keywords of `drape.Step`.
#[derive(IntoPyObject)]
struct StepFields {
    time: f64,
    dt: f64,
    speed_max: f64,
    imbalance: f64,
    iterations: usize,
    finished: bool,
    phase: String,
    events: Vec<String>,
}

/// Motion of a rigid body: a shift, in m, and a turn about x, y and z, in degrees, about a centre.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct RigidMotion {
    shift: [f64; 3],
    turn: [f64; 3],
    center: Option<[f64; 3]>,
}

/// Body: name, vertices, triangles.
type Outline<'py> = (String, Bound<'py, PyAny>, Bound<'py, PyAny>);

impl Simulation {
    fn check(&self) -> PyResult<()> {
        if self.is_broken {
            let message =
                "a step was interrupted and cannot be taken back; make the simulation anew";
            return Err(failure(Kind::Solver, message));
        }
        Ok(())
    }
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(scene: &Bound<'_, Scene>, threads: Option<usize>) -> PyResult<Self> {
        let detached = Detached::new(threads)?;
        let scene = scene.get().take(None)?;
        let mut simulation = dynamics::Simulation::new(scene).map_err(of_dynamics)?;
        simulation.give_up_when(detached.give_up.clone());
        Ok(Self { simulation, detached, is_long: false, is_broken: false })
    }

    fn step(&mut self, py: Python<'_>) -> PyResult<StepFields> {
        self.check()?;
        let Self { simulation, detached, is_long, is_broken } = self;
        let start = is_long.then(|| simulation.saved());
        let began = Instant::now();
        let work = |_: &Outbox<()>| simulation.step();
        let (step, raised) = detached.run(py, work, |_, ()| Ok(()));
        *is_long = began.elapsed() >= LONG_STEP;
        let step = match step {
            Ok(step) => step,
            Err(error) => {
                let was_cancelled = raised.is_err();
                if was_cancelled {
                    *is_broken = true;
                    if let Some(start) = start {
                        simulation.resume(start).map_err(of_dynamics)?;
                        *is_broken = false;
                    }
                }
                raised?;
                return Err(failure(Kind::Solver, error));
            }
        };
        raised?;
        let phase = serde_json::to_value(step.phase).unwrap_or_default();
        Ok(StepFields {
            time: step.time,
            dt: step.dt,
            speed_max: step.speed_max,
            imbalance: step.imbalance,
            iterations: step.report.iterations,
            finished: step.finished,
            phase: phase.as_str().unwrap_or_default().to_owned(),
            events: step.events,
        })
    }

    /// Lets forces act from now on, three numbers for each particle; none without numbers.
    fn apply_forces(&mut self, forces: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        self.check()?;
        self.simulation.apply_forces(forces.as_slice()?).map_err(of_dynamics)
    }

    fn next_step(&self) -> f64 {
        self.simulation.next_step()
    }

    /// Leads a body to positions of its vertices, three numbers each, or by a rigid motion.
    fn lead_body(
        &mut self,
        name: &str,
        vertices: Option<PyReadonlyArray1<'_, f64>>,
        rigid: RigidMotion,
        seconds: f64,
    ) -> PyResult<()> {
        self.check()?;
        let RigidMotion { shift, turn, center } = rigid;
        let target = match vertices {
            Some(numbers) => BodyTarget::Vertices(numbers.as_slice()?.as_chunks::<3>().0.to_vec()),
            None => BodyTarget::Rigid(Displacement { shift, turn, center }),
        };
        self.simulation.lead_body(name, &target, seconds).map_err(of_dynamics)
    }

    /// Names, vertices and triangles of the bodies.
    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Vec<Outline<'py>>> {
        self.check()?;
        let outline = |(name, outline): (String, Triangulation)| {
            let vertices = rows(py, outline.vertices.as_flattened(), 3)?;
            Ok((name, vertices, rows(py, outline.triangles.as_flattened(), 3)?))
        };
        self.simulation.bodies().into_iter().map(outline).collect()
    }

    #[getter]
    fn time(&self) -> f64 {
        self.simulation.time()
    }

    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.check()?;
        rows(py, self.simulation.positions(), 3)
    }

    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.check()?;
        rows(py, self.simulation.velocities(), 3)
    }

    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.simulation.triangles().as_flattened(), 3)
    }

    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        rows(py, self.simulation.coordinates().as_flattened(), 2)
    }

    /// Summary so far, as JSON.
    fn summary(&self) -> PyResult<String> {
        self.check()?;
        let summary = self.detached.install(|| self.simulation.summary());
        serde_json::to_string(&summary).map_err(|error| PyRuntimeError::new_err(error.to_string()))
    }

    fn state_hash(&self) -> PyResult<String> {
        self.check()?;
        Ok(self.simulation.state_hash())
    }

    /// Forces and moments of the pins, a pair of rows.
    fn pin_loads(&mut self) -> PyResult<Vec<([f64; 3], [f64; 3])>> {
        self.check()?;
        let loads = self.simulation.pin_loads();
        Ok(loads.iter().map(|load| (load.force, load.moment)).collect())
    }
}
