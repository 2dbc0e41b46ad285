//! Scenes that were read and checked, and their runs.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use drape::dynamics::{self, Energy, Progress, Simulation, Status, Step, Summary};
use drape::frames::Frame;
use drape::input::{Document, FileAccess};
use drape::run::file::FileKind;
use drape::run::{
    FolderRun, Goal, Limits, PlacedSpec, ReachedLimit, ResumableRun, RunOptions, RunRequest,
    Watcher, end_at, scene_document,
};
use drape::scene::SceneSpec;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::array::rows;
use crate::detached::{Detached, Outbox};
use crate::error::{Kind, failure, input, of_dynamics, of_run, of_scene, warn};
use crate::fit::restorer;
use crate::remedy;
use crate::spec::{self, Held};
use crate::threads::compute;

/// Scene that was read and checked.
#[pyclass(frozen, module = "drape._drape")]
pub(crate) struct Scene {
    origin: Origin,
    /// File that it was read from; a text has none.
    file: Option<PathBuf>,
    name: String,
    particles: usize,
    panels: Vec<(String, usize, usize)>,
    notes: Vec<String>,
    /// Keys of the specification that the scene was made of; a scene from a text has none.
    keys: Option<SceneKeys>,
    /// Working folder when it was made.
    working_folder: PathBuf,
    /// The scene as it was checked, until a run takes it. Only a thread with the lock of the
    /// interpreter holds this lock, so that a child of a fork never finds it held.
    checked: Mutex<Option<drape::scene::Scene>>,
}

/// What a scene is made of.
enum Origin {
    /// Text.
    Text(Box<Document>),
    /// Spec that was made of keys.
    Spec(Box<PlacedSpec>),
}

impl Origin {
    /// Checks the scene.
    fn check(&self) -> PyResult<drape::scene::Scene> {
        match self {
            Self::Text(document) => drape::run::scene_of(document),
            Self::Spec(placed) => drape::run::scene_of_spec(placed),
        }
        .map_err(of_scene)
    }
}

/// Keys of a scene that was built in Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct SceneKeys {
    /// The keys, which nothing changes any more. Names of `held` in it stand for the things that
    /// `held` has.
    table: Py<PyDict>,
    held: Held,
    /// Folder from which files are seen.
    folder: PathBuf,
    /// Files and folders elsewhere that the scene may name.
    allow: Vec<PathBuf>,
}

/// Place of the text of a scene.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct TextPlace {
    /// Path beside which the files are that the text names.
    path: PathBuf,
    /// Files and folders elsewhere that the text may name.
    allow: Vec<PathBuf>,
    /// Whether a file with this path has the text.
    has_file: bool,
}

/// Settings of a run.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct RunSettings {
    output: Option<PathBuf>,
    until: Option<f64>,
    threads: Option<usize>,
    replace: bool,
    checkpoint_every: f64,
    state_hash: bool,
    max_wall: Option<f64>,
    extend: Option<f64>,
    /// File of the extension module: a run goes on only with the same one.
    program: PathBuf,
    progress: Option<Py<PyAny>>,
    on_frame: Option<Py<PyAny>>,
}

/// What a run tells.
enum Event {
    Step { time: f64, done: f64, phase: String, speed_max: f64, iterations: usize },
    Frame { number: usize, time: f64, positions: Vec<f64> },
}

/// Reporter of a run: what hands its events over.
struct Reporter {
    outbox: Outbox<Event>,
    /// Whether the run is to end.
    stop: Arc<AtomicBool>,
    steps: bool,
    frames: bool,
}

impl Watcher for Reporter {
    fn step(&mut self, step: &Step, done: f64) {
        if self.steps {
            let phase = serde_json::to_value(step.phase).unwrap_or_default();
            self.outbox.send(Event::Step {
                time: step.time,
                done,
                phase: phase.as_str().unwrap_or_default().to_owned(),
                speed_max: step.speed_max,
                iterations: step.report.iterations,
            });
        }
    }

    fn frame(&mut self, frame: &Frame) {
        if self.frames {
            let (number, time) = (frame.number, frame.time);
            let positions = frame.cloth.as_flattened().to_vec();
            self.outbox.send(Event::Frame { number, time, positions });
        }
    }

    fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Progress of a run that stores nothing.
struct Unkept {
    reporter: Reporter,
    goal: Goal,
    limits: Limits,
    begin: Instant,
}

impl Unkept {
    /// Returns the limit that the run has reached. No results are stored, so that no folder counts.
    fn reached(&self) -> Option<ReachedLimit> {
        self.limits.reached(self.begin, Path::new(""))
    }
}

impl Progress for Unkept {
    fn step(&mut self, step: &Step, _ticks: usize) {
        let done = self.goal.done(step);
        self.reporter.step(step, done);
    }

    fn frame(&mut self, frame: &Frame, _: Option<&Energy>) -> Result<(), dynamics::Error> {
        self.reporter.frame(frame);
        Ok(())
    }

