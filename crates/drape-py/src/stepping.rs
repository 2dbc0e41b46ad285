//! Simulation step by step.

use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};

use drape::collide::Triangulation;
use drape::dynamics::{self, BodyTarget, Displacement};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::array::rows;
use crate::detached::{Detached, Outbox};
use crate::error::{Kind, failure, of_dynamics};
use crate::scene::Scene;

/// Duration of a step above which the state is copied before the next one, which then can be taken
/// back when it is given up.
const LONG_STEP: Duration = Duration::from_millis(200);

/// Simulation of a scene. One thread steps or reads it at a time.
#[pyclass(frozen, module = "drape._drape")]
pub(crate) struct Simulation {
    state: Mutex<State>,
    detached: Detached,
}

/// State of a simulation.
struct State {
    /// The simulation, unless a step was given up that could not be taken back.
    simulation: Option<Box<dynamics::Simulation>>,
    is_long: bool,
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

/// Motion of a body: a shift, in m, and a turn about x, y and z, in degrees, about a centre.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
struct RigidMotion {
    shift: [f64; 3],
    turn: [f64; 3],
    center: Option<[f64; 3]>,
    /// Time that the motion takes, in s.
    seconds: f64,
}

/// Body: name, vertices, triangles.
type Outline<'py> = (String, Bound<'py, PyAny>, Bound<'py, PyAny>);

impl Simulation {
    /// Returns the state, unless another thread has it.
    fn lock(&self) -> PyResult<MutexGuard<'_, State>> {
        match self.state.try_lock() {
            Ok(state) => Ok(state),
            Err(TryLockError::Poisoned(poisoned)) => Ok(PoisonError::into_inner(poisoned)),
            Err(TryLockError::WouldBlock) => {
                let message = "the simulation is in another call: one thread uses it at a time, \
                               and a child of a fork only one that was in no call";
                Err(failure(Kind::Usage, message))
            }
        }
    }

    /// Returns what `read` takes from the simulation.
    fn read<T>(&self, read: impl FnOnce(&dynamics::Simulation) -> PyResult<T>) -> PyResult<T> {
        let state = self.lock()?;
        read(state.simulation.as_deref().ok_or_else(broken)?)
    }

    /// Returns the result of short work with the simulation, which is done on its threads.
    fn compute<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut dynamics::Simulation) -> T + Send,
    ) -> PyResult<T> {
        let mut state = self.lock()?;
        let simulation = state.simulation.as_deref_mut().ok_or_else(broken)?;
        self.detached.threads.compute(py, || work(simulation))
    }
}

/// Returns the exception of a simulation that cannot go on.
fn broken() -> PyErr {
    let message = "a step ended halfway and cannot be taken back; make the simulation anew";
    failure(Kind::Solver, message)
}

#[pymethods]
impl Simulation {
    #[new]
    fn new(py: Python<'_>, scene: &Bound<'_, Scene>, threads: Option<usize>) -> PyResult<Self> {
        let detached = Detached::new(threads)?;
        let scene = scene.get().take(py, None)?;
        let simulation = detached.threads.compute(py, || dynamics::Simulation::new(scene))?;
        let mut simulation = Box::new(simulation.map_err(of_dynamics)?);
        simulation.give_up_when(detached.give_up.clone());
        let state = State { simulation: Some(simulation), is_long: false };
        Ok(Self { state: Mutex::new(state), detached })
    }

    fn step(&self, py: Python<'_>) -> PyResult<StepFields> {
        let mut state = self.lock()?;
        // Threads that cannot be made must not cost the simulation.
        self.detached.threads.pool(py)?;
        let is_long = state.is_long;
        let mut simulation = state.simulation.take().ok_or_else(broken)?;
        let work = move |_: Outbox<()>| {
            let start = is_long.then(|| simulation.saved());
            let began = Instant::now();
            let step = simulation.step();
            (simulation, start, step, began.elapsed())
        };
        let (done, raised) = self.detached.run(py, work, |_, ()| Ok(()))?;
        let (mut simulation, start, step, duration) = done;
        state.is_long = duration >= LONG_STEP;

        // A step that fails has left the last good state, but one that was given up has not.
        if step.is_err() && raised.is_err() {
            if let Some(start) = start {
                let back = self.detached.threads.compute(py, || simulation.resume(start))?;
                back.map_err(of_dynamics)?;
                state.simulation = Some(simulation);
            }
        } else {
            state.simulation = Some(simulation);
        }
        raised?;
        let step = step.map_err(|error| failure(Kind::Solver, error))?;
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
    fn apply_forces(&self, py: Python<'_>, forces: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        let forces = forces.as_slice()?;
        self.compute(py, |simulation| simulation.apply_forces(forces))?.map_err(of_dynamics)
    }

    fn next_step(&self) -> PyResult<f64> {
        self.read(|simulation| Ok(simulation.next_step()))
    }

    /// Leads a body to positions of its vertices, three numbers each, or by the shift and the turn
    /// of `motion`, which says how long it takes.
    fn lead_body(
        &self,
        py: Python<'_>,
        name: &str,
        vertices: Option<PyReadonlyArray1<'_, f64>>,
        motion: RigidMotion,
    ) -> PyResult<()> {
        let RigidMotion { shift, turn, center, seconds } = motion;
        let target = match vertices {
            Some(numbers) => BodyTarget::Vertices(numbers.as_slice()?.as_chunks::<3>().0.to_vec()),
            None => BodyTarget::Rigid(Displacement { shift, turn, center }),
        };
        let led = self.compute(py, |simulation| simulation.lead_body(name, &target, seconds))?;
        led.map_err(of_dynamics)
    }

    /// Names, vertices and triangles of the bodies.
    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Vec<Outline<'py>>> {
        let bodies = self.compute(py, |simulation| simulation.bodies())?;
        let outline = |(name, outline): (String, Triangulation)| {
            let vertices = rows(py, outline.vertices.as_flattened(), 3)?;
            Ok((name, vertices, rows(py, outline.triangles.as_flattened(), 3)?))
        };
        bodies.into_iter().map(outline).collect()
    }

    #[getter]
    fn time(&self) -> PyResult<f64> {
        self.read(|simulation| Ok(simulation.time()))
    }

    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.read(|simulation| rows(py, simulation.positions(), 3))
    }

    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.read(|simulation| rows(py, simulation.velocities(), 3))
    }

    fn triangles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.read(|simulation| rows(py, simulation.triangles().as_flattened(), 3))
    }

    fn coordinates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.read(|simulation| rows(py, simulation.coordinates().as_flattened(), 2))
    }

    /// Summary so far, as JSON.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        let summary = self.compute(py, |simulation| simulation.summary())?;
        serde_json::to_string(&summary).map_err(|error| failure(Kind::Fault, error))
    }

    fn state_hash(&self, py: Python<'_>) -> PyResult<String> {
        self.compute(py, |simulation| simulation.state_hash())
    }

    /// Forces and moments of the pins, a pair of rows.
    fn pin_loads(&self, py: Python<'_>) -> PyResult<Vec<([f64; 3], [f64; 3])>> {
        self.compute(py, |simulation| {
            let loads = simulation.pin_loads();
            loads.iter().map(|load| (load.force, load.moment)).collect()
        })
    }
}