    fn is_interrupted(&self) -> bool {
        self.reporter.is_interrupted() || self.reached().is_some()
    }
}

impl RunSettings {
    fn run_options(&self, detached: &Detached) -> PyResult<RunOptions> {
        if !(self.checkpoint_every >= 0.0 && self.checkpoint_every <= 1e9) {
            let message =
                format!("checkpoint_every={}: give a time from 0 to 1e9 s", self.checkpoint_every);
            return Err(failure(Kind::Usage, message));
        }
        Ok(RunOptions {
            limits: Limits { max_wall: self.max_wall, ..Limits::default() },
            program: self.program.clone(),
            replace: self.replace,
            give_up: detached.give_up.clone(),
        })
    }

    /// Executes `run` on the threads of `detached`. The callbacks receive the events of the run.
    /// Returns the summary as JSON.
    fn execute(
        &self,
        py: Python<'_>,
        detached: &Detached,
        run: impl FnOnce(Reporter) -> Result<Summary, drape::run::Error> + Send + 'static,
    ) -> PyResult<String> {
        let (steps, frames) = (self.progress.is_some(), self.on_frame.is_some());
        let stop = detached.stop.clone();
        let work = move |outbox| run(Reporter { outbox, stop, steps, frames });
        let (summary, raised) = detached.run(py, work, |py, event| self.handle(py, event))?;
        raised?;
        let summary = summary.map_err(of_run)?;
        serde_json::to_string(&summary).map_err(|error| failure(Kind::Fault, error))
    }

    fn handle(&self, py: Python<'_>, event: Event) -> PyResult<()> {
        match (event, &self.progress, &self.on_frame) {
            (Event::Step { time, done, phase, speed_max, iterations }, Some(progress), _) => {
                progress.call1(py, (time, done, phase, speed_max, iterations))?;
            }
            (Event::Frame { number, time, positions }, _, Some(on_frame)) => {
                on_frame.call1(py, (number, time, rows(py, &positions, 3)?))?;
            }
            _ => {}
        }
        Ok(())
    }
}

impl Scene {
    fn new(origin: Origin, file: Option<PathBuf>) -> PyResult<Self> {
        let scene = origin.check()?;
        let panels = scene.panels.iter().map(|panel| {
            let range = panel.particles();
            (panel.name.clone(), range.start, range.end)
        });
        let notes = scene.source.notes.iter().chain(&scene.source.contact_limits);
        Ok(Self {
            name: scene.name.clone(),
            particles: scene.cloth.particle_count(),
            panels: panels.collect(),
            notes: notes.map(|note| note.in_words(remedy::in_words)).collect(),
            keys: None,
            working_folder: std::env::current_dir().unwrap_or_default(),
            checked: Mutex::new(Some(scene)),
            origin,
            file,
        })
    }

    /// Returns the scene as it was checked, or reads it again where a run has taken that.
    pub(crate) fn take(&self, py: Python<'_>, until: Option<f64>) -> PyResult<drape::scene::Scene> {
        let checked = self.checked.lock().unwrap_or_else(PoisonError::into_inner).take();
        let mut scene = match checked {
            Some(scene) => scene,
            None => compute(py, || self.origin.check())??,
        };
        if let Some(end) = until {
            // A scene that is refused is checked still.
            end_at(&mut scene, end).map_err(of_run)?;
        }
        Ok(scene)
    }
}

#[pymethods]
impl Scene {
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf, allow: Vec<PathBuf>) -> PyResult<Self> {
        compute(py, || {
            FileKind::expect(&path, &[FileKind::Scene]).map_err(|mistakes| input(&mistakes))?;
            let document = Document::read(&path).map_err(|mistakes| input(&mistakes))?;
            Self::new(Origin::Text(Box::new(document.allowing(&allow))), Some(path))
        })?
    }

    /// Makes a scene of a `text` that belongs to `place`.
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: String, place: TextPlace) -> PyResult<Self> {
        let TextPlace { path, allow, has_file } = place;
        let document = Document::new(&path, text).allowing(&allow);
        let origin = Origin::Text(Box::new(document));
        compute(py, || Self::new(origin, has_file.then_some(path)))?
    }

    /// Makes a scene of `keys`.
    #[staticmethod]
    fn from_keys(py: Python<'_>, keys: SceneKeys) -> PyResult<Self> {
        let access = FileAccess { allowed: keys.allow.clone(), ..FileAccess::default() };
        let document = spec::document(Path::new(""), keys.table.bind(py))?;
        let decoded = compute(py, || SceneSpec::with_faults(&document))?;
        let (mut spec, faults) = decoded.map_err(|mistakes| input(&mistakes))?;
        spec::hold(py, &mut spec, &keys.held)?;
        let placed = PlacedSpec { spec, faults, folder: keys.folder.clone(), access };
        let origin = Origin::Spec(Box::new(placed));
        let scene = compute(py, || Self::new(origin, None))??;
        Ok(Self { keys: Some(keys), ..scene })
    }

    /// Pickles the scene as its text or its keys, with the paths of its files from the root. Files
    /// that it names are not part of it.
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let whole = |path: &PathBuf| self.working_folder.join(path);
        let allowing = |allow: &[PathBuf]| -> Vec<PathBuf> {
            allow.iter().map(whole).chain([self.working_folder.clone()]).collect()
        };
        match (&self.origin, &self.keys) {
            (Origin::Text(document), _) => {
                let path = whole(&document.path().to_owned());
                let allow = allowing(&document.access().allowed);
                let place = PyDict::new(py);
                place.set_item("path", path)?;
                place.set_item("allow", allow)?;
                place.set_item("has_file", self.file.is_some())?;
                Ok((restorer(py, "scene")?, (document.text(), place).into_pyobject(py)?))
            }
            (Origin::Spec(_), Some(SceneKeys { table, held, folder, allow })) => {
                let keys = PyDict::new(py);
                keys.set_item("table", table)?;
                keys.set_item("held", held)?;
                keys.set_item("folder", whole(folder))?;
                keys.set_item("allow", allowing(allow))?;
                Ok((restorer(py, "built_scene")?, (keys,).into_pyobject(py)?))
            }
            (Origin::Spec(_), None) => Err(failure(Kind::Fault, "a scene without its keys")),
        }
    }

    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    #[getter]
    fn particles(&self) -> usize {
        self.particles
    }

    fn panels(&self) -> Vec<(String, usize, usize)> {
        self.panels.clone()
    }

    fn notes(&self) -> Vec<String> {
        self.notes.clone()
    }

    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        match &self.origin {
            Origin::Text(document) => Ok(document.text().to_owned()),
            Origin::Spec(placed) => compute(py, || placed.spec.to_toml())?.map_err(|error| {
                failure(Kind::Usage, format!("{error}, with SceneBuilder.save(path)"))
            }),
        }
    }

    /// Runs the scene; returns its summary as JSON.
    fn run(&self, py: Python<'_>, settings: RunSettings) -> PyResult<String> {
        let detached = Detached::new(settings.threads)?;
        let run_options = settings.run_options(&detached)?;
        let scene = self.take(py, settings.until)?;
        let Some(folder) = &settings.output else {
            let made = detached.threads.compute(py, || {
                let simulation = Simulation::new(scene)?;
                let goal = Goal::new(&simulation);
                Ok((simulation, goal))
            });
            let (mut simulation, goal) = made?.map_err(of_dynamics)?;
            simulation.give_up_when(detached.give_up.clone());
            if settings.state_hash {
                simulation.hash_steps();
            }
            let begin = Instant::now();
            return settings.execute(py, &detached, move |reporter| {
                let mut unkept = Unkept { reporter, goal, limits: run_options.limits, begin };
                let mut summary = simulation.run(&mut unkept)?;
                if summary.status == Status::Interrupted {
                    summary.reason = unkept.reached().map(|limit| limit.to_string());
                }
                Ok(summary)
            });
        };
        let file = match (&self.file, &self.origin) {
            (Some(file), _) => file.clone(),
            (None, Origin::Spec(_)) => PlacedSpec::stored_path(folder),
            (None, Origin::Text(_)) => PathBuf::from("-"),
        };
        let request = RunRequest {
            state_hash: settings.state_hash,
            ..RunRequest::new(&file, settings.until, settings.checkpoint_every)
        };
        let begun = detached.threads.compute(py, || {
            let run = FolderRun::begin(scene, folder, &request, &run_options)?;
            if let Origin::Spec(placed) = &self.origin {
                placed.store(folder)?;
            }
            Ok(run)
        });
        let run = begun?.map_err(of_run)?;
        settings.execute(py, &detached, |mut reporter| Ok(run.run(&mut reporter)?.close()))
    }
}

/// Goes on with the run of a folder; returns its summary as JSON.
#[pyfunction]
pub(crate) fn resume(
    py: Python<'_>,
    folder: PathBuf,
    scene: Option<&Bound<'_, Scene>>,
    settings: RunSettings,
) -> PyResult<String> {
    let detached = Detached::new(settings.threads)?;
    let opened = detached.threads.compute(py, || ResumableRun::open(&folder, settings.extend))?;
    let resumed = opened.map_err(of_run)?;
    let scene = match scene {
        Some(scene) => scene.get().take(py, resumed.request.until)?,
        None if resumed.request.has_no_file() => {
            let message = "the scene was a text, which has no file: give it again, with scene=";
            return Err(failure(Kind::Usage, message));
        }
        None => {
            let path = &resumed.request.scene;
            let read = compute(py, || {
                let document = scene_document(path, &folder);
                let document = document.map_err(|mistakes| input(&mistakes))?;
                Scene::new(Origin::Text(Box::new(document)), Some(path.clone()))
            });
            read??.take(py, resumed.request.until)?
        }
    };
    let run_options = settings.run_options(&detached)?;
    let gone_on = detached.threads.compute(py, || resumed.go_on(scene, &run_options))?;
    let (run, notes) = gone_on.map_err(of_run)?;
    for note in &notes {
        warn(py, note)?;
    }
    settings.execute(py, &detached, |mut reporter| Ok(run.run(&mut reporter)?.close()))
}
